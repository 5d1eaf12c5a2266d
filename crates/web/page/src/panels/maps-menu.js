// The menu of maps: bundled and generated ones with small pictures, and an empty one.

import { LAND } from "../model/land.js";
import { bundled, generators, loadMap, SIDES, titleOf } from "../model/maps.js";
import { changes, field, h, part, select, setText } from "./dom.js";
import { icon } from "./icons.js";
import { closeMenu } from "./menu.js";
import { say, sentence } from "./message.js";

/** @typedef {import("../../types").MapSource} MapSource */

const PREVIEW_SIDE = 64;

export class MapsMenu {
  #model;
  #menu = part("maps", HTMLDetailsElement);
  #title = h("span", { class: "menu-title" }, "Map");
  #side = select(Object.fromEntries(SIDES.map((side) => [String(side), `${side} × ${side}`])), () => {});
  #seed = h("input", { type: "number", min: 0, max: 4294967295, step: 1, value: 1, inputmode: "numeric" });
  #width = size(64, "Width");
  #height = size(40, "Height");
  #another = h("button", { type: "button", click: () => this.#next() }, icon("dice"), "Another one");
  #isBuilt = false;

  /** @param {import("../../types").Model} model */
  constructor(model) {
    this.#model = model;
    this.#side.value = "256";
    const summary = this.#menu.querySelector("summary");
    for (const node of [...(summary?.childNodes ?? [])]) if (node.nodeType === Node.TEXT_NODE) node.remove();
    summary?.append(this.#title);
    this.#menu.addEventListener("toggle", () => this.#menu.open && this.#build());
    changes(model, (detail) => (detail.map || detail.cells) && this.#show());
    this.#show();
  }

  #show() {
    const { source, edited } = this.#model;
    setText(this.#title, `${titleOf(source)}${edited ? ", edited" : ""}`);
    this.#title.parentElement?.setAttribute("aria-label", `Map: ${this.#title.textContent}`);
    this.#another.disabled = source.kind !== "generated";
    if (source.kind !== "generated") return;
    this.#side.value = String(source.side);
    this.#seed.value = String(source.seed);
  }

  #build() {
    if (this.#isBuilt) return;
    this.#isBuilt = true;
    const sheet = this.#menu.querySelector(".sheet");
    const ready = bundled.map(({ name, title, about }) => {
      const source = /** @type {const} */ ({ kind: "bundled", name });
      return this.#entry(title, about, source, () => this.#load(source));
    });
    const made = generators.map(({ name, title, about }) =>
      this.#entry(title, about, { kind: "generated", name, side: PREVIEW_SIDE, seed: 3 }, () =>
        this.#load({ kind: "generated", name, side: Number(this.#side.value), seed: this.#seedNow() }),
      ),
    );
    const empty = h(
      "button",
      {
        type: "button",
        click: () =>
          this.#load({
            kind: "empty",
            width: this.#width.valueAsNumber,
            height: this.#height.valueAsNumber,
          }),
      },
      "Empty map",
    );
    sheet?.append(
      h("h3", {}, "Ready"),
      h("div", { class: "map-grid" }, ...ready),
      h("h3", {}, "Generated"),
      h("div", { class: "map-grid" }, ...made),
      h("div", { class: "map-form" }, field("Size", this.#side), field("Seed", this.#seed), this.#another),
      h("h3", {}, "Your own"),
      h("div", { class: "map-form" }, field("Width", this.#width), field("Height", this.#height), empty),
    );
  }

  /** @param {string} title @param {string} about @param {MapSource} source @param {() => void} chosen */
  #entry(title, about, source, chosen) {
    const canvas = h("canvas", { width: 72, height: 48, "aria-hidden": "true" });
    preview(canvas, source).catch(() => canvas.remove());
    return h("button", { type: "button", title: about, click: chosen }, canvas, title);
  }

  #seedNow() {
    const seed = Math.round(this.#seed.valueAsNumber);
    return seed >= 0 && seed <= 0xffff_ffff ? seed : 1;
  }

  #next() {
    const { source } = this.#model;
    if (source.kind !== "generated") return;
    this.#load({ ...source, side: Number(this.#side.value), seed: (source.seed + 1) % 2 ** 32 }, true);
  }

  /** @param {MapSource} source @param {boolean} [staysOpen] */
  async #load(source, staysOpen = false) {
    if (!staysOpen) closeMenu(this.#menu);
    try {
      this.#model.load(await loadMap(source));
    } catch (error) {
      say(sentence(error), { kind: "error", key: "map" });
    }
  }
}

/** @param {number} value @param {string} label */
function size(value, label) {
  const range = { min: 1, max: 4096, step: 1, value };
  return h("input", { type: "number", ...range, inputmode: "numeric", "aria-label": label });
}

/** A small picture of a map. @param {HTMLCanvasElement} canvas @param {MapSource} source */
async function preview(canvas, source) {
  const { width, height, cells, costs } = await loadMap(source);
  canvas.width = width;
  canvas.height = height;
  const context = canvas.getContext("2d");
  if (!context) return;
  const style = getComputedStyle(document.documentElement);
  LAND.filter(({ cost }) => cost > 1 && costs).forEach(({ cost, name }) => {
    context.fillStyle = style.getPropertyValue(`--land-${name.toLowerCase()}`);
    costs?.forEach((own, at) => {
      if (own === cost) context.fillRect(at % width, Math.floor(at / width), 1, 1);
    });
  });
  context.fillStyle = style.getPropertyValue("--wall");
  for (let at = 0; at < cells.length; at += 1) {
    if (cells[at]) context.fillRect(at % width, Math.floor(at / width), 1, 1);
  }
}
