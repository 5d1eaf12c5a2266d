// A square map that the generators draw on: rectangles, and convex shapes by the half-planes that bound them.

import { root } from "./random.js";

/** The side of a cell in the units of the shapes' coordinates. */
export const UNIT = 8;

/** The places with a·x + b·y ≥ c, in units.
 * @typedef {{ a: number, b: number, c: number }} HalfPlane */

/** The half-plane on the right hand of the way from p to q, as y points down, moved inwards.
 * @param {readonly number[]} p @param {readonly number[]} q @param {number} [inwards] units */
export function halfPlane(p, q, inwards = 0) {
  const [a, b] = [p[1] - q[1], q[0] - p[0]];
  return { a, b, c: a * p[0] + b * p[1] + inwards * root(a * a + b * b) };
}

export class Board {
  /** @param {number} side @param {0 | 1} [value] */
  constructor(side, value = 0) {
    this.side = side;
    this.cells = new Uint8Array(side * side).fill(value);
  }

  /** @param {number} x @param {number} y */
  has(x, y) {
    return x >= 0 && y >= 0 && x < this.side && y < this.side;
  }

  /** Outside of the board all is blocked.
   * @param {number} x @param {number} y */
  isBlocked(x, y) {
    return !this.has(x, y) || this.cells[y * this.side + x] === 1;
  }

  /** The cells with x0 ≤ x < x1 and y0 ≤ y < y1.
   * @param {number} x0 @param {number} y0 @param {number} x1 @param {number} y1 @param {0 | 1} value */
  rectangle(x0, y0, x1, y1, value) {
    const { side, cells } = this;
    const [left, right] = [Math.max(0, x0), Math.min(side, x1)];
    for (let y = Math.max(0, y0); y < Math.min(side, y1); y++) {
      if (left < right) cells.fill(value, y * side + left, y * side + right);
    }
  }

  /** Calls with each row of the cells whose centers are in all half-planes: y, x0 ≤ x < x1. Stops when the
   * call returns true, and returns whether it did.
   * @param {readonly HalfPlane[]} planes @param {number} top @param {number} bottom the rows to look at
   * @param {(y: number, x0: number, x1: number) => boolean | void} visit */
  rows(planes, top, bottom, visit) {
    for (let y = Math.max(0, top); y < Math.min(this.side, bottom); y++) {
      let [left, right] = [0, this.side - 1];
      for (const { a, b, c } of planes) {
        const rest = c - b * (UNIT * y + UNIT / 2) - (a * UNIT) / 2;
        if (a > 0) left = Math.max(left, Math.ceil(rest / (a * UNIT)));
        else if (a < 0) right = Math.min(right, Math.floor(rest / (a * UNIT)));
        else if (rest > 0) right = -1;
      }
      if (left <= right && visit(y, left, right + 1) === true) return true;
    }
    return false;
  }

  /** @param {readonly HalfPlane[]} planes @param {number} top @param {number} bottom @param {0 | 1} value */
  convex(planes, top, bottom, value) {
    const { side, cells } = this;
    this.rows(planes, top, bottom, (y, x0, x1) => {
      cells.fill(value, y * side + x0, y * side + x1);
    });
  }

  /** Whether all of the cells are free.
   * @param {readonly HalfPlane[]} planes @param {number} top @param {number} bottom */
  isFree(planes, top, bottom) {
    const { side, cells } = this;
    return !this.rows(planes, top, bottom, (y, x0, x1) => {
      return cells.subarray(y * side + x0, y * side + x1).includes(1);
    });
  }
}
