// Noise: each cell is blocked by chance, independent of all others.

import { sizeOfLargestPart } from "../ends.js";

/** @typedef {import("./random.js").Random} Random */

/** With 40 % blocked, the free cells of some maps fall into small parts. Such maps are passed over.
 * @param {number} percent of the cells that are blocked
 * @returns {(side: number, random: Random) => Uint8Array} */
export function noise(percent) {
  return (side, random) => {
    for (let tries = 0; ; tries++) {
      const cells = new Uint8Array(side * side);
      for (let i = 0; i < cells.length; i++) if (random.chance(percent)) cells[i] = 1;
      const half = (cells.length * (100 - percent)) / 200;
      if (sizeOfLargestPart(side, side, cells) > half || tries > 100) return cells;
    }
  };
}
