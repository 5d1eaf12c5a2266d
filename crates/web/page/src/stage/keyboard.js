// The keyboard on a pane: a cursor of one cell that draws walls and puts the ends, and the keys of view and
// tools.

import { landOf } from "../model/land.js";

/** @typedef {import("./stage.js").Stage} Stage */
/** @typedef {import("./pane.js").Pane} Pane */

/** @type {Record<string, [number, number]>} */
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
/** @type {import("../../types.d.ts").Tool[]} */
const TOOLS = ["move", "draw", "erase", "fill", "rectangle"];
const FAR = 8;

export class Keyboard {
  /** While a key is held that draws: the key, and what it makes of cells. @type {{ key: string, paint:
   *  (cells: number[]) => void } | null} */
  #drawing = null;
  #version = 0;

  /** @param {Stage} stage */
  constructor(stage) {
    this.stage = stage;
  }

  /** @param {Pane} pane */
  listen(pane) {
    const { surface } = pane;
    surface.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      if (!this.#press(pane, event)) return;
      event.preventDefault();
    });
    surface.addEventListener("keyup", (event) => {
      if (event.key === this.#drawing?.key) this.#stop();
    });
    surface.addEventListener("focus", () => {
      // A pointer brings the focus too; then no cursor is needed.
      if (surface.matches(":focus-visible")) this.#show();
    });
    surface.addEventListener("blur", () => {
      this.#stop();
      this.stage.soil("top");
    });
  }

  /** Returns whether the key means something here. @param {Pane} pane @param {KeyboardEvent} event */
  #press(pane, event) {
    const { stage } = this;
    const { key } = event;
    const arrow = ARROWS[key];
    if (arrow) {
      this.#go(arrow, event.shiftKey ? FAR : 1);
      return true;
    }
    const tool = TOOLS[Number(key) - 1];
    if (tool) {
      stage.tool = tool;
      return true;
    }
    if (key === " " || key === "Enter") return this.#draw(key, event.repeat);
    if (key === "Escape") return this.#leave();
    if (key === "0") stage.fit();
    else if (key === "+" || key === "=") this.#zoom(pane, 1.25);
    else if (key === "-") this.#zoom(pane, 0.8);
    else if (key === "s" || key === "S") this.#put("start");
    else if (key === "g" || key === "G") this.#put("goal");
    else return false;
    return true;
  }

  #show() {
    this.stage.cursor.isShown = true;
    this.stage.soil("top");
  }

  /** @param {[number, number]} direction @param {number} steps */
  #go([dx, dy], steps) {
    const { cursor, model, view } = this.stage;
    if (!cursor.isShown) {
      // The first key only shows where the cursor is.
      view.reveal(cursor.x, cursor.y);
      this.stage.moved();
      this.#show();
      this.#tell();
      return;
    }
    const cells = [];
    for (let i = 0; i < steps; i++) {
      cursor.x = Math.min(model.width - 1, Math.max(0, cursor.x + dx));
      cursor.y = Math.min(model.height - 1, Math.max(0, cursor.y + dy));
      cells.push(cursor.y * model.width + cursor.x);
    }
    this.#drawing?.paint(cells);
    const before = [view.x, view.y];
    view.reveal(cursor.x, cursor.y);
    if (view.x !== before[0] || view.y !== before[1]) this.stage.moved();
    this.#show();
    this.#tell();
  }

  /** @param {string} key @param {boolean} isRepeat */
  #draw(key, isRepeat) {
    const { cursor, model, pointer } = this.stage;
    if (pointer.isSpaceDown) return true;
    if (!cursor.isShown) {
      this.#go([0, 0], 0);
      return true;
    }
    if (isRepeat || this.#drawing) return true;
    const cell = cursor.y * model.width + cursor.x;
    this.#drawing = { key, paint: this.#brushAt(cell) };
    this.#version = model.version;
    model.beginGesture("cells");
    this.#drawing.paint([cell]);
    this.#tell();
    return true;
  }

  /** The stroke that begins at a cell: what is there already, it takes away. @param {number} cell
   *  @returns {(cells: number[]) => void} */
  #brushAt(cell) {
    const { model, brush } = this.stage;
    const isFree = model.cells[cell] === 0;
    if (brush === 0) return (cells) => model.paint(cells, isFree);
    const isThere = isFree && (model.costs?.[cell] ?? 1) === brush;
    return (cells) => model.paintLand(cells, isThere ? 1 : brush);
  }

  #stop() {
    if (!this.#drawing) return;
    this.#drawing = null;
    this.stage.model.endGesture();
  }

  #leave() {
    const { stage } = this;
    if (this.#drawing) {
      this.#stop();
      if (stage.model.version !== this.#version) stage.model.undo();
      return true;
    }
    if (stage.pointer.cancel()) return true;
    if (!stage.cursor.isShown) return false;
    stage.cursor.isShown = false;
    stage.soil("top");
    return true;
  }

  /** @param {"start" | "goal"} end */
  #put(end) {
    const { cursor, model } = this.stage;
    if (!cursor.isShown) this.#show();
    model.beginGesture("end");
    model.moveEnd(end, [cursor.x, cursor.y]);
    model.endGesture();
    this.#say(`The ${end} is at ${cursor.x}, ${cursor.y}.`);
  }

  /** Zooms around the cursor, if it is shown. @param {Pane} pane @param {number} factor */
  #zoom(pane, factor) {
    const { cursor, view } = this.stage;
    if (!cursor.isShown) return this.stage.zoom(factor);
    const at = pane.spotOf(cursor.x + 0.5, cursor.y + 0.5);
    view.zoom(factor, at.x - pane.width / 2, at.y - pane.height / 2);
    return this.stage.moved();
  }

  #tell() {
    const { cursor, model } = this.stage;
    const { x, y } = cursor;
    const isAt = (/** @type {readonly number[]} */ end) => end[0] === x && end[1] === y;
    const end = isAt(model.start) ? ", the start" : isAt(model.goal) ? ", the goal" : "";
    const cell = y * model.width + x;
    const land = landOf(model.costs?.[cell] ?? 0);
    const free = land ? `${land.name.toLowerCase()}, cost ${land.cost}` : "free";
    this.#say(`Cell ${x}, ${y}: ${model.cells[cell] ? "wall" : free}${end}.`);
  }

  /** @param {string} sentence */
  #say(sentence) {
    this.stage.dispatchEvent(new CustomEvent("say", { detail: sentence }));
  }
}
