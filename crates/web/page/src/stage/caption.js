// The caption of a pane: the lane's mark, engine, k, length and how it stands; and the sentences and the
// legend that lie over its map.

import { cells, count, engineName, kText, withNames } from "../panels/words.js";
import { DASHES } from "./colors.js";

/** @typedef {import("../../types.d.ts").LaneSetup} LaneSetup */
/** @typedef {import("../../types.d.ts").LaneState} LaneState */
/** @typedef {import("../../types.d.ts").Lanes} Lanes */
/** @typedef {import("../../types.d.ts").Overlay} Overlay */

/** @template {keyof HTMLElementTagNameMap} K @param {K} tag @param {string} className @param {Element}
 *  [parent] @returns {HTMLElementTagNameMap[K]} */
export function element(tag, className, parent) {
  const made = document.createElement(tag);
  made.className = className;
  parent?.append(made);
  return made;
}

/** Changes the text only if it is another: the browser then need not lay out. @param {Element} target
 *  @param {string} text */
function say(target, text) {
  if (target.textContent !== text) target.textContent = text;
}

/** The line of the lane, as its path is drawn. @param {number} lane */
function mark(lane) {
  const dashes = DASHES[lane % 4].map((length) => 0.8 * length).join(" ");
  return `<svg viewBox="0 0 30 10" width="30" height="10" aria-hidden="true">
    <line x1="2" y1="5" x2="28" y2="5" stroke="var(--lane-${lane % 4})" stroke-width="3.5"
      ${dashes ? `stroke-dasharray="${dashes}"` : 'stroke-linecap="round"'}/></svg>`;
}

/** @param {LaneState} state */
function statusOf({ phase, progress, expanded, answer, message }) {
  if (phase === "starting") return "starting";
  if (phase === "preparing") {
    if (!progress || progress.total === 0) return "preparing";
    return `preparing: ${progress.stage} ${Math.floor((100 * progress.done) / progress.total)} %`;
  }
  if (phase === "searching") return expanded > 0 ? `searching: ${count(expanded)}` : "searching";
  if (phase === "cancelled") return "stopped";
  if (phase === "failed") return message ? "failed" : "";
  if (answer?.status === "unreachable") return "no path";
  if (answer?.status === "invalid") return "invalid";
  if (answer?.status === "nearest") return "no path: this leads nearest";
  return "";
}

/** The pane's message if anything is wrong, as a sentence; empty if nothing is. @param {LaneState} state */
export function sentenceOf({ phase, answer, message }) {
  if (phase === "failed" || phase === "cancelled") return withNames(message);
  if (phase !== "done" || !answer) return "";
  if (answer.status === "invalid") return answer.error?.message ?? "The query is invalid.";
  return answer.status === "unreachable" ? "No path leads to the goal." : "";
}

export class Caption {
  /** @param {Element} pane @param {() => void} chosen */
  constructor(pane, chosen) {
    this.button = element("button", "stage-caption", pane);
    this.button.type = "button";
    this.button.addEventListener("click", chosen);
    this.mark = element("span", "stage-mark", this.button);
    this.engine = element("span", "stage-engine", this.button);
    this.k = element("span", "stage-k", this.button);
    this.length = element("span", "stage-length", this.button);
    this.status = element("span", "stage-status", this.button);
    this.bar = element("span", "stage-progress", this.button);
    this.lane = -1;
    this.name = "";
  }

  /** @param {number} lane @param {LaneSetup} setup @param {LaneState | undefined} state @param {boolean}
   *  isActive @param {boolean} hasArrived Whether the length is known in the race. */
  update(lane, setup, state, isActive, hasArrived) {
    if (lane !== this.lane) this.mark.innerHTML = mark(lane);
    this.lane = lane;
    say(this.engine, engineName(setup.engine));
    say(this.k, `k = ${kText(setup.k)}`);
    const answer = state?.answer ?? null;
    const isKnown = answer && (answer.status === "found" || answer.status === "nearest") && hasArrived;
    const price = isKnown && answer.cost !== null ? `cost ${cells(answer.cost)}` : "";
    say(this.length, price || (isKnown ? cells(answer.length) : ""));
    const status = state ? statusOf(state) : "starting";
    say(this.status, status);
    // The parts of the caption are set apart by space alone: read out, "k = 3" and "74.43" were one number.
    const name = [engineName(setup.engine), this.k.textContent, this.length.textContent, status]
      .filter(Boolean)
      .join(", ");
    if (this.name !== name) this.button.setAttribute("aria-label", name);
    this.name = name;
    this.button.classList.toggle("is-wrong", !!state && sentenceOf(state) !== "");
    this.button.setAttribute("aria-pressed", String(isActive));
    const progress = state?.phase === "preparing" ? state.progress : null;
    const share = progress && progress.total > 0 ? progress.done / progress.total : 0;
    this.bar.hidden = !progress;
    this.bar.style.setProperty("--share", String(share));
    this.bar.style.setProperty("--color", `var(--lane-${lane % 4})`);
  }
}

/** The legend of what lies over the map. */
export class Legend {
  /** @param {Element} parent */
  constructor(parent) {
    this.root = element("div", "stage-legend", parent);
    this.root.hidden = true;
    this.key = "";
  }

  /** @param {Overlay} overlay @param {Lanes["field"]} field @param {LaneSetup} setup
   *  @param {{ search: "" | "tiles" | "marks" | "labels", isBeaten: boolean, onLand: boolean }} shown */
  update(overlay, field, setup, shown) {
    const html = legendOf(overlay, field, setup, shown);
    if (html === this.key) return;
    this.key = html;
    this.root.innerHTML = html;
    this.root.hidden = html === "";
  }
}

/** @param {number} value */
const short = (value) => (value >= 100 ? value.toFixed(0) : String(Number(value.toPrecision(3))));

/** @param {Overlay} overlay @param {Lanes["field"]} field @param {LaneSetup} setup
 *  @param {{ search: string, isBeaten: boolean, onLand: boolean }} shown */
function legendOf(overlay, field, setup, { search, isBeaten, onLand }) {
  if (overlay === "search" && search) {
    const what = onLand ? "over N(k)" : "at any angle";
    const optimum = isBeaten ? `<i class="stage-optimum"></i><span>shortest<b> ${what}</b></span>` : "";
    if (search === "labels") return `${optimum}<span>no search: hub labels</span>`;
    return `${optimum}<span>expanded<b> first</b></span><i class="stage-scale is-${search}"></i><b>last</b>
      <i class="stage-tile"></i><span>open</span>`;
  }
  if (field && field.kind === overlay) {
    const what = overlay === "clearance" ? "clearance" : onLand ? "cost" : "distance";
    return `<span>${what} 0</span><i class="stage-scale is-${overlay}"></i>
      <span>${short(field.greatest)}</span>`;
  }
  if (overlay !== "rules") return "";
  const line = (/** @type {string} */ d, /** @type {string} */ color) =>
    `<svg viewBox="0 0 14 14" width="14" height="14" aria-hidden="true"><path d="${d}" fill="none"
      stroke="var(--${color})" stroke-width="2.5" stroke-linecap="round"/></svg>`;
  const words =
    setup.placement === "corner"
      ? ["gap between walls: open", "closed"]
      : ["step past a wall's corner: allowed", "forbidden"];
  return `${line("M2 2L12 12", "text")}<span>${words[0]}</span>
    ${line("M3 3L11 11M11 3L3 11", "danger")}<span>${words[1]}</span>`;
}
