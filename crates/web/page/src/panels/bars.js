// The bars over the knob: how much longer than the shortest paths over N(k) can be on any map, and how much
// longer the best one is on this map. On land, how much more each k costs here.

import { LARGEST_K_ON_LAND } from "../model/land.js";
import { kAt, PLACES, placeOf } from "../model/steps.js";
import { part, s } from "./dom.js";
import { excess } from "./words.js";

/** @import { LaneState } from "../../types.js" */
/** @typedef {import("../model/steps.js").K} K */
/** @typedef {import("../model/steps.js").Rungs} Rungs */

/** The height of the picture, in its own units. */
const HEIGHT = 4;
/** The free space at each side of a bar, of the width of a place. */
const GAP = 0.14;

export class Bars {
  #svg = part("k-bars", SVGSVGElement);
  #drawn = "";

  /** @param {(place: number) => void} chosen */
  constructor(chosen) {
    this.#svg.setAttribute("viewBox", `0 0 ${PLACES.length} ${HEIGHT}`);
    this.#svg.setAttribute("preserveAspectRatio", "none");
    this.#svg.addEventListener("click", ({ clientX }) => {
      const { left, width } = this.#svg.getBoundingClientRect();
      const at = Math.floor(((clientX - left) / width) * PLACES.length);
      chosen(PLACES[Math.min(PLACES.length - 1, Math.max(0, at))]);
    });
  }

  /** @param {K} now @param {Map<K, number | null>} bounds @param {LaneState | null} lane @param {Rungs} rungs
   *  @param {number[][]} steps */
  show(now, bounds, lane, rungs, steps) {
    const least = rungs.get("any")?.length;
    /** @type {Map<K, number>} */
    const seen = new Map();
    if (least) for (const [k, { length }] of rungs) seen.set(k, length / least);
    const answer = lane && !lane.stale ? lane.answer : null;
    const own = answer?.reference?.what === "any" ? excess(answer) : undefined;
    if (own !== undefined) seen.set(now, own);
    this.#draw(now, bounds, seen, steps);
  }

  /** On land no bound holds on every map. @param {K} now @param {Rungs} rungs @param {number[][]} steps */
  showLand(now, rungs, steps) {
    const least = rungs.get(LARGEST_K_ON_LAND)?.cost;
    /** @type {Map<K, number>} */
    const ratios = new Map();
    if (least) for (const [k, { cost }] of rungs) ratios.set(k, cost / least);
    this.#draw(now, ratios, new Map(), steps);
  }

  /** @param {K} now @param {Map<K, number | null>} bounds @param {Map<K, number>} seen
   *  @param {number[][]} steps */
  #draw(now, bounds, seen, steps) {
    const state = JSON.stringify([now, [...bounds], [...seen], steps]);
    if (state === this.#drawn) return;
    this.#drawn = state;
    const bars = PLACES.map((place, index) => {
      const k = kAt(place);
      const high = Math.max(rise(bounds.get(k) ?? 1), 0.06);
      const box = { x: index + GAP, width: 1 - 2 * GAP, y: HEIGHT - high, height: high };
      return s("rect", { class: k === now ? "bar now" : "bar", ...box });
    });
    this.#svg.replaceChildren(...bars, ...steps.flatMap((step) => mark(step, now, seen)));
  }
}

/** The mark over the bars of a step: a line. @param {number[]} step @param {K} now
 *  @param {Map<K, number>} seen */
function mark(step, now, seen) {
  const isNow = step.includes(placeOf(now));
  const ratio = seen.get(isNow ? now : kAt(step[0]));
  if (ratio === undefined) return [];
  const y = HEIGHT - Math.max(rise(ratio), 0.03);
  const d = `M${step[0] - PLACES[0] + GAP} ${y}h${step.length - 2 * GAP}`;
  return [s("path", { class: isNow ? "seen now" : "seen", d })];
}

/** The height of a ratio over the slider. The root lets us see small excesses beside large ones.
 *  @param {number} ratio */
function rise(ratio) {
  const most = 0.45;
  return Math.sqrt(Math.min(Math.max(ratio - 1, 0), most) / most) * 3.8;
}
