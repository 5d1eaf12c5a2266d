// The overlays with a value for each place: distances and clearance as colors with contour lines, flow as
// arrows.

import { Contours } from "./contours.js";
import { Arrows } from "./paint-arrows.js";
import { Raster } from "./raster.js";

/** @typedef {NonNullable<import("../../types.d.ts").Lanes["field"]>} Field */
/** @typedef {import("./view.js").Frame} Frame */
/** @typedef {import("./colors.js").Theme} Theme */

/** About so many contour lines from the least to the greatest value. */
const LINES = 20;
/** The least side of a cell, in pixels of the page, that has them. */
const LEAST_WITH_LINES = 2.5;

/** The least of 1, 2, 5, 10, … and their decimal parts that gives no more lines. @param {Field} field */
function stepOf({ greatest }) {
  const least = Math.max(1e-6, greatest / LINES);
  const unit = 10 ** Math.floor(Math.log10(least));
  return unit * ([1, 2, 5].find((factor) => factor * unit >= least * (1 - 1e-9)) ?? 10);
}

/** The shift of a field's raster against the cells. @param {Field} field */
function shiftOf(field) {
  return field.kind !== "clearance" && field.placement === "corner" ? -0.5 : 0;
}

export class FieldPainter {
  #raster = new Raster(1, 1);
  #arrows = new Arrows();
  /** @type {Field | null} */
  #field = null;
  /** @type {Theme | null} */
  #theme = null;
  /** @type {Contours | null} */
  #lines = null;

  /** @param {CanvasRenderingContext2D} context @param {Frame} frame @param {Field} field @param {Theme}
   *  theme */
  drawColors(context, frame, field, theme) {
    this.#update(field, theme);
    context.globalAlpha = field.kind === "flow" ? 0.4 : 1;
    this.#raster.draw(context, frame, shiftOf(field));
    context.globalAlpha = 1;
  }

  /** @param {CanvasRenderingContext2D} context @param {Frame} frame @param {Field} field @param {Theme}
   *  theme */
  drawLines(context, frame, field, theme) {
    this.#update(field, theme);
    if (field.kind === "flow") return this.#arrows.draw(context, frame, field, shiftOf(field) + 0.5, theme);
    if (frame.scale < LEAST_WITH_LINES * frame.dpr) return undefined;
    this.#lines ??= new Contours(field, stepOf(field));
    return this.#lines.draw(context, frame, shiftOf(field) + 0.5);
  }

  /** @param {Field} field @param {Theme} theme */
  #update(field, theme) {
    if (field === this.#field && theme === this.#theme) return;
    if (field !== this.#field) this.#lines = null;
    [this.#field, this.#theme] = [field, theme];
    const { width, height, values, greatest } = field;
    const isSame = this.#raster.width === width && this.#raster.height === height;
    if (!isSame) this.#raster = new Raster(width, height);
    const { pixels } = this.#raster;
    const scale = greatest > 0 ? 255 / greatest : 0;
    const step = stepOf(field);
    for (let i = 0; i < pixels.length; i++) {
      const value = values[i];
      // Every other band is a little darker: contours also where lines would be too dense.
      const band = Math.floor(value / step) & 1 ? -5 : 5;
      const index = Math.round(value * scale + band);
      pixels[i] = value < Infinity ? theme.field[Math.min(255, Math.max(0, index))] : 0;
    }
    this.#raster.touch();
  }
}
