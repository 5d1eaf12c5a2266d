// The steps of undo and redo. A step holds what the scene had on its other side: the model exchanges the two,
// so that the same step leads back and forth.

import { BitSet } from "./bits.js";

/** @typedef {import("../../types.d.ts").Point} Point */
/** @typedef {import("./terrain.js").PackedTerrain} PackedTerrain */

/** The other side of a step: the cells that it flips, what cells cost then, the ends of then, or the map of
 * then.
 * @typedef {object} Step
 * @property {Uint32Array | BitSet | null} cells
 * @property {Map<number, number> | null} [costs] by cell
 * @property {[Point, Point] | null} ends
 * @property {PackedTerrain | null} map */

const LIMIT_BYTES = 64 * 1024 * 1024;
const LIMIT_STEPS = 1000;

/** The rough size of a step besides its cells and map, in bytes. */
const STEP_BYTES = 200;
/** That of an entry of a map of numbers. */
const COST_BYTES = 40;

/** The flipped cells in the form that takes less memory: a list of few, or a bit for each cell.
 * @param {BitSet} flipped */
export function compact(flipped) {
  return flipped.count * 32 < flipped.size ? flipped.toList() : flipped.copy();
}

/** @param {Step} step */
function bytesOf({ cells, costs, map }) {
  let bytes = STEP_BYTES + COST_BYTES * (costs?.size ?? 0);
  if (cells !== null) bytes += cells instanceof BitSet ? cells.words.byteLength : cells.byteLength;
  if (map !== null) bytes += map.blocked.words.byteLength + map.edits.words.byteLength + map.land.bytes;
  return bytes;
}

/** The steps that can be undone and redone: the last ones, as far as they fit into the memory. */
export class History {
  /** @type {Step[]} */ #done = [];
  /** @type {Step[]} the next one last */ #undone = [];

  /** @param {number} [limit] bytes */
  constructor(limit = LIMIT_BYTES) {
    this.limit = limit;
  }

  get canUndo() {
    return this.#done.length > 0;
  }

  get canRedo() {
    return this.#undone.length > 0;
  }

  get bytes() {
    return [...this.#done, ...this.#undone].reduce((sum, step) => sum + bytesOf(step), 0);
  }

  clear() {
    this.#done = [];
    this.#undone = [];
  }

  /** Adds a step that was just done. Steps that were undone before it cannot be redone any more.
   * @param {Step} step */
  push(step) {
    this.#undone = [];
    this.#done.push(step);
    this.#forget();
  }

  /** Undoes the last step by `exchange`.
   * @param {(step: Step) => void} exchange */
  undo(exchange) {
    this.#move(this.#done, this.#undone, exchange);
  }

  /** @param {(step: Step) => void} exchange */
  redo(exchange) {
    this.#move(this.#undone, this.#done, exchange);
  }

  /** @param {Step[]} from @param {Step[]} to @param {(step: Step) => void} exchange */
  #move(from, to, exchange) {
    const step = from.pop();
    if (step === undefined) return;
    to.push(step);
    exchange(step);
    this.#forget();
  }

  /** Drops the steps that are farthest away until the rest fits. */
  #forget() {
    let bytes = this.bytes;
    while (bytes > this.limit || this.#done.length > LIMIT_STEPS) {
      const step = this.#done.shift() ?? this.#undone.shift();
      if (step === undefined) return;
      bytes -= bytesOf(step);
    }
  }
}
