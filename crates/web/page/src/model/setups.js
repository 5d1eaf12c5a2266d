// The allowed lanes, overlays, wishes and sizes: the checks that the model and the scenes in links share.
// Whether an engine and a motion go together is for the engines to say (`Lanes.check`).

/** @typedef {import("../../types.d.ts").LaneSetup} LaneSetup */
/** @typedef {import("../../types.d.ts").Overlay} Overlay */

import { CHOICES, LARGEST_K } from "./described.js";

export { CHOICES };

export const MOST_LANES = 4;
export const LARGEST_RADIUS = 1000;
export const MOST_AGENTS = 400;

/** The page's limit: 4096 × 4096. */
export const MOST_CELLS = 16_777_216;
/** The library's limit. */
export const LONGEST_SIDE = 32_768;

/** @type {readonly Overlay[]} */
export const OVERLAYS = ["search", "clearance", "distances", "flow", "rules", "none"];

/** @type {Readonly<LaneSetup>} */
export const FIRST_LANE = Object.freeze({
  engine: "astar",
  k: 3,
  placement: "center",
  corners: "never",
  gap: "open",
  smooth: "",
});

/** The mistake in the setup of a lane, as a sentence; empty if there is none.
 * @param {unknown} setup */
export function whyNoLane(setup) {
  if (typeof setup !== "object" || setup === null) return "A lane needs an engine and a motion.";
  const fields = /** @type {Record<string, unknown>} */ (setup);
  const unknown = Object.keys(fields).find((key) => !Object.hasOwn(FIRST_LANE, key));
  if (unknown !== undefined) return `A lane has no field "${unknown}".`;
  const { engine, k } = fields;
  if (typeof engine !== "string" || !/^[a-z][a-z0-9-]{0,31}$/.test(engine)) {
    return "A lane's engine must be the name of an engine.";
  }
  const isNumber = typeof k === "number" && Number.isInteger(k) && k >= 2 && k <= LARGEST_K;
  if (!isNumber && k !== "any") return `A lane's k must be a number from 2 to ${LARGEST_K} or "any".`;
  for (const [key, words] of Object.entries(CHOICES)) {
    const word = fields[key];
    if (typeof word !== "string" || !words.includes(word)) {
      return `A lane's ${key} must be ${words.map((w) => `"${w}"`).join(" or ")}.`;
    }
  }
  return "";
}

/** The first mistake in the lanes of a scene, as a sentence; empty if there is none.
 * @param {unknown} lanes */
export function whyNoLanes(lanes) {
  if (!Array.isArray(lanes) || lanes.length < 1 || lanes.length > MOST_LANES) {
    return `A scene has 1 to ${MOST_LANES} lanes.`;
  }
  return lanes.map(whyNoLane).find((why) => why !== "") ?? "";
}

/** The objection to a map of this size, as a sentence; empty if there is none.
 * @param {unknown} width @param {unknown} height */
export function whyNoSize(width, height) {
  /** @param {unknown} side */
  const isSide = (side) => Number.isInteger(side) && Number(side) >= 1 && Number(side) <= LONGEST_SIDE;
  if (!isSide(width) || !isSide(height)) return `Each side of a map has 1 to ${LONGEST_SIDE} cells.`;
  if (Number(width) * Number(height) > MOST_CELLS) {
    return `A map of ${width} × ${height} cells is too large for the page: it takes up to 4096 × 4096.`;
  }
  return "";
}

/** The mistake in the size of a map or in the number of its cells, as a sentence; empty if there is none.
 * @param {unknown} width @param {unknown} height @param {ArrayLike<number>} cells */
export function whyNoMap(width, height, cells) {
  const why = whyNoSize(width, height);
  if (why !== "" || cells.length === Number(width) * Number(height)) return why;
  return `A map of ${width} × ${height} cells cannot have ${cells.length} cells.`;
}

/** @param {readonly Readonly<LaneSetup>[]} a @param {readonly Readonly<LaneSetup>[]} b */
export function areSameLanes(a, b) {
  const keys = /** @type {(keyof LaneSetup)[]} */ (Object.keys(FIRST_LANE));
  return a.length === b.length && a.every((lane, i) => keys.every((key) => lane[key] === b[i][key]));
}

/** The nearest whole number within the bounds; undefined if the value is no number.
 * @param {unknown} value @param {number} least @param {number} most */
export function whole(value, least, most) {
  if (typeof value !== "number" || Number.isNaN(value)) return undefined;
  return Math.round(Math.min(Math.max(value, least), most));
}

/** The radius in whole thousandths of a cell, as links hold it; undefined if the value is no number.
 * @param {unknown} value */
export function radius(value) {
  if (typeof value !== "number") return undefined;
  const thousandths = whole(value * 1000, 0, LARGEST_RADIUS * 1000);
  return thousandths === undefined ? undefined : thousandths / 1000;
}

/**
 * Whether paths bend at corners: at corners all do, between centers those at any angle.
 * @param {Pick<LaneSetup, "k" | "placement">} setup
 */
export const bendsAtCorners = ({ k, placement }) => placement === "corner" || k === "any";

/**
 * The rule at gaps: between centers the one that connects what the moves connect.
 * @param {Pick<LaneSetup, "placement" | "corners" | "gap">} setup
 */
export function gapOf({ placement, corners, gap }) {
  if (placement === "corner") return gap;
  return corners === "always" ? "open" : "closed";
}
