// The scene as a file: JSON that people can read, with all cells as rows of `.` (free) and `@` (blocked); and
// with rows of what steps on them cost, if that differs.

import { settingsOf, whyNoSettings, whyNoSource } from "./scene.js";
import { MOST_CELLS, whyNoSize } from "./setups.js";

/** @typedef {import("../../types.d.ts").MapSource} MapSource */
/** @typedef {import("./model.js").Model} Model */
/** @typedef {import("./scene.js").Scene} Scene */

const FORMAT = "mediant scene";
/** Without land; with it. Pages of the first version would pass over what cells cost. */
const [VERSION, WITH_LAND] = [1, 2];
const [FREE, BLOCKED] = [".", "@"];
/** The code of the digit 0. */
const ZERO = 48;

/** @param {Model} model @returns {Promise<Blob>} */
export async function toFile(model) {
  const { source, edited, width, height, cells, costs } = model;
  const decoder = new TextDecoder();
  /** A line for each row. @param {string} key @param {Uint8Array} letters */
  const rowsOf = (key, letters) => {
    const rows = Array.from({ length: height }, (_, y) => {
      return decoder.decode(letters.subarray(y * width, (y + 1) * width));
    });
    return [`,\n "${key}": [\n  "`, rows.join('",\n  "'), '"\n ]'];
  };
  const version = costs === null ? VERSION : WITH_LAND;
  const scene = { format: FORMAT, version, map: { ...source, edited }, ...settingsOf(model) };
  const parts = [
    JSON.stringify(scene, null, 1).slice(0, -2),
    ...rowsOf(
      "rows",
      cells.map((cell) => (cell === 0 ? FREE : BLOCKED).charCodeAt(0)),
    ),
    ...(costs === null
      ? []
      : rowsOf(
          "costs",
          costs.map((cost) => cost + ZERO),
        )),
    "\n}\n",
  ];
  return new Blob(parts, { type: "application/json" });
}

/** The scene in a file's text. Rejects with an `Error` whose message is a sentence.
 * @param {string} text @returns {Promise<Scene>} */
export async function fromFile(text) {
  if (text.length > 4 * MOST_CELLS) throw new Error("The file is too large for a scene.");
  const scene = parsed(text);
  if (scene?.format !== FORMAT) throw new Error("The file is no scene of Mediant.");
  if (scene.version !== VERSION && scene.version !== WITH_LAND) {
    throw new Error(`The scene is of version ${scene.version}, and this page reads version ${WITH_LAND}.`);
  }
  const { map, rows, costs: land, start, goal, lanes, active, overlay, nearest, radius, agents } = scene;
  const settings = { start, goal, lanes, active, overlay, nearest, radius, agents };
  const why = whyNoSource(map) || whyNoRows(rows) || whyNoLand(land, rows) || whyNoSettings(settings);
  if (why !== "") throw new Error(`The file holds no whole scene. ${why}`);
  const [width, height] = [rows[0].length, rows.length];
  const cells = new Uint8Array(width * height);
  rows.forEach((/** @type {string} */ row, /** @type {number} */ y) => {
    for (let x = 0; x < width; x++) if (row[x] === BLOCKED) cells[y * width + x] = 1;
  });
  const costs = land ? Uint8Array.from(land.join(""), Number) : null;
  const whole = { width, height, cells, costs, edited: map.edited === true };
  return { source: plainSource(map), settings, map: whole };
}

/** The source without what else stands beside it.
 * @param {MapSource} map @returns {MapSource} */
function plainSource(map) {
  switch (map.kind) {
    case "bundled":
    case "file":
      return { kind: map.kind, name: map.name };
    case "generated":
      return { kind: map.kind, name: map.name, side: map.side, seed: map.seed };
    case "empty":
      return { kind: map.kind, width: map.width, height: map.height };
  }
}

/** @param {string} text */
function parsed(text) {
  try {
    return JSON.parse(text);
  } catch (cause) {
    throw new Error("The file is no scene: it is damaged, or of another kind.", { cause });
  }
}

/** The mistake in rows of what cells cost, as a sentence; empty if there is none, or no rows.
 * @param {unknown} land @param {string[]} rows */
function whyNoLand(land, rows) {
  if (land === undefined) return "";
  const [width, height] = [rows[0].length, rows.length];
  const isRow = (/** @type {unknown} */ row) => typeof row === "string" && /^[1248]*$/.test(row);
  const isWhole = Array.isArray(land) && land.length === height;
  if (isWhole && land.every((row) => isRow(row) && row.length === width)) return "";
  return "What its cells cost must have a row for each row of cells, of the digits 1, 2, 4 and 8.";
}

/** The mistake in rows of cells, as a sentence; empty if there is none.
 * @param {unknown} rows */
function whyNoRows(rows) {
  if (!Array.isArray(rows) || typeof rows[0] !== "string") return "It has no rows of cells.";
  const [width, height] = [rows[0].length, rows.length];
  const isRow = (/** @type {unknown} */ row) => typeof row === "string" && /^[.@]*$/.test(row);
  const odd = rows.findIndex((row) => !isRow(row) || row.length !== width);
  if (odd >= 0) return `Row ${odd} is not as long as the first one, or has other letters.`;
  return whyNoSize(width, height);
}
