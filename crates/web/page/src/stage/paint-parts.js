// Where there is no path: the part of the map that the start reaches, and, with stripes, that of the goal.

import { Raster } from "./raster.js";

/** @import { Lanes } from "../../types.js" */
/** @typedef {import("./view.js").Frame} Frame */
/** @typedef {import("./colors.js").Theme} Theme */

/** The width of a stripe and its space together, in vertices. */
const STRIPES = 4;

export class Parts {
  #raster = new Raster(1, 1);
  /** @type {unknown[]} */
  #seen = [];

  /** @param {CanvasRenderingContext2D} context @param {Frame} frame
   *  @param {NonNullable<Lanes["parts"]>} parts @param {Theme} theme */
  draw(context, frame, parts, theme) {
    if (this.#seen[0] !== parts || this.#seen[1] !== theme) this.#fill(parts, theme);
    this.#seen = [parts, theme];
    this.#raster.draw(context, frame, parts.placement === "corner" ? -0.5 : 0);
  }

  /** @param {NonNullable<Lanes["parts"]>} parts @param {Theme} theme */
  #fill({ width, height, values }, { parts: [start, goal, stripe] }) {
    if (this.#raster.width !== width || this.#raster.height !== height) {
      this.#raster = new Raster(width, height);
    }
    const { pixels } = this.#raster;
    for (let v = 0; v < values.length; v++) {
      const isStripe = ((v % width) + Math.floor(v / width)) % STRIPES < STRIPES / 2;
      pixels[v] = values[v] === 0 ? 0 : values[v] === 1 ? start : isStripe ? stripe : goal;
    }
    this.#raster.touch();
  }
}
