// Islands: the sea between coast lines. High ground is land, which is blocked.

import { keepLargestPart } from "../ends.js";
import { heights, levelOf } from "./heights.js";

/** @typedef {import("./random.js").Random} Random */

/** @param {number} side @param {Random} random */
export function islands(side, random) {
  const longest = Math.max(12, Math.floor(side / 6));
  const land = heights(side, random.next(), longest, Math.max(4, side >> 9));
  const level = levelOf(land, 34);
  const cells = land.map((height) => (height > level ? 1 : 0));
  keepLargestPart(side, side, cells);
  return cells;
}
