// The messages between the page and its workers, and the parts of a setup that both use. There is nothing
// here that runs long: both sides import it.

/** @import { Change, LaneAnswer, LaneSetup, LaneState, Model, Motion, Point, Rect } from "../../types.js" */
/** @import { EngineInfo, Options, Waypoints } from "../../mediant/mediant.js" */
/** @import { Kind } from "../workers.js" */
import { bendsAtCorners, gapOf } from "../model/setups.js";

/**
 * The news that a worker lacks of the model's map: nothing, the map, or the cells of a rectangle.
 * @typedef {object} MapNews
 * @property {{ width: number, height: number, cells: Uint8Array, costs: Uint8Array | null }} [map]
 * @property {Rect & { cells: Uint8Array, costs: Uint8Array | null }} [patch]
 */

/**
 * A query of a lane, with all that has changed since the last one.
 * @typedef {object} Ask
 * @property {"ask"} type
 * @property {number} number - Grows; the replies carry it.
 * @property {MapNews} news
 * @property {LaneSetup} setup
 * @property {number} radius
 * @property {Point} start
 * @property {Point} goal
 * @property {boolean} nearest
 * @property {boolean} hurry - A gesture is under way: another query comes soon.
 * @property {boolean} record - Whether to keep the steps of the search.
 */

/**
 * A task for one agent. If its path holds, it is kept. If not, or without one, the agent gets a
 * path from the first of these places that has a way to the goal; without places, from one chosen at random.
 * @typedef {object} Errand
 * @property {number} agent
 * @property {Waypoints | null} path
 * @property {number[]} places - x, y, x, y, …
 */

/**
 * @typedef {object} Walk
 * @property {"walk"} type
 * @property {number} id
 * @property {Point} goal
 * @property {boolean} nearest
 * @property {number} seed
 * @property {Errand[]} errands
 */

/**
 * The outcome of an errand. `path` is null if there is no way; `kept` says that the old path holds.
 * @typedef {{ agent: number, kept: boolean, path: Waypoints | null }} ErrandDone
 */

/**
 * An order to a lane's worker for a file.
 * @typedef {{ type: "trace" } | { type: "picture", format: "png" | "svg", overlay: string }} Order
 */

/**
 * The first message to a worker with a package.
 * @typedef {{ type: "start", kind: Kind, module: WebAssembly.Module }} Start
 */

/**
 * A message to a lane's worker.
 * @typedef {Start | Ask | Walk | { type: "cancel" }
 *   | { type: "refine" } | (Order & { id: number })} ToLane
 */

/**
 * A message from a lane's worker.
 * @typedef {{ type: "ready", engines: EngineInfo[] }
 *   | { type: "preparing", number: number }
 *   | { type: "progress", number: number, stage: string, done: number, total: number }
 *   | { type: "prepared", number: number, took: number, wasEdit: boolean, index: LaneState["index"] }
 *   | { type: "searching", number: number, expanded: number }
 *   | { type: "answer", number: number, answer: LaneAnswer, memory: number }
 *   | { type: "timing", number: number, ms: number, settled: boolean }
 *   | { type: "reference", number: number, reference: LaneAnswer["reference"] }
 *   | { type: "failed", number: number, message: string, broken: boolean }
 *   | { type: "walked", id: number, done: ErrandDone[], ms: number, over: boolean }
 *   | Reply} FromLane
 */

/**
 * The reply to a request with an id; to an order it is a file. A worker that is broken answers no more.
 * @typedef {{ type: "result", id: number, value: unknown }
 *   | { type: "refused", id: number, message: string, broken?: boolean }} Reply
 */

/**
 * The parts of a scene on which its overlay depends.
 * @typedef {object} OverlayWish
 * @property {MapNews} news
 * @property {LaneSetup} setup
 * @property {number} radius
 * @property {Point} goal
 * @property {"clearance" | "distances" | "flow" | ""} kind
 * @property {boolean} narrow - Whether to tell where the agent does not fit.
 * @property {boolean} parts - Whether to tell what the start reaches, and what the goal.
 * @property {Point} start
 */

/**
 * A question for the best path of a setup, with all that has changed of the map since the last one.
 * @typedef {object} RungWish
 * @property {MapNews} news
 * @property {LaneSetup} setup
 * @property {string} engine - The one that is asked, in place of the setup's.
 * @property {number} radius
 * @property {Point} start
 * @property {Point} goal
 */

/** @typedef {{ name: string, bytes: Uint8Array }} NamedBytes */

/**
 * A scenario, for a map of this size.
 * @typedef {NamedBytes & { width: number, height: number }} ScenarioWish
 */

/**
 * A request to the helper.
 * @typedef {{ type: "moves", k: number } | { type: "check", setup: LaneSetup, onLand: boolean }
 *   | { type: "bounds", setup: LaneSetup, ks: number[] }
 *   | { type: "read", files: NamedBytes[] } | ({ type: "scenario" } & ScenarioWish)
 *   | ({ type: "overlay" } & OverlayWish)
 *   | ({ type: "rung" } & RungWish)} Request
 */

/** The most cells of a map that the page takes. */
export const MOST_CELLS = 4096 * 4096;

/**
 * The motion of a setup, as the package has it.
 * @param {Readonly<LaneSetup>} setup
 * @returns {Motion}
 */
export function motionOf(setup) {
  const { k, placement } = setup;
  return bendsAtCorners(setup)
    ? { k, placement, gap: gapOf(setup) }
    : { k, placement, corners: setup.corners };
}

/**
 * The options of a setup's engine.
 * @param {Readonly<LaneSetup>} setup
 * @returns {Options}
 */
export function optionsOf(setup) {
  return setup.smooth ? { smooth: setup.smooth } : {};
}

/**
 * A text that is the same for equal motions.
 * @param {Readonly<LaneSetup>} setup
 */
export function motionKey(setup) {
  return `${setup.k} ${setup.placement} ${setup.placement === "center" ? setup.corners : setup.gap}`;
}

/**
 * A text that is the same for scenes with the same shortest path at any angle.
 * @param {Model} model
 * @param {Readonly<LaneSetup>} setup
 */
export function bestKey({ version, start, goal, radius, costs }, setup) {
  return `${version} ${start} ${goal} ${radius} ${costs !== null} ${motionKey({ ...setup, k: "any" })}`;
}

/**
 * A text that is the same for setups that prepare and search the same.
 * @param {Readonly<LaneSetup>} setup
 */
export function setupKey(setup) {
  return `${setup.engine} ${motionKey(setup)} ${setup.smooth}`;
}

/**
 * The detail of a `change` event of the model.
 * @param {Event} event
 * @returns {Change}
 */
export function changeOf(event) {
  return /** @type {CustomEvent<Change>} */ (event).detail;
}

/**
 * The message of an error, or the text of anything else that was thrown.
 * @param {unknown} error
 */
export function textOf(error) {
  return error instanceof Error ? error.message : String(error);
}

/**
 * A sentence from a text of the library, which begins with a small letter, has no period, and marks what is
 * to be typed as documentation does. The name of a file or an engine stays as it is.
 * @param {string} text
 */
export function sentence(text) {
  const trimmed = text.trim().replaceAll("`", '"');
  const first = /^[a-z]+ /.test(trimmed) ? trimmed.charAt(0).toUpperCase() : trimmed.charAt(0);
  return first + trimmed.slice(1) + (/[.!?]$/.test(trimmed) ? "" : ".");
}

/** The message of a lane whose engine met a mistake of its own. */
export const BROKEN =
  "The engine stopped by a mistake of its own. Take another engine, or change the scene and try again.";
