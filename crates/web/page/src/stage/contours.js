// Contour lines of a field, by marching squares, in tiles: only what is seen is computed, and kept while the
// field stays. Short lines are stroked fast; one line through the whole map would not be.

/** @typedef {import("./view.js").Frame} Frame */
/** @typedef {{ width: number, height: number, values: Float32Array }} Values */

const TILE = 32;
/** More pieces than so are noise: none is drawn. */
const MOST = 20000;

/** @typedef {{ path: Path2D, pieces: number }} Tile */

export class Contours {
  /** @type {Map<number, Tile>} */
  #tiles = new Map();

  /** Lines at the multiples of `step`. @param {Values} field @param {number} step */
  constructor(field, step) {
    this.field = field;
    this.step = step;
  }

  /** @param {CanvasRenderingContext2D} context @param {Frame} frame @param {number} shift Of a vertex, in
   *  cells. */
  draw(context, frame, shift) {
    const tiles = this.#visible(frame, shift);
    if (tiles.reduce((sum, { pieces }) => sum + pieces, 0) > MOST) return;
    context.save();
    context.translate(frame.left + shift * frame.scale, frame.top + shift * frame.scale);
    context.scale(frame.scale, frame.scale);
    context.lineWidth = frame.dpr / frame.scale;
    context.strokeStyle = "#1f2328";
    context.globalAlpha = 0.3;
    for (const { path } of tiles) context.stroke(path);
    context.restore();
  }

  /** @param {Frame} frame @param {number} shift @returns {Tile[]} */
  #visible(frame, shift) {
    const { width, height } = this.field;
    const side = TILE * frame.scale;
    const first = (/** @type {number} */ edge) =>
      Math.max(0, Math.floor((-edge - shift * frame.scale) / side));
    const tiles = [];
    for (let y = first(frame.top); y * TILE < height && frame.top + y * side < frame.height; y++) {
      for (let x = first(frame.left); x * TILE < width && frame.left + x * side < frame.width; x++) {
        const key = y * 65536 + x;
        const tile = this.#tiles.get(key) ?? tileAt(this.field, this.step, x * TILE, y * TILE);
        this.#tiles.set(key, tile);
        if (tile.pieces > 0) tiles.push(tile);
      }
    }
    return tiles;
  }
}

/** @param {Values} field @param {number} step @param {number} left @param {number} top @returns {Tile} */
function tileAt({ width, height, values }, step, left, top) {
  const tile = { path: new Path2D(), pieces: 0 };
  if (!(step > 0)) return tile;
  for (let y = top; y < Math.min(height - 1, top + TILE); y++) {
    for (let x = left; x < Math.min(width - 1, left + TILE); x++) {
      const at = y * width + x;
      const [a, b, c, d] = [values[at], values[at + 1], values[at + width + 1], values[at + width]];
      const low = Math.min(a, b, c, d);
      const high = Math.max(a, b, c, d);
      // No line where a vertex has no value.
      if (!(high < Infinity)) continue;
      const first = Math.floor(low / step) + 1;
      // A cliff would have more lines than can be seen.
      for (let n = first; n * step <= high && n < first + 8; n++) {
        tile.pieces += square(tile.path, x, y, [a, b, c, d], n * step);
      }
    }
  }
  return tile;
}

const CORNERS = [
  [0, 0],
  [1, 0],
  [1, 1],
  [0, 1],
];

/** Adds the lines through a square of four vertices. Returns how many there are. @param {Path2D} path @param
 *  {number} x @param {number} y @param {number[]} values Clockwise from the top left. @param {number} level
 *  */
function square(path, x, y, values, level) {
  /** @type {[number, number][]} */
  const crossings = [];
  for (let side = 0; side < 4; side++) {
    const [a, b] = [values[side], values[(side + 1) % 4]];
    if (a < level === b < level) continue;
    const t = (level - a) / (b - a);
    const [[ax, ay], [bx, by]] = [CORNERS[side], CORNERS[(side + 1) % 4]];
    crossings.push([x + ax + t * (bx - ax), y + ay + t * (by - ay)]);
  }
  // Of a saddle, the lines go around the corners above the level.
  const last = crossings.at(-1);
  if (crossings.length === 4 && last && values[0] >= level) crossings.unshift(last);
  for (let i = 0; i + 1 < crossings.length; i += 2) {
    path.moveTo(...crossings[i]);
    path.lineTo(...crossings[i + 1]);
  }
  return crossings.length >> 1;
}
