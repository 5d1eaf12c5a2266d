// Finds a start and a goal for a map that has none: free cells in the largest connected part, far apart.

/** @typedef {import("../../types.d.ts").Point} Point */

/** The share of a search's cells, the last ones, where an end is looked for, and at how many of them. */
const LATE = 0.4;
const CANDIDATES = 4000;

/** A breadth-first search over the edges of cells. It keeps what it has seen: so it can count parts. */
class Spread {
  /** @param {number} width @param {number} height @param {Uint8Array} cells */
  constructor(width, height, cells) {
    this.width = width;
    this.height = height;
    this.seen = cells.slice();
    this.queue = new Int32Array(cells.length);
  }

  /** Visits all cells that are connected with `from`. Returns how many; `queue` has them by distance.
   * @param {number} from */
  from(from) {
    const { width, seen, queue } = this;
    const size = seen.length;
    let tail = 1;
    queue[0] = from;
    seen[from] = 1;
    for (let head = 0; head < tail; head++) {
      const cell = queue[head];
      const x = cell % width;
      if (x > 0 && seen[cell - 1] === 0) {
        seen[cell - 1] = 1;
        queue[tail++] = cell - 1;
      }
      if (x + 1 < width && seen[cell + 1] === 0) {
        seen[cell + 1] = 1;
        queue[tail++] = cell + 1;
      }
      if (cell >= width && seen[cell - width] === 0) {
        seen[cell - width] = 1;
        queue[tail++] = cell - width;
      }
      if (cell + width < size && seen[cell + width] === 0) {
        seen[cell + width] = 1;
        queue[tail++] = cell + width;
      }
    }
    return tail;
  }
}

/** The largest connected part: the first of its cells, and how many there are.
 * @param {Spread} spread */
function largestPart(spread) {
  const { seen } = spread;
  let left = 0;
  for (let i = 0; i < seen.length; i++) left += 1 - seen[i];
  const best = { cell: -1, count: 0 };
  for (let i = 0; i < seen.length && left > best.count; i++) {
    if (seen[i] !== 0) continue;
    const count = spread.from(i);
    left -= count;
    if (count > best.count) Object.assign(best, { cell: i, count });
  }
  return best;
}

/** The number of free cells in the largest connected part.
 * @param {number} width @param {number} height @param {Uint8Array} cells */
export function sizeOfLargestPart(width, height, cells) {
  return largestPart(new Spread(width, height, cells)).count;
}

/** Blocks all cells but those of the largest connected part. Returns how many are free.
 * @param {number} width @param {number} height @param {Uint8Array} cells */
export function keepLargestPart(width, height, cells) {
  const { cell, count } = largestPart(new Spread(width, height, cells));
  if (cell < 0) return 0;
  const spread = new Spread(width, height, cells);
  spread.from(cell);
  cells.fill(1);
  for (let i = 0; i < count; i++) cells[spread.queue[i]] = 0;
  return count;
}

/** The number of free cells among the 5 × 5 around a cell.
 * @param {number} cell @param {number} width @param {number} height @param {Uint8Array} cells */
function roomAround(cell, width, height, cells) {
  const [x, y] = [cell % width, Math.floor(cell / width)];
  let room = 0;
  for (let v = Math.max(0, y - 2); v <= Math.min(height - 1, y + 2); v++) {
    for (let u = Math.max(0, x - 2); u <= Math.min(width - 1, x + 2); u++) room += 1 - cells[v * width + u];
  }
  return room;
}

/** A cell far from where a search began: one of those that it reached late, far away also as the crow flies,
 * and with much room, as an end in a nook looks odd.
 * @param {Spread} spread @param {number} count @param {Uint8Array} cells */
function farthest({ queue, width, height }, count, cells) {
  const [x, y] = [queue[0] % width, Math.floor(queue[0] / width)];
  const step = Math.ceil((count * LATE) / CANDIDATES);
  let best = queue[count - 1];
  let most = -1;
  for (let i = count - 1; i >= count * (1 - LATE); i -= step) {
    const cell = queue[i];
    const [dx, dy] = [(cell % width) - x, Math.floor(cell / width) - y];
    const score = (dx * dx + dy * dy) * (5 + roomAround(cell, width, height, cells));
    if (score > most) [best, most] = [cell, score];
  }
  return best;
}

/** Two free cells far apart in the largest connected part; the left one is the start. An end that is given
 * stays, and the other one is far from it. In a map without a free cell: two corners of the map.
 * @param {number} width @param {number} height @param {Uint8Array} cells
 * @param {{ start?: Point, goal?: Point }} [given]
 * @returns {{ start: Point, goal: Point }} */
export function findEnds(width, height, cells, given = {}) {
  /** @param {number} cell @returns {Point} */
  const point = (cell) => [cell % width, Math.floor(cell / width)];
  if (given.start && given.goal) return { start: given.start, goal: given.goal };
  const end = given.start ?? given.goal;
  const place = end ? end[1] * width + end[0] : -1;
  const isPlace = end !== undefined && end[0] >= 0 && end[0] < width && cells[place] === 0;
  const { cell } = isPlace ? { cell: place } : largestPart(new Spread(width, height, cells));
  if (cell < 0) return { start: given.start ?? [0, 0], goal: given.goal ?? [width - 1, height - 1] };

  const sweep = () => {
    const spread = new Spread(width, height, cells);
    return (/** @type {number} */ from) => farthest(spread, spread.from(from), cells);
  };
  const first = sweep()(cell);
  if (given.start) return { start: given.start, goal: point(first) };
  if (given.goal) return { start: point(first), goal: given.goal };
  const ends = [point(first), point(sweep()(first))];
  ends.sort(([ax, ay], [bx, by]) => ax - bx || ay - by);
  return { start: ends[0], goal: ends[1] };
}
