// The knob: the slider for k, the star of moves beside it, and what k is worth.

import { LARGEST_K_ON_LAND, MOST_CELLS_OF_LADDER } from "../model/land.js";
import { changes, eachFrame, h, part, s, setText } from "./dom.js";
import { LadderTable } from "./ladder.js";
import { readout } from "./readout.js";
import { drawStar } from "./star.js";
import { count } from "./words.js";

/** @typedef {import("../../types").LaneSetup} LaneSetup */

/** The place of ∞ on the slider. */
const ANY = 13;
const PLACES = Array.from({ length: ANY - 1 }, (_, index) => index + 2);

/** @param {number} place @returns {number | "any"} */
const kAt = (place) => (place === ANY ? "any" : place);
/** @param {number | "any"} k */
const placeOf = (k) => (k === "any" ? ANY : k);

/**
 * @param {import("../../types").Model} model
 * @param {import("../../types").Lanes} lanes
 * @param {import("./setups.js").Setups} setups
 * @param {import("./bounds.js").Bounds} bounds
 */
export function startK(model, lanes, setups, bounds) {
  const slider = part("k-slider", HTMLInputElement);
  slider.addEventListener("input", () => setups.change({ k: kAt(Number(slider.value)) }));
  drawTicks((place) => setups.change({ k: kAt(place) }));
  const worth = new Worth();
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
    if (onLand) worth.showLand(setup.k, lanes.ladder);
    else worth.show(setup, known, lane, `${model.version} ${model.radius}`);
    ladder.show(onLand && model.cells.length <= MOST_CELLS_OF_LADDER, lanes.ladder, setup.k);
    showLegend(onLand);
    for (const tick of part("k-ticks", HTMLElement).children) {
      const place = Number(tick.getAttribute("data-place"));
      tick.classList.toggle("beyond", onLand && place > LARGEST_K_ON_LAND);
    }
    readout(setup, lane, known.get(setup.k), onLand);
  });
  changes(model, show);
  changes(lanes, show);
  changes(bounds, show);
  lanes.ready.then(show, () => {});
  show();
}

/** @param {(place: number) => void} chosen */
function drawTicks(chosen) {
  const ticks = PLACES.map((place) => {
    const text = place === ANY ? "∞" : String(place);
    return h("span", { "data-place": place, click: () => chosen(place) }, text);
  });
  part("k-ticks", HTMLElement).append(...ticks);
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

/** The bars over the slider: the bound of each k, and the excess of the paths that were seen. */
class Worth {
  /** The excess by k, of the scene of now. @type {Map<number | "any", number>} */
  #seen = new Map();
  #key = "";
  #drawn = "";

  /**
   * @param {LaneSetup} setup
   * @param {Map<number | "any", number | null>} bounds
   * @param {import("../../types").LaneState | null} lane
   * @param {string} scene the map, and the agent on it
   */
  show(setup, bounds, lane, scene) {
    const answer = lane && !lane.stale ? lane.answer : null;
    const ends = answer ? `${answer.start} ${answer.goal}` : (this.#key.split("|")[2] ?? "");
    const key = `${setup.placement} ${setup.corners} ${setup.gap} ${setup.smooth}|${scene}|${ends}`;
    if (key !== this.#key) this.#seen.clear();
    this.#key = key;
    if (answer?.reference?.what === "any" && answer.status === "found" && answer.reference.length > 0) {
      this.#seen.set(setup.k, answer.length / answer.reference.length);
    }
    const state = JSON.stringify([setup.k, [...bounds], [...this.#seen]]);
    if (state === this.#drawn) return;
    this.#drawn = state;
    this.#draw(setup.k, bounds);
  }

  /** On land no bound holds on every map: the bars are how much more each k costs than the largest one.
   *  @param {number | "any"} now @param {import("./ladder.js").Rungs} rungs */
  showLand(now, rungs) {
    const state = JSON.stringify(["land", now, [...rungs]]);
    if (state === this.#drawn) return;
    this.#drawn = state;
    this.#seen.clear();
    this.#key = "";
    const least = rungs.get(LARGEST_K_ON_LAND)?.cost;
    /** @type {Map<number | "any", number>} */ const ratios = new Map();
    if (least) for (const [k, { cost }] of rungs) ratios.set(k, cost / least);
    this.#draw(now, ratios);
  }

  /** @param {number | "any"} now @param {Map<number | "any", number | null>} bounds */
  #draw(now, bounds) {
    const svg = part("k-bars", SVGSVGElement);
    const [width, height] = [PLACES.length, 4];
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    svg.setAttribute("preserveAspectRatio", "none");
    const marks = PLACES.flatMap((place, index) => {
      const k = kAt(place);
      const kind = k === now ? " now" : "";
      const bound = bounds.get(k);
      const seen = this.#seen.get(k);
      const high = Math.max(bound ? rise(bound) : 0, 0.06);
      const box = { x: index + 0.14, width: 0.72, y: height - high, height: high };
      const bar = s("rect", { class: `bar${kind}`, ...box });
      if (seen === undefined) return [bar];
      const y = height - Math.max(rise(seen), 0.03);
      return [bar, s("path", { class: `seen${kind}`, d: `M${index + 0.14} ${y}h0.72` })];
    });
    svg.replaceChildren(...marks);
  }
}

/** The height of a ratio over the slider. The root lets us see small excesses beside large ones.
 *  @param {number} ratio */
function rise(ratio) {
  const most = 0.45;
  return Math.sqrt(Math.min(Math.max(ratio - 1, 0), most) / most) * 3.8;
}
