// The places where the rules of motion differ. At centers: diagonal steps past the corner of one wall, or
// between two. At corners: gaps, the vertices where two blocked cells touch diagonally. A short line goes
// where a step can pass; a cross stands where none can.

import { Raster } from "./raster.js";

/** @typedef {import("../../types.d.ts").Model} Model */
/** @typedef {import("../../types.d.ts").LaneSetup} LaneSetup */
/** @typedef {import("./view.js").Frame} Frame */
/** @typedef {import("./colors.js").Theme} Theme */

/** The bits of a lattice point: the diagonal of its free cells; whether both others are blocked. */
const FALLING = 1;
const RISING = 2;
const TWO = 4;

/** The least side of a cell, in pixels of the page, that has glyphs; smaller ones have a pixel a place. */
const LEAST_WITH_GLYPHS = 6;

export class Rules {
  /** The bits of each lattice point, (W + 1) × (H + 1) of them. */
  #places = new Uint8Array(0);
  #raster = new Raster(1, 1);
  #key = "";

  /** @param {CanvasRenderingContext2D} context @param {Frame} frame @param {Model} model @param {LaneSetup}
   *  setup @param {Theme} theme */
  draw(context, frame, model, setup, theme) {
    this.#update(model, setup, theme);
    const { scale, dpr } = frame;
    if (scale < LEAST_WITH_GLYPHS * dpr) {
      context.globalAlpha = 0.6;
      this.#raster.draw(context, frame, -0.5);
      context.globalAlpha = 1;
      return;
    }
    const glyphs = glyphsOf(Math.min(9 * dpr, 0.3 * scale), dpr, theme);
    const half = glyphs.falling.width / 2;
    const columns = model.width + 1;
    const last = [(frame.width - frame.left) / scale + 1, (frame.height - frame.top) / scale + 1];
    for (let y = Math.max(0, Math.floor(-frame.top / scale)); y < Math.min(model.height, last[1]); y++) {
      for (let x = Math.max(0, Math.floor(-frame.left / scale)); x < Math.min(model.width, last[0]); x++) {
        const kind = this.#places[y * columns + x];
        if (kind === 0 || !isMeant(setup, kind)) continue;
        const glyph = !isOpen(setup, kind) ? glyphs.closed : kind & FALLING ? glyphs.falling : glyphs.rising;
        // Whole pixels: a glyph is copied, not computed anew.
        const left = Math.round(frame.left + x * scale - half);
        context.drawImage(glyph, left, Math.round(frame.top + y * scale - half));
      }
    }
  }

  /** @param {Model} model @param {LaneSetup} setup @param {Theme} theme */
  #update(model, setup, theme) {
    const { width, height, version } = model;
    const rule = setup.placement === "corner" ? setup.gap : setup.corners;
    const key = [version, width, height, setup.placement, rule, theme.ink, theme.danger].join();
    if (key === this.#key) return;
    this.#key = key;
    const columns = width + 1;
    this.#places = placesOf(model);
    if (this.#raster.width !== columns || this.#raster.height !== height + 1) {
      this.#raster = new Raster(columns, height + 1);
    }
    const { pixels } = this.#raster;
    for (let i = 0; i < pixels.length; i++) {
      const kind = this.#places[i];
      pixels[i] = kind === 0 || !isMeant(setup, kind) ? 0 : isOpen(setup, kind) ? theme.ink : theme.danger;
    }
    this.#raster.touch();
  }
}

/** @param {Model} model */
function placesOf({ width, height, cells }) {
  const columns = width + 1;
  const places = new Uint8Array(columns * (height + 1));
  for (let y = 1; y < height; y++) {
    for (let x = 1; x < width; x++) {
      const at = y * width + x;
      const falling = cells[at - width - 1] + cells[at];
      const rising = cells[at - width] + cells[at - 1];
      if (falling === 0 && rising > 0) places[y * columns + x] = FALLING | (rising === 2 ? TWO : 0);
      else if (rising === 0 && falling > 0) places[y * columns + x] = RISING | (falling === 2 ? TWO : 0);
    }
  }
  return places;
}

/** Whether the placement has a rule for this kind. @param {LaneSetup} setup @param {number} kind */
function isMeant(setup, kind) {
  return setup.placement === "center" || (kind & TWO) !== 0;
}

/** @param {LaneSetup} setup @param {number} kind */
function isOpen(setup, kind) {
  if (setup.placement === "corner") return setup.gap === "open";
  return setup.corners === "always" || (setup.corners === "one" && !(kind & TWO));
}

/** The pictures of the glyphs. @param {number} size @param {number} dpr @param {Theme} theme */
function glyphsOf(size, dpr, theme) {
  const { text, danger, page } = theme.css;
  const arm = 0.66 * size;
  return {
    falling: glyph(size, dpr, text, page, [[-size, -size, size, size]]),
    rising: glyph(size, dpr, text, page, [[-size, size, size, -size]]),
    closed: glyph(size, dpr, danger, page, [
      [-arm, -arm, arm, arm],
      [-arm, arm, arm, -arm],
    ]),
  };
}

/** @param {number} size @param {number} dpr @param {string} color @param {string} rim @param {number[][]}
 *  lines */
function glyph(size, dpr, color, rim, lines) {
  const canvas = document.createElement("canvas");
  const half = Math.ceil(size + 3 * dpr);
  [canvas.width, canvas.height] = [2 * half, 2 * half];
  const context = canvas.getContext("2d");
  if (!context) return canvas;
  context.lineCap = "round";
  context.translate(half, half);
  const thick = Math.max(1.25 * dpr, 0.28 * size);
  for (const [ink, width] of /** @type {[string, number][]} */ ([
    [rim, thick + 2 * dpr],
    [color, thick],
  ])) {
    context.beginPath();
    for (const [x0, y0, x1, y1] of lines) {
      context.moveTo(x0, y0);
      context.lineTo(x1, y1);
    }
    context.strokeStyle = ink;
    context.lineWidth = width;
    context.stroke();
  }
  return canvas;
}
