// The first sight moves once by itself: k goes from 2 to ∞ through the steps that change the path, and comes
// to rest. Any input stops it. Then a short call says what can be dragged.

import { kAt } from "../model/steps.js";
import { changes } from "./dom.js";
import { hush, unhush } from "./message.js";
import { FIRST_SIGHT } from "./presets.js";
import { cells } from "./words.js";

/** @import { Lanes, Model, Stage } from "../../types.js" */
/** @typedef {import("./setups.js").Setups} Setups */

/** The key under which the browser keeps that there was a visit. */
const KEY = "visited";
/** The time for the first k, for all steps after it, and for ∞, in ms. */
const [FIRST, STEPS, LAST] = [600, 2600, 1100];
/** The longest time for one step, in ms. */
const SLOWEST = 480;
const INPUTS = ["pointerdown", "keydown", "wheel", "touchstart", "dragenter"];

/** Whether nothing is stored here, and no link was followed. */
export function isFirstVisit() {
  if (location.hash.length > 1) return false;
  try {
    return !localStorage.getItem(KEY) && !localStorage.getItem("theme");
  } catch {
    // Without storage each visit is the first one.
    return true;
  }
}

/** Whether the page may move by itself. */
export const mayMove = () => !matchMedia("(prefers-reduced-motion: reduce)").matches;

/** The lane with which the page begins. @param {boolean} moves */
export const firstLane = (moves) => ({ ...FIRST_SIGHT, k: moves ? 2 : FIRST_SIGHT.k });

/**
 * Moves k, if it may, and calls to drag.
 * @param {{ model: Model, lanes: Lanes, setups: Setups, stage: Stage, moves: boolean,
 *   painted: Promise<unknown> }} parts
 */
export async function startTour({ moves, painted, ...parts }) {
  remember();
  const tour = new Tour(parts);
  await painted;
  if (moves ? await tour.run() : tour.skip()) startCalls(parts.model, parts.stage);
}

function remember() {
  try {
    localStorage.setItem(KEY, "1");
  } catch {
    // Without storage the page moves at each visit.
  }
}

class Tour {
  #parts;
  #isOver = false;
  /** Whether a change of the model is the tour's own. */
  #isMine = false;
  #stop = () => this.#end();

  /** Any input from now on is the end. @param {{ model: Model, lanes: Lanes, setups: Setups, stage: Stage }}
   *  parts */
  constructor(parts) {
    this.#parts = parts;
    for (const input of INPUTS) addEventListener(input, this.#stop, { capture: true, passive: true });
    changes(parts.model, () => this.#isMine || this.#end());
  }

  /** Moves nothing. Returns whether nobody did anything before. */
  skip() {
    const wasFree = !this.#isOver;
    this.#end();
    return wasFree;
  }

  /** Returns whether nobody stopped it. */
  async run() {
    const { lanes, setups, stage } = this.#parts;
    if (this.#isOver) return false;
    hush();
    stage.glides = true;
    await Promise.all([pause(FIRST), this.#until(() => lanes.isLadderWhole)]);
    const places = setups.steps.map(([first]) => first).slice(1);
    const [from, to] = [kAt(2), "any"].map(
      (k) => lanes.ladder.get(/** @type {2 | "any"} */ (k))?.length ?? 0,
    );
    for (const place of places) {
      await this.#go(kAt(place), Math.min(SLOWEST, STEPS / places.length));
    }
    await this.#go(FIRST_SIGHT.k, LAST);
    await this.#until(() => !lanes.list[0].stale);
    const wasFree = !this.#isOver;
    this.#end(
      `k went from 2 to ∞: the path went from ${cells(from)} to ${cells(to)} cells. ` +
        `Now k = ${FIRST_SIGHT.k}. `,
    );
    return wasFree;
  }

  /** After a time, and when the path is there, the next k. @param {number | "any"} k @param {number} ms */
  async #go(k, ms) {
    if (this.#isOver) return;
    await Promise.all([pause(ms), this.#until(() => !this.#parts.lanes.list[0].stale)]);
    if (this.#isOver) return;
    this.#isMine = true;
    this.#parts.setups.change({ k }, true);
    this.#isMine = false;
  }

  /** Waits until it holds, or the tour is over. @param {() => boolean} holds */
  async #until(holds) {
    while (!this.#isOver && !holds()) await pause(20);
  }

  /** @param {string} [said] */
  #end(said = "") {
    if (this.#isOver) return;
    this.#isOver = true;
    this.#parts.stage.glides = false;
    for (const input of INPUTS) removeEventListener(input, this.#stop, { capture: true });
    unhush(said);
  }
}

/** Shows what can be dragged, until somebody changes the scene. @param {Model} model @param {Stage} stage */
function startCalls(model, stage) {
  stage.calls = document.body.classList.toggle("calls", true);
  changes(model, () => {
    stage.calls = document.body.classList.toggle("calls", false);
  });
}

/** @param {number} ms */
const pause = (ms) => new Promise((/** @type {(value?: unknown) => void} */ done) => setTimeout(done, ms));
