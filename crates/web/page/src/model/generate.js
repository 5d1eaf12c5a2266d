// Maps from a seed: the same name, side and seed give the same map on every platform.

import { findEnds } from "./ends.js";
import { cave } from "./generate/cave.js";
import { city } from "./generate/city.js";
import { islands } from "./generate/islands.js";
import { maze } from "./generate/maze.js";
import { noise } from "./generate/noise.js";
import { obstacles } from "./generate/obstacles.js";
import { mix, Random } from "./generate/random.js";
import { rooms } from "./generate/rooms.js";
import { warehouse } from "./generate/warehouse.js";

/** `title`: what a menu shows. `about`: what the map is, as a sentence. `side`: a side that suits it.
 * @typedef {object} Generator
 * @property {string} name
 * @property {string} title
 * @property {string} about
 * @property {number} side
 * @property {boolean} [endsInCorners] or else the ends are as far apart as the way between them is long
 * @property {(side: number, random: Random) => Uint8Array} make */

/** @typedef {import("../../types.d.ts").Point} Point */

export const LEAST_SIDE = 32;
export const MOST_SIDE = 4096;

/** The sides that a menu offers. */
export const SIDES = Object.freeze([64, 128, 256, 512, 1024, 2048, 4096]);

/** @type {readonly Readonly<Generator>[]} */
export const generators = Object.freeze([
  {
    name: "obstacles", title: "Obstacles", side: 256, make: obstacles,
    about: "Triangles and other convex shapes on open ground: here k shows most.",
  },
  {
    name: "city", title: "City", side: 256, make: city,
    about: "Streets at angles, courts, parks and squares.",
  },
  { name: "rooms", title: "Rooms", side: 256, make: rooms, about: "Halls and chambers, joined by doors." },
  { name: "cave", title: "Cave", side: 256, make: cave, about: "Smooth rock around chambers and passages." },
  { name: "islands", title: "Islands", side: 512, make: islands, about: "The sea between coast lines." },
  {
    name: "warehouse", title: "Warehouse", side: 128, make: warehouse,
    about: "Rows of shelves with aisles between them.",
  },
  {
    name: "maze", title: "Maze", side: 128, make: maze((side) => 3 + 2 * Math.floor(side / 256)),
    about: "Wide corridors with some loops.", endsInCorners: true,
  },
  {
    name: "narrow-maze", title: "Narrow maze", side: 128, make: maze(() => 1),
    about: "Corridors one cell wide, with some loops.", endsInCorners: true,
  },
  ...[10, 20, 30, 40].map((percent) => ({
    name: `noise-${percent}`, title: `Random, ${percent} %`, side: 256, make: noise(percent),
    about: `Each cell is blocked with a chance of ${percent} %.`,
  })),
]);

/** Why there is no such map, as a sentence; empty if there is.
 * @param {string} name @param {number} side @param {number} seed */
export function whyNotGenerated(name, side, seed) {
  if (!generators.some((generator) => generator.name === name)) return `There is no generated map "${name}".`;
  if (!Number.isInteger(side) || side < LEAST_SIDE || side > MOST_SIDE) {
    return `The side of a generated map is a whole number from ${LEAST_SIDE} to ${MOST_SIDE}.`;
  }
  const isSeed = Number.isInteger(seed) && seed >= 0 && seed <= 0xffff_ffff;
  return isSeed ? "" : "The seed of a generated map is a whole number from 0 to 4294967295.";
}

/** A map with ends. Throws if there is no such generator, side or seed.
 * @param {string} name @param {number} side @param {number} seed from 0 to 2³² - 1 */
export function generate(name, side, seed) {
  const generator = generators.find((entry) => entry.name === name);
  const why = whyNotGenerated(name, side, seed);
  if (generator === undefined || why !== "") throw new RangeError(why);
  const { make, endsInCorners } = generator;
  const cells = make(side, new Random(mix(seed) ^ side));
  const ends = endsInCorners ? cornerEnds(side, cells) : findEnds(side, side, cells);
  return { width: side, height: side, cells, ...ends };
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
