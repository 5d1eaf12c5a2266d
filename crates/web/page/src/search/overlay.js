// The values of the overlay: the clearance, the distances to the goal or the directions to it; the cells
// where the agent does not fit; and without a path, the two parts of the map. They are computed in a worker
// of their own; the latest wish wins.

/** @import { Change, LaneSetup, Lanes, Model, Point } from "../../types.js" */
import { Helper } from "./assistant.js";
import { buffersOf, Feed } from "./feed.js";
import { motionKey } from "./protocol.js";

/** A map of more cells leaves much memory behind. */
const LARGE = 2 ** 21;
/** An overlay that took longer than this (ms) is not computed at each stroke, but at most every so often. */
const [QUICK, EVERY] = [25, 150];

/** @param {Model} model */
const isLarge = ({ width, height }) => width * height > LARGE;

/**
 * @typedef {object} Wished
 * @property {string} field
 * @property {string} narrow
 * @property {string} parts
 * @property {"clearance" | "distances" | "flow" | ""} kind
 * @property {Readonly<LaneSetup>} setup
 * @property {number} radius
 * @property {Point} start
 * @property {Point} goal
 */

const NOTHING = { field: "", narrow: "", parts: "" };

export class Overlay {
  /** @type {Lanes["field"]} */
  field = null;
  /** @type {Uint8Array | null} */
  tooNarrow = null;
  /** @type {Lanes["parts"]} */
  parts = null;
  #model;
  #isCut;
  #changed;
  #helper = new Helper();
  #feed;
  /** The wish whose values are shown. */
  #shown = NOTHING;
  #isBusy = false;
  /** The number of maps so far: values of an earlier one are dropped. */
  #maps = 0;
  #isLarge;
  #took = 0;
  #next = 0;
  #timer = 0;

  /**
   * @param {Model} model
   * @param {() => boolean} isCut - Whether the active lane found no path to the goal.
   * @param {() => void} changed
   */
  constructor(model, isCut, changed) {
    this.#model = model;
    this.#isCut = isCut;
    this.#changed = changed;
    this.#feed = new Feed(model);
    this.#isLarge = isLarge(model);
  }

  /** @param {Change} change */
  note(change) {
    this.#feed.note(change);
    if (change.map) {
      this.#maps++;
      this.#clear();
      // The memory of a worker never shrinks.
      if (this.#isLarge) {
        this.#helper.stop("Another map was loaded.");
      }
      this.#isLarge = isLarge(this.#model);
    }
    this.update();
  }

  /**
   * The wish of the scene: each part as a text, so that equal wishes are equal texts.
   * @returns {Wished}
   */
  #wish() {
    const { overlay, lanes, active, radius, version, start, goal } = this.#model;
    const kind = overlay === "clearance" || overlay === "distances" || overlay === "flow" ? overlay : "";
    const setup = lanes[active];
    const motion = setup ? motionKey(setup) : "";
    const agent = `${version} ${radius} ${motion}`;
    return {
      field: setup && kind && (kind === "clearance" ? `${kind} ${version}` : `${kind} ${goal} ${agent}`),
      narrow: setup && radius ? agent : "",
      parts: setup && this.#isCut() ? `${start} ${goal} ${agent}` : "",
      kind,
      setup,
      radius,
      start,
      goal,
    };
  }

  /** Asks for what is not there yet, if it is time. */
  update() {
    const wish = this.#wish();
    if (!wish.field && !wish.narrow && !wish.parts) {
      this.#clear();
      return;
    }
    const { field, narrow, parts } = this.#shown;
    const isShown = wish.field === field && wish.narrow === narrow && wish.parts === parts;
    if (isShown || this.#isBusy) {
      return;
    }
    const wait = this.#took > QUICK && this.#model.gesture ? this.#next - performance.now() : 0;
    clearTimeout(this.#timer);
    if (wait > 0) {
      this.#timer = setTimeout(() => this.update(), wait);
    } else {
      this.#ask(wish);
    }
  }

  /** @param {Wished} wish */
  async #ask(wish) {
    const { kind, setup, radius, start, goal } = wish;
    const [needsField, needsNarrow, needsParts] = /** @type {const} */ (["field", "narrow", "parts"]).map(
      (part) => wish[part] !== this.#shown[part],
    );
    const [news, map] = [this.#feed.take(), this.#maps];
    const began = performance.now();
    this.#isBusy = true;
    const request = {
      type: /** @type {const} */ ("overlay"),
      news,
      setup: { ...setup },
      radius,
      start,
      goal,
      kind: needsField ? kind : /** @type {const} */ (""),
      narrow: needsNarrow,
      parts: needsParts && wish.parts !== "",
    };
    try {
      const { field, narrow, parts } = await this.#helper.ask(request, buffersOf(news));
      if (map === this.#maps) {
        this.field = needsField ? field : this.field;
        this.tooNarrow = needsNarrow ? narrow : this.tooNarrow;
        this.parts = needsParts ? parts : this.parts;
        this.#shown = wish;
      }
    } catch {
      // There is no field of this motion, or no memory for it. Nothing is shown; the lane says why.
      this.#feed.reset();
      this.field = this.tooNarrow = this.parts = null;
      this.#shown = wish;
    }
    this.#isBusy = false;
    this.#took = performance.now() - began;
    this.#next = performance.now() + Math.max(EVERY, 2 * this.#took);
    this.#changed();
    this.update();
  }

  #clear() {
    clearTimeout(this.#timer);
    this.#shown = NOTHING;
    if (this.field || this.tooNarrow || this.parts) {
      this.field = this.tooNarrow = this.parts = null;
      this.#changed();
    }
  }
}
