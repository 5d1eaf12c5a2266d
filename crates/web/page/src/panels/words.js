// The words and numbers of the panels: names of engines, what a guarantee means, units.

/** @typedef {import("../../types").LaneSetup} LaneSetup */
/** @typedef {import("../../types").LaneAnswer} LaneAnswer */
/** @typedef {import("../../types").LaneState} LaneState */

import { ENGINES } from "../model/described.js";
import { bendsAtCorners, gapOf } from "../model/setups.js";

/** @param {string} engine */
export const engineName = (engine) => ENGINES[engine]?.name ?? engine;

/** A sentence of the library with the engines' names, and ∞, as people write them. @param {string} text */
export function withNames(text) {
  const keys = Object.keys(ENGINES).sort((a, b) => b.length - a.length);
  const pattern = new RegExp(`(?<![\\w-])(${keys.join("|")})(?![\\w-])`, "gi");
  const named = text.replace(pattern, (key) => engineName(key.toLowerCase()));
  return named.replace(/\bk = any\b/g, "k = ∞");
}

/** The engine's method, in a sentence. @param {string} engine */
export const engineHow = (engine) => ENGINES[engine]?.how ?? "";

/** Whether hub labels answered: they expand nothing, and nothing can be replayed.
 *  @param {LaneState | null | undefined} lane */
export const hasNoSearch = (lane) =>
  lane?.index?.levels === "labels" && !!lane.answer && !lane.answer.error && lane.answer.expanded === 0;

/** @param {number | "any"} k */
export const kText = (k) => (k === "any" ? "∞" : String(k));

/** The engine's guarantee with this setup, in a sentence.
 *  @param {LaneSetup} setup @param {string} guarantee of the engine's table
 *  @param {boolean} onLand whether steps cost differently */
export function promise(setup, guarantee, onLand) {
  if (onLand) return setup.k === "any" ? "" : `No path over N(${setup.k}) costs less.`;
  if (guarantee === "suboptimal") return "Its paths may be longer than the shortest.";
  if (setup.smooth) return "Smoothing leaves N(k): the path is at most as long as before.";
  if (setup.k === "any") return "No legal path at any angle is shorter.";
  if (guarantee === "optimal(k)") return `No path over N(${setup.k}) is shorter.`;
  return setup.k === 2 ? "No path over N(2) is shorter." : "It is optimal at k = 2 only.";
}

/** The placement, the rule and the smoothing, in short. @param {LaneSetup} setup */
export function motionText(setup) {
  const rule = bendsAtCorners(setup)
    ? { open: "gaps open", closed: "gaps closed" }[gapOf(setup)]
    : { never: "never cut", one: "cut one", always: "cut always" }[setup.corners];
  const smooth = setup.smooth ? `, smoothed ${setup.smooth}` : "";
  return `${setup.placement === "center" ? "centers" : "corners"}, ${rule}${smooth}`;
}

/** What is wrong with a lane, as a sentence; empty if nothing is. @param {LaneState} lane */
export function sentenceOf({ phase, answer, message }) {
  if (phase === "failed" || phase === "cancelled") return withNames(message);
  if (phase !== "done" || !answer) return "";
  if (answer.status === "invalid") return answer.error?.message ?? "The query is invalid.";
  return answer.status === "unreachable"
    ? "No path: walls part the start, shaded, from the goal, striped."
    : "";
}

const WHOLE = new Intl.NumberFormat("en", { maximumFractionDigits: 0 });
const TWO = new Intl.NumberFormat("en", { minimumFractionDigits: 2, maximumFractionDigits: 2 });

/** @param {number} count */
export const count = (count) => WHOLE.format(count);

/** A length in cells. @param {number} cells */
export const cells = (cells) => TWO.format(cells);

/** A ratio as percent above one. @param {number} ratio @returns {string} */
export function over(ratio) {
  const percent = Math.max(0, (ratio - 1) * 100);
  // A small excess does not show as 0; one that rounding can leave does.
  const text = percent > 1e-7 && percent < 0.005 ? percent.toPrecision(1) : TWO.format(percent);
  return `${Number(text) === 0 ? "0" : text} %`;
}

/** A ratio as percent, with its sign: a path that leaves N(k) may be shorter than the shortest over N(k).
 *  @param {number} ratio */
export function more(ratio) {
  const isLess = ratio < 1;
  const text = over(isLess ? 2 - ratio : ratio);
  return text === "0 %" ? text : `${isLess ? "−" : "+"}${text}`;
}

/** A time, with three digits that count. @param {number} ms */
export function time(ms) {
  if (ms < 1) return `${(ms * 1000).toPrecision(ms < 0.01 ? 2 : 3)} µs`;
  if (ms < 1000) return `${ms.toPrecision(3)} ms`;
  return `${(ms / 1000).toPrecision(3)} s`;
}

/** @param {number} bytes */
export function size(bytes) {
  if (bytes < 1000) return `${bytes} B`;
  if (bytes < 1e6) return `${(bytes / 1e3).toPrecision(3)} kB`;
  return `${(bytes / 1e6).toPrecision(3)} MB`;
}

/** The ratio of the answer's length, or cost, to that of the reference; undefined if it is not known.
 *  @param {LaneAnswer | null} answer */
export function excess(answer) {
  if (!answer?.reference || answer.status !== "found" || answer.reference.length <= 0) return undefined;
  return (answer.cost ?? answer.length) / answer.reference.length;
}
