// The worth of k on this map: the best path between the ends for each k, one after another, by a helper of
// its own. It waits until no gesture is under way; the latest scene wins.

/** @import { Change, LaneSetup, Model, Rung } from "../../types.js" */
/** @import { Kind } from "../workers.js" */
import { LARGEST_K } from "../model/described.js";
import { LARGEST_K_ON_LAND, MOST_CELLS_OF_LADDER, MOST_CELLS_OF_STEPS } from "../model/land.js";
import { Helper } from "./assistant.js";
import { buffersOf, Feed } from "./feed.js";
import { motionKey } from "./protocol.js";
import { kindFor } from "./stand-in.js";

/** @typedef {number | "any"} K */

/** @param {number} most @returns {number[]} */
const upTo = (most) => Array.from({ length: most - 1 }, (_, index) => index + 2);
/** @type {K[]} */
const ON_LAND = upTo(LARGEST_K_ON_LAND);
/** At any angle first: a k whose path is as short needs no larger one. @type {K[]} */
const ALL = ["any", ...upTo(LARGEST_K)];
/** Sums of roots differ so much by rounding. */
const SAME = 1 + 1e-9;

/** The engine that is exact and quick for these paths. @param {Readonly<LaneSetup>} setup
 *  @param {boolean} onLand */
function engineFor({ k, placement }, onLand) {
  if (onLand) return "astar";
  return k === "any" || placement === "corner" ? "anya" : "jps";
}

export class Ladder {
  /** @type {Map<K, Rung>} */
  rungs = new Map();
  #model;
  #changed;
  #helper = new Helper();
  #feed;
  /** The scene of the rungs, and the k that are known of it. */
  #key = "";
  /** @type {Set<K>} */
  #known = new Set();
  #isBusy = false;
  #isStarted = false;

  /**
   * @param {Model} model
   * @param {() => void} changed
   */
  constructor(model, changed) {
    this.#model = model;
    this.#changed = changed;
    this.#feed = new Feed(model);
  }

  /** @param {Change} change */
  note(change) {
    this.#feed.note(change);
    if (this.#isStarted) {
      this.update();
    }
  }

  /** Whether nothing more will come for the scene of now. */
  get isWhole() {
    return this.#key !== "" && this.#next === undefined;
  }

  get #next() {
    return (this.#model.costs ? ON_LAND : ALL).find((k) => !this.#known.has(k));
  }

  /** Asks for what is not there yet, if it is time. */
  update() {
    this.#isStarted = true;
    const { costs, cells, version, radius, lanes, active, start, goal, gesture } = this.#model;
    const setup = lanes[active];
    if (!setup || cells.length > (costs ? MOST_CELLS_OF_LADDER : MOST_CELLS_OF_STEPS)) {
      this.#forget("");
      return;
    }
    if (gesture) {
      return;
    }
    const motion = motionKey({ ...setup, k: 2 });
    this.#forget(`${version} ${radius} ${motion} ${start} ${goal} ${costs !== null}`);
    const k = this.#next;
    if (k !== undefined && !this.#isBusy) {
      this.#ask(k);
    }
  }

  /** @param {string} key - The scene of now. */
  #forget(key) {
    if (key === this.#key) {
      return;
    }
    this.#key = key;
    this.#known.clear();
    if (this.rungs.size > 0) {
      this.rungs = new Map();
      this.#changed();
    }
  }

  /** Asks this package from now on. @param {Kind} kind */
  #take(kind) {
    if (kind === this.#helper.kind) return;
    this.#helper.stop("");
    this.#helper = new Helper(kind);
    this.#feed.reset();
  }

  /** @param {K} k */
  async #ask(k) {
    const { lanes, active, radius, start, goal, costs } = this.#model;
    const setup = { ...lanes[active], k };
    const engine = engineFor(setup, costs !== null);
    this.#take(kindFor(engine, this.#model));
    const [news, key] = [this.#feed.take(), this.#key];
    const request = /** @type {const} */ ({ type: "rung", news, setup, engine, radius, start, goal });
    this.#isBusy = true;
    try {
      const rung = await this.#helper.ask(request, buffersOf(news));
      if (key === this.#key) {
        this.#add(k, rung);
      }
    } catch {
      // There is no memory for it: the lane says so.
      this.#feed.reset();
      ALL.forEach((k) => this.#known.add(k));
    }
    this.#isBusy = false;
    this.#changed();
    this.update();
  }

  /** @param {K} k @param {Rung | null} rung */
  #add(k, rung) {
    this.#known.add(k);
    /** @type {K[]} */
    let same = [k];
    const least = this.rungs.get("any");
    if (k === "any" && !rung) {
      // Where no way leads at any angle, none leads over any N(k).
      same = ALL;
    } else if (k !== "any" && rung && least && rung.length <= least.length * SAME) {
      same = ALL.slice(ALL.indexOf(k));
    }
    same.forEach((k) => this.#known.add(k));
    if (rung) {
      this.rungs = new Map([...this.rungs, ...same.map((k) => /** @type {const} */ ([k, rung]))]);
    }
  }
}
