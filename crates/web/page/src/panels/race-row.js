// One lane of the race: a row of the table.

import { h, setText } from "./dom.js";
import { laneMark } from "./figures.js";
import { iconButton } from "./icons.js";
import {
  cells,
  count,
  engineName,
  excess,
  hasNoSearch,
  kText,
  more,
  motionText,
  over,
  size,
  time,
  withNames,
} from "./words.js";

/** @typedef {import("../../types").LaneState} LaneState */
/** @typedef {import("../../types").LaneSetup} LaneSetup */
/** @typedef {{ name: string, title: string, value: ((lane: LaneState) => number | undefined) | null,
 *   text: (lane: LaneState, setup: LaneSetup) => string, onLand?: boolean, inRace?: boolean,
 *   note?: string }} Column `inRace`: of one lane alone, the panel of the knob says it. */

/** @param {LaneState} lane */
function lengthText({ answer }) {
  if (answer?.status === "unreachable") return "no path";
  return answer && answer.path.length > 0 ? cells(answer.length) : "";
}
/** @param {LaneState} lane */
const cost = ({ answer }) => (answer?.status === "found" ? (answer.cost ?? undefined) : undefined);
/** Lengths of different promise are compared only if they are whole ways. @param {LaneState} lane */
const length = (lane) => (lane.answer?.status === "found" ? lane.answer.length : undefined);
/** @param {LaneState} lane */
const certificate = ({ answer }) => (answer?.status === "found" ? (answer.bound ?? undefined) : undefined);

/** A query that was refused has no search: it must not win by doing nothing.
 *  @param {LaneState} lane */
const searched = ({ answer }) => (answer && !answer.error ? answer : undefined);
/** Labels win no race of searches. @param {LaneState} lane */
const expansions = (lane) => (hasNoSearch(lane) ? undefined : searched(lane)?.expanded);
/** A first time is mostly the browser's compiler: it must not be compared. @param {LaneState} lane */
const settled = (lane) => (searched(lane)?.settled ? searched(lane)?.ms : undefined);
/** @param {number | undefined} value @param {(value: number) => string} text */
const shown = (value, text) => (value === undefined ? "" : text(value));
/** A number is not parted from its unit at the end of a line. @param {string} text */
const whole = (text) => text.replace(" ", "\u00a0");
/** @param {number} bound */
const atMost = (bound) => (bound === 1 ? over(bound) : `≤ ${over(bound)}`);

/** @type {readonly Column[]} */
export const COLUMNS = [
  { name: "k", title: "The number of moves is 2 to the k", value: null, text: (_, setup) => kText(setup.k) },
  {
    name: "Expansions",
    note: "expansions",
    title: "Vertices taken from the open list; hub labels need no search",
    value: expansions,
    text: (lane) => (hasNoSearch(lane) ? "no search" : shown(expansions(lane), count)),
  },
  {
    name: "Cost",
    title: "Of the path over the land: the length in each cell times what a step costs there",
    value: cost,
    text: (lane) => shown(lane.answer?.path.length ? (lane.answer.cost ?? undefined) : undefined, cells),
    onLand: true,
    inRace: true,
  },
  { name: "Length", title: "In cells", value: length, text: lengthText, inRace: true },
  {
    name: "Excess",
    note: "excess",
    onLand: false,
    inRace: true,
    title: "How much longer the path is than the shortest",
    value: ({ answer }) => (answer?.reference?.what === "any" ? excess(answer) : undefined),
    text: ({ answer }, setup) => {
      const ratio = excess(answer);
      const what = answer?.reference?.what === "k" ? ` over N(${setup.k})` : "";
      return ratio === undefined ? "" : `${more(ratio)}${what}`;
    },
  },
  {
    name: "Certificate",
    note: "certificate",
    onLand: false,
    inRace: true,
    title: "Proven: at most so much longer than the shortest path at any angle",
    value: certificate,
    text: (lane) => shown(certificate(lane), atMost),
  },
  {
    name: "Time",
    title: "Of one query on a warm planner",
    value: settled,
    text: (lane) => (searched(lane)?.settled === false ? "…" : shown(settled(lane), time)),
  },
  {
    name: "Index",
    title: "What the engine prepared, once for the map",
    value: null,
    text: ({ index }) =>
      index && index.bytes > 0 ? `${whole(time(index.ms))}, ${whole(size(index.bytes))}` : "–",
  },
];

/** Whether the table has this column. @param {Column} column @param {import("../../types").Model} model */
export function isShown({ onLand, inRace }, { costs, lanes }) {
  return (onLand ?? costs !== null) === (costs !== null) && !(inRace && lanes.length < 2);
}

export class RaceRow {
  #index;
  #model;
  #lanes;
  #radio;
  #name = h("span", { class: "race-engine" });
  #motion = h("span", { class: "race-motion muted small" });
  #status = h("p", { class: "race-status small", hidden: true });
  #progress = h("progress", { hidden: true });
  #cells = COLUMNS.map(({ name }) => h("td", { role: "cell", "data-label": name }));
  #cancel;
  #retry;
  #remove;
  /** @type {HTMLTableRowElement} */
  element;

  /**
   * @param {number} index
   * @param {import("../../types").Model} model
   * @param {import("../../types").Lanes} lanes
   */
  constructor(index, model, lanes) {
    this.#index = index;
    this.#model = model;
    this.#lanes = lanes;
    this.#radio = h("input", {
      type: "radio",
      name: "active-lane",
      class: "sr-only",
      change: () => model.set({ active: index }),
    });
    this.#cancel = iconButton("stop", `Cancel lane ${index + 1}`, () => lanes.cancel(index));
    this.#retry = iconButton("retry", `Start lane ${index + 1} again`, () => lanes.retry(index));
    this.#remove = iconButton("close", `Remove lane ${index + 1}`, () => model.removeLane(index));
    const label = h(
      "label",
      { class: "race-lane" },
      this.#radio,
      laneMark(index),
      h("span", { class: "race-names" }, this.#name, this.#motion),
    );
    this.element = h(
      "tr",
      { role: "row" },
      h("th", { scope: "row", role: "rowheader" }, label, this.#status, this.#progress),
      ...this.#cells,
      h("td", { role: "cell", class: "race-actions" }, this.#cancel, this.#retry, this.#remove),
    );
    this.element.addEventListener("click", (event) => {
      if (!(event.target instanceof Element) || event.target.closest("button")) return;
      if (model.active !== index) model.set({ active: index });
    });
  }

  /** @param {Map<string, number>} best the least value of each column */
  show(best) {
    const setup = this.#model.lanes[this.#index];
    const lane = this.#lanes.list[this.#index];
    if (!setup || !lane) return;
    const active = this.#model.active === this.#index;
    this.element.classList.toggle("active", active && this.#model.lanes.length > 1);
    this.element.classList.toggle("stale", lane.stale);
    this.#radio.checked = active;
    this.#radio.setAttribute(
      "aria-label",
      `Lane ${this.#index + 1}: ${engineName(setup.engine)}, k = ${kText(setup.k)}, ${motionText(setup)}`,
    );
    setText(this.#name, engineName(setup.engine));
    setText(this.#motion, motionText(setup));
    // Alone, the panel of the engine says it.
    this.#motion.hidden = this.#model.lanes.length < 2;
    COLUMNS.forEach((column, at) => {
      this.#cells[at].hidden = !isShown(column, this.#model);
    });
    COLUMNS.forEach((column, at) => this.#showCell(column, at, setup, lane, best));
    this.#showStatus(lane, setup);
    this.#remove.hidden = this.#model.lanes.length < 2;
  }

  /** @param {Column} column @param {number} at @param {LaneSetup} setup @param {LaneState} lane
   *  @param {Map<string, number>} best */
  #showCell({ name, value, text }, at, setup, lane, best) {
    const cell = this.#cells[at];
    if (!cell) return;
    const least = best.get(name);
    const own = value?.(lane);
    const wins = least !== undefined && own !== undefined && own <= least * 1.000001 + 1e-9;
    cell.classList.toggle("best", wins);
    setText(cell, text(lane, setup) || "–");
    if (wins) cell.title = "The best of the race";
    else cell.removeAttribute("title");
  }

  /** @param {LaneState} lane @param {LaneSetup} setup */
  #showStatus(lane, setup) {
    const busy = lane.phase === "preparing" || lane.phase === "searching" || lane.phase === "starting";
    const text = statusText(lane, setup);
    setText(this.#status, text);
    this.#status.hidden = text === "";
    this.#status.classList.toggle("error", lane.phase === "failed" || (lane.answer?.error !== null && !busy));
    const progress = lane.phase === "preparing" ? lane.progress : null;
    this.#progress.hidden = !progress;
    if (progress) {
      this.#progress.max = Math.max(progress.total, 1);
      this.#progress.value = progress.done;
      this.#progress.setAttribute("aria-label", progress.stage);
    }
    this.#cancel.hidden = lane.phase !== "preparing" && lane.phase !== "searching";
    this.#retry.hidden = lane.phase !== "cancelled" && lane.phase !== "failed";
  }
}

/** @param {LaneState} lane @param {LaneSetup} setup */
function statusText({ phase, progress, expanded, message, answer, index }, { engine }) {
  if (phase === "failed") return withNames(message) || "The engine stopped.";
  if (phase === "cancelled") return message || "Cancelled.";
  if (phase === "starting") return "Starting…";
  if (phase === "preparing") return progress ? `Preparing: ${progress.stage}` : "Preparing…";
  if (phase === "searching") return expanded > 0 ? `Searching: ${count(expanded)} expansions` : "";
  if (answer?.error) return answer.error.message;
  if (answer?.status === "unreachable") return "There is no path to the goal.";
  if (answer?.status === "nearest") return "No way to the goal: the path ends at the nearest vertex.";
  const isReplaced = answer && index && index.searchedBy !== engine;
  return isReplaced ? `${engineName(index.searchedBy)} searches: subgoals would be slow on this map.` : "";
}
