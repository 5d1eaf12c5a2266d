// The brush, which draws walls or land, and the legend of the land under the map.

import { LAND } from "../model/land.js";
import { changes, eachFrame, h, part, select } from "./dom.js";
import { announce } from "./message.js";

/** @typedef {import("../../types").Model} Model */
/** @typedef {import("../../types").Stage & EventTarget} Stage */

/** By what a step costs; 0 is a wall. */
const BRUSHES = /** @type {Record<string, string>} */ ({
  0: "Wall",
  ...Object.fromEntries(LAND.map(({ cost, name }) => [cost, `${name}, ${cost}`])),
});
/** The brushes in the order in which the key goes through them. */
const ORDER = [0, ...LAND.map(({ cost }) => cost)];

/** A patch of a color. @param {string} name */
export const swatch = (name) => h("i", { class: `swatch land-${name.toLowerCase()}`, "aria-hidden": "true" });

export class BrushChoice {
  #stage;
  #swatch = h("span", { class: "swatch-slot" });
  #select;
  /** @type {HTMLLabelElement} */
  element;

  /** @param {Stage} stage */
  constructor(stage) {
    this.#stage = stage;
    this.#select = select(BRUSHES, (value) => this.choose(Number(value)), {
      "aria-label": "Brush: what the tools draw, and what a step costs there",
      title: "What the tools draw, and what a step costs there (L)",
    });
    this.element = h("label", { class: "brush" }, this.#swatch, this.#select);
    stage.addEventListener("tool", () => this.#show());
    this.#show();
  }

  /** @param {number} brush */
  choose(brush) {
    this.#stage.brush = brush;
    // Whoever takes a brush wants to draw.
    if (this.#stage.tool === "move" || this.#stage.tool === "erase") this.#stage.tool = "draw";
    this.#show();
  }

  /** The next one, by the key. */
  next() {
    this.choose(ORDER[(ORDER.indexOf(this.#stage.brush) + 1) % ORDER.length]);
    announce(`Brush: ${BRUSHES[this.#stage.brush]}.`);
  }

  #show() {
    const { brush } = this.#stage;
    this.#select.value = String(brush);
    this.#swatch.replaceChildren(swatch(BRUSHES[brush].split(",")[0]));
  }
}

/** Shows the legend where steps cost differently. @param {Model} model */
export function startLandLegend(model) {
  const entries = LAND.map(({ cost, name }) => h("li", {}, swatch(name), `${name.toLowerCase()} ${cost}`));
  const legend = h(
    "ul",
    { class: "land-legend", "aria-label": "What a step costs on each kind of land", hidden: true },
    ...entries,
    h("li", {}, swatch("Wall"), "wall"),
  );
  part("stage", HTMLElement).parentElement?.after(legend);
  const show = eachFrame(() => {
    legend.hidden = model.costs === null;
  });
  changes(model, show);
  show();
}
