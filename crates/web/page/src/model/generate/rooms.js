// Rooms: a building of halls and chambers. Walls divide the place again and again, each with doors of its
// own, so that every room can be reached.

import { Board } from "./board.js";
import { root } from "./random.js";

/** @typedef {import("./random.js").Random} Random */

/** A part of the building: x0 ≤ x < x1, y0 ≤ y < y1. `depth`: how many walls made it.
 * @typedef {{ x0: number, y0: number, x1: number, y1: number, depth: number }} Part */

class Building {
  /** @param {number} side @param {Random} random */
  constructor(side, random) {
    this.board = new Board(side);
    this.random = random;
    /** The least inner side of a room. */
    this.room = 4 + Math.floor(root(side) / 3);
    this.thickest = 1 + Math.floor(side / 400);
  }

  /** Whether a wall whose first cells are at `place` meets no door at its two ends.
   * @param {Part} part @param {boolean} isUpright @param {number} place @param {number} thick */
  isClear(part, isUpright, place, thick) {
    for (let i = place - 1; i <= place + thick; i++) {
      const ends = isUpright
        ? [
            [i, part.y0 - 1],
            [i, part.y1],
          ]
        : [
            [part.x0 - 1, i],
            [part.x1, i],
          ];
      if (ends.some(([x, y]) => !this.board.isBlocked(x, y))) return false;
    }
    return true;
  }

  /** @param {Part} part @param {boolean} isUpright @param {number} place @param {number} thick */
  wall(part, isUpright, place, thick) {
    const { board, random } = this;
    const [from, to] = isUpright ? [part.y0, part.y1] : [part.x0, part.x1];
    /** @param {number} a @param {number} b @param {0 | 1} value */
    const stretch = (a, b, value) => {
      if (isUpright) board.rectangle(place, a, place + thick, b, value);
      else board.rectangle(a, place, b, place + thick, value);
    };
    stretch(from, to, 1);
    const doors = 1 + Math.floor((to - from) / (this.room * 5));
    for (let i = 0; i < doors; i++) {
      const [a, b] = [0, 1].map((j) => from + Math.floor(((to - from) * (i + j)) / doors));
      const width = Math.min(random.between(2, 2 + thick), b - a - 2);
      const door = random.between(a + 1, b - 1 - width);
      stretch(door, door + width, 0);
    }
  }

  /** Divides a part by a wall. Returns the two sides, or null if it is a room already.
   * @param {Part} part @returns {Part[] | null} */
  divide(part) {
    const { random, room } = this;
    const [width, height] = [part.x1 - part.x0, part.y1 - part.y0];
    const isUpright = width * 4 > height * 5 || (height * 4 <= width * 5 && random.chance(50));
    const [from, to] = isUpright ? [part.x0, part.x1] : [part.y0, part.y1];
    const thick = Math.max(1, this.thickest - (part.depth >> 1));
    const spare = to - from - 2 * room - thick;
    // A hall stays as large as it is now and then.
    if (spare < 0 || (part.depth > 3 && to - from < room * 5 && random.chance(12))) return null;
    for (let tries = 0; tries < 12; tries++) {
      const place = from + room + ((random.below(spare + 1) + random.below(spare + 1)) >> 1);
      if (!this.isClear(part, isUpright, place, thick)) continue;
      this.wall(part, isUpright, place, thick);
      const depth = part.depth + 1;
      const end = place + thick;
      return isUpright
        ? [
            { ...part, x1: place, depth },
            { ...part, x0: end, depth },
          ]
        : [
            { ...part, y1: place, depth },
            { ...part, y0: end, depth },
          ];
    }
    return null;
  }

  /** Columns in large rooms, and a block in the middle of some others.
   * @param {Part} part */
  furnish({ x0, y0, x1, y1 }) {
    const { board, random, room } = this;
    const [width, height] = [x1 - x0, y1 - y0];
    const size = Math.max(1, Math.floor(room / 7));
    if (Math.min(width, height) >= room * 2 && random.chance(75)) {
      const step = size * 4;
      const [left, top] = [width, height].map((length) => 1 + size + (((length - 2 - 3 * size) % step) >> 1));
      for (let y = y0 + top; y + size < y1 - 1; y += step) {
        for (let x = x0 + left; x + size < x1 - 1; x += step) board.rectangle(x, y, x + size, y + size, 1);
      }
    } else if (random.chance(15)) {
      const [dx, dy] = [width, height].map((length) => Math.max(2 + size, Math.floor(length / 3)));
      board.rectangle(x0 + dx, y0 + dy, x1 - dx, y1 - dy, 1);
    }
  }
}

/** @param {number} side @param {Random} random */
export function rooms(side, random) {
  const building = new Building(side, random);
  const edge = building.thickest;
  building.board.cells.fill(1);
  building.board.rectangle(edge, edge, side - edge, side - edge, 0);
  const parts = [{ x0: edge, y0: edge, x1: side - edge, y1: side - edge, depth: 0 }];
  for (let part = parts.pop(); part !== undefined; part = parts.pop()) {
    const sides = building.divide(part);
    if (sides === null) building.furnish(part);
    else parts.push(...sides);
  }
  return building.board.cells;
}
