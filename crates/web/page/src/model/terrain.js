// The map of a scene: its cells, where it came from, and which cells were changed since.

import { BitSet } from "./bits.js";

/** @typedef {import("../../types.d.ts").MapSource} MapSource */

/** A terrain with one bit a cell, as undo keeps it.
 * @typedef {{ width: number, height: number, source: MapSource, wasEdited: boolean, blocked: BitSet,
 *   edits: BitSet }} PackedTerrain */

export class Terrain {
  /** @param {number} width @param {number} height @param {Uint8Array} cells row by row, 1 = blocked
   * @param {MapSource} source
   * @param {boolean} wasEdited whether the cells differed from the source from the beginning
   * @param {BitSet} [edits] the cells that were changed since */
  constructor(width, height, cells, source, wasEdited, edits = new BitSet(cells.length)) {
    this.width = width;
    this.height = height;
    this.cells = cells;
    this.source = source;
    this.wasEdited = wasEdited;
    this.edits = edits;
  }

  get edited() {
    return this.wasEdited || this.edits.count > 0;
  }

  /** @param {number} cell */
  flip(cell) {
    this.cells[cell] ^= 1;
    this.edits.flip(cell);
  }

  /** @returns {PackedTerrain} */
  pack() {
    const { width, height, source, wasEdited, edits } = this;
    return { width, height, source, wasEdited, edits, blocked: BitSet.of(this.cells) };
  }

  /** @param {PackedTerrain} packed */
  static unpack({ width, height, source, wasEdited, edits, blocked }) {
    return new Terrain(width, height, blocked.toCells(), source, wasEdited, edits);
  }
}
