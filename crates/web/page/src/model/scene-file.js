// The scene as a file: JSON that people can read, with all cells as rows of `.` (free) and `@` (blocked).

import { settingsOf, whyNoSettings, whyNoSource } from "./scene.js";
import { MOST_CELLS, whyNoSize } from "./setups.js";

/** @typedef {import("../../types.d.ts").MapSource} MapSource */
/** @typedef {import("./model.js").Model} Model */
/** @typedef {import("./scene.js").Scene} Scene */

const FORMAT = "mediant scene";
const VERSION = 1;
const [FREE, BLOCKED] = [".", "@"];

/** @param {Model} model @returns {Promise<Blob>} */
export async function toFile(model) {
  const { source, edited, width, height, cells } = model;
  const letters = cells.map((cell) => (cell === 0 ? FREE : BLOCKED).charCodeAt(0));
  const decoder = new TextDecoder();
  const rows = Array.from({ length: height }, (_, y) => {
    return decoder.decode(letters.subarray(y * width, (y + 1) * width));
  });
  const scene = { format: FORMAT, version: VERSION, map: { ...source, edited }, ...settingsOf(model) };
  // A line for each row.
  const text = JSON.stringify(scene, null, 1).slice(0, -2);
  const parts = [text, ',\n "rows": [\n  "', rows.join('",\n  "'), '"\n ]\n}\n'];
  return new Blob(parts, { type: "application/json" });
}

/** The scene in a file's text. Rejects with an `Error` whose message is a sentence.
 * @param {string} text @returns {Promise<Scene>} */
export async function fromFile(text) {
  if (text.length > 3 * MOST_CELLS) throw new Error("The file is too large for a scene.");
  const scene = parsed(text);
  if (scene?.format !== FORMAT) throw new Error("The file is no scene of Mediant.");
  if (scene.version !== VERSION) {
    throw new Error(`The scene is of version ${scene.version}, and this page reads version ${VERSION}.`);
  }
  const { map, rows, start, goal, lanes, active, overlay, nearest, radius, agents } = scene;
  const settings = { start, goal, lanes, active, overlay, nearest, radius, agents };
  const why = whyNoSource(map) || whyNoRows(rows) || whyNoSettings(settings);
  if (why !== "") throw new Error(`The file holds no whole scene. ${why}`);
  const [width, height] = [rows[0].length, rows.length];
  const cells = new Uint8Array(width * height);
  rows.forEach((/** @type {string} */ row, /** @type {number} */ y) => {
    for (let x = 0; x < width; x++) if (row[x] === BLOCKED) cells[y * width + x] = 1;
  });
  return { source: plainSource(map), settings, map: { width, height, cells, edited: map.edited === true } };
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
