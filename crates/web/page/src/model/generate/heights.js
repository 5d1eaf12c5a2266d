// A hilly landscape of random heights: waves of several lengths, the shorter the lower.

import { mix } from "./random.js";

/** One wave: random slopes at the points of a lattice, and heights between them that follow the slopes. */
class Wave {
  /** @param {number} side @param {number} length cells between two points of the lattice
   * @param {number} height @param {number} seed */
  constructor(side, length, height, seed) {
    this.length = length;
    this.height = height;
    this.seed = seed;
    // The lattices of the waves must not lie on each other: their lines would show.
    this.shift = mix(seed) % length;
    /** For each cell between two points, how far it is from the first one, of 256. */
    this.place = Int32Array.from({ length }, (_, i) => Math.floor((i * 256) / length));
    /** And how much the second point counts, of 256: smooth at both. */
    this.share = this.place.map((t) => (t * t * (768 - 2 * t)) >> 16);
    /** For each column of points: the height at this row, and the slope to the right. */
    this.level = new Int32Array(Math.floor(side / length) + 3);
    this.slope = new Int32Array(this.level.length);
  }

  /** @param {number} i @param {number} j */
  at(i, j) {
    return mix(this.seed ^ Math.imul(i, 0x1f123bb5) ^ Math.imul(j, 0x5f356495));
  }

  /** Adds the wave's heights along row y.
   * @param {Int32Array} sums @param {number} y */
  addTo(sums, y) {
    const { length, level, slope, place, share, height } = this;
    const j = Math.floor((y + this.shift) / length);
    const v = y + this.shift - j * length;
    const [down, part] = [place[v], share[v]];
    for (let i = 0; i < level.length; i++) {
      const [above, below] = [this.at(i, j), this.at(i, j + 1)];
      const [upper, lower] = [((above & 255) - 128) * down, ((below & 255) - 128) * (down - 256)];
      level[i] = upper + (((lower - upper) * part) >> 8);
      const [first, second] = [((above >> 8) & 255) - 128, ((below >> 8) & 255) - 128];
      slope[i] = first + (((second - first) * part) >> 8);
    }
    for (let i = 0, x = 0; x < sums.length; i++) {
      const [base, rise, next, fall] = [level[i], slope[i], level[i + 1], slope[i + 1]];
      const first = i === 0 ? this.shift : 0;
      const last = Math.min(length, first + sums.length - x);
      for (let u = first; u < last; u++, x++) {
        const left = base + rise * place[u];
        const right = next + fall * (place[u] - 256);
        sums[x] += ((left + (((right - left) * share[u]) >> 8)) * height) >> 8;
      }
    }
  }
}

/** A height from 0 to 255 for each cell.
 * @param {number} side @param {number} seed @param {number} longest the length of the longest wave, in cells
 * @param {number} shortest the least length of the shortest wave */
export function heights(side, seed, longest, shortest) {
  /** @type {Wave[]} */ const waves = [];
  let total = 0;
  for (let length = longest, height = 256; length >= shortest; ) {
    waves.push(new Wave(side, length, height, mix(seed + waves.length)));
    total += height;
    [length, height] = [Math.floor((length * 2) / 3), Math.floor((height * 2) / 3)];
  }
  const result = new Uint8Array(side * side);
  const sums = new Int32Array(side);
  for (let y = 0; y < side; y++) {
    sums.fill(0);
    for (const wave of waves) wave.addTo(sums, y);
    for (let x = 0; x < side; x++) {
      const height = 128 + Math.floor((sums[x] * 3) / total);
      result[y * side + x] = Math.min(Math.max(height, 0), 255);
    }
  }
  return result;
}

/** The least height above which are no more than `percent` of the cells.
 * @param {Uint8Array} result @param {number} percent */
export function levelOf(result, percent) {
  const counts = new Uint32Array(256);
  for (let i = 0; i < result.length; i++) counts[result[i]]++;
  let above = 0;
  for (let level = 255; level > 0; level--) {
    above += counts[level];
    if (above * 100 > result.length * percent) return level;
  }
  return 0;
}
