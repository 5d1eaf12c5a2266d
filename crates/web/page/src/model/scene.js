// A scene as links and files hold it: its checks, and how it becomes the model's.

import { BitSet } from "./bits.js";
import { digest } from "./bytes.js";
import { whyNotGenerated } from "./generators.js";
import { differences, merged } from "./land.js";
import { bundled, loadMap as loadFromPage, titleOf } from "./maps.js";
import * as setups from "./setups.js";

/** @typedef {import("../../types.d.ts").Point} Point */
/** @typedef {import("../../types.d.ts").LaneSetup} LaneSetup */
/** @typedef {import("../../types.d.ts").MapSource} MapSource */
/** @typedef {import("../../types.d.ts").Overlay} Overlay */
/** @typedef {import("./model.js").Model} Model */
/** @typedef {import("./model.js").NewMap} NewMap */
/** @typedef {(source: MapSource) => Promise<NewMap>} LoadMap */

/** All but the map.
 * @typedef {object} Settings
 * @property {Point} start
 * @property {Point} goal
 * @property {LaneSetup[]} lanes
 * @property {number} active
 * @property {Overlay} overlay
 * @property {boolean} nearest
 * @property {number} radius
 * @property {number} agents */

/** A map with all its cells.
 * @typedef {{ width: number, height: number, cells: Uint8Array, costs: Uint8Array | null,
 *   edited: boolean }} WholeMap */

/** A map as changes of its source's. `edits` gives the numbers of the cells that differ, and `land` those
 * that cost otherwise by what they cost, once it is known how many cells there are; `digest` is that of the
 * map that comes out.
 * @typedef {{ edits: (size: number) => Promise<Uint32Array>,
 *   land: (size: number) => Promise<Map<number, Uint32Array>>, digest: string }} EditedMap */

/** @typedef {{ source: MapSource, map: WholeMap | EditedMap, settings: Settings }} Scene */

/** @param {Model} model @returns {Settings} */
export function settingsOf({ start, goal, lanes, active, overlay, nearest, radius, agents }) {
  return { start, goal, lanes: lanes.map((lane) => ({ ...lane })), active, overlay, nearest, radius, agents };
}

/** @param {Uint8Array} cells */
export function digestOf(cells) {
  // Four cells at once.
  return digest(Math.ceil(cells.length / 4), (i) => {
    return cells[4 * i] | (cells[4 * i + 1] << 8) | (cells[4 * i + 2] << 16) | (cells[4 * i + 3] << 24);
  });
}

/** Costs with those of some cells changed; null if all are 1.
 * @param {Uint8Array | null} costs @param {Map<number, Uint32Array>} land @param {number} size */
export function withLand(costs, land, size) {
  const all = costs?.slice() ?? new Uint8Array(size).fill(1);
  for (const [cost, cells] of land) for (const cell of cells) all[cell] = cost;
  return all.some((cost) => cost !== 1) ? all : null;
}

/** The mistake in the source of a map, as a sentence; empty if there is none.
 * @param {MapSource} source */
export function whyNoSource(source) {
  switch (source?.kind) {
    case "bundled": {
      const isThere = bundled.some(({ name }) => name === source.name);
      return isThere ? "" : `There is no bundled map "${source.name}".`;
    }
    case "generated":
      return whyNotGenerated(source.name, source.side, source.seed);
    case "empty":
      return setups.whyNoSize(source.width, source.height);
    case "file":
      return typeof source.name === "string" && source.name.length <= 255 ? "" : "The map has no name.";
    default:
      return "The scene does not say where its map is from.";
  }
}

/** The mistake in settings, as a sentence; empty if there is none. The ends may be outside of the map.
 * @param {Settings} settings */
export function whyNoSettings({ start, goal, lanes, active, overlay, nearest, radius, agents }) {
  /** @param {unknown} end */
  const isPoint = (end) => Array.isArray(end) && end.length === 2 && end.every(Number.isSafeInteger);
  /** @param {unknown} n @param {number} most */
  const isWhole = (n, most) => Number.isInteger(n) && setups.whole(n, 0, most) === n;
  const why = setups.whyNoLanes(lanes);
  if (why !== "") return why;
  if (!isPoint(start) || !isPoint(goal)) return "The start and the goal must be cells.";
  if (!isWhole(active, lanes.length - 1)) return "The active lane must be one of the lanes.";
  if (!setups.OVERLAYS.includes(overlay)) return "There is no such overlay.";
  if (typeof nearest !== "boolean") return "The scene does not say whether the nearest vertex will do.";
  if (setups.radius(radius) !== radius) return `The radius must be from 0 to ${setups.LARGEST_RADIUS}.`;
  return isWhole(agents, setups.MOST_AGENTS) ? "" : `There are 0 to ${setups.MOST_AGENTS} agents.`;
}

/** Makes the scene the model's: all of it, or nothing and an `Error` whose message is a sentence.
 * @param {Scene | Promise<Scene>} scene @param {Model} model @param {LoadMap} [loadMap] */
export async function apply(scene, model, loadMap = loadFromPage) {
  const { source, map, settings } = await scene;
  const why = whyNoSource(source) || whyNoSettings(settings);
  if (why !== "") throw new Error(why);
  const { start, goal, lanes, ...rest } = settings;
  const isWhole = "cells" in map;
  const { base, edits, land } = isWhole
    ? await ofWhole(source, map, loadMap)
    : await ofEdits(source, map, loadMap);
  const isInside = [start, goal].every(([x, y]) => x >= 0 && y >= 0 && x < base.width && y < base.height);
  if (!isInside) throw new Error("The start or the goal is outside of the map.");
  model.batch(() => {
    model.load({ ...base, start, goal });
    model.beginGesture("cells");
    model.paint(
      edits.filter((cell) => base.cells[cell] === 0),
      true,
    );
    model.paint(
      edits.filter((cell) => base.cells[cell] === 1),
      false,
    );
    for (const [cost, cells] of land) model.setCosts(cells, cost);
    model.endGesture();
    model.setLanes(lanes);
    model.set(rest);
  });
}

/** The source's map with changes.
 * @param {MapSource} source @param {EditedMap} map @param {LoadMap} loadMap */
async function ofEdits(source, map, loadMap) {
  const base = await loadMap(source);
  const edits = await map.edits(base.cells.length);
  const land = await map.land(base.cells.length);
  const cells = base.cells.slice();
  for (const cell of edits) cells[cell] ^= 1;
  if (digestOf(merged(cells, withLand(base.costs ?? null, land, cells.length))) !== map.digest) {
    throw new Error(`The map "${titleOf(source)}" is no longer what it was when the link was made.`);
  }
  return { base, edits, land };
}

/** The source's map with the changes that lead to the whole one; without the source, the whole one as a file.
 * @param {MapSource} source @param {WholeMap} map @param {LoadMap} loadMap */
async function ofWhole(source, map, loadMap) {
  const none = { edits: new Uint32Array(0), land: new Map() };
  if (source.kind === "file") return { base: { source, ...map }, ...none };
  const base = await loadMap(source).catch(() => null);
  if (base === null || base.width !== map.width || base.height !== map.height) {
    const file = /** @type {const} */ ({ kind: "file", name: titleOf(source) });
    return { base: { source: file, ...map }, ...none };
  }
  const edits = BitSet.of(map.cells.map((cell, i) => cell ^ base.cells[i])).toList();
  return { base, edits, land: differences(base.costs ?? null, map.costs) };
}
