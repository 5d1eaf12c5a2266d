// A warehouse: double rows of shelves with aisles between them, in halls whose shelves stand upright or
// across, wide ways between the halls, and pallets along the docks.

import { Board } from "./board.js";
import { root } from "./random.js";

/** @typedef {import("./random.js").Random} Random */
/** @typedef {{ x0: number, y0: number, x1: number, y1: number }} Hall */

const SHELF = 2;
const AISLE = 3;

/** Fills a hall with shelves.
 * @param {Board} board @param {Random} random @param {Hall} hall
 * @param {boolean} isUpright whether the shelves stand upright on the screen @param {number} length */
function shelves(board, random, { x0, y0, x1, y1 }, isUpright, length) {
  const [from, to, start, end] = isUpright ? [x0, x1, y0, y1] : [y0, y1, x0, x1];
  const count = Math.max(1, Math.floor((end - start + AISLE) / (length + AISLE)));
  const each = Math.floor((end - start - (count - 1) * AISLE) / count);
  for (let a = from; a + SHELF <= to; a += SHELF + AISLE) {
    for (let i = 0; i < count; i++) {
      const b = start + i * (each + AISLE);
      // Some places are empty, some shelves have a passage.
      if (random.chance(6)) continue;
      const passage = random.chance(12) ? b + random.below(each - 1) : -2;
      for (const [c, d] of [
        [b, passage],
        [passage < 0 ? b : passage + 2, b + each],
      ]) {
        if (d <= c) continue;
        if (isUpright) board.rectangle(a, c, a + SHELF, d, 1);
        else board.rectangle(c, a, d, a + SHELF, 1);
      }
    }
  }
}

/** Pallets: small stacks along the docks.
 * @param {Board} board @param {Random} random @param {Hall} docks */
function pallets(board, random, { x0, y0, x1, y1 }) {
  for (let y = y0; y + 2 <= y1; y += 4) {
    for (let x = x0; x + 2 <= x1; x += 4) {
      if (random.chance(35)) board.rectangle(x, y, x + 2, y + random.between(1, 2), 1);
    }
  }
}

/** @param {number} side @param {Random} random */
export function warehouse(side, random) {
  const board = new Board(side, 1);
  board.rectangle(1, 1, side - 1, side - 1, 0);
  const docks = Math.min(48, Math.max(9, Math.floor(side / 10)));
  const way = Math.max(4, Math.floor(root(side) / 4));
  pallets(board, random, { x0: 4, y0: 4, x1: docks - 2, y1: side - 4 });
  const length = 8 + Math.floor(root(side) / 3);
  const halls = Math.max(2, Math.floor(side / 96));
  for (let j = 0; j < halls; j++) {
    const [y0, y1] = [j, j + 1].map((n) => way + Math.floor(((side - way) * n) / halls));
    for (let i = 0; i < halls; i++) {
      const [x0, x1] = [i, i + 1].map((n) => docks + Math.floor(((side - docks - 1) * n) / halls));
      const hall = { x0, y0, x1: x1 - way, y1: y1 - way };
      shelves(board, random, hall, random.chance(60), length);
    }
  }
  return board.cells;
}
