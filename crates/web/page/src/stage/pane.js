// One pane: a lane's view of the map, in three canvases, each redrawn only when what it shows has changed.
// `ground`: free cells, colors of the search or of a field. `walls`: grid lines, walls, lines and glyphs.
// `top`: marks, path, agents, start and goal, and the cursor.

import { bendsAtCorners } from "../model/setups.js";
import { engineName, hasNoSearch, kText } from "../panels/words.js";
import { Caption, element, Legend } from "./caption.js";
import { Glide } from "./glide.js";
import { SearchHeat } from "./heat.js";
import { Agents } from "./paint-agents.js";
import { FieldPainter } from "./paint-field.js";
import { drawBorder, drawGridLines, Hatch, mapBox } from "./paint-map.js";
import { Parts } from "./paint-parts.js";
import {
  drawApart,
  drawBadge,
  drawCells,
  drawMissing,
  drawOptimum,
  drawPath,
  isBeaten,
} from "./paint-path.js";
import { Rules } from "./paint-rules.js";

/** @typedef {import("./stage.js").Stage} Stage */
/** @typedef {import("../../types.d.ts").LaneAnswer} LaneAnswer */
/** @typedef {import("../../types.d.ts").Rect} Rect */
/** @typedef {import("./view.js").Frame} Frame */

/** An answer that is older than the scene fades after so many milliseconds. */
const FADES_AFTER = 350;
/** The opacity of the search where there is land below it. */
const OVER_LAND = 0.42;

export class Pane {
  /** @type {Record<"ground" | "walls" | "top", CanvasRenderingContext2D>} */
  #layers;
  #heat = new SearchHeat();
  #field = new FieldPainter();
  #hatch = new Hatch();
  #rules = new Rules();
  #agents = new Agents();
  #glide = new Glide();
  #parts = new Parts();
  /** Whether the optimum is shorter than the path. */
  #isBeaten = false;
  #dirty = { ground: true, walls: true, top: true, text: true };
  /** @type {Rect | null} */
  #patch = null;
  #staleSince = 0;

  /** @param {Stage} stage @param {number} lane */
  constructor(stage, lane) {
    this.stage = stage;
    this.lane = lane;
    this.root = element("div", "stage-pane");
    this.caption = new Caption(this.root, () => stage.model.set({ active: this.lane }));
    this.legend = new Legend(this.root);
    /** Takes pointer and keyboard. */
    this.surface = element("div", "stage-surface", this.root);
    this.surface.tabIndex = 0;
    this.surface.setAttribute("role", "application");
    this.surface.setAttribute("aria-describedby", stage.helpId);
    const make = (/** @type {string} */ name) => newLayer(this.surface, name);
    this.#layers = { ground: make("ground"), walls: make("walls"), top: make("top") };
    this.width = 1;
    this.height = 1;
  }

  get setup() {
    return this.stage.model.lanes[this.lane];
  }
  get state() {
    return this.stage.lanes.list[this.lane];
  }
  /** From a vertex to its place in cells. */
  get shift() {
    return this.setup.placement === "corner" ? 0 : 0.5;
  }
  /** The same for the vertices that a search expands. */
  get #searchedShift() {
    return bendsAtCorners(this.setup) ? 0 : 0.5;
  }
  get frame() {
    return this.stage.view.frame(this.width, this.height);
  }
  get #isActive() {
    return this.stage.model.active === this.lane;
  }

  /** The spot in the pane of a place of the map, in pixels of the page. @param {number} x @param {number} y
   *  */
  spotOf(x, y) {
    const { left, top, scale, dpr } = this.frame;
    return { x: (left + x * scale) / dpr, y: (top + y * scale) / dpr };
  }

  /** Takes the size that the page gives. */
  measure() {
    this.width = Math.max(1, this.surface.clientWidth);
    this.height = Math.max(1, this.surface.clientHeight);
  }

  resize() {
    const { width, height } = this.frame;
    for (const { canvas } of Object.values(this.#layers)) {
      if (canvas.width !== width) canvas.width = width;
      if (canvas.height !== height) canvas.height = height;
    }
    this.soil("ground", "walls", "top", "text");
  }

  /** @param {("ground" | "walls" | "top" | "text")[]} parts */
  soil(...parts) {
    for (const part of parts) this.#dirty[part] = true;
    this.stage.requestFrame();
  }

  /** Cells changed: only that part of the walls is drawn again. @param {Rect} rect */
  soilCells(rect) {
    const old = this.#patch;
    const [x, y] = [Math.min(rect.x, old?.x ?? rect.x), Math.min(rect.y, old?.y ?? rect.y)];
    const right = Math.max(rect.x + rect.width, old ? old.x + old.width : 0);
    const bottom = Math.max(rect.y + rect.height, old ? old.y + old.height : 0);
    this.#patch = { x, y, width: right - x, height: bottom - y };
    this.stage.requestFrame();
  }

  /** Draws what has changed. Returns whether the next frame shall come at once. @param {number} now */
  draw(now) {
    if (!this.setup) return false;
    const dirty = this.#dirty;
    this.#dirty = { ground: false, walls: false, top: false, text: false };
    const rows = this.#advance();
    if (rows && this.#heat.isSparse) dirty.top = true;
    if (dirty.ground) this.#drawGround(null);
    else if (rows) this.#drawGround(rows);
    if (dirty.walls) this.#drawWalls(null);
    else if (this.#patch) this.#drawWalls(this.#patch);
    this.#patch = null;
    if (dirty.text) this.#write();
    return dirty.top ? this.#drawTop(now) : false;
  }

  /** Shows as much of the search as the player says. @returns {[number, number] | null} */
  #advance() {
    const { model, player, theme } = this.stage;
    const answer = model.overlay === "search" ? (this.state?.answer ?? null) : null;
    const rows = model.height + (bendsAtCorners(this.setup) ? 1 : 0);
    return this.#heat.show(answer, answer ? player.shown(this.lane) : 0, theme, rows);
  }

  /** @param {[number, number] | null} rows Only these rows of vertices. */
  #drawGround(rows) {
    const { model, theme, lanes } = this.stage;
    const { frame } = this;
    const context = this.#layers.ground;
    const box = mapBox(frame, model);
    context.save();
    /** @type {[number, number] | null} */
    let drawn = null;
    if (rows) {
      const top = Math.floor(frame.top + (rows[0] - 1) * frame.scale) - 2;
      const bottom = Math.ceil(frame.top + (rows[1] + 1) * frame.scale) + 2;
      clip(context, 0, top, frame.width, bottom - top);
      // More rows than are cleared, so that no edge is left white.
      const more = 3 + Math.ceil(4 / frame.scale);
      drawn = [rows[0] - more, rows[1] + more];
    }
    context.fillStyle = theme.css.outside;
    context.fillRect(0, 0, frame.width, frame.height);
    clip(context, box.left, box.top, box.right - box.left, box.bottom - box.top);
    context.fillStyle = theme.css.free;
    context.fillRect(0, 0, frame.width, frame.height);
    const field = this.#fieldShown();
    const { land } = this.stage;
    if (!field || field.kind === "flow") land.draw(context, frame);
    if (field) this.#field.drawColors(context, frame, field, theme);
    else if (lanes.parts && this.#isActive) this.#parts.draw(context, frame, lanes.parts, theme);
    // The land shines through the search.
    context.globalAlpha = land.isShown ? OVER_LAND : 1;
    if (!this.#heat.isSparse) this.#heat.draw(context, frame, this.#searchedShift - 0.5, drawn);
    context.globalAlpha = 1;
    context.restore();
  }

  /** The field that this pane shows: that of the active lane, or what holds for all. */
  #fieldShown() {
    const { model, lanes } = this.stage;
    const { field } = lanes;
    if (!field || field.kind !== model.overlay) return null;
    return this.#isActive || field.kind === "clearance" ? field : null;
  }

  /** @param {Rect | null} rect Only these cells. */
  #drawWalls(rect) {
    const { model, theme, lanes } = this.stage;
    const { frame } = this;
    const context = this.#layers.walls;
    const part = pixelsOf(frame, rect);
    if (part.width <= 0 || part.height <= 0) return;
    context.save();
    if (rect) clip(context, part.x, part.y, part.width, part.height);
    context.clearRect(0, 0, frame.width, frame.height);
    const field = this.#fieldShown();
    if (!field || field.kind === "flow") drawGridLines(context, frame, model, theme);
    if (model.radius > 0) this.#hatch.draw(context, frame, model, lanes.tooNarrow, theme, part);
    const { walls, wallsInField } = this.stage;
    (field && field.kind !== "flow" ? wallsInField : walls).draw(context, frame, rect ?? undefined);
    if (field) this.#field.drawLines(context, frame, field, theme);
    if (model.overlay === "rules") this.#rules.draw(context, frame, model, this.setup, theme);
    drawBorder(context, frame, model, theme);
    context.restore();
  }

  /** @param {number} now @returns {boolean} */
  #drawTop(now) {
    const { model, theme, walkers, player } = this.stage;
    const { frame, shift } = this;
    const context = this.#layers.top;
    const answer = this.state?.answer;
    context.clearRect(0, 0, frame.width, frame.height);
    this.#heat.drawMarks(context, frame, this.#searchedShift - 0.5);
    let isMoving = false;
    if (answer && player.arrived(this.lane) && answer.status !== "invalid") {
      if (answer.status === "nearest") drawMissing(context, frame, answer, shift, theme);
      isMoving = this.#drawPaths(answer, now);
    }
    if (this.#isActive) {
      const look = { shift, radius: model.radius };
      isMoving = this.#agents.draw(context, frame, walkers, look, theme, now) || isMoving;
    }
    this.#drawCursor(context);
    this.#drawEnds(context);
    this.stage.placeCalls(this);
    if (isMoving) this.#dirty.top = true;
    return isMoving;
  }

  /** The path, and the optimum where it is shorter. Returns whether the path still moves.
   *  @param {LaneAnswer} answer @param {number} now */
  #drawPaths(answer, now) {
    const { model, theme, glides } = this.stage;
    const { frame, shift } = this;
    const context = this.#layers.top;
    const { path, isMoving } = this.#glide.at(answer.path, glides, now);
    const look = { lane: this.lane, shift, radius: model.radius, isFaint: this.#isFaint(now) };
    const optimum = answer.reference && (isMoving || isBeaten(answer)) ? answer.reference.path : null;
    if (optimum) drawApart(context, frame, path, optimum, look, theme);
    drawPath(context, frame, path, look, theme);
    if (optimum) drawOptimum(context, frame, optimum, shift, theme);
    return isMoving;
  }

  /** Whether the answer is older than the scene for a while. @param {number} now */
  #isFaint(now) {
    if (!this.state?.stale) {
      this.#staleSince = 0;
      return false;
    }
    if (this.#staleSince === 0) {
      this.#staleSince = now;
      setTimeout(() => this.soil("top"), FADES_AFTER + 20);
    }
    return now - this.#staleSince > FADES_AFTER;
  }

  /** @param {CanvasRenderingContext2D} context */
  #drawEnds(context) {
    const { model, theme, held, near } = this.stage;
    const state = (/** @type {string} */ end) => (held === end ? "held" : near === end ? "near" : "");
    drawBadge(context, this.frame, "S", model.start, this.shift, state("start"), theme);
    drawBadge(context, this.frame, "G", model.goal, this.shift, state("goal"), theme);
  }

  /** @param {CanvasRenderingContext2D} context */
  #drawCursor(context) {
    const { preview, cursor, theme } = this.stage;
    const { frame } = this;
    if (preview && (preview.isShared || preview.pane === this)) {
      const color = preview.isErasing ? theme.css.muted : theme.css.text;
      drawCells(context, frame, preview.rect, color, preview.isShared ? 0.3 : 0.12, theme);
    }
    if (cursor.isShown && document.activeElement === this.surface) {
      const rect = { x: cursor.x, y: cursor.y, width: 1, height: 1 };
      drawCells(context, frame, rect, theme.css.focus, 0.2, theme);
    }
  }

  /** The words of the pane. */
  #write() {
    const { model, player, lanes } = this.stage;
    const { state, setup } = this;
    this.caption.update(this.lane, setup, state, this.#isActive);
    this.root.classList.toggle("is-active", this.#isActive && model.lanes.length > 1);
    const hasSearch = !!state?.answer?.steps?.length;
    const isHere = this.#isActive || model.overlay === "rules";
    /** @type {"" | "tiles" | "marks" | "labels"} */
    const search = hasNoSearch(state) ? "labels" : !hasSearch ? "" : this.#heat.isSparse ? "marks" : "tiles";
    const answer = state?.answer;
    // The optimum comes a little after its answer: until then the legend stays as it is.
    if (answer && (answer.reference || !answer.path.length)) this.#isBeaten = isBeaten(answer);
    const { legend } = this;
    const onLand = model.costs !== null;
    const isCut = !!lanes.parts && this.#isActive;
    const shown = { search, isBeaten: this.#isBeaten && player.arrived(this.lane), isCut, onLand };
    legend.update(isHere ? model.overlay : "none", lanes.field, setup, shown);
    const label = `Map, lane ${this.lane + 1}: ${engineName(setup.engine)}, k = ${kText(setup.k)}`;
    if (this.surface.getAttribute("aria-label") !== label) this.surface.setAttribute("aria-label", label);
  }
}

/** The pixels of a pane that show these cells, or all. @param {Frame} frame @param {Rect | null} rect
 *  @returns {Rect} */
function pixelsOf({ left, top, scale, width, height }, rect) {
  if (!rect) return { x: 0, y: 0, width, height };
  // Some pixels more on each side: smoothing reaches over.
  const margin = 2;
  const x = Math.max(0, Math.floor(left + rect.x * scale) - margin);
  const y = Math.max(0, Math.floor(top + rect.y * scale) - margin);
  const right = Math.min(width, Math.ceil(left + (rect.x + rect.width) * scale) + margin);
  const bottom = Math.min(height, Math.ceil(top + (rect.y + rect.height) * scale) + margin);
  return { x, y, width: right - x, height: bottom - y };
}

/** @param {CanvasRenderingContext2D} context @param {number} x @param {number} y @param {number} width
 *  @param {number} height */
function clip(context, x, y, width, height) {
  context.beginPath();
  context.rect(x, y, width, height);
  context.clip();
}

/** @param {Element} surface @param {string} name */
function newLayer(surface, name) {
  const canvas = element("canvas", `stage-layer is-${name}`, surface);
  canvas.setAttribute("aria-hidden", "true");
  const context = canvas.getContext("2d", { alpha: name !== "ground" });
  if (!context) throw new Error("This browser gives no canvas to draw on.");
  return context;
}
