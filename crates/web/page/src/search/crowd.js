// The agents' side of a lane's worker: which of their paths still hold, and new ones for those whose path
// does not.

/** @import { Point } from "../../types.js" */
/** @import { Planner, Space, Waypoints } from "../../mediant/mediant.js" */
/** @import { Errand, ErrandDone, Walk } from "./protocol.js" */
/** @import { Say } from "./search.js" */
/** @import { Session } from "./session.js" */
import { Random } from "../model/generate/random.js";
import { questionOf, sliced } from "./search.js";

/** Milliseconds of work between two looks at the messages. */
const SLICE = 8;
/** The number of places tried at random, and the reach of the search around a place, in cells. */
const TRIES = 200;
const REACH = 3;

/**
 * Does the errands, and tells of those that are done after each slice. A change of the map ends it: then the
 * agents ask again.
 * @param {Session} session
 * @param {Walk} walk
 * @param {Say} say
 * @returns {Generator<void, void>}
 */
export function* walk(session, { id, goal, nearest, seed, errands }, say) {
  const { serial } = session;
  const random = new Random(seed);
  const measured = { pace: session.pace };
  /** @type {ErrandDone[]} */
  let done = [];
  let began = performance.now();
  const tell = (over = false) => {
    const buffers = done.flatMap(({ path }) => (path ? [/** @type {ArrayBuffer} */ (path.buffer)] : []));
    say({ type: "walked", id, done, ms: performance.now() - began, over }, buffers);
    done = [];
  };
  for (const errand of errands) {
    if (session.serial !== serial || !session.space) {
      break;
    }
    const one = oneErrand(session, errand, { goal, nearest, random, measured });
    for (let step = one.next(); ; step = one.next()) {
      if (step.done) {
        done.push({ agent: errand.agent, ...step.value });
        break;
      }
      tell();
      yield;
      if (session.serial !== serial) {
        break;
      }
      began = performance.now();
    }
    if (performance.now() - began > SLICE) {
      tell();
      yield;
      began = performance.now();
    }
  }
  tell(true);
}

/**
 * @param {Session} session
 * @param {Errand} errand
 * @param {{ goal: Point, nearest: boolean, random: Random, measured: { pace: number } }} how
 * @returns {Generator<void, { kept: boolean, path: Waypoints | null }>}
 */
function* oneErrand(session, { path, places }, { goal, nearest, random, measured }) {
  const [space, planner] = [session.space, session.walker];
  if (!space || !planner) {
    return { kept: false, path: null };
  }
  if (path && space.holds(path)) {
    return { kept: true, path: null };
  }
  const start = placeToStart(space, places, { goal, nearest, random });
  if (!start) {
    return { kept: false, path: null };
  }
  const { answer } = yield* sliced(planner, questionOf({ start, goal, nearest }), measured);
  return { kept: false, path: answer.path ?? null };
}

/**
 * A place from which an agent arrives; null if there is none. With `nearest` any free place will do, if the
 * goal cannot be reached.
 * @param {Space} space
 * @param {number[]} places
 * @param {{ goal: Point, nearest: boolean, random: Random }} how
 * @returns {Point | null}
 */
function placeToStart(space, places, { goal, nearest, random }) {
  const hasGoal = space.isFree(goal);
  if (!hasGoal && !nearest) {
    return null;
  }
  /** @param {Point} at */
  const leads = (at) => space.isFree(at) && (!hasGoal || space.connected(at, goal));
  if (!places.length) {
    return randomPlace(space, leads, random);
  }
  // Without a way to the goal, a wish for the nearest place still leads somewhere.
  const isFree = (/** @type {Point} */ at) => space.isFree(at);
  for (const fits of nearest ? [leads, isFree] : [leads]) {
    for (let i = 0; i < places.length; i += 2) {
      /** @type {Point} */
      const at = [places[i], places[i + 1]];
      if (fits(at)) {
        return at;
      }
    }
    const around = placeAround(places, fits);
    if (around) {
      return around;
    }
  }
  return null;
}

/**
 * @param {Space} space
 * @param {(at: Point) => boolean} fits
 * @param {Random} random
 * @returns {Point | null}
 */
function randomPlace(space, fits, random) {
  const { width, height } = vertices(space);
  for (let i = 0; i < TRIES; i++) {
    /** @type {Point} */
    const at = [random.below(width), random.below(height)];
    if (fits(at)) {
      return at;
    }
  }
  return null;
}

/**
 * The nearest place that fits, around the first one.
 * @param {number[]} places
 * @param {(at: Point) => boolean} fits
 * @returns {Point | null}
 */
function placeAround([x, y], fits) {
  /** @type {{ at: Point, far: number }[]} */
  const around = [];
  for (let dy = -REACH; dy <= REACH; dy++) {
    for (let dx = -REACH; dx <= REACH; dx++) {
      around.push({ at: [x + dx, y + dy], far: dx * dx + dy * dy });
    }
  }
  around.sort((a, b) => a.far - b.far);
  return around.find(({ at }) => fits(at))?.at ?? null;
}

/**
 * The number of vertices in a row, and the number of rows.
 * @param {Space} space
 */
function vertices(space) {
  const grid = space.grid;
  const more = space.motion.placement === "corner" ? 1 : 0;
  const size = { width: grid.width + more, height: grid.height + more };
  grid.free();
  return size;
}
