// The engine of the active lane, its motion, and what the query asks.

import { Choice } from "./choice.js";
import { changes, eachFrame, h, part, select, setText } from "./dom.js";
import { CORNER_RULES, GAP_RULES, laneMark, PLACEMENTS } from "./figures.js";
import { engineHow, engineName, promise, withNames } from "./words.js";

/** @typedef {import("../../types").LaneSetup} LaneSetup */
/** @typedef {import("../../types").EngineInfo} EngineInfo */

/** The engines that prepare an index of the map. `EngineInfo.index` says it of those that save it. */
const GROUPS = /** @type {const} */ ([
  ["Prepares little", (/** @type {EngineInfo} */ engine) => !engine.index && !near(engine)],
  ["Prepared", (/** @type {EngineInfo} */ engine) => engine.index && !near(engine)],
  ["Near-optimal", (/** @type {EngineInfo} */ engine) => near(engine)],
]);

/** @param {EngineInfo} engine */
const near = (engine) => engine.guarantee === "suboptimal";

export class EnginePanel {
  #model;
  #lanes;
  #engine;
  #mark = h("span", { class: "mark-slot" });
  #why = h("p", { class: "why" });
  #paper = h("p", { class: "muted small" });
  #placement;
  #corners;
  #gap;
  #smooth;
  #radius = h("input", { type: "range", min: 0, max: 4, step: 0.25 });
  #radiusText = h("output", { class: "range-value" });
  #nearest = h("input", { type: "checkbox" });
  #checked = "";

  /**
   * @param {import("../../types").Model} model
   * @param {import("../../types").Lanes} lanes
   * @param {import("./setups.js").Setups} setups
   */
  constructor(model, lanes, setups) {
    this.#model = model;
    this.#lanes = lanes;
    const choice = (
      /** @type {string} */ legend,
      /** @type {keyof LaneSetup} */ key,
      /** @type {[string, string, (() => SVGElement)?][]} */ options,
      /** @type {string} */ note,
    ) =>
      new Choice(
        legend,
        options.map(([value, label, figure]) => ({ value, label, figure: figure?.() })),
        (value) => setups.change({ [key]: value }),
        note,
      );
    this.#engine = select({}, (engine) => setups.change({ engine }), { "aria-labelledby": "engine-title" });
    this.#placement = choice(
      "Vertices",
      "placement",
      [
        ["corner", "corners", PLACEMENTS.corner],
        ["center", "centers", PLACEMENTS.center],
      ],
      "vertices",
    );
    this.#corners = choice(
      "Corner cutting",
      "corners",
      [
        ["never", "never", CORNER_RULES.never],
        ["one", "one", CORNER_RULES.one],
        ["always", "always", CORNER_RULES.always],
      ],
      "corners",
    );
    this.#gap = choice(
      "Gaps",
      "gap",
      [
        ["open", "open", GAP_RULES.open],
        ["closed", "closed", GAP_RULES.closed],
      ],
      "gaps",
    );
    this.#smooth = choice(
      "Smoothing",
      "smooth",
      [
        ["", "none"],
        ["linear", "linear"],
        ["taut", "taut"],
      ],
      "smoothing",
    );
    this.#build();
    const show = eachFrame(() => this.#show());
    changes(model, show);
    lanes.ready.then(
      () => {
        this.#fillEngines();
        show();
      },
      () => {},
    );
    show();
  }

  #build() {
    this.#radius.addEventListener("input", () => this.#model.set({ radius: Number(this.#radius.value) }));
    this.#nearest.addEventListener("change", () => this.#model.set({ nearest: this.#nearest.checked }));
    const radius = h(
      "label",
      { class: "field" },
      h("span", { class: "field-label" }, "Agent radius"),
      this.#radius,
      this.#radiusText,
    );
    const nearest = h("label", { class: "check" }, this.#nearest, "Nearest vertex if there is no way");
    const panel = part("engine", HTMLElement);
    panel.querySelector(".panel-head")?.append(this.#mark, this.#engine);
    const rules = h(
      "div",
      { class: "rules" },
      this.#paper,
      h("div", { class: "choice-pair" }, this.#placement.element, this.#corners.element, this.#gap.element),
      this.#placement.reason,
      this.#corners.reason,
      this.#gap.reason,
      this.#smooth.element,
      this.#smooth.reason,
      radius,
      nearest,
    );
    panel.append(this.#why, h("details", { class: "more" }, h("summary", {}, "Rules of motion"), rules));
  }

  #fillEngines() {
    const groups = GROUPS.map(([label, fits]) =>
      h("optgroup", { label }, ...this.#lanes.engines.filter(fits).map(({ name }) => option(name))),
    );
    this.#engine.replaceChildren(...groups);
  }

  #show() {
    const setup = this.#model.lanes[this.#model.active];
    if (!setup) return;
    const engine = this.#lanes.engines.find(({ name }) => name === setup.engine);
    // Before all engines are there, only that of the lane is known.
    if (this.#engine.querySelector("optgroup") === null) this.#engine.replaceChildren(option(setup.engine));
    this.#engine.value = setup.engine;
    this.#mark.replaceChildren(laneMark(this.#model.active));
    const onLand = this.#model.costs !== null;
    const isTaken = engine && (!onLand || engine.costs);
    const promised = isTaken ? promise(setup, engine.guarantee, onLand) : "";
    setText(this.#why, `${engineHow(setup.engine)} ${promised}`);
    setText(this.#paper, engine?.paper ?? "");
    this.#placement.value = setup.placement;
    this.#corners.value = setup.corners;
    this.#gap.value = setup.gap;
    this.#smooth.value = setup.smooth;
    this.#corners.element.hidden = setup.placement !== "center";
    this.#gap.element.hidden = setup.placement !== "corner";
    const { radius, nearest } = this.#model;
    this.#radius.value = String(radius);
    const text = radius === 0 ? "a point" : `${radius} ${radius === 1 ? "cell" : "cells"}`;
    setText(this.#radiusText, text);
    this.#radius.setAttribute("aria-valuetext", text);
    this.#nearest.checked = nearest;
    this.#refuse({ ...setup }).catch(() => {});
  }

  /** Disables what does not go together, with the library's sentence. @param {LaneSetup} setup */
  async #refuse(setup) {
    const key = JSON.stringify([setup, this.#model.costs !== null]);
    if (key === this.#checked || this.#lanes.engines.length === 0) return;
    this.#checked = key;
    const check = async (
      /** @type {Choice} */ choice,
      /** @type {keyof LaneSetup} */ name,
      /** @type {string[]} */ values,
    ) => {
      const reasons = new Map();
      for (const value of values) {
        // The current choice stays: that it goes together is mended elsewhere.
        const reason = value === setup[name] ? "" : await this.#lanes.check({ ...setup, [name]: value });
        reasons.set(value, withNames(reason));
      }
      if (this.#checked === key) choice.refuse(reasons);
    };
    await Promise.all([
      check(this.#placement, "placement", ["corner", "center"]),
      check(this.#corners, "corners", setup.placement === "center" ? ["never", "one", "always"] : []),
      check(this.#gap, "gap", setup.placement === "corner" ? ["open", "closed"] : []),
      check(this.#smooth, "smooth", ["", "linear", "taut"]),
    ]);
  }
}

/** @param {string} engine */
const option = (engine) => h("option", { value: engine }, engineName(engine));
