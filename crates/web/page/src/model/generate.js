// Maps from a seed: the same name, side and seed give the same map on every platform.

import { findEnds } from "./ends.js";
import { cave } from "./generate/cave.js";
import { city } from "./generate/city.js";
import { islands } from "./generate/islands.js";
import { landscape } from "./generate/landscape.js";
import { maze } from "./generate/maze.js";
import { noise } from "./generate/noise.js";
import { obstacles } from "./generate/obstacles.js";
import { mix, Random } from "./generate/random.js";
import { rooms } from "./generate/rooms.js";
import { warehouse } from "./generate/warehouse.js";
import { generators, PERCENTS, whyNotGenerated } from "./generators.js";

/** @typedef {import("../../types.d.ts").Point} Point */

/** Cells, and what steps on them cost if that differs.
 * @typedef {Uint8Array | { cells: Uint8Array, costs: Uint8Array }} Made */

/** The functions that make the cells, by the names of the generators.
 * @type {Record<string, (side: number, random: Random) => Made>} */
const makers = {
  obstacles,
  city,
  rooms,
  cave,
  islands,
  landscape,
  warehouse,
  maze: maze((side) => 3 + 2 * Math.floor(side / 256)),
  "narrow-maze": maze(() => 1),
  ...Object.fromEntries(PERCENTS.map((percent) => [`noise-${percent}`, noise(percent)])),
};

/** A map with ends. Throws if there is no such generator, side or seed.
 * @param {string} name @param {number} side @param {number} seed from 0 to 2³² - 1 */
export function generate(name, side, seed) {
  const generator = generators.find((entry) => entry.name === name);
  const why = whyNotGenerated(name, side, seed);
  if (generator === undefined || why !== "") throw new RangeError(why);
  const made = makers[name](side, new Random(mix(seed) ^ side));
  const { cells, costs } = made instanceof Uint8Array ? { cells: made, costs: null } : made;
  const ends = generator.endsInCorners ? cornerEnds(side, cells) : findEnds(side, side, cells);
  return { width: side, height: side, cells, costs, ...ends };
}

/** The middles of the first free stretches of the diagonal from the top left and from the bottom right.
 * @param {number} side @param {Uint8Array} cells
 * @returns {{ start: Point, goal: Point }} */
function cornerEnds(side, cells) {
  const diagonal = Array.from({ length: side }, (_, i) => cells[i * (side + 1)]);
  /** @param {number[]} values */
  const middle = (values) => {
    const first = values.indexOf(0);
    return (first + values.indexOf(1, first) - 1) >> 1;
  };
  const [near, far] = [middle(diagonal), side - 1 - middle(diagonal.reverse())];
  return { start: [near, near], goal: [far, far] };
}
