// Noise: each cell is blocked by chance, independent of all others.

/** @typedef {import("./random.js").Random} Random */

/** @param {number} percent of the cells that are blocked
 * @returns {(side: number, random: Random) => Uint8Array} */
export function noise(percent) {
  return (side, random) => {
    const cells = new Uint8Array(side * side);
    for (let i = 0; i < cells.length; i++) if (random.chance(percent)) cells[i] = 1;
    return cells;
  };
}
