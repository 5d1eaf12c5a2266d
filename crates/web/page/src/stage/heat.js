// The search as it spread: the steps as pixels, one a vertex, in the order of expansion.

import { cssOf } from "./colors.js";
import { expansionEnds } from "./player.js";
import { Raster } from "./raster.js";

/** @typedef {import("../../types.d.ts").LaneAnswer} LaneAnswer */
/** @typedef {import("./view.js").Frame} Frame */
/** @typedef {import("./colors.js").Theme} Theme */

/** A search with more expansions is never shown as marks. */
const MOST_MARKS = 6000;
const COLORS_OF_MARKS = 12;

export class SearchHeat {
  /** @type {Uint32Array | null} */
  #steps = null;
  #shown = 0;
  #expanded = 0;
  /** @type {Theme | null} */
  #theme = null;
  #isSparse = false;
  /** The rows with colors, from `first` up to but without `end`. */
  #first = 0;
  #end = 0;
  #raster = new Raster(1, 1);
  /** The marks of the steps that are shown, once they are needed. @type {number[][] | null} */
  #groups = null;

  /** Whether single vertices are marked, since few were expanded. */
  get isSparse() {
    return this.#isSparse;
  }

  /** Shows the first `count` steps. Returns the rows that changed, or null.
   *  @param {LaneAnswer | null} answer @param {number} count @param {Theme} theme @param {number} rows
   *  @returns {[number, number] | null} */
  show(answer, count, theme, rows) {
    const steps = answer?.steps ?? null;
    if (steps === this.#steps && theme === this.#theme && count === this.#shown) return null;
    const columns = answer?.verticesPerRow ?? 0;
    this.#groups = null;
    /** @type {[number, number]} */
    let changed = [Infinity, 0];
    if (steps !== this.#steps || theme !== this.#theme || count < this.#shown) {
      changed = [this.#first, this.#end];
      this.#clear(columns, rows);
      if (steps !== this.#steps && steps) this.#isSparse = isSparse(steps, columns, this.#isSparse);
      this.#steps = steps;
      this.#theme = theme;
    }
    if (steps && count > this.#shown) {
      const [first, end] = this.#paint(steps, count, theme, columns);
      changed = [Math.min(changed[0], first), Math.max(changed[1], end)];
    }
    return changed[1] > changed[0] ? changed : null;
  }

  /** @param {number} columns @param {number} rows */
  #clear(columns, rows) {
    if (columns !== this.#raster.width || rows !== this.#raster.height) {
      if (columns > 0) this.#raster = new Raster(columns, rows);
    } else if (this.#end > this.#first) {
      this.#raster.pixels.fill(0, this.#first * columns, this.#end * columns);
      this.#raster.touch(0, this.#first, columns, this.#end - this.#first);
    }
    [this.#shown, this.#expanded, this.#first, this.#end] = [0, 0, Infinity, 0];
  }

  /** Paints the steps from the last one shown up to `count`. @param {Uint32Array} steps @param {number}
   *  count @param {Theme} theme @param {number} columns @returns {[number, number]} */
  #paint(steps, count, theme, columns) {
    const { pixels } = this.#raster;
    const { expanded, open } = theme;
    const pace = 255 / Math.max(1, expansionEnds(steps).length);
    let [n, least, greatest] = [this.#expanded, 0xffffffff, 0];
    for (let i = this.#shown; i < count; i++) {
      const v = steps[i] >>> 1;
      if (steps[i] & 1) {
        pixels[v] = expanded[(n * pace) | 0];
        n++;
      } else if (pixels[v] === 0) {
        pixels[v] = open;
      }
      if (v < least) least = v;
      if (v > greatest) greatest = v;
    }
    [this.#expanded, this.#shown] = [n, count];
    const [first, end] = [Math.floor(least / columns), Math.floor(greatest / columns) + 1];
    this.#raster.touch(0, first, columns, end - first);
    [this.#first, this.#end] = [Math.min(this.#first, first), Math.max(this.#end, end)];
    return [first, end];
  }

  /** @param {CanvasRenderingContext2D} context @param {Frame} frame @param {number} shift
   *  @param {[number, number] | null} rows */
  draw(context, frame, shift, rows) {
    if (!this.#steps || this.#end <= this.#first) return;
    const [y0, y1] = [Math.max(this.#first, rows?.[0] ?? 0), Math.min(this.#end, rows?.[1] ?? Infinity)];
    if (y1 <= y0) return;
    this.#raster.draw(context, frame, shift, { x0: 0, y0, x1: this.#raster.width, y1 });
  }

  /** Draws a mark for each vertex, if there are few. Marks are never smaller than three pixels.
   *  @param {CanvasRenderingContext2D} context @param {Frame} frame @param {number} shift */
  drawMarks(context, frame, shift) {
    const theme = this.#theme;
    if (!this.#isSparse || !this.#steps || !theme) return;
    const radius = Math.max(1.75 * frame.dpr, Math.min(6.5 * frame.dpr, 0.3 * frame.scale));
    const groups = this.#marks(this.#steps, theme.open);
    const rim = radius + 0.75 * frame.dpr;
    context.fillStyle = theme.css.page;
    for (const vertices of groups) this.#fillMarks(context, frame, shift + 0.5, vertices, rim);
    groups.forEach((vertices, i) => {
      const t = (i - 1) / (COLORS_OF_MARKS - 1);
      context.fillStyle = cssOf(i === 0 ? theme.open : theme.marks[Math.round(255 * t)]);
      this.#fillMarks(context, frame, shift + 0.5, vertices, radius);
    });
  }

  /** @param {CanvasRenderingContext2D} context @param {Frame} frame @param {number} middle Of a vertex, in
   *  cells. @param {number[]} vertices @param {number} radius */
  #fillMarks(context, frame, middle, vertices, radius) {
    const columns = this.#raster.width;
    const isSmall = radius < 2.2 * frame.dpr;
    for (const v of vertices) {
      const x = frame.left + ((v % columns) + middle) * frame.scale;
      const y = frame.top + (Math.floor(v / columns) + middle) * frame.scale;
      if (x < -9 || y < -9 || x > frame.width + 9 || y > frame.height + 9) continue;
      if (isSmall) {
        context.fillRect(x - radius, y - radius, 2 * radius, 2 * radius);
      } else {
        // Each by itself: one figure of thousands of parts would be slow.
        context.beginPath();
        context.arc(x, y, radius, 0, 7);
        context.fill();
      }
    }
  }

  /** The vertices that were touched: first the open ones, then the expanded ones in groups of a color each.
   *  @param {Uint32Array} steps @param {number} open The pixel of open ones. @returns {number[][]} */
  #marks(steps, open) {
    if (this.#groups) return this.#groups;
    const { pixels } = this.#raster;
    /** @type {number[][]} */
    const groups = Array.from({ length: COLORS_OF_MARKS + 1 }, () => []);
    const pace = COLORS_OF_MARKS / Math.max(1, expansionEnds(steps).length);
    // From the last: some engines expand a vertex several times.
    const seen = new Set();
    for (let i = this.#shown - 1, n = this.#expanded; i >= 0; i--) {
      const v = steps[i] >>> 1;
      const isExpanded = (steps[i] & 1) === 1;
      if (isExpanded) n--;
      if ((!isExpanded && pixels[v] !== open) || seen.has(v)) continue;
      seen.add(v);
      groups[isExpanded ? 1 + Math.floor(n * pace) : 0].push(v);
    }
    this.#groups = groups;
    return groups;
  }
}

/** Whether most expanded vertices stand alone, as those of jump point search and of prepared engines do.
 *  In doubt it stays as before: the picture does not flicker while an end is dragged. @param {Uint32Array}
 *  steps @param {number} columns @param {boolean} before */
function isSparse(steps, columns, before) {
  const ends = expansionEnds(steps);
  if (ends.length > MOST_MARKS || steps.length > 8 * MOST_MARKS) return false;
  if (ends.length < 8) return before;
  const touched = new Set();
  for (const step of steps) touched.add(step >>> 1);
  const around = [-columns - 1, -columns, 1 - columns, -1, 1, columns - 1, columns, columns + 1];
  const stride = Math.ceil(steps.length / 1500);
  let [alone, all] = [0, 0];
  for (let i = 0; i < steps.length; i += stride) {
    const v = steps[i] >>> 1;
    let neighbors = 0;
    for (const d of around) if (touched.has(v + d)) neighbors++;
    all++;
    if (neighbors < 3) alone++;
  }
  return alone > all * (before ? 0.35 : 0.6);
}
