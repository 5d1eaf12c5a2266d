// A scenario of the MovingAI benchmarks: its queries one by one, with the length that it publishes beside
// ours.

import { titleOf } from "../model/maps.js";
import { changes, eachFrame, h, part, setText } from "./dom.js";
import { iconButton } from "./icons.js";
import { say } from "./message.js";
import { cells, count, kText, more, motionText } from "./words.js";

/** @import { LaneSetup, LaneState, Lanes, Model, Point, Queries } from "../../types.js" */
/** @typedef {import("./setups.js").Setups} Setups */

/** The rules for which the published lengths hold. */
const RULES = /** @type {const} */ ({ k: 3, placement: "center", corners: "never", smooth: "" });
/** Files round lengths: what differs by less, in cells, is the same. */
const ROUNDED = 0.01;

/** The name of a map's file, without what comes before and after. @param {string} name */
const plain = (name) => name.toLowerCase().replace(/\.(map|png|pgm|pbm|yaml|yml)$/, "");

export class ScenarioBar {
  #model;
  #lanes;
  #setups;
  /** @type {Queries | null} */
  #queries = null;
  #at = 0;
  #name = h("b");
  #number = h("input", { type: "number", min: 1, step: 1, inputmode: "numeric", "aria-label": "Query" });
  #of = h("span");
  #said = h("span", { class: "scenario-lengths" });
  #bar;

  /** @param {Model} model @param {Lanes} lanes @param {Setups} setups */
  constructor(model, lanes, setups) {
    this.#model = model;
    this.#lanes = lanes;
    this.#setups = setups;
    this.#number.addEventListener("change", () => this.#go(Math.round(this.#number.valueAsNumber || 1) - 1));
    this.#bar = h(
      "div",
      { class: "scenario", role: "group", "aria-label": "Scenario", hidden: true },
      this.#name,
      iconButton("previous", "Previous query", () => this.step(-1), "B"),
      this.#number,
      this.#of,
      iconButton("next", "Next query", () => this.step(1), "N"),
      this.#said,
      iconButton("close", "Close the scenario", () => this.#close()),
    );
    part("tools", HTMLElement).after(this.#bar);
    const show = eachFrame(() => this.#show());
    changes(model, (detail) => {
      if (detail.map) this.#close();
      show();
    });
    changes(lanes, show);
  }

  /** Opens a scenario of the map that the page shows. Rejects with a sentence if it is of another one.
   *  @param {File} file @param {boolean} cameWithMap */
  async open(file, cameWithMap) {
    const queries = await this.#lanes.readScenario(file);
    const { source, width, height, edited } = this.#model;
    const own = plain("name" in source ? source.name : "");
    const { name, map, fits, lengths } = queries;
    if (!fits || (own !== plain(map) && !cameWithMap)) {
      const shown = `${titleOf(source)}, ${width} × ${height} cells`;
      throw new Error(`${name} is a scenario of ${map}, and this map is ${shown}. Drop both files together.`);
    }
    this.#queries = queries;
    this.#setups.change(RULES);
    this.#go(0);
    const [queriesText, changed] = [`${count(lengths.length)} queries`, edited ? " The map was edited." : ""];
    say(`${name}: ${queriesText}. Its lengths are for k = 3 between centers.${changed}`, { key: "file" });
  }

  /** So many queries on, or back. @param {number} by */
  step(by) {
    if (this.#queries) this.#go(this.#at + by);
  }

  /** @param {number} at */
  #go(at) {
    const { starts, goals, lengths } = /** @type {Queries} */ (this.#queries);
    this.#at = Math.min(lengths.length - 1, Math.max(0, at));
    const endOf = (/** @type {Int32Array} */ ends) =>
      /** @type {Point} */ ([ends[2 * this.#at], ends[2 * this.#at + 1]]);
    this.#model.batch(() => {
      this.#model.beginGesture("end");
      this.#model.moveEnd("start", endOf(starts));
      this.#model.moveEnd("goal", endOf(goals));
      this.#model.endGesture();
    });
    this.#show();
  }

  #close() {
    this.#queries = null;
    this.#show();
  }

  #show() {
    const queries = this.#queries;
    this.#bar.hidden = !queries;
    if (!queries) return;
    const { name, lengths } = queries;
    setText(this.#name, name);
    this.#number.max = String(lengths.length);
    if (document.activeElement !== this.#number) this.#number.value = String(this.#at + 1);
    setText(this.#of, `of ${count(lengths.length)}`);
    const { lanes, active } = this.#model;
    setText(this.#said, lengthsText(lengths[this.#at], this.#lanes.list[active], lanes[active]));
  }
}

/** The published length and ours. @param {number} published @param {LaneState | undefined} lane
 *  @param {Readonly<LaneSetup>} setup */
function lengthsText(published, lane, setup) {
  const theirs = `published: ${Number.isNaN(published) ? "none" : cells(published)}`;
  const answer = lane && !lane.stale && lane.phase === "done" ? lane.answer : null;
  if (!answer) return `${theirs}, here: …`;
  if (answer.status !== "found") return `${theirs}, here: no path`;
  const { length } = answer;
  const isSame = Math.abs(length - published) < ROUNDED;
  const ratio = length / published;
  const apart = isSame ? " (the same)" : Number.isFinite(ratio) ? ` (${more(ratio)})` : "";
  const hasRules = Object.entries(RULES).every(([key, value]) => setup[/** @type {"k"} */ (key)] === value);
  const rules = hasRules ? "" : ` with k = ${kText(setup.k)}, ${motionText(setup)}`;
  return `${theirs}, here${rules}: ${cells(length)}${apart}`;
}
