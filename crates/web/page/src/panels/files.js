// Opens maps, scenes and scenarios from files, by a dialog or by a drop anywhere; saves; copies the link.

import { encode, fromFile, TOO_LARGE, toFile } from "../model/link.js";
import { titleOf } from "../model/maps.js";
import { h, part } from "./dom.js";
import { closeMenu } from "./menu.js";
import { say, sentence } from "./message.js";
import { openScene } from "./scenes.js";

/** @typedef {import("../model/model.js").Model} Model */
/** @typedef {import("../../types").Lanes} Lanes */

export class Files {
  #model;
  #lanes;
  #scenario;

  /** @param {Model} model @param {Lanes} lanes @param {import("./scenario.js").ScenarioBar} scenario */
  constructor(model, lanes, scenario) {
    this.#model = model;
    this.#lanes = lanes;
    this.#scenario = scenario;
    const input = part("file", HTMLInputElement);
    part("open", HTMLElement).addEventListener("click", () => input.click());
    input.addEventListener("change", () => {
      if (input.files?.length) this.#open([...input.files]);
      input.value = "";
    });
    part("share", HTMLElement).addEventListener("click", () => this.#share());
    this.#buildSave();
    this.#listenToDrops();
  }

  /** @param {File[]} files */
  async #open(files) {
    try {
      const [first] = files;
      if (files.length === 1 && first && /\.json$/i.test(first.name)) {
        await openScene(first.text().then(fromFile), this.#model);
        say(`${first.name} is open.`, { key: "file" });
        return;
      }
      const scenario = files.find(({ name }) => /\.scen$/i.test(name));
      const rest = files.filter((file) => file !== scenario);
      if (rest.length) await this.#openMap(rest);
      if (scenario) await this.#scenario.open(scenario, rest.length > 0);
    } catch (error) {
      say(sentence(error), { kind: "error", key: "file" });
    }
  }

  /** @param {File[]} files */
  async #openMap(files) {
    const { name, width, height, cells } = await this.#lanes.readMap(files);
    this.#model.load({ width, height, cells, source: { kind: "file", name } });
    say(`${name}: ${width} × ${height} cells.`, { key: "file" });
  }

  async #share() {
    try {
      const scene = await encode(this.#model);
      if (scene === null) throw new Error(TOO_LARGE);
      const link = new URL(`#${scene}`, location.href).href;
      // The address gets the link: a reload of the page opens this scene, too.
      history.replaceState(null, "", link);
      const isCopied = await copy(link);
      const where = isCopied ? "is copied" : "is in the address bar now";
      say(`The link that holds this scene ${where}.`, { key: "share" });
    } catch (error) {
      say(sentence(error), { kind: "error", key: "share" });
    }
  }

  #buildSave() {
    const menu = part("save", HTMLDetailsElement);
    const sheet = menu.querySelector(".sheet");
    const name = () => fileName(titleOf(this.#model.source));
    const active = () => this.#model.active;
    /** @type {[string, string, () => Promise<Blob> | Blob][]} */
    const kinds = [
      ["Scene: map, ends and lanes", "json", () => toFile(this.#model)],
      ["Picture, PNG", "png", () => this.#lanes.picture(active(), "png")],
      ["Picture, SVG", "svg", () => this.#lanes.picture(active(), "svg")],
      ["Search for the Posthoc visualizer", "trace.yaml", () => this.#lanes.trace(active())],
      ["Map, MovingAI .map", "map", () => new Blob([mapText(this.#model)], { type: "text/plain" })],
    ];
    sheet?.append(
      ...kinds.map(([label, ending, make]) =>
        h(
          "button",
          {
            type: "button",
            click: async () => {
              closeMenu(menu);
              try {
                download(await make(), `${name()}.${ending}`);
              } catch (error) {
                say(sentence(error), { kind: "error", key: "save" });
              }
            },
          },
          label,
        ),
      ),
    );
  }

  #listenToDrops() {
    const cover = part("drop", HTMLElement);
    let inside = 0;
    const hasFiles = (/** @type {DragEvent} */ event) => event.dataTransfer?.types.includes("Files") ?? false;
    const show = (/** @type {number} */ count) => {
      inside = Math.max(0, count);
      cover.hidden = inside === 0;
    };
    addEventListener("dragenter", (event) => hasFiles(event) && show(inside + 1));
    addEventListener("dragleave", (event) => hasFiles(event) && show(inside - 1));
    addEventListener("dragover", (event) => hasFiles(event) && event.preventDefault());
    addEventListener("drop", (event) => {
      show(0);
      if (!hasFiles(event)) return;
      event.preventDefault();
      const files = [...(event.dataTransfer?.files ?? [])];
      if (files.length) this.#open(files);
    });
  }
}

/** Whether the text is in the clipboard now. @param {string} text */
async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false;
  }
}

/** @param {Blob} blob @param {string} name */
function download(blob, name) {
  const url = URL.createObjectURL(blob);
  h("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

/** @param {string} title */
function fileName(title) {
  const words = title
    .toLowerCase()
    .replace(/\.[a-z]+$/, "")
    .replace(/[^a-z0-9]+/g, "-");
  return words.replace(/^-|-$/g, "") || "map";
}

/** The map in the format of the MovingAI benchmarks. @param {Model} model */
function mapText({ width, height, cells }) {
  const lines = [`type octile`, `height ${height}`, `width ${width}`, `map`];
  for (let y = 0; y < height; y += 1) {
    lines.push(Array.from(cells.subarray(y * width, (y + 1) * width), (cell) => (cell ? "@" : ".")).join(""));
  }
  return `${lines.join("\n")}\n`;
}
