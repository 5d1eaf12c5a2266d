// Obstacles: triangles and other convex shapes, far from each other, on open ground. Here the shortest path
// depends most on the directions that a move may take.

import { Board, UNIT } from "./board.js";
import { root } from "./random.js";

/** @typedef {import("./random.js").Random} Random */
/** @typedef {import("./board.js").HalfPlane} HalfPlane */

/** Directions around, in order: the corners of a polygon that is nearly round. */
const DIRECTIONS = (() => {
  const quarter = [
    [16, 0],
    [16, 3],
    [15, 6],
    [13, 9],
    [11, 11],
    [9, 13],
    [6, 15],
    [3, 16],
  ];
  const turn = (/** @type {number[]} */ [x, y]) => [-y, x];
  const second = quarter.map(turn);
  const third = second.map(turn);
  return [...quarter, ...second, ...third, ...third.map(turn)];
})();

/** A convex shape around (x, y), as half-planes that face its middle at these distances.
 * @param {number} x @param {number} y @param {{ turn: number, distance: number }[]} edges
 * @returns {HalfPlane[]} */
function shape(x, y, edges) {
  return edges.map(({ turn, distance }) => {
    const [dx, dy] = DIRECTIONS[turn % DIRECTIONS.length];
    const away = dx * x + dy * y + distance * root(dx * dx + dy * dy);
    return { a: -dx, b: -dy, c: -away };
  });
}

/** The edges of a triangle, a bar, or a polygon of up to seven edges, about `radius` wide.
 * @param {number} radius in units @param {Random} random */
function edges(radius, random) {
  const first = random.below(32);
  const kind = random.below(100);
  if (kind < 45) {
    const turns = [first, first + random.between(9, 12), first + random.between(20, 23)];
    return turns.map((turn) => ({ turn, distance: radius >> 1 }));
  }
  if (kind < 65) {
    const thin = Math.floor(radius / random.between(3, 6));
    return [0, 8, 16, 24].map((turn) => ({ turn: first + turn, distance: turn % 16 === 0 ? thin : radius }));
  }
  const count = random.between(4, 7);
  return Array.from({ length: count }, (_, i) => ({
    turn: first + Math.floor((32 * i + random.below(20)) / count),
    distance: Math.floor((radius * random.between(60, 85)) / 100),
  }));
}

/** @param {number} side @param {Random} random */
export function obstacles(side, random) {
  const board = new Board(side);
  const gap = 2 + Math.floor(side / 128);
  const [least, most] = [Math.max(2, Math.floor(side / 60)), Math.max(6, Math.floor(side / 11))];
  const tries = 500;
  for (let i = 0; i < tries; i++) {
    // The large ones first.
    const radius = least + Math.floor(((most - least) * (tries - i) * (tries - i)) / (tries * tries));
    const [x, y] = [random.below(side), random.below(side)];
    const outline = edges(radius * UNIT, random);
    const [top, bottom] = [y - 3 * radius - gap, y + 3 * radius + gap];
    const [px, py] = [x * UNIT + random.below(UNIT), y * UNIT + random.below(UNIT)];
    const wide = outline.map((edge) => ({ ...edge, distance: edge.distance + gap * UNIT }));
    if (board.isFree(shape(px, py, wide), top, bottom)) board.convex(shape(px, py, outline), top, bottom, 1);
  }
  return board.cells;
}
