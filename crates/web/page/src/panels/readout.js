// The answer of the active lane in three numbers and a sentence.

import { LARGEST_K_ON_LAND } from "../model/land.js";
import { h, part } from "./dom.js";
import { announce } from "./message.js";
import { cells, count, excess, hasNoSearch, more, over } from "./words.js";

/** @typedef {import("../../types").LaneSetup} LaneSetup */
/** @typedef {import("../../types").LaneState} LaneState */

/**
 * @param {LaneSetup} setup
 * @param {LaneState | null} lane
 * @param {number | null | undefined} bound of this k and motion; undefined if it is not known yet
 * @param {boolean} onLand whether steps cost differently
 */
export function readout(setup, lane, bound, onLand) {
  const answer = lane?.answer ?? null;
  const list = part("readout", HTMLElement);
  list.classList.toggle("stale", lane?.stale ?? false);
  const reference = answer?.reference?.what === "k" ? `over N(${setup.k})` : "over any angle";
  const length = figure("Length", lengthText(lane), answer?.path.length ? "cells" : "");
  const figures = onLand
    ? [figure("Cost", costText(lane), "over the land"), length]
    : [
        length,
        figure("Excess", excessText(lane), reference),
        figure("Certificate", certificate(lane), "at most"),
      ];
  list.replaceChildren(...figures);
  part("worth", HTMLElement).textContent = onLand ? worthOnLand(setup) : worth(setup, bound);
  tell(lane);
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

/** @param {LaneState | null} lane */
function certificate(lane) {
  const bound = lane?.answer?.bound;
  return typeof bound === "number" && lane?.answer?.status === "found" ? more(bound) : "–";
}

/** The bound of this k on any map, as a sentence. @param {LaneSetup} setup
 *  @param {number | null | undefined} bound */
function worth(setup, bound) {
  if (setup.k === "any") return "N(∞): no path at any angle is shorter, on any map.";
  if (bound === undefined) return "";
  if (setup.placement === "center") {
    return `N(${setup.k}): no bound holds at centers against paths that bend at corners of walls.`;
  }
  if (bound === null) return `N(${setup.k}): there is no bound.`;
  return `N(${setup.k}): at most ${over(bound)} longer than the shortest path at any angle, on any map.`;
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
    said = text;
    announce(text);
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
