// When a lane's query is sent. Pure, so that it can be tested.

/** Of a gesture's queries, one that took this long (ms) gives way to the next. */
export const PATIENCE = 1000;
/** A preparation of a map that has changed is given up after this long. */
export const PREPARING = 1000;
/** An index that took longer than this is not prepared at each stroke, but at a pause of so long. */
export const [QUICK, PAUSE] = [30, 120];

/**
 * A query under way.
 * @typedef {object} Sent
 * @property {number} number
 * @property {number} at - The time.
 * @property {boolean} isPreparing
 * @property {boolean} tells - Whether the engine tells how far it is: such an index is never repaired.
 * @property {string} scene - All on which the shortest path at any angle depends.
 */

/**
 * @typedef {object} Situation
 * @property {number} now
 * @property {"" | "end" | "cells"} gesture
 * @property {number} took - The time to bring the index up to date after an edit, in ms.
 * @property {number} pauseEnds - The time at which the user has not drawn for a while.
 * @property {Pick<Sent, "at" | "isPreparing"> | null} sent
 * @property {boolean} isOther - Whether more than the ends has changed since it was sent.
 */

/**
 * The next action: the query is sent now, at a time, or after the answer to the one under way; or the worker
 * is replaced, as its work is of no use and cannot be paused.
 * @param {Situation} situation
 * @returns {"send" | "replace" | "await" | { until: number }}
 */
export function whatNow({ now, gesture, took, pauseEnds, sent, isOther }) {
  if (gesture === "cells" && took > QUICK && now < pauseEnds) {
    return { until: pauseEnds };
  }
  if (!sent) {
    return "send";
  }
  const age = now - sent.at;
  if (sent.isPreparing) {
    return isOther && age > PREPARING ? "replace" : "await";
  }
  // In a gesture the answer to a scene a little older is better than none.
  return (isOther && !gesture) || age > PATIENCE ? "send" : "await";
}
