// What a lane shows of its worker: a `LaneState`, kept up to date.

/** @import { LaneState } from "../../types.js" */
/** @import { OfQuery } from "./engine.js" */

/**
 * @template {OfQuery["type"]} Type
 * @typedef {Extract<OfQuery, { type: Type }>} Message
 */

export class Shown {
  /** @type {LaneState} */
  state = {
    phase: "starting",
    progress: null,
    expanded: 0,
    message: "",
    answer: null,
    stale: true,
    index: null,
  };
  #changed;
  /** The number of the answer. */
  #number = 0;

  /** @param {() => void} changed */
  constructor(changed) {
    this.#changed = changed;
  }

  /**
   * @param {LaneState["phase"]} phase
   * @param {string} [message]
   */
  phase(phase, message = "") {
    const { state } = this;
    [state.phase, state.message] = [phase, message];
    if (phase !== "preparing") {
      state.progress = null;
    }
    this.#changed();
  }

  /**
   * A query takes a while.
   * @param {boolean} isPreparing
   */
  work(isPreparing) {
    this.state.expanded = 0;
    this.phase(isPreparing ? "preparing" : "searching");
  }

  /** @param {Message<"progress">} message */
  progress({ stage, done, total }) {
    this.state.progress = { stage, done, total };
    this.phase("preparing");
  }

  /** @param {Message<"prepared">} message */
  prepared({ index }) {
    this.state.index = index ?? this.state.index;
    if (this.state.phase === "preparing") {
      this.phase("searching");
    }
  }

  /** @param {Message<"searching">} message */
  searching({ expanded }) {
    this.state.expanded = expanded;
    this.phase("searching");
  }

  /**
   * @param {Message<"answer">} message
   * @param {boolean} stale
   */
  answer({ number, answer }, stale) {
    this.#number = number;
    [this.state.answer, this.state.expanded, this.state.stale] = [answer, answer.expanded, stale];
    this.phase("done");
  }

  /**
   * What comes after an answer goes into it; it stays the same object.
   * @param {Message<"timing"> | Message<"reference">} message
   */
  complete(message) {
    const { answer } = this.state;
    if (!answer || message.number !== this.#number) {
      return;
    }
    if (message.type === "timing") {
      answer.ms = message.ms;
      answer.settled = message.settled;
    } else {
      answer.reference = message.reference;
    }
    this.#changed();
  }

  /** @param {string} message */
  fail(message) {
    this.state.answer = null;
    this.phase("failed", message);
  }
}
