// A maze: corridors grown by a random walk that turns back at dead ends. Some walls are opened again, so that
// there are several ways.

/** @typedef {import("./random.js").Random} Random */

/** The directions out of a place of the maze: right, down, left, up. */
const [DX, DY] = [
  [1, 0, -1, 0],
  [0, 1, 0, -1],
];

/** @param {number} columns @param {number} rows @param {Random} random
 * @returns {Uint8Array} for each place, bit 0: open to the right, bit 1: open downwards */
function corridors(columns, rows, random) {
  const open = new Uint8Array(columns * rows);
  const seen = new Uint8Array(columns * rows);
  const way = new Int32Array(columns * rows);
  let length = 1;
  way[0] = random.below(columns * rows);
  seen[way[0]] = 1;
  while (length > 0) {
    const place = way[length - 1];
    const x = place % columns;
    const y = (place - x) / columns;
    const first = random.below(4);
    let next = -1;
    // An odd step visits all four directions, in one sense or the other.
    for (let i = 0, step = 1 + 2 * random.below(2); i < 4 && next < 0; i++) {
      const d = (first + i * step) & 3;
      const [u, v] = [x + DX[d], y + DY[d]];
      if (u < 0 || v < 0 || u >= columns || v >= rows || seen[v * columns + u] === 1) continue;
      next = v * columns + u;
      open[d < 2 ? place : next] |= (d & 1) === 0 ? 1 : 2;
    }
    if (next < 0) {
      length--;
    } else {
      seen[next] = 1;
      way[length++] = next;
    }
  }
  for (let i = 0; i < open.length; i++) if (random.chance(4)) open[i] |= 1 + random.below(2);
  return open;
}

/** @param {(side: number) => number} corridorOf the width of the corridors; a wall is a fifth as thick
 * @returns {(side: number, random: Random) => Uint8Array} */
export function maze(corridorOf) {
  return (side, random) => {
    const corridor = corridorOf(side);
    const wall = Math.max(1, Math.floor(corridor / 5));
    const step = corridor + wall;
    const places = Math.floor((side - wall) / step);
    const open = corridors(places, places, random);
    const cells = new Uint8Array(side * side).fill(1);
    const edge = (side - places * step + wall) >> 1;
    for (let j = 0; j < places; j++) {
      for (let i = 0; i < places; i++) {
        const way = open[j * places + i];
        const [x, y] = [edge + i * step, edge + j * step];
        const right = (way & 1) !== 0 && i + 1 < places ? step : corridor;
        const down = (way & 2) !== 0 && j + 1 < places ? step : corridor;
        for (let v = 0; v < down; v++) {
          const row = (y + v) * side + x;
          cells.fill(0, row, row + (v < corridor ? right : corridor));
        }
      }
    }
    return cells;
  };
}
