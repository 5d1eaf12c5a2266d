// The changes of the model's map that a worker does not know yet. Each worker has a copy of the map of its
// own, and is told only the rectangle that has changed.

/** @import { Change, Model, Rect } from "../../types.js" */
/** @import { MapNews } from "./protocol.js" */

export class Feed {
  /** @type {Pick<Model, "width" | "height" | "cells" | "costs">} */
  #model;
  /** Whether the worker's map has land on which steps cost differently. */
  #hasCosts = false;
  /** Whether the worker has the map, but for the rectangle. */
  #has = false;
  /** @type {Rect | null} */
  #dirty = null;

  /** @param {Pick<Model, "width" | "height" | "cells" | "costs">} model */
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
    const { width, height, cells, costs = null } = this.#model;
    const rectangle = this.#dirty;
    this.#dirty = null;
    // A map with costs is another kind of map.
    if (!this.#has || this.#hasCosts !== (costs !== null)) {
      [this.#has, this.#hasCosts] = [true, costs !== null];
      return { map: { width, height, cells: cells.slice(), costs: costs?.slice() ?? null } };
    }
    if (!rectangle) return {};
    const [own, land] = [cells, costs].map((array) => array && copy(array, width, rectangle));
    return { patch: { ...rectangle, cells: /** @type {Uint8Array} */ (own), costs: land } };
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
  const arrays = [news.map?.cells, news.map?.costs, news.patch?.cells, news.patch?.costs];
  return arrays.filter((array) => !!array).map((array) => /** @type {ArrayBuffer} */ (array.buffer));
}
