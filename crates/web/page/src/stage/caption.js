// The caption of a pane: the lane's mark, engine, k and how it stands; and the legend beside it.

import { count, engineName, kText, sentenceOf } from "../panels/words.js";
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

export class Caption {
  /** @param {Element} pane @param {() => void} chosen */
  constructor(pane, chosen) {
    this.button = element("button", "stage-caption", pane);
    this.button.type = "button";
    this.button.addEventListener("click", chosen);
    this.mark = element("span", "stage-mark", this.button);
    this.engine = element("span", "stage-engine", this.button);
    this.k = element("span", "stage-k", this.button);
    this.status = element("span", "stage-status", this.button);
    this.bar = element("span", "stage-progress", this.button);
    this.lane = -1;
    this.name = "";
  }

  /** @param {number} lane @param {LaneSetup} setup @param {LaneState | undefined} state @param {boolean}
   *  isActive */
  update(lane, setup, state, isActive) {
    if (lane !== this.lane) this.mark.innerHTML = mark(lane);
    this.lane = lane;
    say(this.engine, engineName(setup.engine));
    say(this.k, `k = ${kText(setup.k)}`);
    const status = state ? statusOf(state) : "starting";
    say(this.status, status);
    // The parts of the caption are set apart by space alone: read out, they were one word.
    const name = [engineName(setup.engine), this.k.textContent, status].filter(Boolean).join(", ");
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
   *  @param {{ search: "" | "tiles" | "marks" | "labels", isBeaten: boolean, isCut: boolean,
   *  onLand: boolean }} shown */
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

/** What the start and the goal reach, where there is no path. */
const PARTS = `<i class="stage-part"></i><span>start<b> reaches this</b></span>
  <i class="stage-part is-goal"></i><span>goal<b> is in this</b></span>`;

/** @param {Overlay} overlay @param {Lanes["field"]} field @param {LaneSetup} setup
 *  @param {{ search: string, isBeaten: boolean, isCut: boolean, onLand: boolean }} shown */
function legendOf(overlay, field, setup, { search, isBeaten, isCut, onLand }) {
  const what = onLand ? "over N(k)" : "at any angle";
  const optimum = isBeaten ? `<i class="stage-optimum"></i><span>shortest<b> ${what}</b></span>` : "";
  return `${isCut ? PARTS : optimum}${keysOf(overlay, field, setup, search, onLand)}`;
}

/** @param {Overlay} overlay @param {Lanes["field"]} field @param {LaneSetup} setup @param {string} search
 *  @param {boolean} onLand */
function keysOf(overlay, field, setup, search, onLand) {
  if (overlay === "search" && search) {
    if (search === "labels") return "<span>no search: hub labels</span>";
    return `<span>expanded<b> first</b></span><i class="stage-scale is-${search}"></i><b>last</b>
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
