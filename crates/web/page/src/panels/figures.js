// Small drawings of the rules of motion, and of the marks of lanes.

import { s } from "./dom.js";

/** Two by two cells of side 12 in a frame of 28 × 28. */
const [LEFT, MIDDLE, RIGHT] = [2, 14, 26];

/** @param {...SVGElement} parts */
function figure(...parts) {
  const frame = `M${LEFT} ${LEFT}H${RIGHT}V${RIGHT}H${LEFT}z`;
  const grid = `${frame}M${MIDDLE} ${LEFT}V${RIGHT}M${LEFT} ${MIDDLE}H${RIGHT}`;
  return s(
    "svg",
    { class: "figure", viewBox: "0 0 28 28", "aria-hidden": "true" },
    ...parts.filter((part) => part.classList.contains("f-wall")),
    s("path", { class: "f-grid", d: grid }),
    ...parts.filter((part) => !part.classList.contains("f-wall")),
  );
}

/** A blocked cell. @param {number} x @param {number} y */
function wall(x, y) {
  return s("rect", { class: "f-wall", x: LEFT + 12 * x, y: LEFT + 12 * y, width: 12, height: 12 });
}
/** @param {string} d */
const way = (d) => s("path", { class: "f-way", d });
/** @param {string} d */
const stop = (d) => s("path", { class: "f-stop", d });
/** @param {number[]} places */
function dots(places) {
  return places.flatMap((cx) => places.map((cy) => s("circle", { class: "f-dot", cx, cy, r: 2.2 })));
}

export const PLACEMENTS = {
  center: () => figure(...dots([8, 20])),
  corner: () => figure(...dots([LEFT, MIDDLE, RIGHT])),
};

/** The most that may be blocked beside a move through a corner point. */
export const CORNER_RULES = {
  never: () => figure(way("M8 20 20 8")),
  one: () => figure(wall(1, 1), way("M8 20 20 8")),
  always: () => figure(wall(0, 0), wall(1, 1), way("M8 20 20 8")),
};

export const GAP_RULES = {
  open: () => figure(wall(0, 0), wall(1, 1), way("M4.5 23.5 23.5 4.5")),
  closed: () => figure(wall(0, 0), wall(1, 1), way("M4.5 23.5 12.5 15.5"), stop("M10 10 18 18")),
};

/** The dashes of the lanes' paths, as the stage has them. */
const DASHES = ["", "8 4", "2.5 3.2", "9 3.2 2.5 3.2"];

/** The line by which a lane is known. @param {number} lane */
export function laneMark(lane) {
  return s(
    "svg",
    { class: `lane-mark lane-${lane}`, viewBox: "0 0 30 10", "aria-hidden": "true" },
    s("path", { d: "M2 5H28", "stroke-dasharray": DASHES[lane] ?? "" }),
  );
}
