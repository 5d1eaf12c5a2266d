// Reads a map from files that were dropped or opened: which of them is the map, and whether it is too
// large; and scenarios.

/** @import { Grid, Scenario } from "../../mediant/mediant.js" */
/** @import { Queries } from "../../types.js" */
/** @import { NamedBytes, ScenarioWish } from "./protocol.js" */
import { MOST_CELLS } from "./protocol.js";

/** A sentence for the user. */
export class Refusal extends Error {
  name = "Refusal";
}

const isRos = (/** @type {NamedBytes} */ { name }) => /\.ya?ml$/i.test(name);

/**
 * The map in these files.
 * @param {Pick<typeof Grid, "read" | "size">} grids - The reader of the package.
 * @param {NamedBytes[]} files
 * @returns {{ name: string, width: number, height: number, cells: Uint8Array }}
 */
export function readMap(grids, files) {
  const main = mainOf(files);
  /** @type {Record<string, Uint8Array>} */
  const others = {};
  for (const file of files) {
    if (file !== main) {
      others[file.name] = file.bytes;
    }
  }
  checkPicture(main, others);
  const { name, bytes } = main;
  const [width, height] = grids.size(name, bytes, others);
  checkSize(name, width, height);
  const grid = grids.read(name, bytes, others);
  const cells = grid.cells();
  grid.free();
  return { name, width, height, cells };
}

/**
 * @param {NamedBytes[]} files
 * @returns {NamedBytes}
 */
function mainOf(files) {
  const main = files.find(isRos) ?? files[0];
  if (!main) {
    throw new Refusal("No file was given.");
  }
  if (files.length > 1 && !isRos(main)) {
    throw new Refusal("Open one map at a time. Only a ROS map is two files: a YAML file and its picture.");
  }
  return main;
}

/**
 * A ROS map needs its picture beside it.
 * @param {NamedBytes} main
 * @param {Record<string, Uint8Array>} others
 */
function checkPicture(main, others) {
  if (!isRos(main)) {
    return;
  }
  const text = new TextDecoder().decode(main.bytes.subarray(0, 100_000));
  const picture = /^\s*image\s*:\s*["']?([^"'#\r\n]+?)["']?\s*(#.*)?$/m.exec(text)?.[1].split(/[\\/]/).pop();
  if (!picture || picture in others) {
    return;
  }
  const names = Object.keys(others);
  const found = names.length ? `, not ${names.join(", ")}` : "";
  const { name } = main;
  throw new Refusal(`${name} is a ROS map whose picture is ${picture}${found}: drop both files together.`);
}

/**
 * @param {string} name
 * @param {number} width
 * @param {number} height
 */
export function checkSize(name, width, height) {
  if (width * height > MOST_CELLS) {
    const number = (/** @type {number} */ count) => count.toLocaleString("en");
    throw new Refusal(
      `${name} has ${width} × ${height} = ${number(width * height)} cells. This page takes at most ` +
        `${number(MOST_CELLS)}, which is 4096 × 4096. The program and the Python package take larger maps.`,
    );
  }
}

/**
 * The queries of a scenario, and whether they are for a map of this size.
 * @param {Pick<typeof Scenario, "read">} scenarios - The reader of the package.
 * @param {Grid} grid - As large as the map of the page.
 * @param {ScenarioWish} wish
 * @returns {Queries}
 */
export function readScenario(scenarios, grid, { name, bytes }) {
  const scenario = scenarios.read(bytes);
  try {
    const [map] = scenario.maps();
    if (map === undefined) {
      throw new Refusal(`${name} is a scenario without a query.`);
    }
    let fits = true;
    try {
      scenario.check(grid);
    } catch {
      fits = false;
    }
    const [starts, goals, lengths] = [scenario.starts(), scenario.goals(), scenario.lengths()];
    return { name, map: map.split(/[\\/]/).pop() ?? map, fits, starts, goals, lengths };
  } finally {
    scenario.free();
  }
}
