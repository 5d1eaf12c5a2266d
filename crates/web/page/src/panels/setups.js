// Changes the setup of the active lane, for all panels. It remembers what was wished for: an engine that made
// way for a k is back as soon as the k allows it.

import { kAt, placeOf, stepped, stepsFor } from "../model/steps.js";
import { changes } from "./dom.js";
import { mended } from "./mend.js";
import { dismiss, say } from "./message.js";

/** @typedef {import("../../types").LaneSetup} LaneSetup */

export class Setups {
  /** The setup wished for, and the mended one, by lane. @type {Map<number, [LaneSetup, LaneSetup]>} */
  #wishes = new Map();
  #model;
  #lanes;
  #isMine = false;

  /** @param {import("../../types").Model} model @param {import("../../types").Lanes} lanes */
  constructor(model, lanes) {
    this.#model = model;
    this.#lanes = lanes;
    // The message about a mended setup holds until somebody else changes the lanes.
    changes(model, ({ lanes }) => lanes && !this.#isMine && dismiss("mend"));
  }

  /** Changes the active lane. `quietly`: without a word about what else that changed.
   *  @param {Partial<LaneSetup>} change @param {boolean} [quietly] */
  change(change, quietly = false) {
    const index = this.#model.active;
    const now = this.#model.lanes[index];
    if (!now) return;
    const [wish, made] = this.#wishes.get(index) ?? [now, now];
    const wanted = same(made, now) ? wish : { ...now };
    const onLand = this.#model.costs !== null;
    const { setup, said } = mended(wanted, change, this.#lanes.engines, onLand);
    const remembered = change.engine === undefined ? { ...wanted, ...change } : setup;
    this.#wishes.set(index, [remembered, setup]);
    this.#isMine = true;
    this.#model.setLane(index, setup);
    this.#isMine = false;
    if (said && !quietly) say(said, { key: "mend" });
    else dismiss("mend");
  }

  /** The steps of the knob, for the active lane. */
  get steps() {
    const setup = this.#model.lanes[this.#model.active];
    const engine = this.#lanes.engines.find(({ name }) => name === setup.engine);
    return stepsFor(setup, engine?.guarantee, this.#lanes.ladder);
  }

  /** One step of k up or down. @param {1 | -1} by */
  stepK(by) {
    const { k } = this.#model.lanes[this.#model.active];
    this.change({ k: kAt(stepped(this.steps, placeOf(k), by)) });
  }
}

/** @param {LaneSetup} a @param {Readonly<LaneSetup>} b */
function same(a, b) {
  return (
    a.engine === b.engine &&
    a.k === b.k &&
    a.placement === b.placement &&
    a.corners === b.corners &&
    a.gap === b.gap &&
    a.smooth === b.smooth
  );
}
