// A landscape: lakes, swamp beside them, grass, forest on the heights, and roads with bridges. Steps cost
// 1, 2, 4 and 8.

import { keepLargestPart } from "../ends.js";
import { heights, levelOf } from "./heights.js";

/** @typedef {import("./random.js").Random} Random */

/** The heights up to which there are lakes, swamp and grass, by the percentages of cells above them. */
const [LAKES, SWAMPS, GRASS] = [90, 74, 38];

/** @param {number} side @param {Random} random */
export function landscape(side, random) {
  const longest = Math.max(12, Math.floor(side / 3));
  const land = heights(side, random.next(), longest, 4);
  const [lake, swamp, grass] = [LAKES, SWAMPS, GRASS].map((percent) => levelOf(land, percent));
  const cells = land.map((height) => (height <= lake ? 1 : 0));
  const costs = land.map((height) => (height <= swamp ? 8 : height <= grass ? 2 : 4));
  // Roads are contour lines of other heights: they wind, and end at the border only.
  const other = heights(side, random.next(), Math.max(16, Math.floor(side / 2)), Math.max(8, side >> 3));
  const middle = levelOf(other, 50);
  const isAbove = (/** @type {number} */ x, /** @type {number} */ y) => other[y * side + x] > middle;
  for (let y = 0; y + 1 < side; y++) {
    for (let x = 0; x + 1 < side; x++) {
      const here = isAbove(x, y);
      if (here === isAbove(x + 1, y) && here === isAbove(x, y + 1)) continue;
      cells[y * side + x] = 0;
      costs[y * side + x] = 1;
    }
  }
  keepLargestPart(side, side, cells);
  return { cells, costs };
}
