// The package itself, in node: what the page must show.

import { readFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { PACKAGE } from "./places.mjs";

/** Loads the package from its folder, or its light module. @param {"" | "light"} [part] */
export async function load(part = "") {
  const folder = join(PACKAGE, part);
  const mediant = await import(pathToFileURL(join(folder, "mediant.js")).href);
  await mediant.default({ module_or_path: readFileSync(join(folder, "mediant_bg.wasm")) });
  return mediant;
}

/**
 * The space of a lane of the page.
 * @param {any} mediant @param {string[]} rows @param {any} setup @param {number} [radius] of the agent
 */
export function spaceOf(mediant, rows, { k, placement, corners, gap }, radius = 0) {
  const closed = corners === "always" ? "open" : "closed";
  const rule =
    k === "any" && placement === "center" ? { gap: closed } : placement === "center" ? { corners } : { gap };
  const motion = { k, placement, ...rule };
  const grid = mediant.Grid.fromRows(rows.map((row) => row.replaceAll("#", "@")));
  return (radius ? grid.forDisc(radius, motion) : grid).space(motion);
}

/**
 * The length of a path for a lane of the page.
 * @param {any} mediant @param {string[]} rows @param {any} setup
 * @param {number[]} start @param {number[]} goal @param {number} [radius] of the agent
 */
export function lengthOf(mediant, rows, setup, start, goal, radius = 0) {
  const { engine, smooth } = setup;
  const space = spaceOf(mediant, rows, setup, radius);
  return space
    .prepare(engine, smooth ? { smooth } : {})
    .planner()
    .find(start, goal).distance;
}
