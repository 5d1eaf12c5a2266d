// The answer of the active lane: the length, how far it is from the shortest, and a sentence.

import { LARGEST_K_ON_LAND } from "../model/land.js";
import { h, part } from "./dom.js";
import { announce } from "./message.js";
import { cells, count, excess, hasNoSearch, more, over, sentenceOf } from "./words.js";

/** @typedef {import("../../types").LaneSetup} LaneSetup */
/** @typedef {import("../../types").LaneState} LaneState */

/**
 * @param {LaneSetup} setup
 * @param {LaneState | null} lane
 * @param {number | null | undefined} bound of this k and motion; undefined if it is not known yet
 * @param {boolean} onLand whether steps cost differently
 */
export function readout(setup, lane, bound, onLand) {
  const list = part("readout", HTMLElement);
  list.classList.toggle("stale", lane?.stale ?? false);
  const length = figure("Length", lengthText(lane), lane?.answer?.path.length ? "cells" : "");
  const figures = onLand
    ? [figure("Cost", costText(lane), "over the land"), length]
    : [length, figure("Longer than the shortest", excessText(lane), reference(setup, lane))];
  list.replaceChildren(...figures);
  const wrong = lane ? sentenceOf(lane) : "";
  const sentence = part("worth", HTMLElement);
  sentence.classList.toggle("error", wrong !== "");
  sentence.textContent = wrong || (onLand ? worthOnLand(setup) : worth(setup, bound));
  tell(lane);
}

/** @param {LaneSetup} setup @param {LaneState | null} lane */
function reference({ k }, lane) {
  return lane?.answer?.reference?.what === "k" ? `over N(${k})` : "at any angle";
}

/** @param {string} name @param {string} value @param {string} unit */
function figure(name, value, unit) {
  const what = value === "–" ? "" : unit;
  return h(
    "div",
    {},
    h("dt", {}, name),
    h("dd", { class: "value" }, value),
    h("dd", { class: "unit muted" }, what),
  );
}

/** @param {LaneState | null} lane */
function lengthText(lane) {
  const answer = lane?.answer;
  if (!answer) return "–";
  if (answer.status === "unreachable") return "no path";
  return answer.path.length ? cells(answer.length) : "–";
}

/** @param {LaneState | null} lane */
function costText(lane) {
  const cost = lane?.answer?.path.length ? lane.answer.cost : null;
  return typeof cost === "number" ? cells(cost) : "–";
}

/** @param {LaneSetup} setup */
function worthOnLand({ k }) {
  if (k === "any" || k > LARGEST_K_ON_LAND) {
    return `Where steps cost differently, there is k = 2 to ${LARGEST_K_ON_LAND}.`;
  }
  return `N(${k}): no path over it costs less. No bound is known for all maps where steps cost differently.`;
}

/** @param {LaneState | null} lane */
function excessText(lane) {
  const ratio = excess(lane?.answer ?? null);
  return ratio === undefined ? "–" : more(ratio);
}

/** The bound of this k on any map, as a sentence. @param {LaneSetup} setup
 *  @param {number | null | undefined} bound */
function worth(setup, bound) {
  if (setup.k === "any") return "No path at any angle is shorter, on any map.";
  if (setup.placement === "center") return "Between centers no bound holds on all maps.";
  if (bound === undefined) return "";
  if (bound === null) return `For k = ${setup.k} there is no bound.`;
  return `On any map, with k = ${setup.k}: at most ${over(bound)} longer.`;
}

/** The sentence that was said last. */
let said = "";
/** @type {ReturnType<typeof setTimeout> | undefined} */
let waiting;

/** Says the answer to screen readers, once it has come to rest. @param {LaneState | null} lane */
function tell(lane) {
  if (!lane || lane.stale || lane.phase !== "done") return;
  const text = sentence(lane);
  clearTimeout(waiting);
  if (text === said) return;
  waiting = setTimeout(() => {
    if (announce(text)) said = text;
  }, 700);
}

/** @param {number} ratio */
const apart = (ratio) => (more(ratio).startsWith("−") ? `${over(2 - ratio)} under` : `${over(ratio)} over`);

/** @param {LaneState} lane */
function sentence(lane) {
  const { answer } = lane;
  if (!answer) return "";
  if (answer.error) return answer.error.message;
  const expanded = hasNoSearch(lane) ? "no search" : `${count(answer.expanded)} expansions`;
  if (answer.status === "unreachable") return `There is no path; ${expanded}.`;
  const ratio = excess(answer);
  const what = answer.reference?.what === "k" ? "over N(k)" : "at any angle";
  const above = ratio === undefined ? "" : `, ${apart(ratio)} the shortest ${what}`;
  const found = answer.status === "nearest" ? "No way to the goal; to the nearest vertex" : "Found";
  if (answer.cost !== null) {
    return `${found}: cost ${cells(answer.cost)}, ${cells(answer.length)} cells, ${expanded}.`;
  }
  return `${found}: ${cells(answer.length)} cells${above}, ${expanded}.`;
}
