// The bound of each k, by the package, which is asked once for each motion.

/** @typedef {import("../../types").LaneSetup} LaneSetup */
/** @typedef {Map<number | "any", number | null>} ByK */

const KS = [2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12];

/** Dispatches `change` when bounds have come. */
export class Bounds extends EventTarget {
  #lanes;
  #failed;
  /** Empty while they are asked for. @type {Map<string, ByK>} */
  #known = new Map();

  /**
   * @param {import("../../types").Lanes} lanes
   * @param {(error: unknown) => void} failed
   */
  constructor(lanes, failed) {
    super();
    this.#lanes = lanes;
    this.#failed = failed;
  }

  /** The bound by k; `null` where there is none. Empty until they have come.
   *  @param {LaneSetup} setup */
  of(setup) {
    const key = setup.placement === "center" ? setup.corners : setup.gap;
    const known = this.#known.get(key);
    if (known) return known;
    /** @type {ByK} */
    const byK = new Map();
    this.#known.set(key, byK);
    this.#ask(setup, byK).catch(this.#failed);
    return byK;
  }

  /** @param {LaneSetup} setup @param {ByK} byK */
  async #ask(setup, byK) {
    // At centers none holds against paths that bend at corners.
    if (setup.placement === "corner") {
      const bounds = await this.#lanes.bounds(setup, KS);
      KS.forEach((k, index) => byK.set(k, bounds[index] ?? null));
    }
    byK.set("any", 1);
    this.dispatchEvent(new CustomEvent("change"));
  }
}
