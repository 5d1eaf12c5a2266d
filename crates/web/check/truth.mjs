// The package itself, in node: what the page must show.

import { readFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { PACKAGE } from "./places.mjs";

/** Loads the package from its folder. */
export async function load() {
  const mediant = await import(pathToFileURL(join(PACKAGE, "mediant.js")).href);
  await mediant.default({ module_or_path: readFileSync(join(PACKAGE, "mediant_bg.wasm")) });
  return mediant;
}

/**
 * The length of a path for a lane of the page.
 * @param {any} mediant @param {string[]} rows @param {any} setup
 * @param {number[]} start @param {number[]} goal
 */
export function lengthOf(mediant, rows, setup, start, goal) {
  const { engine, k, placement, corners, gap } = setup;
  const rule = placement === "center" ? { corners } : { gap };
  const cells = rows.map((row) => row.replaceAll("#", "@"));
  const planner = mediant.Grid.fromRows(cells)
    .space({ k, placement, ...rule })
    .prepare(engine)
    .planner();
  return planner.find(start, goal).distance;
}
