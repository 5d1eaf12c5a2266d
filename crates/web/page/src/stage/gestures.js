// The gestures: a drag moves the map or an end, or draws a stroke or a rectangle; and the fill of an area.

import { LAND, merged } from "../model/land.js";
import { View } from "./view.js";

/** @typedef {import("./stage.js").Stage} Stage */
/** @typedef {import("./pane.js").Pane} Pane */
/** @typedef {import("../../types.d.ts").Model} Model */
/** @typedef {import("../../types.d.ts").Point} Point */
/** @typedef {import("../../types.d.ts").Rect} Rect */

/** A place in the pane, in pixels of the page. @typedef {{ x: number, y: number, time: number }} Spot */

/**
 * @typedef {object} Gesture
 * @property {(spots: Spot[]) => void} move The pointer was at these places since the last call.
 * @property {() => void} end
 * @property {() => void} cancel Leaves everything as it was.
 */

/** The side of the brush on the screen, at least. */
const BRUSH = 4;

/** The cell or vertex at a spot, inside the map. @param {Pane} pane @param {Spot} spot @param {number} shift
 *  @returns {Point} */
export function cellAt(pane, spot, shift = 0.5) {
  const { width, height } = pane.stage.model;
  const [x, y] = View.place(pane.frame, spot.x, spot.y);
  const near = (/** @type {number} */ at, /** @type {number} */ count) =>
    Math.min(count - 1, Math.max(0, Math.floor(at + 0.5 - shift)));
  return [near(x, width), near(y, height)];
}

/** The cells that the brush covers at a spot, also outside of the map. @param {Pane} pane @param {Spot} spot
 *  @returns {Rect} */
export function brushAt(pane, spot) {
  const { scale } = pane.stage.view;
  const size = Math.max(1, Math.round(BRUSH / scale));
  const [x, y] = View.place(pane.frame, spot.x, spot.y);
  const half = (size - 1) / 2;
  return { x: Math.floor(x - half), y: Math.floor(y - half), width: size, height: size };
}

/** The part of a rectangle inside of the map. @param {Model} model @param {Rect} rect @returns {Rect} */
export function inMap(model, rect) {
  const [x, y] = [Math.max(0, rect.x), Math.max(0, rect.y)];
  const width = Math.max(0, Math.min(model.width, rect.x + rect.width) - x);
  return { x, y, width, height: Math.max(0, Math.min(model.height, rect.y + rect.height) - y) };
}

/** @param {Model} model @param {Rect} rect @param {Set<number> | number[]} cells */
function addCells(model, rect, cells) {
  const { x, y, width, height } = inMap(model, rect);
  for (let row = y; row < y + height; row++) {
    for (let at = row * model.width + x, end = at + width; at < end; at++) {
      if (cells instanceof Set) cells.add(at);
      else cells.push(at);
    }
  }
}

/** Paints with the brush: walls, or land. What is erased is free, and with a brush of land a road.
 *  @param {Stage} stage @param {Iterable<number>} cells @param {boolean} isErasing */
function paint({ model, brush }, cells, isErasing) {
  if (brush === 0) model.paint(cells, !isErasing);
  else model.paintLand(cells, isErasing ? LAND[0].cost : brush);
}

/** @param {Stage} stage @param {Spot} from @returns {Gesture} */
export function panning(stage, from) {
  let last = from;
  const { root } = stage;
  root.classList.add("is-panning");
  const end = () => root.classList.remove("is-panning");
  return {
    move(spots) {
      const spot = spots[spots.length - 1];
      stage.view.pan(spot.x - last.x, spot.y - last.y);
      last = spot;
      stage.moved();
    },
    end,
    cancel: end,
  };
}

/** Drags the start or the goal. It keeps its distance from the pointer, so that it does not jump when it is
 *  taken. @param {Pane} pane @param {"start" | "goal"} which @param {Spot} from @returns {Gesture} */
export function dragging(pane, which, from) {
  const { stage } = pane;
  const { model, record } = stage;
  const before = model[which];
  const center = pane.spotOf(before[0] + pane.shift, before[1] + pane.shift);
  const [dx, dy] = [center.x - from.x, center.y - from.y];
  stage.held = which;
  stage.watched = pane;
  record.begin();
  model.beginGesture("end");
  stage.soil("top");
  const end = () => {
    stage.held = "";
    record.end();
    model.endGesture();
    stage.soil("top");
  };
  return {
    move(spots) {
      const spot = spots[spots.length - 1];
      const to = cellAt(pane, { x: spot.x + dx, y: spot.y + dy, time: spot.time }, pane.shift);
      const old = model[which];
      if (to[0] === old[0] && to[1] === old[1]) return;
      record.moved({ start: model.start, goal: model.goal, [which]: to }, spot.time);
      model.moveEnd(which, to);
    },
    end,
    cancel() {
      model.moveEnd(which, before);
      end();
    },
  };
}

/** Draws or erases walls or land under the brush, without gaps between the places of the pointer.
 *  @param {Pane} pane @param {boolean} isErasing @param {Spot} from @returns {Gesture} */
export function stroking(pane, isErasing, from) {
  const { stage } = pane;
  const { model, record } = stage;
  const version = model.version;
  let last = brushAt(pane, from);
  stage.watched = pane;
  record.begin();
  model.beginGesture("cells");
  const paintRects = (/** @type {Rect[]} */ rects, /** @type {number} */ time) => {
    /** @type {Set<number>} */
    const cells = new Set();
    for (const rect of rects) addCells(model, rect, cells);
    const old = model.version;
    if (cells.size > 0) paint(stage, cells, isErasing);
    if (model.version !== old) record.moved(model, time);
  };
  paintRects([last], from.time);
  const end = () => {
    record.end();
    model.endGesture();
  };
  return {
    move(spots) {
      const rects = [];
      for (const spot of spots) {
        const next = brushAt(pane, spot);
        rects.push(...between(last, next));
        last = next;
      }
      paintRects(rects, spots[spots.length - 1].time);
    },
    end,
    cancel() {
      end();
      if (model.version !== version) model.undo();
    },
  };
}

/** The brush on its way from one place to the next, without the first. @param {Rect} a @param {Rect} b */
function between(a, b) {
  const steps = Math.max(Math.abs(b.x - a.x), Math.abs(b.y - a.y));
  const rects = [];
  for (let i = 1; i <= steps; i++) {
    const t = i / steps;
    rects.push({ ...b, x: Math.round(a.x + t * (b.x - a.x)), y: Math.round(a.y + t * (b.y - a.y)) });
  }
  return rects;
}

/** A rectangle of walls or land, or of free cells; all panes show it until it is done.
 *  @param {Pane} pane @param {boolean} isErasing @param {Spot} from @returns {Gesture} */
export function boxing(pane, isErasing, from) {
  const { stage } = pane;
  const { model } = stage;
  const first = cellAt(pane, from);
  const show = (/** @type {Point} */ to) => {
    const [x, y] = [Math.min(first[0], to[0]), Math.min(first[1], to[1])];
    const rect = { x, y, width: Math.abs(first[0] - to[0]) + 1, height: Math.abs(first[1] - to[1]) + 1 };
    stage.preview = { rect, pane, isErasing, isShared: true };
    stage.soil("top");
  };
  show(first);
  const cancel = () => {
    stage.preview = null;
    stage.soil("top");
  };
  return {
    move: (spots) => show(cellAt(pane, spots[spots.length - 1])),
    end() {
      /** @type {number[]} */
      const cells = [];
      if (stage.preview) addCells(model, stage.preview.rect, cells);
      cancel();
      model.beginGesture("cells");
      paint(stage, cells, isErasing);
      model.endGesture();
    },
    cancel,
  };
}

/** Makes the area around a cell the other way: free cells blocked, walls free; with a brush of land, makes
 *  it this land. An area is connected by edges. @param {Model} model @param {Point} at
 *  @param {number} [brush] */
export function fill(model, [x, y], brush = 0) {
  const from = y * model.width + x;
  model.beginGesture("cells");
  if (brush === 0) model.paint(areaOf(model, model.cells, from), model.cells[from] === 0);
  else model.paintLand(areaOf(model, merged(model.cells, model.costs), from), brush);
  model.endGesture();
}

/** @param {Model} model @param {Uint8Array} cells @param {number} from @returns {number[]} */
function areaOf({ width, height }, cells, from) {
  const state = cells[from];
  const seen = new Uint8Array(width * height);
  const area = [from];
  seen[from] = 1;
  const visit = (/** @type {number} */ cell) => {
    if (seen[cell] || cells[cell] !== state) return;
    seen[cell] = 1;
    area.push(cell);
  };
  for (let i = 0; i < area.length; i++) {
    const cell = area[i];
    const x = cell % width;
    if (x > 0) visit(cell - 1);
    if (x + 1 < width) visit(cell + 1);
    if (cell >= width) visit(cell - width);
    if (cell + width < width * height) visit(cell + width);
  }
  return area;
}
