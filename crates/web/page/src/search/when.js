// When a lane's next query is sent. Pure, so that it can be tested.

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
 * @property {number} at - When.
 * @property {boolean} isPreparing
 * @property {boolean} tells - Whether the engine tells how far it is: such an index is never repaired.
 */

/**
 * @typedef {object} Situation
 * @property {number} now
 * @property {"" | "end" | "cells"} gesture
 * @property {number} took - What bringing the index up to date takes after an edit, in ms.
 * @property {number} pauseEnds - When the user has not drawn for a while.
 * @property {Pick<Sent, "at" | "isPreparing"> | null} sent
 * @property {boolean} isOther - Whether more than the ends has changed since it was sent.
 */

/**
 * What to do: send the next query, wait until a time or for the answer to the query under way, or replace the
 * worker, as what it does is of no use and cannot be paused.
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
