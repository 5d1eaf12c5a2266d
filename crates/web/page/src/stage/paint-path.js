// The moving marks above the map: the path and the optimum, start and goal, the brush, the keyboard's cell.

import { DASHES } from "./colors.js";

/** @typedef {import("../../types.d.ts").LaneAnswer} LaneAnswer */
/** @typedef {import("../../types.d.ts").Point} Point */
/** @typedef {import("../../types.d.ts").Rect} Rect */
/** @typedef {import("./view.js").Frame} Frame */
/** @typedef {import("./colors.js").Theme} Theme */
/** @typedef {{ lane: number, shift: number, radius: number, isFaint: boolean }} Look */

/** The radius of the badges of start and goal, in pixels of the page. */
export const BADGE = 11;
/** The width of the optimum, of that of a path: both are seen where they lie on each other. */
const OPTIMUM = 0.5;
/** The opacity of the area between a path and the optimum. */
const AREA = 0.2;
const FONT = 'system-ui, -apple-system, "Segoe UI", Roboto, Helvetica, Arial, sans-serif';

/** @param {CanvasRenderingContext2D} context @param {Frame} frame @param {ArrayLike<number>} points
 *  @param {number} shift */
function trace(context, frame, points, shift) {
  context.beginPath();
  for (let i = 0; i + 1 < points.length; i += 2) {
    const x = frame.left + (points[i] + shift) * frame.scale;
    const y = frame.top + (points[i + 1] + shift) * frame.scale;
    if (i === 0) context.moveTo(x, y);
    else context.lineTo(x, y);
  }
}

/** The width of a path. @param {Frame} frame */
const widthAt = ({ scale, dpr }) => Math.min(4.5, Math.max(3.25, 2.5 + scale / dpr / 12)) * dpr;

/** The path of a lane: a rim in the color of the page, the lane's color and dashes, and dots where it turns.
 *  `shift`: of a vertex from the corner of its cell. `radius`: of the agent, in cells.
 *  @param {CanvasRenderingContext2D} context @param {Frame} frame @param {ArrayLike<number>} path
 *  @param {Look} look @param {Theme} theme */
export function drawPath(context, frame, path, look, theme) {
  if (path.length < 4) return;
  const { dpr, scale } = frame;
  const color = theme.lanes[look.lane % 4];
  const width = widthAt(frame);
  context.save();
  context.lineJoin = "round";
  context.lineCap = "round";
  trace(context, frame, path, look.shift);
  context.globalAlpha = look.isFaint ? 0.45 : 1;
  if (look.radius > 0) {
    context.save();
    context.globalAlpha *= 0.24;
    context.strokeStyle = color;
    context.lineWidth = Math.max(width, 2 * look.radius * scale);
    context.stroke();
    context.restore();
  }
  context.strokeStyle = theme.css.page;
  context.lineWidth = width + 2.75 * dpr;
  context.stroke();
  context.strokeStyle = color;
  context.lineWidth = width;
  const dashes = DASHES[look.lane % 4];
  if (dashes.length > 0) {
    context.lineCap = "butt";
    context.setLineDash(dashes.map((length) => (length * width) / 3.5));
  }
  context.stroke();
  context.setLineDash([]);
  drawTurns(context, frame, path, look.shift, width, color, theme.css.page);
  context.restore();
}

/** How far a path is from the optimum: the area between them, and a rim around the optimum. Below the path.
 *  @param {CanvasRenderingContext2D} context @param {Frame} frame @param {ArrayLike<number>} path
 *  @param {ArrayLike<number>} optimum @param {Look} look @param {Theme} theme */
export function drawApart(context, frame, path, optimum, { lane, shift }, theme) {
  context.save();
  context.lineJoin = "round";
  trace(context, frame, [...Array.from(path), ...reversed(optimum)], shift);
  context.globalAlpha = AREA;
  context.fillStyle = theme.lanes[lane % 4];
  context.fill();
  context.globalAlpha = 1;
  trace(context, frame, optimum, shift);
  context.strokeStyle = theme.css.page;
  context.lineWidth = OPTIMUM * widthAt(frame) + 3.5 * frame.dpr;
  context.stroke();
  context.restore();
}

/** The optimum, where the lane's path is longer: a line above that path, thinner than it.
 *  @param {CanvasRenderingContext2D} context @param {Frame} frame @param {ArrayLike<number>} optimum
 *  @param {number} shift @param {Theme} theme */
export function drawOptimum(context, frame, optimum, shift, theme) {
  context.save();
  context.lineJoin = "round";
  context.lineCap = "round";
  trace(context, frame, optimum, shift);
  context.strokeStyle = theme.css.reference;
  context.lineWidth = OPTIMUM * widthAt(frame);
  context.stroke();
  context.restore();
}

/** The points of a path from its end. @param {ArrayLike<number>} path */
function reversed(path) {
  return Array.from(path, (_, i) => path[path.length - 2 - i + 2 * (i % 2)]);
}

/** Whether the optimum is shorter than the lane's path: by more than sums of roots differ by rounding.
 *  @param {LaneAnswer} answer */
export function isBeaten({ reference, length, cost }) {
  return !!reference && reference.length < (cost ?? length) * (1 - 1e-9);
}

/** Dots along the path that was traced. @param {CanvasRenderingContext2D} context @param {Frame} frame
 *  @param {string} rim @param {string} color */
function dot(context, { dpr }, rim, color) {
  context.lineCap = "round";
  context.lineJoin = "round";
  context.setLineDash([0.01 * dpr, 6 * dpr]);
  for (const [style, width] of /** @type {[string, number][]} */ ([
    [rim, 4.5],
    [color, 2],
  ])) {
    context.lineWidth = width * dpr;
    context.strokeStyle = style;
    context.stroke();
  }
}

/** Dots at the waypoints, if they are well apart. @param {CanvasRenderingContext2D} context @param {Frame}
 *  frame @param {ArrayLike<number>} path @param {number} shift @param {number}
 *  width @param {string} color @param {string} rim */
function drawTurns(context, frame, path, shift, width, color, rim) {
  const { left, top, scale, dpr } = frame;
  const first = Math.abs(path[2] - path[0]) + Math.abs(path[3] - path[1]);
  const turns = path.length / 2 - 2;
  const span = Math.hypot(path[path.length - 2] - path[0], path[path.length - 1] - path[1]) + first;
  if (turns < 1 || scale < 7 * dpr || (span * scale) / turns < 14 * dpr) return;
  context.beginPath();
  for (let i = 2; i + 3 < path.length; i += 2) {
    const [x, y] = [left + (path[i] + shift) * scale, top + (path[i + 1] + shift) * scale];
    if (x < -9 || y < -9 || x > frame.width + 9 || y > frame.height + 9) continue;
    context.moveTo(x + 0.95 * width, y);
    context.arc(x, y, 0.95 * width, 0, 7);
  }
  context.fillStyle = color;
  context.fill();
  context.strokeStyle = rim;
  context.lineWidth = 1.25 * dpr;
  context.stroke();
}

/** A dotted line from where the path had to end to the goal that cannot be reached.
 *  @param {CanvasRenderingContext2D} context @param {Frame} frame @param {LaneAnswer} answer
 *  @param {number} shift @param {Theme} theme */
export function drawMissing(context, frame, answer, shift, theme) {
  const { path, goal } = answer;
  const from = path.slice(-2);
  if (from.length < 2) return;
  context.save();
  trace(context, frame, [from[0], from[1], goal[0], goal[1]], shift);
  dot(context, frame, theme.css.page, theme.css.danger);
  context.restore();
}

/** A badge with the letter of the figures. @param {CanvasRenderingContext2D} context @param {Frame} frame
 *  @param {"S" | "G"} letter @param {Point} at @param {number} shift
 *  @param {"" | "near" | "held"} state @param {Theme} theme */
export function drawBadge(context, frame, letter, at, shift, state, theme) {
  const { dpr } = frame;
  const x = frame.left + (at[0] + shift) * frame.scale;
  const y = frame.top + (at[1] + shift) * frame.scale;
  const size = frame.width < 260 * dpr ? BADGE - 2 : BADGE;
  const radius = (state === "" ? size : size + 2) * dpr;
  if (state === "held") {
    context.beginPath();
    context.arc(x, y, radius + 6 * dpr, 0, 7);
    context.globalAlpha = 0.25;
    context.fillStyle = theme.css.focus;
    context.fill();
    context.globalAlpha = 1;
  }
  context.beginPath();
  context.arc(x, y, radius, 0, 7);
  context.fillStyle = letter === "S" ? theme.css.start : theme.css.goal;
  context.fill();
  context.lineWidth = 1.75 * dpr;
  context.strokeStyle = theme.css.page;
  context.stroke();
  context.fillStyle = theme.css.page;
  context.font = `700 ${Math.round(1.15 * radius)}px ${FONT}`;
  context.textAlign = "center";
  context.textBaseline = "alphabetic";
  context.fillText(letter, x, y + 0.41 * radius);
}

/** The outline of cells: the brush, or a rectangle to come. @param {CanvasRenderingContext2D} context
 *  @param {Frame} frame @param {Rect} rect @param {string} color @param {number} fill Opacity inside.
 *  @param {Theme} theme */
export function drawCells(context, frame, rect, color, fill, theme) {
  const { dpr, scale } = frame;
  const left = Math.round(frame.left + rect.x * scale);
  const top = Math.round(frame.top + rect.y * scale);
  const width = Math.max(2 * dpr, Math.round(frame.left + (rect.x + rect.width) * scale) - left);
  const height = Math.max(2 * dpr, Math.round(frame.top + (rect.y + rect.height) * scale) - top);
  if (fill > 0) {
    context.globalAlpha = fill;
    context.fillStyle = color;
    context.fillRect(left, top, width, height);
    context.globalAlpha = 1;
  }
  context.strokeStyle = theme.css.page;
  context.lineWidth = 4 * dpr;
  context.strokeRect(left, top, width, height);
  context.strokeStyle = color;
  context.lineWidth = 2 * dpr;
  context.strokeRect(left, top, width, height);
}
