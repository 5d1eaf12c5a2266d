// The details of the model's `change` events: the rectangle of changed cells, and two changes as one.

/** @typedef {import("../../types.d.ts").Rect} Rect */

/** The parts of the scene that a change touched. `gesture`: a gesture began or ended.
 * @typedef {import("../../types.d.ts").Change & { gesture?: boolean }} Change */

/** The smallest rectangle around the cells that are added. */
export class Box {
  #left = Infinity;
  #right = -Infinity;
  #top = Infinity;
  #bottom = -Infinity;

  /** @param {number} width of the map */
  constructor(width) {
    this.width = width;
  }

  /** @param {number} cell */
  add(cell) {
    const x = cell % this.width;
    const y = (cell - x) / this.width;
    if (x < this.#left) this.#left = x;
    if (x > this.#right) this.#right = x;
    if (y < this.#top) this.#top = y;
    if (y > this.#bottom) this.#bottom = y;
  }

  /** Null if no cell was added.
   * @returns {Rect | null} */
  get rect() {
    if (this.#left > this.#right) return null;
    const [x, y] = [this.#left, this.#top];
    return { x, y, width: this.#right - x + 1, height: this.#bottom - y + 1 };
  }
}

/** Two changes as one.
 * @param {Change} a @param {Change} b @returns {Change} */
export function joined(a, b) {
  if (!a.cells || !b.cells) return { ...a, ...b };
  const x = Math.min(a.cells.x, b.cells.x);
  const y = Math.min(a.cells.y, b.cells.y);
  const width = Math.max(a.cells.x + a.cells.width, b.cells.x + b.cells.width) - x;
  const height = Math.max(a.cells.y + a.cells.height, b.cells.y + b.cells.height) - y;
  return { ...a, ...b, cells: { x, y, width, height } };
}
