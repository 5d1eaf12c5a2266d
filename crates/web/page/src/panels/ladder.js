// The worth of k on land: a table of the cost of each k. A row is a button for its k.

import { LARGEST_K_ON_LAND } from "../model/land.js";
import { h, part } from "./dom.js";
import { cells, more } from "./words.js";

/** @typedef {import("../model/steps.js").Rungs} Rungs */

const KS = Array.from({ length: LARGEST_K_ON_LAND - 1 }, (_, index) => index + 2);

export class LadderTable {
  #body = h("tbody");
  #table;
  #drawn = "";
  #chosen;

  /** @param {(k: number) => void} chosen */
  constructor(chosen) {
    this.#chosen = chosen;
    const head = ["k", "Cost", "More", "Length"].map((name) => h("th", { scope: "col" }, name));
    this.#table = h(
      "table",
      { class: "ladder", hidden: true },
      h("caption", {}, `The cheapest path by k, and how much more it costs than at k = ${LARGEST_K_ON_LAND}`),
      h("thead", {}, h("tr", {}, ...head)),
      this.#body,
    );
    part("readout", HTMLElement).after(this.#table);
  }

  /** @param {boolean} onLand @param {Rungs} rungs @param {number | "any"} now */
  show(onLand, rungs, now) {
    this.#table.hidden = !onLand;
    const state = JSON.stringify([onLand, [...rungs], now]);
    if (state === this.#drawn || !onLand) return;
    this.#drawn = state;
    const least = rungs.get(LARGEST_K_ON_LAND)?.cost;
    const focused = this.#body.contains(document.activeElement);
    this.#body.replaceChildren(...KS.map((k) => this.#row(k, rungs.get(k), least, now)));
    const own = focused ? this.#body.querySelector("tr.now button") : null;
    if (own instanceof HTMLElement) own.focus();
  }

  /** @param {number} k @param {{ cost: number, length: number } | undefined} rung
   *  @param {number | undefined} least @param {number | "any"} now */
  #row(k, rung, least, now) {
    const button = h(
      "button",
      { type: "button", "aria-label": `k = ${k}`, "aria-pressed": String(k === now) },
      String(k),
    );
    button.addEventListener("click", () => this.#chosen(k));
    return h(
      "tr",
      { class: k === now ? "now" : null },
      h("th", { scope: "row" }, button),
      h("td", {}, rung ? cells(rung.cost) : "–"),
      h("td", {}, rung && least ? more(rung.cost / least) : "–"),
      h("td", {}, rung ? cells(rung.length) : "–"),
    );
  }
}
