// The land under everything: a color for each cell on which steps cost more than 1.

import { LAND } from "../model/land.js";
import { Raster } from "./raster.js";

/** @typedef {import("../../types.d.ts").Model} Model */
/** @typedef {import("../../types.d.ts").Rect} Rect */
/** @typedef {import("./view.js").Frame} Frame */
/** @typedef {import("./colors.js").Theme} Theme */

/** The land; all panes share it. */
export class LandPainter {
  #raster = new Raster(1, 1);
  /** The pixel of each cost. */
  #colors = new Uint32Array(0);
  /** Whether there is any. */
  isShown = false;

  /** @param {Model} model @param {Theme} theme */
  load(model, theme) {
    const { width, height } = model;
    this.#colors = new Uint32Array(1 + Math.max(...LAND.map(({ cost }) => cost)));
    LAND.forEach(({ cost }, index) => (this.#colors[cost] = theme.land[index]));
    this.isShown = model.costs !== null;
    if (!this.isShown) {
      this.#raster = new Raster(1, 1);
      return;
    }
    if (this.#raster.width !== width || this.#raster.height !== height) {
      this.#raster = new Raster(width, height);
    }
    this.#fill(model, { x: 0, y: 0, width, height });
  }

  /** Returns whether anything is to be drawn again. @param {Model} model @param {Rect} rect @param {Theme}
   *  theme */
  patch(model, rect, theme) {
    if (this.isShown !== (model.costs !== null)) {
      this.load(model, theme);
      return true;
    }
    if (this.isShown) this.#fill(model, rect);
    return this.isShown;
  }

  /** @param {Model} model @param {Rect} rect */
  #fill({ costs }, rect) {
    const { pixels, width } = this.#raster;
    if (costs === null) return;
    for (let y = rect.y; y < rect.y + rect.height; y++) {
      for (let at = y * width + rect.x, end = at + rect.width; at < end; at++) {
        pixels[at] = this.#colors[costs[at]];
      }
    }
    this.#raster.touch(rect.x, rect.y, rect.width, rect.height);
  }

  /** @param {CanvasRenderingContext2D} context @param {Frame} frame */
  draw(context, frame) {
    if (this.isShown) this.#raster.draw(context, frame, 0);
  }
}
