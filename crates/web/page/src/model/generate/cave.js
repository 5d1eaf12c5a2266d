// A cave: random rock, denser in some regions than in others, worn smooth by a cellular automaton.

import { keepLargestPart } from "../ends.js";
import { heights } from "./heights.js";
import { root } from "./random.js";

/** @typedef {import("./random.js").Random} Random */

/** One step: a cell is rock if most of the 3 × 3 cells around it are. Outside is rock.
 * @param {number} side @param {Uint8Array} cells */
function wear(side, cells) {
  const result = new Uint8Array(cells.length);
  const columns = new Uint8Array(side + 2);
  columns[0] = columns[side + 1] = 3;
  for (let y = 0; y < side; y++) {
    const row = y * side;
    for (let x = 0; x < side; x++) {
      const above = y > 0 ? cells[row - side + x] : 1;
      const below = y + 1 < side ? cells[row + side + x] : 1;
      columns[x + 1] = above + cells[row + x] + below;
    }
    for (let x = 0; x < side; x++) result[row + x] = columns[x] + columns[x + 1] + columns[x + 2] > 4 ? 1 : 0;
  }
  return result;
}

/** Each cell as four.
 * @param {number} side @param {Uint8Array} cells @param {number} newSide about twice the side */
function twice(side, cells, newSide) {
  const result = new Uint8Array(newSide * newSide);
  for (let y = 0; y < newSide; y++) {
    const row = Math.min(y >> 1, side - 1) * side;
    for (let x = 0; x < newSide; x++) result[y * newSide + x] = cells[row + Math.min(x >> 1, side - 1)];
  }
  return result;
}

/** Random rock, and what wear makes of it. Large caves grow out of small ones: so they have large chambers.
 * @param {number} side @param {number} first the largest side that does not grow out of a smaller one
 * @param {Random} random @returns {Uint8Array} */
function rock(side, first, random) {
  if (side > first) {
    const half = (side + 1) >> 1;
    let cells = twice(half, rock(half, first, random), side);
    for (let i = 0; i < cells.length; i++) if (random.chance(6)) cells[i] ^= 1;
    for (let i = 0; i < 3; i++) cells = wear(side, cells);
    return cells;
  }
  const density = heights(side, random.next(), Math.max(16, side >> 3), 8);
  let cells = new Uint8Array(side * side);
  for (let i = 0; i < cells.length; i++) cells[i] = random.chance(40 + ((density[i] * 13) >> 8)) ? 1 : 0;
  for (let i = 0; i < 5; i++) cells = wear(side, cells);
  return cells;
}

/** @param {number} side @param {Random} random */
export function cave(side, random) {
  const first = 32 + 8 * root(side);
  let cells = rock(side, first, random);
  for (let tries = 0; keepLargestPart(side, side, cells) * 9 < side * side * 4 && tries < 20; tries++) {
    cells = rock(side, first, random);
  }
  return cells;
}
