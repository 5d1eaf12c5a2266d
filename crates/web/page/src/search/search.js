// A lane's query, in slices: the search with its steps, the time of one query, and the true optimum beside
// it. Each is a generator that gives way after a few milliseconds, so that a newer query is never kept
// waiting.

/** @import { LaneAnswer, Point } from "../../types.js" */
/** @import { Answer, Planner, Trace, Waypoints, Wishes } from "../../mediant/mediant.js" */
/** @import { Ask, FromLane } from "./protocol.js" */
/** @import { Session } from "./session.js" */
import { bendsAtCorners } from "../model/setups.js";
import { mediant } from "./package.js";
import { sentence, textOf } from "./protocol.js";

/** @typedef {(message: FromLane, transfer?: Transferable[]) => void} Say */
/** @typedef {{ start: Point, goal: Point, wishes?: Wishes }} Question */

/** Milliseconds of work between two looks at the messages. */
const SLICE = 10;
/** The most steps that are kept: 32 MB. */
const MOST_STEPS = 8_000_000;
/** A search that took longer (ms) is not run a second time for its time alone. */
const MOST_AGAIN = 3000;
/** A search that took less (ms) is repeated for its time. */
const SHORT = 5;
/** The most work beside a gesture, in ms. */
const LITTLE = 20;

/**
 * Runs a search to its end. Returns the answer, and the milliseconds of the search alone.
 * @param {Planner} planner
 * @param {Question} question
 * @param {{ pace: number }} measured - The pace of the last search; written, too.
 * @param {Trace} [trace]
 * @param {() => void} [between] - Called after each slice.
 * @returns {Generator<void, { answer: Answer, ms: number }>}
 */
export function* sliced(planner, { start, goal, wishes }, measured, trace, between) {
  let began = performance.now();
  planner.begin(start, goal, wishes);
  let ms = performance.now() - began;
  for (;;) {
    const expansions = Math.max(100, Math.round(measured.pace * SLICE));
    began = performance.now();
    const answer = planner.step(expansions, trace);
    const spent = performance.now() - began;
    ms += spent;
    between?.();
    if (answer) {
      return { answer, ms };
    }
    measured.pace = Math.min(measured.pace * 4, expansions / Math.max(spent, 0.1));
    yield;
  }
}

/** The steps of a search, taken out of the package's memory as they come. */
class Recording {
  trace = new mediant.Trace();
  expanded = 0;
  generated = 0;
  #length = 0;
  /** @type {Uint32Array[] | null} */
  #parts;

  /** @param {boolean} keeps */
  constructor(keeps) {
    this.#parts = keeps ? [] : null;
  }

  take() {
    const { trace } = this;
    this.expanded += trace.expanded;
    this.generated += trace.generated;
    if (this.#parts) {
      const steps = trace.steps();
      this.#parts.push(steps);
      this.#length += steps.length;
      if (this.#length > MOST_STEPS) {
        this.#parts = null;
      }
    }
    trace.clear();
  }

  /** All steps, or null if they were too many. */
  steps() {
    const parts = this.#parts;
    if (!parts || parts.length === 1) {
      return parts?.[0] ?? null;
    }
    const all = new Uint32Array(this.#length);
    let at = 0;
    for (const part of parts) {
      all.set(part, at);
      at += part.length;
    }
    return all;
  }
}

/**
 * Answers a query.
 * @param {Session} session
 * @param {Ask} ask
 * @param {Say} say
 * @returns {Generator<void, LaneAnswer>}
 */
export function* search(session, ask, say) {
  const planner = /** @type {Planner} */ (session.planner);
  const recording = new Recording(ask.record);
  let told = performance.now();
  const between = () => {
    recording.take();
    if (performance.now() - told > 100) {
      told = performance.now();
      say({ type: "searching", number: ask.number, expanded: recording.expanded });
    }
  };
  const answer = emptyAnswer(session, ask);
  try {
    const found = yield* sliced(planner, questionOf(ask), session, recording.trace, between);
    const { status, path, distance, cost, length } = found.answer;
    answer.status = status === "stopped" ? "unreachable" : status;
    answer.path = path ?? answer.path;
    const least = found.answer.anyAngleLowerBound;
    answer.bound = least ? Math.max(distance / least, 1) : null;
    answer.length = length ?? distance;
    answer.cost = cost ?? null;
    answer.expanded = recording.expanded;
    answer.generated = recording.generated;
    answer.steps = recording.steps();
    answer.ms = repeated(planner, ask, found.ms);
    answer.settled = ask.hurry || answer.ms >= MOST_AGAIN;
  } catch (error) {
    answer.error = refusal(error, ask);
  } finally {
    recording.trace.free();
  }
  return answer;
}

/**
 * An answer that says invalid.
 * @param {Session} session
 * @param {Ask} ask
 * @returns {LaneAnswer}
 */
function emptyAnswer(session, { start, goal, setup }) {
  const { index, grid } = session;
  return {
    start,
    goal,
    status: "invalid",
    path: new Int32Array(0),
    length: Infinity,
    cost: null,
    expanded: 0,
    generated: 0,
    ms: 0,
    settled: true,
    steps: null,
    reference: null,
    error: null,
    guarantee: index?.guarantee ?? "",
    optimal: index?.optimal ?? false,
    bound: null,
    verticesPerRow: (grid?.width ?? 0) + (bendsAtCorners(setup) ? 1 : 0),
  };
}

/**
 * The library's error against the query. Any other error is not for the user: it is thrown on.
 * @param {unknown} error
 * @param {Ask} ask
 */
function refusal(error, ask) {
  if (error instanceof Error && error.name === "MediantError" && "code" in error && error.code !== "memory") {
    const code = String(error.code);
    return { code, message: tooNarrow(code, ask) || sentence(textOf(error)) };
  }
  throw error;
}

/**
 * The library knows the map for the agent only, on which a place that is too narrow is blocked. The user sees
 * a free cell there.
 * @param {string} code
 * @param {Ask} ask
 */
function tooNarrow(code, { start, goal, radius }) {
  const place = { "start-blocked": start, "goal-blocked": goal }[code];
  if (!radius || !place) {
    return "";
  }
  const end = place === start ? "start" : "goal";
  return (
    `An agent of radius ${radius} does not fit at the ${end} (${place.join(", ")}): ` +
    `move the ${end}, or make the agent smaller.`
  );
}

/**
 * @param {{ start: Point, goal: Point, nearest: boolean }} ask
 * @returns {Question}
 */
export function questionOf({ start, goal, nearest }) {
  return { start, goal, wishes: nearest ? { nearest } : undefined };
}

/**
 * The time of one query, from repetitions if it is short: the clock counts tenths of a millisecond, and the
 * recording takes time, too. The best of a few counts, as the browser makes code faster while it runs.
 * @param {Planner} planner
 * @param {Ask} ask
 * @param {number} first - The time of the first.
 */
function repeated(planner, ask, first) {
  if (first >= (ask.hurry ? 1 : SHORT)) {
    return first;
  }
  const { start, goal, wishes } = questionOf(ask);
  let best = Infinity;
  for (let rounds = ask.hurry ? 1 : 3; rounds > 0; rounds--) {
    const began = performance.now();
    let [spent, times] = [0, 0];
    for (let more = 1; spent < (ask.hurry ? 0.5 : 1); more *= 2) {
      for (let i = 0; i < more; i++) {
        planner.find(start, goal, wishes);
      }
      times += more;
      spent = performance.now() - began;
    }
    best = Math.min(best, spent / times);
  }
  return best;
}

/**
 * The time of one query that takes long, without a recording. The first runs include the browser's compiler:
 * it is asked again until it gets no shorter, and three times at least if it is short.
 * @param {Session} session
 * @param {Ask} ask
 * @param {number} first - The time with a recording.
 * @returns {Generator<void, number>}
 */
function* warmed(session, ask, first) {
  const planner = /** @type {Planner} */ (session.planner);
  for (let [best, runs] = [first, 1]; ; runs++) {
    const { ms } = yield* sliced(planner, questionOf(ask), session);
    const isFaster = ms < 0.8 * best;
    best = Math.min(best, ms);
    if (!isFaster && (runs >= 3 || ms > 10 * SHORT)) {
      return best;
    }
  }
}

/**
 * Completes an answer: tells its time without a recording, and the true optimum.
 * @param {Session} session
 * @param {Ask} ask
 * @param {LaneAnswer} answer
 * @param {boolean} timed - Whether the answer's time is good.
 * @param {Say} say
 * @returns {Generator<void, void>}
 */
export function* refine(session, ask, answer, timed, say) {
  const { number } = ask;
  if (answer.status === "invalid") {
    return;
  }
  const planner = /** @type {Planner} */ (session.planner);
  if (!timed && !ask.hurry && answer.ms < MOST_AGAIN) {
    const ms = yield* warmed(session, ask, answer.ms);
    answer.ms = repeated(planner, ask, ms);
    say({ type: "timing", number, ms: answer.ms, settled: answer.ms >= SHORT });
    yield;
  }
  if (answer.path.length && !(ask.hurry && session.judgment > LITTLE)) {
    const best = yield* optimum(session, ask, answer);
    const what = answer.cost === null ? "any" : "k";
    say({ type: "reference", number, reference: { ...best, what } });
    yield;
  }
  if (!ask.hurry && answer.ms < SHORT) {
    // By now the browser may have made the code faster.
    const ms = Math.min(answer.ms, repeated(planner, ask, answer.ms));
    say({ type: "timing", number, ms, settled: true });
  }
}

/**
 * Whether the time of an answer is that of a query alone.
 * @param {Ask} ask
 * @param {LaneAnswer} answer
 */
export const isTimed = (ask, answer) => !ask.hurry && answer.ms < SHORT;

/**
 * A shortest path between the ends of the answer's path, and its length.
 * @param {Session} session
 * @param {Ask} ask
 * @param {LaneAnswer} answer
 * @returns {Generator<void, { length: number, path: Waypoints }>}
 */
function* optimum(session, ask, { path, length, cost, guarantee }) {
  if (cost !== null) {
    // Every engine that knows costs finds the cheapest path.
    return { length: cost, path };
  }
  if (guarantee === "optimal(any)") {
    return { length, path };
  }
  const planner = session.judge(ask);
  yield;
  const start = /** @type {Point} */ ([path[0], path[1]]);
  const goal = /** @type {Point} */ ([path[path.length - 2], path[path.length - 1]]);
  const { answer, ms } = yield* sliced(planner, { start, goal }, session.judged);
  session.judged.ms = ms;
  return { length: answer.distance, path: answer.path ?? new Int32Array(0) };
}
