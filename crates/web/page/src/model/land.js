// The kinds of land: what a step on each costs. Walls are no land.

/** @typedef {{ cost: number, name: string }} Land */

/** From the cheapest to the dearest.
 * @type {readonly Readonly<Land>[]} */
export const LAND = Object.freeze([
  { cost: 1, name: "Road" },
  { cost: 2, name: "Grass" },
  { cost: 4, name: "Forest" },
  { cost: 8, name: "Swamp" },
]);

/** The largest k that there is where steps cost differently. */
export const LARGEST_K_ON_LAND = 8;

/** On a map of more cells it would take minutes to find what each k is worth on land, and seconds without. */
export const MOST_CELLS_OF_LADDER = 2 ** 20;
export const MOST_CELLS_OF_STEPS = 2 ** 18;

/** @param {number} cost */
export const landOf = (cost) => LAND.find((land) => land.cost === cost);

/** Cells and costs in one array; the cells themselves where all land costs 1.
 * @param {Uint8Array} cells @param {Uint8Array | null} costs */
export function merged(cells, costs) {
  return costs === null ? cells : cells.map((cell, i) => cell | (costs[i] << 1));
}

/** The cells whose costs differ, by what they cost in the second one.
 * @param {Uint8Array | null} from @param {Uint8Array | null} to @returns {Map<number, Uint32Array>} */
export function differences(from, to) {
  /** @type {Map<number, number[]>} */ const found = new Map();
  const size = from?.length ?? to?.length ?? 0;
  for (let i = 0; i < size; i++) {
    const [before, after] = [from?.[i] ?? 1, to?.[i] ?? 1];
    if (before === after) continue;
    const list = found.get(after);
    if (list) list.push(i);
    else found.set(after, [i]);
  }
  return new Map([...found].map(([cost, list]) => [cost, Uint32Array.from(list)]));
}
