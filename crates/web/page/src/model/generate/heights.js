// A hilly landscape of random heights: waves of several lengths, each half as high as the next longer one.

import { mix } from "./random.js";

/** One wave's random heights at a lattice, interpolated between its points. */
class Wave {
  /** @param {number} side @param {number} length cells between two lattice points @param {number} height
   * @param {number} seed */
  constructor(side, length, height, seed) {
    this.length = length;
    this.height = height;
    this.seed = seed;
    this.points = Math.floor(side / length) + 2;
    this.row = new Int32Array(this.points);
    /** For each place between two points, how much the second one counts, of 256: smooth at both. */
    this.share = Int32Array.from({ length }, (_, i) => {
      const t = Math.floor((i * 256) / length);
      return (t * t * (768 - 2 * t)) >> 16;
    });
  }

  /** @param {number} i @param {number} j */
  at(i, j) {
    return mix(this.seed ^ Math.imul(i, 0x1f123bb5) ^ Math.imul(j, 0x5f356495)) & 0xffff;
  }

  /** Adds the wave's heights along row y.
   * @param {number} y @param {Int32Array} sums */
  addTo(sums, y) {
    const { length, row, share, height } = this;
    const j = Math.floor(y / length);
    const down = share[y - j * length];
    for (let i = 0; i < row.length; i++) {
      row[i] = this.at(i, j) * (256 - down) + this.at(i, j + 1) * down >> 8;
    }
    for (let i = 0, x = 0; x < sums.length; i++) {
      const [a, slope] = [row[i], row[i + 1] - row[i]];
      for (let u = 0; u < length && x < sums.length; u++, x++) {
        sums[x] += (a + (slope * share[u] >> 8)) * height >> 8;
      }
    }
  }
}

/** A height from 0 to 255 for each cell. `longest`: the length of the longest wave, in cells.
 * @param {number} side @param {number} longest @param {number} seed @param {number} shortest */
export function heights(side, longest, seed, shortest = 4) {
  /** @type {Wave[]} */ const waves = [];
  let total = 0;
  for (let length = longest, height = 256; length >= shortest; length >>= 1, height >>= 1) {
    waves.push(new Wave(side, length, height, mix(seed + waves.length)));
    total += height;
  }
  const result = new Uint8Array(side * side);
  const sums = new Int32Array(side);
  // Sums of many waves are seldom near the ends: stretch them about the middle.
  const middle = 128 * total;
  for (let y = 0; y < side; y++) {
    sums.fill(0);
    for (const wave of waves) wave.addTo(sums, y);
    for (let x = 0; x < side; x++) {
      const height = 128 + Math.floor(((sums[x] - middle) * 2) / total);
      result[y * side + x] = height < 0 ? 0 : height > 255 ? 255 : height;
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
