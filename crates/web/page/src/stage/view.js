// The view of the map: one center and one scale for all panes, so that they move together.

/**
 * The position and the scale of the map in a pane, in device pixels.
 * @typedef {object} Frame
 * @property {number} left
 * @property {number} top
 * @property {number} scale Pixels a cell.
 * @property {number} width Of the pane.
 * @property {number} height
 * @property {number} dpr Device pixels in a pixel of the page.
 */

const LARGEST_CELL = 160;

export class View {
  constructor() {
    /** Pixels of the page a cell. */
    this.scale = 1;
    /** The place in the map, in cells, at the center of each pane. */
    this.x = 0;
    this.y = 0;
    /** Whether the whole map is shown, also after the next change of size. */
    this.isFitted = true;
    /** @type {[number, number]} */
    this.map = [1, 1];
    /** @type {[number, number]} */
    this.pane = [1, 1];
    this.dpr = 1;
  }

  /** @param {number} width @param {number} height */
  setMap(width, height) {
    this.map = [width, height];
    this.fit();
  }

  /** The size of the smallest pane. @param {number} width @param {number} height @param {number} dpr */
  setPane(width, height, dpr) {
    this.pane = [Math.max(1, width), Math.max(1, height)];
    this.dpr = dpr;
    if (this.isFitted) this.fit();
    else this.#clamp();
  }

  /** The scale at which the map fits a pane of this size. @param {number} width @param {number} height */
  scaleFor(width, height) {
    const margin = Math.min(20, 0.03 * Math.min(width, height) + 4);
    const scale = Math.min((width - 2 * margin) / this.map[0], (height - 2 * margin) / this.map[1]);
    // Cells of whole pixels are all alike.
    const whole = Math.floor(scale * this.dpr) / this.dpr;
    return Math.max(1e-3, scale * this.dpr >= 5 ? whole : scale);
  }

  fit() {
    this.scale = Math.min(LARGEST_CELL, this.scaleFor(...this.pane));
    [this.x, this.y] = [this.map[0] / 2, this.map[1] / 2];
    this.isFitted = true;
  }

  /** Moves the map by so many pixels of the page. @param {number} dx @param {number} dy */
  pan(dx, dy) {
    this.x -= dx / this.scale;
    this.y -= dy / this.scale;
    this.isFitted = false;
    this.#clamp();
  }

  /** Zooms around a place that is so many pixels from a pane's center.
   *  @param {number} factor @param {number} dx @param {number} dy */
  zoom(factor, dx = 0, dy = 0) {
    const least = Math.min(LARGEST_CELL, 0.5 * this.scaleFor(...this.pane));
    const scale = Math.min(LARGEST_CELL, Math.max(least, this.scale * factor));
    this.x += dx / this.scale - dx / scale;
    this.y += dy / this.scale - dy / scale;
    this.scale = scale;
    this.isFitted = false;
    this.#clamp();
  }

  /** Moves as little as needed so that this cell is seen. @param {number} x @param {number} y */
  reveal(x, y) {
    const margin = Math.min(3, this.pane[0] / this.scale / 4, this.pane[1] / this.scale / 4);
    const [halfX, halfY] = [this.pane[0] / this.scale / 2 - margin, this.pane[1] / this.scale / 2 - margin];
    const nextX = Math.min(x + halfX, Math.max(x + 1 - halfX, this.x));
    const nextY = Math.min(y + halfY, Math.max(y + 1 - halfY, this.y));
    if (nextX === this.x && nextY === this.y) return;
    [this.x, this.y, this.isFitted] = [nextX, nextY, false];
  }

  /** The frame of the map in a pane of this size. @param {number} width @param {number} height @returns
   *  {Frame} */
  frame(width, height) {
    const { dpr } = this;
    const scale = this.scale * dpr;
    const [w, h] = [Math.round(width * dpr), Math.round(height * dpr)];
    // Whole pixels: the grid does not shimmer while the map moves.
    const left = Math.round(w / 2 - this.x * scale);
    const top = Math.round(h / 2 - this.y * scale);
    return { left, top, scale, width: w, height: h, dpr };
  }

  /** The place in cells under these pixels of the pane. @param {Frame} frame @param {number} px @param
   *  {number} py @returns {[number, number]} */
  static place(frame, px, py) {
    return [(px * frame.dpr - frame.left) / frame.scale, (py * frame.dpr - frame.top) / frame.scale];
  }

  #clamp() {
    this.x = Math.min(this.map[0], Math.max(0, this.x));
    this.y = Math.min(this.map[1], Math.max(0, this.y));
  }
}
