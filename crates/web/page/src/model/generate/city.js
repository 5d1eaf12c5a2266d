// A city: streets cut it into blocks at various angles, wide ones first. Most blocks are built on, some
// around a court; some are parks with trees, some are squares.

import { Board, halfPlane, UNIT } from "./board.js";
import { root } from "./random.js";

/** @typedef {import("./random.js").Random} Random */

/** A corner of a block, with half the width of the street along the edge to the next corner; all in units.
 * @typedef {{ x: number, y: number, half: number }} Corner */

/** A convex block, its corners clockwise on the screen.
 * @typedef {Corner[]} Block */

/** Twice the area.
 * @param {Block} block */
function area(block) {
  return block.reduce((sum, p, i) => {
    const q = block[(i + 1) % block.length];
    return sum + p.x * q.y - q.x * p.y;
  }, 0);
}

/** The part of the block on the right of the line through (px, py) along (dx, dy).
 * @param {Block} block @param {number} px @param {number} py @param {number} dx @param {number} dy
 * @param {number} half of the street on the line @returns {Block} */
function rightOf(block, px, py, dx, dy, half) {
  const sides = block.map(({ x, y }) => dx * (y - py) - dy * (x - px));
  /** @type {Block} */ const part = [];
  block.forEach((p, i) => {
    const next = (i + 1) % block.length;
    const [here, there] = [sides[i], sides[next]];
    if (here >= 0) part.push(p);
    if (here >= 0 === there >= 0) return;
    const q = block[next];
    const x = p.x + Math.round(((q.x - p.x) * here) / (here - there));
    const y = p.y + Math.round(((q.y - p.y) * here) / (here - there));
    part.push({ x, y, half: here >= 0 ? half : p.half });
  });
  return part;
}

/** Cuts a block across its longest edge, a little askew.
 * @param {Block} block @param {Random} random @param {number} half of the street
 * @param {number} askew in percent */
function cut(block, random, half, askew) {
  let [longest, length] = [0, 0];
  block.forEach((p, i) => {
    const q = block[(i + 1) % block.length];
    const [x, y] = [q.x - p.x, q.y - p.y];
    if (x * x + y * y > length) [longest, length] = [i, x * x + y * y];
  });
  const [p, q] = [block[longest], block[(longest + 1) % block.length]];
  const along = random.between(38, 62);
  const [ex, ey] = [q.x - p.x, q.y - p.y];
  const [px, py] = [p.x + Math.floor((ex * along) / 100), p.y + Math.floor((ey * along) / 100)];
  const turn = random.between(-askew, askew);
  const [dx, dy] = [-ey + Math.floor((ex * turn) / 100), ex + Math.floor((ey * turn) / 100)];
  return [rightOf(block, px, py, dx, dy, half), rightOf(block, px, py, -dx, -dy, half)];
}

class City {
  /** @param {number} side @param {Random} random */
  constructor(side, random) {
    this.board = new Board(side);
    this.random = random;
    /** About how many cells a block is wide. */
    this.block = 8 + Math.floor((root(side) * 3) / 4);
  }

  /** Sets the cells of a block that are farther inside than its streets and `inwards`.
   * @param {Block} block @param {number} inwards units @param {0 | 1} value */
  fill(block, inwards, value) {
    const [top, bottom, planes] = this.inside(block, inwards);
    this.board.convex(planes, top, bottom, value);
  }

  /** @param {Block} block @param {number} inwards
   * @returns {[number, number, import("./board.js").HalfPlane[]]} */
  inside(block, inwards) {
    const planes = block.map((p, i) => {
      const q = block[(i + 1) % block.length];
      return halfPlane([p.x, p.y], [q.x, q.y], p.half + inwards);
    });
    const ys = block.map(({ y }) => Math.floor(y / UNIT));
    return [Math.min(...ys), Math.max(...ys) + 1, planes];
  }

  /** @param {Block} block */
  park(block) {
    const { board, random } = this;
    const [top, bottom, planes] = this.inside(block, UNIT);
    board.rows(planes, top, bottom, (y, x0, x1) => {
      for (let x = x0; x < x1; x++) {
        if (!random.chance(5)) continue;
        const size = random.between(1, 2);
        board.rectangle(x, y, x + size, y + size, 1);
      }
    });
  }

  /** A block around a court, with a gate.
   * @param {Block} block @param {number} thick units */
  court(block, thick) {
    this.fill(block, 0, 1);
    this.fill(block, thick, 0);
    const gate = this.random.below(block.length);
    const [p, q] = [block[gate], block[(gate + 1) % block.length]];
    const [a, b] = [q.x - p.x, q.y - p.y];
    // The gate is a strip across the middle of the edge.
    const middle = (a * (p.x + q.x) + b * (p.y + q.y)) / 2;
    const half = 10 * root(a * a + b * b);
    const strip = [
      { a, b, c: middle - half },
      { a: -a, b: -b, c: -middle - half },
    ];
    const outer = halfPlane([p.x, p.y], [q.x, q.y]);
    const inner = halfPlane([q.x, q.y], [p.x, p.y], -(p.half + thick + UNIT));
    const [top, bottom] = this.inside(block, 0);
    this.board.convex([...strip, outer, inner], top, bottom, 0);
  }

  /** Houses with alleys between them.
   * @param {Block} block */
  houses(block) {
    const parts = [block];
    for (let part = parts.pop(); part !== undefined; part = parts.pop()) {
      const width = Math.floor(root(Math.floor(area(part) / 2)) / UNIT);
      if (width < 9) this.fill(part, 0, 1);
      else parts.push(...cut(part, this.random, 6, 4));
    }
  }

  /** @param {Block} block */
  build(block) {
    const kind = this.random.below(100);
    const width = Math.floor(root(Math.floor(area(block) / 2)) / UNIT);
    if (kind < 10) this.park(block);
    else if (kind < 15) this.fill(block, Math.floor((width * UNIT) / 4), 1);
    else if (kind < 40 && width > 13) this.court(block, UNIT * Math.max(3, Math.floor(width / 5)));
    else if (kind < 65) this.houses(block);
    else this.fill(block, 0, 1);
  }
}

/** @param {number} side @param {Random} random */
export function city(side, random) {
  const made = new City(side, random);
  const edge = side * UNIT;
  /** @type {[Block, number][]} */
  const blocks = [
    [
      [
        [0, 0],
        [edge, 0],
        [edge, edge],
        [0, edge],
      ].map(([x, y]) => ({ x, y, half: 12 })),
      0,
    ],
  ];
  for (let next = blocks.pop(); next !== undefined; next = blocks.pop()) {
    const [block, depth] = next;
    const width = Math.floor(root(Math.floor(area(block) / 2)) / UNIT);
    if (width < (made.block * random.between(100, 150)) / 100) {
      made.build(block);
      continue;
    }
    const half = Math.min(UNIT * 10, Math.max(10, Math.floor((width * UNIT) / 40)));
    for (const part of cut(block, random, half, depth < 3 ? 45 : 10)) blocks.push([part, depth + 1]);
  }
  return made.board.cells;
}
