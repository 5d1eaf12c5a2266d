// The map: walls as pixels, grid lines where cells are large, its frame, and where an agent is too wide.

import { Raster } from "./raster.js";

/** @typedef {import("../../types.d.ts").Model} Model */
/** @typedef {import("../../types.d.ts").Rect} Rect */
/** @typedef {import("./view.js").Frame} Frame */
/** @typedef {import("./colors.js").Theme} Theme */

/** The least side of a cell, in pixels of the page, that has grid lines. */
const LEAST_WITH_LINES = 8;

/** The walls; all panes share them. */
export class Walls {
  #raster = new Raster(1, 1);
  #color = 0;

  /** @param {Model} model @param {number} color */
  load(model, color) {
    const { width, height } = model;
    if (this.#raster.width !== width || this.#raster.height !== height) {
      this.#raster = new Raster(width, height, 0.5);
    }
    this.#color = color;
    this.patch(model, { x: 0, y: 0, width, height });
  }

  /** @param {Model} model @param {Rect} rect */
  patch(model, rect) {
    const { pixels, width } = this.#raster;
    for (let y = rect.y; y < rect.y + rect.height; y++) {
      for (let at = y * width + rect.x, end = at + rect.width; at < end; at++) {
        pixels[at] = model.cells[at] ? this.#color : 0;
      }
    }
    this.#raster.touch(rect.x, rect.y, rect.width, rect.height);
  }

  /** @param {CanvasRenderingContext2D} context @param {Frame} frame @param {Rect} [part] Only these cells.
   *  */
  draw(context, frame, part) {
    // More than is cleared, so that no edge is left.
    const more = 2 + Math.ceil(4 / frame.scale);
    this.#raster.draw(
      context,
      frame,
      0,
      part && {
        x0: part.x - more,
        y0: part.y - more,
        x1: part.x + part.width + more,
        y1: part.y + part.height + more,
      },
    );
  }
}

/** The part of the map that a pane shows, in device pixels. @param {Frame} frame @param {Model} model */
export function mapBox(frame, model) {
  const right = Math.round(frame.left + model.width * frame.scale);
  const bottom = Math.round(frame.top + model.height * frame.scale);
  return { left: frame.left, top: frame.top, right, bottom };
}

/** The cells that a pane shows. @param {Frame} frame @param {Model} model */
export function visibleCells(frame, model) {
  return {
    x0: Math.max(0, Math.floor(-frame.left / frame.scale)),
    y0: Math.max(0, Math.floor(-frame.top / frame.scale)),
    x1: Math.min(model.width, Math.ceil((frame.width - frame.left) / frame.scale)),
    y1: Math.min(model.height, Math.ceil((frame.height - frame.top) / frame.scale)),
  };
}

/** Lines between cells, where these are large enough. Walls are drawn over them. @param
 *  {CanvasRenderingContext2D} context @param {Frame} frame @param {Model} model @param {Theme} theme */
export function drawGridLines(context, frame, model, theme) {
  if (frame.scale < LEAST_WITH_LINES * frame.dpr) return;
  const { x0, y0, x1, y1 } = visibleCells(frame, model);
  const box = mapBox(frame, model);
  const [left, top] = [Math.max(0, box.left), Math.max(0, box.top)];
  const [right, bottom] = [Math.min(frame.width, box.right), Math.min(frame.height, box.bottom)];
  context.fillStyle = theme.css["grid-line"];
  const thick = Math.max(1, Math.round(frame.dpr));
  for (let x = Math.max(1, x0); x < x1; x++) {
    context.fillRect(Math.round(frame.left + x * frame.scale), top, thick, bottom - top);
  }
  for (let y = Math.max(1, y0); y < y1; y++) {
    context.fillRect(left, Math.round(frame.top + y * frame.scale), right - left, thick);
  }
}

/** The border of the map. @param {CanvasRenderingContext2D} context @param {Frame} frame @param {Model}
 *  model @param {Theme} theme */
export function drawBorder(context, frame, model, theme) {
  const { left, top, right, bottom } = mapBox(frame, model);
  const width = Math.max(1, Math.round(frame.dpr));
  context.strokeStyle = theme.css.axis;
  context.lineWidth = width;
  context.strokeRect(left - width / 2, top - width / 2, right - left + width, bottom - top + width);
}

/** Free cells where the agent is too wide: hatched, so that they are told from walls without color. */
export class Hatch {
  #raster = new Raster(1, 1);
  /** @type {Uint8Array | null} */
  #mask = null;
  #version = -1;
  #layer = document.createElement("canvas").getContext("2d");

  /** @param {CanvasRenderingContext2D} context @param {Frame} frame @param {Model} model @param {Uint8Array
   *  | null} mask @param {Theme} theme @param {Rect} part Only these pixels of the pane. */
  draw(context, frame, model, mask, theme, part) {
    const ink = this.#layer;
    const pattern = ink && hatchPattern(ink, frame.dpr, theme.css.wall);
    if (!mask || mask.length !== model.width * model.height || !pattern) return;
    this.#update(model, mask);
    const { x, y, width, height } = part;
    [ink.canvas.width, ink.canvas.height] = [width, height];
    this.#raster.draw(ink, { ...frame, left: frame.left - x, top: frame.top - y, width, height }, 0);
    ink.globalCompositeOperation = "source-in";
    // The pattern moves with the map.
    ink.translate(frame.left - x, frame.top - y);
    ink.fillStyle = pattern;
    ink.fillRect(x - frame.left, y - frame.top, width, height);
    context.drawImage(ink.canvas, x, y);
  }

  /** @param {Model} model @param {Uint8Array} mask */
  #update(model, mask) {
    if (mask === this.#mask && model.version === this.#version) return;
    const { width, height, cells } = model;
    const isSame = this.#raster.width === width && this.#raster.height === height;
    if (!isSame) this.#raster = new Raster(width, height);
    [this.#mask, this.#version] = [mask, model.version];
    const { pixels } = this.#raster;
    for (let i = 0; i < mask.length; i++) pixels[i] = mask[i] && !cells[i] ? 0xffffffff : 0;
    this.#raster.touch();
  }
}

/** Lines from the lower left to the upper right. @param {CanvasRenderingContext2D} context @param {number}
 *  dpr @param {string} color */
function hatchPattern(context, dpr, color) {
  const tile = document.createElement("canvas");
  const side = Math.round(8 * dpr);
  [tile.width, tile.height] = [side, side];
  const ink = tile.getContext("2d");
  if (!ink) return null;
  ink.fillStyle = color;
  ink.globalAlpha = 0.22;
  ink.fillRect(0, 0, side, side);
  ink.globalAlpha = 0.9;
  ink.strokeStyle = color;
  ink.lineWidth = 1.25 * dpr;
  ink.beginPath();
  for (const shift of [-side, 0, side]) {
    ink.moveTo(shift - 1, side + 1);
    ink.lineTo(shift + side + 1, -1);
  }
  ink.stroke();
  return context.createPattern(tile, "repeat");
}
