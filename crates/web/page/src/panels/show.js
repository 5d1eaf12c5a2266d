// The choice of the overlay, with its legend; and the agents.

import { MOST_AGENTS } from "../model/setups.js";
import { changes, eachFrame, field, h, part, select, setText } from "./dom.js";
import { icon, setIcon } from "./icons.js";
import { count, time } from "./words.js";

/** @typedef {import("../../types").Overlay} Overlay */

/** @type {Record<Overlay, string>} */
const NAMES = {
  search: "The search",
  distances: "Distances from the goal",
  flow: "Flow to the goal",
  clearance: "Clearance",
  rules: "Where the rules differ",
  none: "Nothing",
};

/** @type {Record<Overlay, string>} */
const WORDS = {
  search: "The vertices that were expanded, and those still open at the end. Hub labels expand nothing.",
  distances: "The length of a shortest path from each vertex to the goal, with the active lane's motion.",
  flow: "From each vertex, the direction in which a shortest path to the goal begins.",
  clearance: "The distance of each cell to the nearest obstacle, in a straight line.",
  rules: "Where the corner rules, or open and closed gaps, allow different moves.",
  none: "",
};

/** The words where steps cost differently. @type {Partial<Record<Overlay, string>>} */
const ON_LAND = {
  distances: "The cost of a cheapest path from each vertex to the goal, with the active lane's motion.",
  flow: "From each vertex, the direction in which a cheapest path to the goal begins.",
};

/** Shows the search, unless something else lies over the map. @param {import("../../types").Model} model */
export function showSearch(model) {
  if (model.overlay === "none") model.set({ overlay: "search" });
}

export class ShowPanel {
  #model;
  #overlay;
  #words = h("p", { class: "small muted" });
  #narrow = h("p", { class: "small muted" }, "Hatched: too narrow for an agent of this radius.");

  /** @param {import("../../types").Model} model */
  constructor(model) {
    this.#model = model;
    this.#overlay = select(NAMES, (overlay) => model.set({ overlay: /** @type {Overlay} */ (overlay) }), {
      "aria-labelledby": "show-title",
    });
    const panel = part("show", HTMLElement);
    panel.querySelector(".panel-head")?.append(this.#overlay);
    panel.append(this.#words, this.#narrow);
    const show = eachFrame(() => this.#show());
    changes(model, show);
    show();
  }

  #show() {
    const { overlay, radius } = this.#model;
    this.#overlay.value = overlay;
    const onLand = this.#model.costs !== null;
    setText(this.#words, onLand ? (ON_LAND[overlay] ?? WORDS[overlay]) : WORDS[overlay]);
    this.#words.hidden = WORDS[overlay] === "";
    this.#narrow.hidden = radius === 0;
    // How it is played matters when it is seen.
    part("playback", HTMLElement).classList.toggle("is-off", overlay === "none");
  }
}

export class AgentsPanel {
  #model;
  #walkers;
  #number = h("input", {
    type: "number",
    min: 1,
    max: MOST_AGENTS,
    step: 1,
    value: 12,
    inputmode: "numeric",
  });
  #walk = h("button", { type: "button" }, icon("walk"), h("span", {}, "Walk"));
  #counts = h("p", { class: "small agents-counts", role: "status" });

  /** @param {import("../../types").Model} model @param {import("../../types").Walkers} walkers */
  constructor(model, walkers) {
    this.#model = model;
    this.#walkers = walkers;
    if (model.agents > 0) this.#number.value = String(model.agents);
    this.#walk.addEventListener("click", () => this.#toggle());
    this.#number.addEventListener("change", () => {
      const agents = Math.min(MOST_AGENTS, Math.max(1, Math.round(Number(this.#number.value) || 1)));
      this.#number.value = String(agents);
      if (walkers.walking) model.set({ agents });
    });
    part("show", HTMLElement).append(
      h("h3", {}, "Agents"),
      h("div", { class: "agents-row" }, field("Number", this.#number), this.#walk),
      this.#counts,
      h(
        "p",
        { class: "small muted" },
        "They walk to the goal. Draw walls in their way: who is not affected " +
          "keeps its path, the others plan anew.",
      ),
    );
    const show = eachFrame(() => this.#show());
    changes(walkers, show);
    changes(model, (detail) => {
      if (detail.agents && model.agents > 0) this.#number.value = String(model.agents);
    });
    show();
  }

  /** The walkers follow the model. */
  #toggle() {
    this.#model.set({ agents: this.#walkers.walking ? 0 : Number(this.#number.value) });
  }

  #show() {
    const { walking, counts } = this.#walkers;
    setIcon(this.#walk, walking ? "stop" : "walk");
    const label = this.#walk.querySelector("span");
    if (label) setText(label, walking ? "Stop" : "Walk");
    setText(this.#counts, walking || counts.arrived > 0 ? countsText(counts) : "");
    this.#counts.hidden = this.#counts.textContent === "";
  }
}

/** @param {import("../../types").Walkers["counts"]} counts */
function countsText({ walking, arrived, stuck, kept, replanned, ms }) {
  const where = [`${count(walking)} walking`, `${count(arrived)} arrived`];
  if (stuck > 0) where.push(`${count(stuck)} without a way`);
  const text = `${where.join(", ")}.`;
  if (replanned === 0 && ms === 0) return text;
  const [old, other] = [count(kept), count(replanned)];
  return `${text} Since the last edit ${old} kept their way, ${other} replanned, ${time(ms)}.`;
}
