// The race: a table of the lanes, with what each engine answered.

import { MOST_LANES } from "../model/setups.js";
import { changes, eachFrame, h, part, select } from "./dom.js";
import { icon } from "./icons.js";
import { noteOf } from "./notes.js";
import { PRESETS } from "./presets.js";
import { COLUMNS, isShown, RaceRow } from "./race-row.js";
import { showSearch } from "./show.js";

/** @typedef {import("../../types").LaneState} LaneState */

export class RacePanel {
  #model;
  #lanes;
  #player;
  /** @type {RaceRow[]} */
  #rows = [];
  #body = h("tbody", { role: "rowgroup" });
  /** @type {HTMLTableCellElement[]} */
  #heads = [];
  #add = h("button", { type: "button" }, icon("plus"), "Add a lane");

  /**
   * @param {import("../../types").Model} model
   * @param {import("../../types").Lanes} lanes
   * @param {import("../../types").Player} player
   */
  constructor(model, lanes, player) {
    this.#model = model;
    this.#lanes = lanes;
    this.#player = player;
    this.#build();
    const show = eachFrame(() => this.#show());
    changes(model, show);
    changes(lanes, show);
    show();
  }

  #build() {
    const head = (/** @type {Node | string} */ name, title = "") =>
      h("th", { scope: "col", role: "columnheader", title: title || null }, name);
    /** @type {HTMLElement[]} */
    const notes = [];
    this.#heads = COLUMNS.map(({ name, title, note }) => {
      const cell = head(name, title);
      if (!note) return cell;
      const [button, opened] = noteOf(note);
      cell.append(button);
      notes.push(opened);
      return cell;
    });
    const table = h(
      "table",
      { class: "race-table", role: "table", "aria-labelledby": "race-title" },
      h(
        "thead",
        { role: "rowgroup" },
        h(
          "tr",
          { role: "row" },
          head("Engine"),
          ...this.#heads,
          head(h("span", { class: "sr-only" }, "Actions")),
        ),
      ),
      this.#body,
    );
    const names = Object.fromEntries(PRESETS.map(({ name }, index) => [`preset ${index}`, name]));
    const presets = select(
      { "": "Set up a race…", ...names },
      (value) => {
        this.#start(PRESETS[Number(value.split(" ")[1])].lanes);
        presets.value = "";
      },
      { "aria-label": "Set up a race" },
    );
    this.#add.addEventListener("click", () => {
      this.#model.addLane();
      showSearch(this.#model);
    });
    part("race", HTMLElement).append(
      h("div", { class: "race-head" }, h("h2", { "aria-hidden": "true" }, "Race"), presets, this.#add),
      h("div", { class: "race-scroll" }, table),
      ...notes,
    );
  }

  /** @param {import("../../types").LaneSetup[]} lanes */
  #start(lanes) {
    this.#model.batch(() => {
      this.#model.setLanes(lanes.map((lane) => ({ ...lane })));
      showSearch(this.#model);
    });
    this.#player.start();
  }

  #show() {
    const setups = this.#model.lanes;
    // The sentence of a lane alone stands beside its name: the map above does not move when there is one.
    this.#body.classList.toggle("is-alone", setups.length < 2);
    while (this.#rows.length > setups.length) this.#rows.pop()?.element.remove();
    while (this.#rows.length < setups.length) {
      const row = new RaceRow(this.#rows.length, this.#model, this.#lanes);
      this.#rows.push(row);
      this.#body.append(row.element);
    }
    COLUMNS.forEach((column, at) => {
      this.#heads[at].hidden = !isShown(column, this.#model);
    });
    const best = bests(this.#lanes.list.slice(0, setups.length));
    for (const row of this.#rows) row.show(best);
    const isFull = setups.length >= MOST_LANES;
    this.#add.disabled = isFull;
    this.#add.title = isFull ? "A race has at most four lanes" : "Add a lane like the active one";
  }
}

/** The least value of each column, if there is more than one and they differ.
 *  @param {readonly LaneState[]} list @returns {Map<string, number>} */
function bests(list) {
  const best = new Map();
  for (const { name, value } of COLUMNS) {
    if (!value) continue;
    const values = list.map(value).filter((number) => number !== undefined);
    const least = Math.min(...values);
    if (values.length > 1 && values.some((number) => number > least * 1.000001 + 1e-9)) best.set(name, least);
  }
  return best;
}
