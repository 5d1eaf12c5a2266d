// The helper: a worker for all that is no lane's query. It reads files, tells the moves of N(k), what they
// are worth and which setups go together, and computes what lies over the map.

/** @import { LaneSetup, Rung } from "../../types.js" */
/** @import { OverlayWish, Request, RungWish, Start } from "./protocol.js" */
/** @import { Field } from "../../mediant/mediant.js" */
import { bound, checkSetup, Grid, moves, Scenario } from "../../mediant/mediant.js";
import { readMap, readScenario } from "./files.js";
import { begin } from "./package.js";
import { motionOf, optionsOf, sentence, textOf } from "./protocol.js";
import { edited, spaceOf } from "./session.js";

const NO_MEMORY = "There is not enough memory for this. Take a smaller map.";

/** The map of the overlays. @type {Grid | null} */
let grid = null;

/** @typedef {{ value: unknown, transfer: ArrayBuffer[] }} Reply */

/**
 * @param {Request} request
 * @returns {Reply}
 */
function reply(request) {
  switch (request.type) {
    case "moves":
      return { value: moves(request.k), transfer: [] };
    case "check": {
      const why = request.onLand
        ? whyNotOnLand(request.setup)
        : checkSetup(request.setup.engine, motionOf(request.setup), optionsOf(request.setup));
      return { value: why ? sentence(why) : "", transfer: [] };
    }
    case "bounds":
      return { value: request.ks.map((k) => bound(motionOf({ ...request.setup, k })) ?? null), transfer: [] };
    case "read": {
      const map = readMap(Grid, request.files);
      return { value: map, transfer: [/** @type {ArrayBuffer} */ (map.cells.buffer)] };
    }
    case "scenario": {
      const { width, height } = request;
      const empty = new Grid(width, height, new Uint8Array(width * height));
      try {
        return { value: readScenario(Scenario, empty, request), transfer: [] };
      } finally {
        empty.free();
      }
    }
    case "rung":
      grid = edited(grid, request.news);
      return { value: grid && rungOf(grid, request), transfer: [] };
    case "overlay": {
      grid = edited(grid, request.news);
      const value = {
        field: grid && fieldOf(grid, request),
        narrow: grid && narrowOf(grid, request),
        parts: grid && partsOf(grid, request),
      };
      const { field, narrow, parts } = value;
      const arrays = [field?.values, field?.flow, narrow, parts?.values].filter((array) => !!array);
      return { value, transfer: arrays.map((array) => /** @type {ArrayBuffer} */ (array.buffer)) };
    }
  }
}

/**
 * The conflict between a setup and land on which steps cost differently; undefined if there is none.
 * @param {LaneSetup} setup
 */
function whyNotOnLand(setup) {
  const land = new Grid(1, 1, new Uint8Array(1), { costs: [2] });
  try {
    land.setup({ engine: setup.engine, ...motionOf(setup), ...optionsOf(setup) });
    return undefined;
  } catch (error) {
    return textOf(error);
  } finally {
    land.free();
  }
}

/**
 * The best path; null if there is none.
 * @param {Grid} grid
 * @param {RungWish} wish
 * @returns {Rung | null}
 */
function rungOf(grid, wish) {
  const space = spaceOf(grid, wish);
  const index = space.prepare(wish.engine);
  const planner = index.planner();
  try {
    const { status, distance, length } = planner.find(wish.start, wish.goal);
    return status === "found" ? { cost: distance, length: length ?? distance } : null;
  } catch (error) {
    // An end on a wall; the lane says so.
    if (error instanceof Error && error.name === "MediantError") return null;
    throw error;
  } finally {
    for (const object of [planner, index, space]) object.free();
  }
}

/**
 * The values of the overlay; null where there are none, as with a goal on a wall.
 * @param {Grid} grid
 * @param {OverlayWish} wish
 */
function fieldOf(grid, wish) {
  const { kind, setup } = wish;
  if (!kind) {
    return null;
  }
  if (kind === "clearance") {
    const values = Float32Array.from(grid.clearance());
    const { width, height } = grid;
    return { kind, width, height, placement: "center", values, flow: null, greatest: greatest(values) };
  }
  const space = spaceOf(grid, wish);
  /** @type {Field | null} */
  let field = null;
  try {
    if (!space.isFree(wish.goal)) {
      return null;
    }
    field = space.field(wish.goal);
    const { width, height } = field;
    const values = Float32Array.from(field.distances());
    const flow = kind === "flow" ? field.flow() : null;
    return { kind, width, height, placement: setup.placement, values, flow, greatest: greatest(values) };
  } finally {
    field?.free();
    space.free();
  }
}

/**
 * The greatest finite value.
 * @param {Float32Array} values
 */
function greatest(values) {
  let most = 0;
  for (const value of values) {
    if (value > most && value < Infinity) {
      most = value;
    }
  }
  return most;
}

/**
 * The cells where the agent does not fit; null for a point.
 * @param {Grid} grid
 * @param {OverlayWish} wish
 */
function narrowOf(grid, { radius, setup, narrow }) {
  if (!radius || !narrow) {
    return null;
  }
  const fitted = grid.forDisc(radius, motionOf(setup));
  const cells = fitted.cells();
  fitted.free();
  return cells;
}

/**
 * The vertices that the start reaches, 1, and those that the goal reaches, 2.
 * @param {Grid} grid
 * @param {OverlayWish} wish
 */
function partsOf(grid, { parts, setup, radius, start, goal }) {
  if (!parts) {
    return null;
  }
  // More moves connect no more, and take longer.
  const space = spaceOf(grid, { setup: { ...setup, k: setup.k === 2 ? 2 : 3 }, radius });
  try {
    const fields = [start, goal].map((end) => space.field(end));
    const { width, height } = fields[0];
    const values = new Uint8Array(width * height);
    fields.forEach((field, at) => {
      field.distances().forEach((distance, v) => {
        if (distance < Infinity) values[v] = at + 1;
      });
      field.free();
    });
    return { width, height, placement: setup.placement, values };
  } finally {
    space.free();
  }
}

/** @typedef {Start | (Request & { id: number })} Message */

/** @param {Message} data */
function hear(data) {
  if (data.type === "start") {
    begin(data.kind, data.module);
    postMessage({ type: "ready" });
    return;
  }
  try {
    const { value, transfer } = reply(data);
    postMessage({ type: "result", id: data.id, value }, { transfer });
  } catch (error) {
    const isMistake = error instanceof Error && ["MediantError", "Refusal"].includes(error.name);
    const message = isMistake ? sentence(textOf(error)) : NO_MEMORY;
    postMessage({ type: "refused", id: data.id, message, broken: !isMistake });
  }
}

export function work() {
  addEventListener("message", ({ data }) => hear(data));
}
