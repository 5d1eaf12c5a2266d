// A lane's worker, as the page holds it: started, replaced, asked. What it says of queries goes to the
// lane.

/** @import { Change, Model } from "../../types.js" */
/** @import { EngineInfo } from "../../mediant/mediant.js" */
/** @import { FromLane, ToLane, Walk } from "./protocol.js" */
import { buffersOf, Feed } from "./feed.js";
import { Orders } from "./orders.js";
import { Remote } from "./remote.js";

/** @typedef {Extract<FromLane, { type: "walked" }>} Walked */
/** @typedef {Exclude<FromLane, { type: "ready" | "walked" | "result" | "refused" }>} OfQuery */
/** @typedef {Omit<Extract<ToLane, { type: "ask" }>, "type" | "news">} Question */

/**
 * Who is told of the worker.
 * @typedef {object} Owner
 * @property {(engines: EngineInfo[]) => void} readied
 * @property {(message: OfQuery) => void} heard
 * @property {(why: string, wasReady: boolean) => void} died
 */

/** A worker that was started ahead. @type {Remote<FromLane> | null} */
let spare = null;

/** Starts the worker of the first lane while the page is still put together. */
export function warm() {
  spare ??= new Remote("lane");
}

export class Engine {
  isReady = false;
  /** Whether the worker could not be loaded. */
  isDead = false;
  #owner;
  #feed;
  #orders = new Orders();
  /** @type {Remote<FromLane>} */
  #remote;
  /** The agents' errands, and who hears what became of them. */
  /** @type {{ walk: Walk, heard: (message: Walked | null) => void, isSent: boolean } | null} */
  #walk = null;

  /**
   * @param {Model} model
   * @param {Owner} owner
   */
  constructor(model, owner) {
    this.#owner = owner;
    this.#feed = new Feed(model);
    this.#remote = this.#start();
  }

  #start() {
    /** @type {Remote<FromLane>} */
    const remote = spare ?? new Remote("lane");
    spare = null;
    remote.listen(
      (message) => this.#hear(message),
      (why) => this.#died(why),
    );
    return remote;
  }

  /** @param {string} why */
  #died(why) {
    const wasReady = this.isReady;
    this.isReady = false;
    this.isDead = true;
    this.#forget("The engine stopped.");
    this.#owner.died(why, wasReady);
  }

  /** Another worker takes the place of one that is broken, or that cannot be stopped otherwise. */
  replace() {
    this.close("The engine was stopped.");
    this.isReady = this.isDead = false;
    this.#feed.reset();
    this.#remote = this.#start();
  }

  /** @param {string} why - What is said to those who wait for something. */
  close(why) {
    this.#remote.close();
    this.#forget(why);
  }

  /** @param {string} why */
  #forget(why) {
    this.#orders.refuse(why);
    this.#endWalk()?.heard(null);
  }

  #endWalk() {
    const walk = this.#walk;
    this.#walk = null;
    return walk;
  }

  /** @param {Change} change */
  note(change) {
    this.#feed.note(change);
  }

  /**
   * Asks a query, and tells what has changed on the map.
   * @param {Question} question
   */
  ask(question) {
    const news = this.#feed.take();
    this.#remote.post({ type: "ask", ...question, news }, buffersOf(news));
  }

  /** @param {"cancel" | "refine"} type */
  tell(type) {
    this.#remote.post({ type });
  }

  /**
   * @param {{ type: "trace" } | { type: "picture", format: "png" | "svg", overlay: string }} order
   * @returns {Promise<Blob>}
   */
  order(order) {
    return this.#orders.place((id) => this.#remote.post(/** @type {ToLane} */ ({ ...order, id })));
  }

  /**
   * Takes agents' errands, for `sendWalk`. `heard` is told what is done, and null if the rest will not be.
   * @param {Walk} walk
   * @param {(message: Walked | null) => void} heard
   */
  takeWalk(walk, heard) {
    this.#endWalk()?.heard(null);
    this.#walk = { walk, heard, isSent: false };
  }

  /** Sends the errands that wait: after all that the worker must know before. */
  sendWalk() {
    if (this.#walk && !this.#walk.isSent) {
      this.#walk.isSent = true;
      this.#remote.post(this.#walk.walk);
    }
  }

  /** @param {FromLane} message */
  #hear(message) {
    switch (message.type) {
      case "ready":
        this.isReady = true;
        this.#owner.readied(message.engines);
        break;
      case "walked":
        if (this.#walk?.walk.id === message.id) {
          (message.over ? this.#endWalk() : this.#walk)?.heard(message);
        }
        break;
      case "result":
      case "refused":
        this.#orders.hear(message);
        break;
      default:
        this.#owner.heard(message);
    }
  }
}
