// The worker of a lane. It does one slice of work at a time, and looks at its messages in between: a newer
// query takes the place of the one under way. Queries come first; then the agents, then what was ordered,
// then the time and the optimum of the last answer.

/** @import { LaneAnswer } from "../../types.js" */
/** @import { Ask, FromLane, ToLane } from "./protocol.js" */
/** @import { Index } from "../../mediant/mediant.js" */
import { walk } from "./crowd.js";
import { write } from "./output.js";
import { begin } from "./package.js";
import { BROKEN, sentence, textOf } from "./protocol.js";
import { isTimed, refine, search } from "./search.js";
import { Session } from "./session.js";

/** @typedef {Generator<void, void>} Job */

const session = new Session();
/** @type {WebAssembly.Memory | undefined} */
let memory;
/** The query that was asked last. @type {Ask | null} */
let ask = null;
/** The last answer, with its query. @type {{ ask: Ask, answer: LaneAnswer, timed: boolean } | null} */
let last = null;

/** @type {Job | null} */
let query = null;
/** @type {Job | null} */
let refining = null;
/** @type {Job[]} */
const walks = [];
/** @type {Job[]} */
const orders = [];

const channel = new MessageChannel();
let isAwake = false;
let turns = 0;

/**
 * @param {FromLane} message
 * @param {Transferable[]} [transfer]
 */
function say(message, transfer = []) {
  postMessage(message, { transfer });
}

/**
 * Answers a query: brings the index up to date, which cannot be paused, and searches.
 * @param {Ask} ask
 * @returns {Job}
 */
function* answerTo(ask) {
  const { number } = ask;
  if (session.isBehind(ask)) {
    prepare(ask);
  }
  const answer = yield* search(session, ask, say);
  last = { ask, answer, timed: isTimed(ask, answer) };
  const steps = answer.steps ? [/** @type {ArrayBuffer} */ (answer.steps.buffer)] : [];
  say({ type: "answer", number, answer, memory: memory?.buffer.byteLength ?? 0 }, steps);
  refining = refine(session, ask, answer, last.timed, say);
}

/** @param {Index} index */
const factsOf = ({ memoryBytes, origin, levels, searchedBy }) => ({
  bytes: memoryBytes,
  origin,
  levels,
  searchedBy,
});

/** @param {Ask} ask */
function prepare(ask) {
  const { number } = ask;
  say({ type: "preparing", number });
  const began = performance.now();
  let told = began;
  const ms = session.sync(ask, (stage, done, total) => {
    const now = performance.now();
    if (now - told > 50) {
      told = now;
      say({ type: "progress", number, stage, done, total });
    }
  });
  const { index } = session;
  const { wasEdit } = session;
  const known = index && ms !== null ? { ms, ...factsOf(index) } : null;
  say({ type: "prepared", number, took: performance.now() - began, wasEdit, index: known });
}

/** Stops the query, and what follows the last one. */
function drop() {
  query?.return();
  refining?.return();
  query = refining = null;
}

/** Does one slice of work. */
function turn() {
  turns++;
  // Agents get every fourth slice beside a long search.
  const first = turns % 4 ? query : walks[0];
  const job = first ?? query ?? walks[0] ?? orders[0] ?? refining;
  if (!job) {
    isAwake = false;
    return;
  }
  try {
    if (job.next().done) {
      finished(job);
    }
  } catch (error) {
    finished(job);
    failed(error);
  }
  channel.port2.postMessage(null);
}

/** @param {Job} job */
function finished(job) {
  for (const jobs of [walks, orders]) {
    if (jobs[0] === job) {
      jobs.shift();
    }
  }
  query = query === job ? null : query;
  refining = refining === job ? null : refining;
}

/** @param {unknown} error */
function failed(error) {
  const isMistake = error instanceof Error && error.name === "MediantError";
  const hasNoMemory = isMistake && "code" in error && error.code === "memory";
  const size = memory?.buffer.byteLength ?? 0;
  say({
    type: "failed",
    number: ask?.number ?? 0,
    message: isMistake && !hasNoMemory ? sentence(textOf(error)) : brokenText(error, size),
    broken: !isMistake || hasNoMemory,
  });
}

/**
 * @param {unknown} error
 * @param {number} size - Of the memory, in bytes.
 */
function brokenText(error, size) {
  const isFull = size > 2 ** 30 || error instanceof RangeError || /memory/i.test(textOf(error));
  return isFull
    ? "The engine ran out of memory on this map. Take a smaller map or k, or another engine."
    : BROKEN;
}

function wake() {
  if (!isAwake) {
    isAwake = true;
    turn();
  }
}

/** @param {ToLane} data */
function hear(data) {
  switch (data.type) {
    case "start": {
      const begun = begin(data.kind, data.module);
      memory = begun.memory;
      say({ type: "ready", engines: begun.engines });
      break;
    }
    case "ask":
      drop();
      session.note(data.news);
      ask = data;
      query = answerTo(data);
      break;
    case "cancel":
      drop();
      break;
    case "refine":
      if (last && last.ask === ask && !query) {
        refining = refine(session, { ...last.ask, hurry: false }, last.answer, last.timed, say);
      }
      break;
    case "walk":
      walks.push(walk(session, data, say));
      break;
    default:
      if (ask) {
        orders.push(write(session, ask, data, say));
      } else {
        say({ type: "refused", id: data.id, message: "The engine has no answer yet. Wait for it." });
      }
  }
  wake();
}

export function work() {
  channel.port1.onmessage = turn;
  addEventListener("message", ({ data }) => hear(data));
}
