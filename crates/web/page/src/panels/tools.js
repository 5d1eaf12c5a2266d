// The tools to edit the map, undo and redo, and the buttons of the view.

import { changes, eachFrame, h, part } from "./dom.js";
import { icon, iconButton } from "./icons.js";
import { BrushChoice } from "./land.js";
import { announce } from "./message.js";

/** @typedef {import("../../types").Tool} Tool */

/** @type {readonly { tool: Tool, name: string, key: string, what: string }[]} */
export const TOOLS = [
  { tool: "move", name: "Move", key: "m", what: "Drag the start, the goal or the map" },
  { tool: "draw", name: "Draw", key: "d", what: "Draw walls or land" },
  { tool: "erase", name: "Erase", key: "e", what: "Erase walls or land" },
  { tool: "fill", name: "Fill", key: "f", what: "Fill or clear a connected area" },
  { tool: "rectangle", name: "Rectangle", key: "r", what: "Draw a rectangle of walls or land" },
];

export class ToolBar {
  #stage;
  /** @type {Map<Tool, HTMLButtonElement>} */
  #buttons = new Map();
  #brush;

  /** @param {import("../../types").Model} model @param {import("../../types").Stage & EventTarget} stage */
  constructor(model, stage) {
    this.#stage = stage;
    const bar = part("tools", HTMLElement);
    const group = h("div", { class: "segmented" });
    for (const { tool, name, key, what } of TOOLS) {
      const title = `${what} (${key.toUpperCase()})`;
      const button = h(
        "button",
        { type: "button", title, click: () => this.choose(tool) },
        icon(tool),
        h("span", { class: "tool-name" }, name),
      );
      this.#buttons.set(tool, button);
      group.append(button);
    }
    const undo = iconButton("undo", "Undo", () => model.undo(), "Ctrl+Z");
    const redo = iconButton("redo", "Redo", () => model.redo(), "Ctrl+Shift+Z");
    this.#brush = new BrushChoice(stage);
    bar.append(
      group,
      this.#brush.element,
      h("span", { class: "spring" }),
      h(
        "div",
        { class: "group zoom" },
        iconButton("minus", "Zoom out", () => stage.zoom(1 / 1.5), "−"),
        iconButton("plus", "Zoom in", () => stage.zoom(1.5), "+"),
        iconButton("fit", "Fit the map to the view", () => stage.fit(), "0"),
      ),
      h("div", { class: "group" }, undo, redo),
    );
    const show = eachFrame(() => {
      undo.disabled = !model.canUndo;
      redo.disabled = !model.canRedo;
    });
    changes(model, show);
    show();
    // The stage has keys for tools, too, and sentences for those who do not see its cell cursor.
    stage.addEventListener("tool", () => this.#show());
    stage.addEventListener("say", (event) => announce(/** @type {CustomEvent<string>} */ (event).detail));
    this.#show();
  }

  /** @param {Tool} tool */
  choose(tool) {
    this.#stage.tool = tool;
    this.#show();
  }

  /** Takes the next brush. */
  nextBrush() {
    this.#brush.next();
  }

  #show() {
    const { tool } = this.#stage;
    for (const [key, button] of this.#buttons) button.setAttribute("aria-pressed", String(key === tool));
  }
}
