// The scene in a link, after the `#`: short, in letters that every program leaves as they are. A link is
//
//   1~MAP~sX.Y~gX.Y~lLANE…~…~hDIGEST~eEDITS~CHECK
//
// with the version first and a check of all that comes before last, so that a link that was cut or changed is
// known for it. MAP is b.NAME (bundled), g.NAME.SIDE.SEED (generated), e.WIDTH.HEIGHT (empty) or
// f.WIDTH.HEIGHT.NAME (a file, whose blocked cells the edits hold; F if it was edited). Land has a field
// tCOST.CELLS for each cost of cells that differ from the map's, of a file from 1. Settings are left out that
// are 0, and the overlay if it is the search.

import { BitSet } from "./bits.js";
import { deflate, digest, fromRuns, fromText, inflate, toRuns, toText } from "./bytes.js";
import { differences, merged } from "./land.js";
import { digestOf, settingsOf, whyNoSettings, whyNoSource, withLand } from "./scene.js";
import { CHOICES, whyNoSize } from "./setups.js";

export { apply } from "./scene.js";
export { fromFile, toFile } from "./scene-file.js";

/** @typedef {import("../../types.d.ts").Point} Point */
/** @typedef {import("../../types.d.ts").LaneSetup} LaneSetup */
/** @typedef {import("../../types.d.ts").MapSource} MapSource */
/** @typedef {import("./model.js").Model} Model */
/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./scene.js").Settings} Settings */

const VERSION = "1";
const LONGEST = 30_000;
/** The most bytes that the edits may have before they are deflated. */
const MOST_BYTES = 4 * 1024 * 1024;

/** The message to the user where `encode` gives null. */
export const TOO_LARGE = "The scene is too large for a link; save the scene as a file.";

/** @param {string} text */
function checkOf(text) {
  return digest(text.length, (i) => text.charCodeAt(i));
}

/** The scene as the text after the `#` of a link; null if it is too large for one (`TOO_LARGE`).
 * @param {Model} model @returns {Promise<string | null>} */
export async function encode(model) {
  const { source, width, height, costs } = model;
  // Read first: the scene may change while the edits are packed.
  const text = [VERSION, mapText(model), ...settingsTexts(settingsOf(model))];
  const numbers = source.kind === "file" ? BitSet.of(model.cells).toList() : model.edits();
  const land = differences(source.kind === "file" ? null : model.firstCosts, costs);
  text.push(`h${digestOf(merged(model.cells, costs))}`);
  if (numbers.length > 0) {
    const runs = toRuns(numbers, Math.min(MOST_BYTES, width * height * 4));
    if (runs === null) return null;
    text.push(`e${toText(await deflate(runs))}`);
  }
  for (const [cost, cells] of land) {
    const runs = toRuns(cells, Math.min(MOST_BYTES, width * height * 4));
    if (runs === null) return null;
    text.push(`t${cost}.${toText(await deflate(runs))}`);
  }
  const link = text.join("~");
  return link.length > LONGEST ? null : `${link}~${checkOf(link)}`;
}

/** @param {Model} model */
function mapText({ source, width, height, edited }) {
  switch (source.kind) {
    case "bundled":
      return `b.${source.name}`;
    case "generated":
      return `g.${source.name}.${source.side}.${source.seed}`;
    case "empty":
      return `e.${source.width}.${source.height}`;
    case "file":
      return `${edited ? "F" : "f"}.${width}.${height}.${toText(new TextEncoder().encode(source.name))}`;
  }
}

/** @param {Settings} settings */
function settingsTexts({ start, goal, lanes, active, overlay, nearest, radius, agents }) {
  const texts = [`s${start.join(".")}`, `g${goal.join(".")}`, ...lanes.map((lane) => `l${laneText(lane)}`)];
  if (active !== 0) texts.push(`a${active}`);
  if (overlay !== "search") texts.push(`o${overlay}`);
  if (nearest) texts.push("n1");
  if (radius !== 0) texts.push(`r${Math.round(radius * 1000)}`);
  if (agents !== 0) texts.push(`w${agents}`);
  return texts;
}

/** The words of a lane's motion, each by its place among the choices.
 * @type {readonly ("placement" | "corners" | "gap" | "smooth")[]} */
const MOTION = ["placement", "corners", "gap", "smooth"];

/** @param {LaneSetup} lane */
function laneText(lane) {
  return `${lane.engine}.${lane.k}.${MOTION.map((key) => CHOICES[key].indexOf(lane[key])).join("")}`;
}

/** The scene in the text after the `#` of a link. Rejects with an `Error` whose message is a sentence.
 * @param {string} text @returns {Promise<Scene>} */
export async function decode(text) {
  const link = plain(text);
  if (link === "") throw new Error("The link holds no scene.");
  const version = link.split("~")[0];
  const check = link.lastIndexOf("~");
  if (/^[1-9]\d*$/.test(version) && version !== VERSION) {
    throw new Error(`The link is of version ${version}; this page reads version ${VERSION}: load it anew.`);
  }
  if (link.length > 2 * LONGEST || check < 0 || checkOf(link.slice(0, check)) !== link.slice(check + 1)) {
    throw new Error("The link is damaged: it was cut off or changed on its way.");
  }
  try {
    return await sceneOf(link.slice(0, check).split("~").slice(1));
  } catch (cause) {
    throw new Error(`The link holds no scene. ${cause instanceof Error ? cause.message : ""}`, { cause });
  }
}

/** Without the `#`, and with the letters that some programs write as a percent sign and a number.
 * @param {string} text */
function plain(text) {
  const link = text.replace(/^#/, "");
  try {
    return decodeURIComponent(link);
  } catch {
    return link;
  }
}

/** A whole number, without a sign and without zeros before it.
 * @param {string} text */
function number(text) {
  if (!/^(0|[1-9]\d{0,9})$/.test(text)) throw new Error(`"${text}" is no number.`);
  return Number(text);
}

/** @param {string} text @returns {Point} */
function point(text) {
  const parts = text.split(".");
  if (parts.length !== 2) throw new Error(`"${text}" is no cell.`);
  return [number(parts[0]), number(parts[1])];
}

/** @param {string} text @returns {LaneSetup} */
function lane(text) {
  const [engine, k, words, ...rest] = text.split(".");
  if (words?.length !== MOTION.length || rest.length > 0) throw new Error(`"${text}" is no lane.`);
  const motion = Object.fromEntries(MOTION.map((key, i) => [key, CHOICES[key][number(words[i])]]));
  // Whether this is a lane is checked with the other settings.
  return /** @type {LaneSetup} */ ({ engine, k: k === "any" ? k : number(k), ...motion });
}

/** @param {string[]} fields @returns {Promise<Scene>} */
async function sceneOf([mapField, ...fields]) {
  /** @type {Record<string, string[]>} */ const values = Object.create(null);
  for (const field of fields) (values[field.slice(0, 1)] ??= []).push(field.slice(1));
  const unknown = Object.keys(values).find((key) => !"sglaonrwhet".includes(key) || key === "");
  if (unknown !== undefined) throw new Error(`It has an unknown field "${unknown}".`);
  const twice = Object.keys(values).find((key) => !"lt".includes(key) && values[key].length > 1);
  if (twice !== undefined) throw new Error(`It has the field "${twice}" twice.`);
  /** @param {string} key @param {string} [otherwise] */
  const one = (key, otherwise = "") => values[key]?.[0] ?? otherwise;

  const settings = /** @type {Settings} */ ({
    start: point(one("s")),
    goal: point(one("g")),
    lanes: (values.l ?? []).map(lane),
    active: number(one("a", "0")),
    overlay: one("o", "search"),
    nearest: number(one("n", "0")) === 1,
    radius: number(one("r", "0")) / 1000,
    agents: number(one("w", "0")),
  });
  const why = whyNoSettings(settings);
  if (why !== "") throw new Error(why);
  return { ...(await mapOf(mapField.split("."), one("e"), values.t ?? [], one("h"))), settings };
}

/** @param {string[]} field @param {string} edits @param {string[]} land @param {string} digest
 * @returns {Promise<Pick<Scene, "source" | "map">>} */
async function mapOf([kind, ...parts], edits, land, digest) {
  const lengths = { b: 1, g: 3, e: 2, f: 3, F: 3 };
  if (lengths[/** @type {keyof typeof lengths} */ (kind)] !== parts.length) throw new Error("It has no map.");
  const source = sourceOf(kind, parts);
  const why = whyNoSource(source);
  if (why !== "") throw new Error(why);
  /** @param {number} size */
  const costs = async (size) => {
    /** @type {Map<number, Uint32Array>} */ const byCost = new Map();
    for (const field of land) {
      const [cost, cells, ...rest] = field.split(".");
      if (!/^[1248]$/.test(cost) || !cells || rest.length > 0) throw new Error(`"${field}" is no land.`);
      byCost.set(Number(cost), await numbersOf(cells, size));
    }
    return byCost;
  };
  if (source.kind !== "file") {
    return { source, map: { edits: (size) => numbersOf(edits, size), land: costs, digest } };
  }

  const [width, height] = parts.map((part, i) => (i < 2 ? number(part) : 0));
  const whyNot = whyNoSize(width, height);
  if (whyNot !== "") throw new Error(whyNot);
  const cells = new Uint8Array(width * height);
  for (const cell of await numbersOf(edits, cells.length)) cells[cell] = 1;
  const all = withLand(null, await costs(cells.length), cells.length);
  if (digestOf(merged(cells, all)) !== digest) throw new Error("Its cells are damaged.");
  return { source, map: { width, height, cells, costs: all, edited: kind === "F" } };
}

/** @param {string} kind @param {string[]} parts @returns {MapSource} */
function sourceOf(kind, [first, second, third]) {
  if (kind === "b") return { kind: "bundled", name: first };
  if (kind === "g") return { kind: "generated", name: first, side: number(second), seed: number(third) };
  if (kind === "e") return { kind: "empty", width: number(first), height: number(second) };
  return { kind: "file", name: new TextDecoder().decode(fromText(third)) };
}

/** The cells that the edits of a link tell, for a map of so many cells.
 * @param {string} edits @param {number} size */
async function numbersOf(edits, size) {
  if (edits === "") return new Uint32Array(0);
  try {
    return fromRuns(await inflate(fromText(edits), MOST_BYTES), size);
  } catch (cause) {
    throw new Error("The cells that the link changes are damaged.", { cause });
  }
}
