// Sets of cells with one bit a cell: what a stroke flipped, what differs from the map as it was loaded.

/** A set of the numbers from 0 to `size - 1`. */
export class BitSet {
  /** @param {number} size */
  constructor(size) {
    this.size = size;
    this.words = new Uint32Array(Math.ceil(size / 32));
    this.count = 0;
  }

  /** The set of the cells that are not 0.
   * @param {Uint8Array} cells */
  static of(cells) {
    const set = new BitSet(cells.length);
    const { words } = set;
    let count = 0;
    for (let i = 0; i < cells.length; i++) {
      if (cells[i] !== 0) {
        words[i >>> 5] |= 1 << (i & 31);
        count++;
      }
    }
    set.count = count;
    return set;
  }

  /** Adds the number, or takes it out if it is there.
   * @param {number} i */
  flip(i) {
    const bit = 1 << (i & 31);
    this.count += (this.words[i >>> 5] & bit) === 0 ? 1 : -1;
    this.words[i >>> 5] ^= bit;
  }

  clear() {
    if (this.count > 0) this.words.fill(0);
    this.count = 0;
  }

  /** Calls with each number of the set, in order.
   * @param {(i: number) => void} visit */
  forEach(visit) {
    const { words } = this;
    for (let w = 0; w < words.length; w++) {
      for (let word = words[w]; word !== 0; word &= word - 1) {
        visit((w << 5) + 31 - Math.clz32(word & -word));
      }
    }
  }

  /** The numbers of the set, in order. */
  toList() {
    const list = new Uint32Array(this.count);
    let n = 0;
    this.forEach((i) => (list[n++] = i));
    return list;
  }

  /** A cell for each number: 1 for those of the set. */
  toCells() {
    const cells = new Uint8Array(this.size);
    this.forEach((i) => (cells[i] = 1));
    return cells;
  }

  /** A set of its own with the same numbers. */
  copy() {
    const set = new BitSet(0);
    set.size = this.size;
    set.words = this.words.slice();
    set.count = this.count;
    return set;
  }
}
