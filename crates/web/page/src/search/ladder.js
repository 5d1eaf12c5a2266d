// The worth of k on land: the cheapest path between the ends for each k, one after another, by a helper of
// its own. It waits until no gesture is under way; the latest scene wins.

/** @import { Change, Model } from "../../types.js" */
import { LARGEST_K_ON_LAND, MOST_CELLS_OF_LADDER } from "../model/land.js";
import { Helper } from "./assistant.js";
import { buffersOf, Feed } from "./feed.js";
import { motionKey } from "./protocol.js";

const KS = Array.from({ length: LARGEST_K_ON_LAND - 1 }, (_, index) => index + 2);

export class Ladder {
  /** @type {Map<number, { cost: number, length: number }>} */
  rungs = new Map();
  #model;
  #changed;
  #helper = new Helper();
  #feed;
  /** The scene of the rungs, and the k that are known of it. */
  #key = "";
  /** @type {Set<number>} */
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

  /** Asks for what is not there yet, if it is time. */
  update() {
    this.#isStarted = true;
    const { costs, cells, version, radius, lanes, active, start, goal, gesture } = this.#model;
    const setup = lanes[active];
    if (costs === null || !setup || cells.length > MOST_CELLS_OF_LADDER) {
      this.#forget("");
      return;
    }
    if (gesture) {
      return;
    }
    const motion = motionKey({ ...setup, k: 2 });
    this.#forget(`${version} ${radius} ${motion} ${start} ${goal}`);
    const k = KS.find((k) => !this.#known.has(k));
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

  /** @param {number} k */
  async #ask(k) {
    const { lanes, active, radius, start, goal } = this.#model;
    const [news, key] = [this.#feed.take(), this.#key];
    const setup = { ...lanes[active], k };
    const request = /** @type {const} */ ({ type: "cost", news, setup, radius, start, goal });
    this.#isBusy = true;
    try {
      const rung = await this.#helper.ask(request, buffersOf(news));
      if (key === this.#key) {
        this.#known.add(k);
        if (rung) {
          this.rungs = new Map([...this.rungs, [k, rung]]);
        }
      }
    } catch {
      // There is no memory for it: the lane says so.
      this.#feed.reset();
      KS.forEach((k) => this.#known.add(k));
    }
    this.#isBusy = false;
    this.#changed();
    this.update();
  }
}
