// The steps of the knob: values of k that give the same path on this map are one step.

import { LARGEST_K } from "./described.js";

/** @import { LaneSetup, Rung } from "../../types.js" */
/** @typedef {number | "any"} K */
/** @typedef {ReadonlyMap<K, Rung>} Rungs */

/** The place of ∞ on the knob. */
export const ANY = LARGEST_K + 1;
/** All places on the knob. */
export const PLACES = Object.freeze(Array.from({ length: ANY - 1 }, (_, index) => index + 2));
/** A path that is shorter by less, in cells, looks the same. */
const VISIBLE = 0.01;

/** @param {number} place @returns {K} */
export const kAt = (place) => (place === ANY ? "any" : place);
/** @param {K} k */
export const placeOf = (k) => (k === "any" ? ANY : k);

/**
 * The places in steps. A k of which nothing is known is a step of its own, and so is ∞: it is no number of
 * moves.
 * @param {Rungs} rungs
 * @returns {number[][]}
 */
export function stepsOf(rungs) {
  /** @type {number[][]} */
  const steps = [];
  let first = Infinity;
  for (const place of PLACES) {
    const cost = place === ANY ? undefined : rungs.get(place)?.cost;
    if (cost !== undefined && first - cost < VISIBLE) {
      steps[steps.length - 1].push(place);
    } else {
      steps.push([place]);
      first = cost ?? Infinity;
    }
  }
  return steps;
}

/**
 * The place so many steps on, or back: the least k of its step.
 * @param {number[][]} steps
 * @param {number} from - A place.
 * @param {number} by
 */
export function stepped(steps, from, by) {
  const at = steps.findIndex((step) => step.includes(from)) + by;
  return steps[Math.min(steps.length - 1, Math.max(0, at))][0];
}

/**
 * What the knob may skip with this setup: nothing where an engine's path is not the best over N(k).
 * @param {Readonly<LaneSetup>} setup
 * @param {string | undefined} guarantee - Of its engine.
 * @param {Rungs} rungs
 */
export function stepsFor({ smooth }, guarantee, rungs) {
  return stepsOf(smooth || guarantee !== "optimal(k)" ? new Map() : rungs);
}
