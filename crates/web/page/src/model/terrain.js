// The map of a scene: its cells, what each costs, where it came from, and which cells were changed since.

import { BitSet } from "./bits.js";

/** @typedef {import("../../types.d.ts").MapSource} MapSource */

/** A terrain with one bit a cell, as undo keeps it.
 * @typedef {{ width: number, height: number, source: MapSource, wasEdited: boolean, blocked: BitSet,
 *   edits: BitSet, land: Costs }} PackedTerrain */

/** The costs of cells: 1 unless they say otherwise. `first`: as they were loaded. */
export class Costs {
  /** Null if all have always been 1. @type {Uint8Array | null} */
  now;
  /** The number of cells whose cost is not 1. */
  dear = 0;
  /** The number of cells that differ from the first ones. */
  changed = 0;

  /** @param {number} size @param {Uint8Array | null} first */
  constructor(size, first) {
    this.size = size;
    this.first = first;
    this.now = first?.slice() ?? null;
    if (first) for (const cost of first) if (cost !== 1) this.dear++;
  }

  /** @param {number} cell */
  at(cell) {
    return this.now?.[cell] ?? 1;
  }

  /** @param {number} cell @param {number} cost */
  set(cell, cost) {
    const before = this.at(cell);
    const first = this.first?.[cell] ?? 1;
    if (before === cost) return;
    this.now ??= new Uint8Array(this.size).fill(1);
    this.now[cell] = cost;
    this.dear += Number(cost !== 1) - Number(before !== 1);
    this.changed += Number(cost !== first) - Number(before !== first);
  }

  get bytes() {
    return (this.now?.byteLength ?? 0) + (this.first?.byteLength ?? 0);
  }
}

export class Terrain {
  /** @param {number} width @param {number} height @param {Uint8Array} cells row by row, 1 = blocked
   * @param {MapSource} source
   * @param {boolean} wasEdited whether the cells differed from the source from the beginning
   * @param {Costs} [land] what the cells cost
   * @param {BitSet} [edits] the cells that were changed since */
  constructor(
    width,
    height,
    cells,
    source,
    wasEdited,
    land = new Costs(cells.length, null),
    edits = new BitSet(cells.length),
  ) {
    this.width = width;
    this.height = height;
    this.cells = cells;
    this.source = source;
    this.wasEdited = wasEdited;
    this.land = land;
    this.edits = edits;
  }

  get edited() {
    return this.wasEdited || this.edits.count > 0 || this.land.changed > 0;
  }

  /** @param {number} cell */
  flip(cell) {
    this.cells[cell] ^= 1;
    this.edits.flip(cell);
  }

  /** @returns {PackedTerrain} */
  pack() {
    const { width, height, source, wasEdited, edits, land } = this;
    return { width, height, source, wasEdited, edits, land, blocked: BitSet.of(this.cells) };
  }

  /** @param {PackedTerrain} packed */
  static unpack({ width, height, source, wasEdited, edits, land, blocked }) {
    return new Terrain(width, height, blocked.toCells(), source, wasEdited, land, edits);
  }
}
