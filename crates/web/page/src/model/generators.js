// The list of generators of maps. The functions that make the cells are in generate.js.

/** `title`: the name in menus. `about`: a description of the map. `side`: a side that suits it.
 * @typedef {object} Generator
 * @property {string} name
 * @property {string} title
 * @property {string} about
 * @property {number} side
 * @property {boolean} [endsInCorners] or else the ends are as far apart as the way between them is long */

const LEAST_SIDE = 32;
const MOST_SIDE = 4096;

/** The sides that a menu offers. */
export const SIDES = Object.freeze([64, 128, 256, 512, 1024, 2048, 4096]);

/** The percentages of blocked cells in the random maps. */
export const PERCENTS = Object.freeze([10, 20, 30, 40]);

/** @type {readonly Readonly<Generator>[]} */
export const generators = Object.freeze([
  {
    name: "obstacles",
    title: "Obstacles",
    side: 256,
    about: "Triangles and other convex shapes on open ground: here k shows most.",
  },
  {
    name: "city",
    title: "City",
    side: 256,
    about: "Streets at angles, courts, parks and squares.",
  },
  { name: "rooms", title: "Rooms", side: 256, about: "Halls and chambers, joined by doors." },
  { name: "cave", title: "Cave", side: 256, about: "Smooth rock around chambers and passages." },
  { name: "islands", title: "Islands", side: 512, about: "The sea between coast lines." },
  {
    name: "landscape",
    title: "Landscape",
    side: 128,
    about: "Roads, grass, forest, swamp and lakes: steps cost 1, 2, 4 and 8.",
  },
  {
    name: "warehouse",
    title: "Warehouse",
    side: 128,
    about: "Rows of shelves with aisles between them.",
  },
  {
    name: "maze",
    title: "Maze",
    side: 128,
    about: "Wide corridors with some loops.",
    endsInCorners: true,
  },
  {
    name: "narrow-maze",
    title: "Narrow maze",
    side: 128,
    about: "Corridors one cell wide, with some loops.",
    endsInCorners: true,
  },
  ...PERCENTS.map((percent) => ({
    name: `noise-${percent}`,
    title: `Random, ${percent} %`,
    side: 256,
    about: `Each cell is blocked with a chance of ${percent} %.`,
  })),
]);

/** The mistake in the request for a generated map, as a sentence; empty if there is none.
 * @param {string} name @param {number} side @param {number} seed */
export function whyNotGenerated(name, side, seed) {
  if (!generators.some((generator) => generator.name === name)) return `There is no generated map "${name}".`;
  if (!Number.isInteger(side) || side < LEAST_SIDE || side > MOST_SIDE) {
    return `The side of a generated map is a whole number from ${LEAST_SIDE} to ${MOST_SIDE}.`;
  }
  const isSeed = Number.isInteger(seed) && seed >= 0 && seed <= 0xffff_ffff;
  return isSeed ? "" : "The seed of a generated map is a whole number from 0 to 4294967295.";
}
