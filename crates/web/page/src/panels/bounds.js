// What each k is worth: the bounds of the package, asked once for each motion.

import { motionOf } from "../search/protocol.js";
import { compiled } from "../search/remote.js";

/** @typedef {import("../../types").LaneSetup} LaneSetup */
/** @typedef {Map<number | "any", number | null>} ByK */

const KS = /** @type {(number | "any")[]} */ ([2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, "any"]);

/** Dispatches `change` when the package has come. */
export class Bounds extends EventTarget {
  /** @type {Map<string, ByK>} */
  #known = new Map();
  /** @type {((motion: import("../../types").Motion) => number | undefined) | null} */
  #bound = null;

  /** Loads the package. */
  async load() {
    const { default: init, bound } = await import("../../mediant/mediant.js");
    await init({ module_or_path: await compiled() });
    this.#bound = bound;
    this.dispatchEvent(new CustomEvent("change"));
  }

  /** The bound by k; `null` where there is none. Empty until the package has come.
   *  @param {LaneSetup} setup */
  of(setup) {
    if (!this.#bound) return /** @type {ByK} */ (new Map());
    const key = setup.placement === "center" ? setup.corners : setup.gap;
    const known = this.#known.get(key);
    if (known) return known;
    /** @type {ByK} */
    const byK = new Map();
    for (const k of KS) {
      byK.set(k, k === "any" ? 1 : this.#bound(motionOf({ ...setup, k })) ?? null);
    }
    this.#known.set(key, byK);
    return byK;
  }
}
