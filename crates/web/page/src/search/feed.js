// The changes of the model's map that a worker does not know yet. Each worker has a copy of the map of its
// own, and is told only the rectangle that has changed.

/** @import { Change, Model, Rect } from "../../types.js" */
/** @import { MapNews } from "./protocol.js" */

export class Feed {
  /** @type {Pick<Model, "width" | "height" | "cells">} */
  #model;
  /** Whether the worker has the map, but for the rectangle. */
  #has = false;
  /** @type {Rect | null} */
  #dirty = null;

  /** @param {Pick<Model, "width" | "height" | "cells">} model */
  constructor(model) {
    this.#model = model;
  }

  /** @param {Change} change */
  note(change) {
    if (change.map) {
      this.reset();
    } else if (change.cells && this.#has) {
      this.#dirty = this.#dirty ? union(this.#dirty, change.cells) : { ...change.cells };
    }
  }

  /** The worker is a new one: it has nothing. */
  reset() {
    this.#has = false;
    this.#dirty = null;
  }

  /**
   * Takes the news for the worker, which knows the map afterwards.
   * @returns {MapNews}
   */
  take() {
    const { width, height, cells } = this.#model;
    const rectangle = this.#dirty;
    this.#dirty = null;
    if (!this.#has) {
      this.#has = true;
      return { map: { width, height, cells: cells.slice() } };
    }
    return rectangle ? { patch: { ...rectangle, cells: copy(cells, width, rectangle) } } : {};
  }
}

/**
 * The smallest rectangle around two.
 * @param {Rect} a
 * @param {Rect} b
 * @returns {Rect}
 */
export function union(a, b) {
  const [x, y] = [Math.min(a.x, b.x), Math.min(a.y, b.y)];
  const right = Math.max(a.x + a.width, b.x + b.width);
  const bottom = Math.max(a.y + a.height, b.y + b.height);
  return { x, y, width: right - x, height: bottom - y };
}

/**
 * The cells of a rectangle, row by row.
 * @param {Uint8Array} cells
 * @param {number} width
 * @param {Rect} rectangle
 */
export function copy(cells, width, rectangle) {
  const out = new Uint8Array(rectangle.width * rectangle.height);
  for (let row = 0; row < rectangle.height; row++) {
    const from = (rectangle.y + row) * width + rectangle.x;
    out.set(cells.subarray(from, from + rectangle.width), row * rectangle.width);
  }
  return out;
}

/**
 * The buffers that a message may hand over instead of copying them.
 * @param {MapNews} news
 * @returns {ArrayBuffer[]}
 */
export function buffersOf(news) {
  const arrays = [news.map?.cells, news.patch?.cells].filter((cells) => cells !== undefined);
  return arrays.map((cells) => /** @type {ArrayBuffer} */ (cells.buffer));
}
