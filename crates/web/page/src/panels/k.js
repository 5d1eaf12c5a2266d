// The knob: the slider for k, the star of moves beside it, and what k is worth.

import { LARGEST_K_ON_LAND, MOST_CELLS_OF_LADDER } from "../model/land.js";
import { ANY, kAt, PLACES, placeOf } from "../model/steps.js";
import { Bars } from "./bars.js";
import { changes, eachFrame, h, part, setText } from "./dom.js";
import { LadderTable } from "./ladder.js";
import { readout } from "./readout.js";
import { drawStar } from "./star.js";
import { count } from "./words.js";

/** @typedef {import("../../types").LaneSetup} LaneSetup */

/**
 * @param {import("../../types").Model} model
 * @param {import("../../types").Lanes} lanes
 * @param {import("./setups.js").Setups} setups
 * @param {import("./bounds.js").Bounds} bounds
 */
export function startK(model, lanes, setups, bounds) {
  const slider = part("k-slider", HTMLInputElement);
  const choose = (/** @type {number} */ place) => setups.change({ k: kAt(place) });
  slider.addEventListener("input", () => choose(Number(slider.value)));
  slider.addEventListener("keydown", (event) => stepKey(event, setups));
  drawTicks(choose);
  const bars = new Bars((place) => choose(stepOf(setups.steps, place)[0]));
  const star = new Star(lanes);
  const ladder = new LadderTable((k) => setups.change({ k }));
  const show = eachFrame(() => {
    const setup = model.lanes[model.active];
    if (!setup) return;
    showValue(slider, setup);
    star.show(setup.k);
    const known = bounds.of(setup);
    const onLand = model.costs !== null;
    const lane = lanes.list[model.active] ?? null;
    const { steps } = setups;
    if (onLand) bars.showLand(setup.k, lanes.ladder, steps);
    else bars.show(setup.k, known, lane, lanes.ladder, steps);
    ladder.show(onLand && model.cells.length <= MOST_CELLS_OF_LADDER, lanes.ladder, setup.k);
    showLegend(onLand);
    showSteps(steps, onLand);
    readout(setup, lane, known.get(setup.k), onLand);
  });
  changes(model, show);
  changes(lanes, show);
  changes(bounds, show);
  lanes.ready.then(show, () => {});
  show();
}

/** The step of a place. @param {number[][]} steps @param {number} place */
const stepOf = (steps, place) => steps.find((step) => step.includes(place)) ?? [place];

/** Arrows go to the next k that changes the path; with Shift to the next k, as the slider does by itself.
 *  @param {KeyboardEvent} event @param {import("./setups.js").Setups} setups */
function stepKey(event, setups) {
  const by = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
  if (by === undefined || event.shiftKey || event.ctrlKey || event.metaKey || event.altKey) return;
  event.preventDefault();
  setups.stepK(by > 0 ? 1 : -1);
}

/** @param {(place: number) => void} chosen */
function drawTicks(chosen) {
  const ticks = PLACES.map((place) => {
    const text = place === ANY ? "∞" : String(place);
    return h("span", { "data-place": place, click: () => chosen(place) }, text);
  });
  part("k-ticks", HTMLElement).append(...ticks);
}

/** Joins the ticks of each step, and says which k give the same path. @param {number[][]} steps
 *  @param {boolean} onLand */
function showSteps(steps, onLand) {
  for (const tick of part("k-ticks", HTMLElement).children) {
    const place = Number(tick.getAttribute("data-place"));
    const step = stepOf(steps, place);
    tick.classList.toggle("beyond", onLand && place > LARGEST_K_ON_LAND);
    tick.classList.toggle("joined", place !== step[0]);
    tick.classList.toggle("joins", place !== step[step.length - 1]);
  }
  const long = steps.filter(({ length }) => length > 1);
  const ranges = long.map((step) => `${step[0]} to ${step[step.length - 1]}`);
  setText(part("k-same", HTMLElement), ranges.length ? `The same path: k = ${ranges.join(", ")}` : "");
}

/** @param {HTMLInputElement} slider @param {LaneSetup} setup */
function showValue(slider, setup) {
  const place = placeOf(setup.k);
  if (slider.value !== String(place)) slider.value = String(place);
  const finite = setup.k === "any" ? 0 : setup.k;
  const text = finite ? things(finite) : "every direction";
  slider.setAttribute("aria-valuetext", `k = ${finite || "∞"}: ${text}`);
  slider.style.setProperty("--at", String((place - 2) / (ANY - 2)));
  const number = part("k-number", HTMLElement);
  number.replaceChildren(h("i", {}, "k"), ` = ${finite || "∞"}`);
  setText(part("k-moves", HTMLElement), text);
  setText(part("k-note", HTMLElement), note(setup.k));
  for (const tick of part("k-ticks", HTMLElement).children) {
    tick.classList.toggle("now", tick.getAttribute("data-place") === String(place));
  }
}

/** The meaning of the bars over the slider. @param {boolean} onLand */
function showLegend(onLand) {
  part("k-legend-map", HTMLElement).hidden = onLand;
  part("k-legend-land", HTMLElement).hidden = !onLand;
}

/** @param {number} k */
const things = (k) => `${count(2 ** k)} moves`;

/** @param {number | "any"} k */
function note(k) {
  if (k === "any") return "No mediant is left to add.";
  if (k === 2) return "Along rows and columns.";
  const added = `${count(2 ** (k - 1))} new:`;
  return k === 3 ? `${added} the diagonals.` : `${added} the mediants, sums of two neighbors.`;
}

/** Keeps the star at the k of the active lane. */
class Star {
  /** @type {number | "any"} */
  #k = 0;
  #lanes;

  /** @param {import("../../types").Lanes} lanes */
  constructor(lanes) {
    this.#lanes = lanes;
  }

  /** @param {number | "any"} k */
  async show(k) {
    if (k === this.#k) return;
    const grows = k !== "any" && this.#k !== "any" && k > this.#k && this.#k !== 0;
    this.#k = k;
    const moves = k === "any" ? new Int32Array() : await this.#lanes.moves(k).catch(() => null);
    if (moves && k === this.#k) drawStar(part("star", SVGSVGElement), k, moves, grows);
    else if (!moves) this.#k = 0;
  }
}
