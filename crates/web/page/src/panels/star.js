// Draws the moves of N(k) as a star. The moves that this k adds, the mediants of their neighbors, stand out.

import { s } from "./dom.js";

/** Up to this k the moves are drawn to scale, with the cells that they lead to. */
const TO_SCALE = 5;
/** Up to this k each move is an arrow of its own. */
const ARROWS = 7;

/**
 * @param {SVGSVGElement} svg
 * @param {number | "any"} k
 * @param {Int32Array} moves of N(k), x, y, …
 * @param {boolean} animate
 */
export function drawStar(svg, k, moves, animate) {
  svg.replaceChildren();
  svg.classList.toggle("animate", animate);
  const label = k === "any" ? "Every direction" : `The ${2 ** k} moves of N(${k}) as a star`;
  svg.setAttribute("aria-label", label);
  if (k === "any") return drawDisc(svg);
  const points = pairs(moves);
  const longest = Math.max(...points.map(([x, y]) => Math.hypot(x, y)));
  const power = k <= TO_SCALE ? 1 : 1 / (1 + 0.22 * (k - TO_SCALE));
  const place = (/** @type {[number, number]} */ [x, y]) => {
    const length = Math.hypot(x, y);
    const scaled = (length / longest) ** power / length;
    return /** @type {[number, number]} */ ([x * scaled, y * scaled]);
  };
  if (k <= TO_SCALE) drawCells(svg, longest, Math.max(...points.flat()));
  const old = points.filter((_, index) => index % 2 === 0 || k === 2);
  const added = k === 2 ? [] : points.filter((_, index) => index % 2 === 1);
  if (k <= ARROWS) {
    for (const point of added) svg.append(arrow(place(point), "new", k));
    for (const point of old) svg.append(arrow(place(point), "old", k));
  } else {
    svg.append(fan(added.map(place), "new", k), fan(old.map(place), "old", k));
  }
  svg.append(s("circle", { class: "center", r: 0.045 }));
}

/** @param {Int32Array} moves */
function pairs(moves) {
  /** @type {[number, number][]} */
  const points = [];
  for (let i = 0; i + 1 < moves.length; i += 2) points.push([moves[i] ?? 0, moves[i + 1] ?? 0]);
  return points;
}

/** A place, as paths have it. @param {number} x @param {number} y */
const at = (x, y) => `${x.toFixed(3)} ${y.toFixed(3)}`;

/** The cells around the star, as points.
 *  @param {SVGSVGElement} svg @param {number} longest @param {number} radius */
function drawCells(svg, longest, radius) {
  let d = "";
  for (let y = -radius; y <= radius; y += 1) {
    for (let x = -radius; x <= radius; x += 1) d += `M${at(x / longest, y / longest)}h0`;
  }
  svg.append(s("path", { class: "cells", d }));
}

/** @param {[number, number]} to @param {string} kind @param {number} k */
function arrow([x, y], kind, k) {
  const length = Math.hypot(x, y);
  const [ux, uy] = [x / length, y / length];
  const head = [0, 0, 0.13, 0.13, 0.1, 0.085, 0.06, 0.045][k] ?? 0.05;
  const [bx, by] = [x - ux * head, y - uy * head];
  const [sx, sy] = [-uy * head * 0.42, ux * head * 0.42];
  const tip = [at(x, y), at(bx + sx, by + sy), at(bx - sx, by - sy)];
  return s(
    "g",
    { class: `move ${kind}` },
    s("path", { class: "shaft", d: `M0 0L${at(bx, by)}`, "stroke-width": k <= 5 ? 1.75 : 1.1 }),
    s("path", { class: "head", d: `M${tip.join("L")}z` }),
  );
}

/** Many moves as one path. @param {[number, number][]} points @param {string} kind @param {number} k */
function fan(points, kind, k) {
  const d = points.map(([x, y]) => `M0 0L${at(x, y)}`).join("");
  const width = 1.1 * 2 ** (-(k - 8) * 0.42);
  return s("path", { class: `fan ${kind}`, d, "stroke-width": width.toFixed(3) });
}

/** @param {SVGSVGElement} svg */
function drawDisc(svg) {
  svg.append(s("circle", { class: "disc", r: 1 }), s("circle", { class: "center", r: 0.045 }));
}
