// The maps that the page offers: bundled ones, which are files beside the page, and generated ones.

import { addressOf } from "../files.js";
import { newWorker } from "../workers.js";
import { generate } from "./generate.js";
import { generators, SIDES, whyNotGenerated } from "./generators.js";
import { whyNoSize } from "./setups.js";

export { generators, SIDES };

/** @typedef {import("../../types.d.ts").Point} Point */
/** @typedef {import("../../types.d.ts").MapSource} MapSource */

/** A bundled map with the ends of its demo, which are free at centers and at corners.
 * @typedef {{ name: string, title: string, about: string, start: Point, goal: Point }} Bundled */

/** @type {readonly Readonly<Bundled>[]} */
export const bundled = Object.freeze([
  {
    name: "archipelago",
    title: "Archipelago",
    about: "A course between islands.",
    start: [1, 1],
    goal: [60, 34],
  },
  {
    name: "cave",
    title: "Small cave",
    about: "A way through a cave.",
    start: [2, 5],
    goal: [62, 33],
  },
  {
    name: "maze",
    title: "Hedges",
    about: "A way through a maze of hedges.",
    start: [2, 2],
    goal: [66, 31],
  },
  {
    name: "town",
    title: "Town",
    about: "A walk across a town with a river.",
    start: [0, 34],
    goal: [70, 3],
  },
]);

/** The name of the map in menus and in the names of saved files.
 * @param {MapSource} source */
export function titleOf(source) {
  switch (source.kind) {
    case "bundled":
      return bundled.find(({ name }) => name === source.name)?.title ?? source.name;
    case "generated": {
      const title = generators.find(({ name }) => name === source.name)?.title ?? source.name;
      return `${title} ${source.side} × ${source.side}, seed ${source.seed}`;
    }
    case "file":
      return source.name;
    case "empty":
      return `Empty ${source.width} × ${source.height}`;
  }
}

/** The map of a source, with ends, for `Model.load`. Rejects with an `Error` whose message is a sentence.
 * @param {MapSource} source
 * @returns {Promise<import("./model.js").NewMap>} */
export async function loadMap(source) {
  switch (source.kind) {
    case "bundled":
      return { source, ...(await fetchBundled(source.name)) };
    case "generated":
      return { source, ...(await generateAside(source.name, source.side, source.seed)) };
    case "empty": {
      const { width, height } = source;
      const why = whyNoSize(width, height);
      if (why !== "") throw new RangeError(why);
      return { source, width, height, cells: new Uint8Array(width * height) };
    }
    case "file":
      throw new Error(`The map ${source.name} is a file: open it from your disk.`);
  }
}

/** From this side on, a generated map is made in a worker: it takes longer than a frame or two. */
const LARGE_SIDE = 512;

/** @param {string} name @param {number} side @param {number} seed
 * @returns {Promise<ReturnType<typeof generate>>} */
async function generateAside(name, side, seed) {
  const why = whyNotGenerated(name, side, seed);
  if (why !== "") throw new RangeError(why);
  if (side < LARGE_SIDE || typeof Worker === "undefined") return generate(name, side, seed);
  const worker = newWorker("maker");
  try {
    return await new Promise((resolve, reject) => {
      worker.onmessage = ({ data }) => resolve(data);
      worker.onerror = reject;
      worker.postMessage({ name, side, seed });
    });
  } catch {
    // The worker could not be started: the page makes the map itself.
    return generate(name, side, seed);
  } finally {
    worker.terminate();
  }
}

/** @param {string} name */
async function fetchBundled(name) {
  const map = bundled.find((entry) => entry.name === name);
  if (map === undefined) throw new Error(`There is no bundled map "${name}".`);
  const failed = `The map ${map.title} could not be loaded.`;
  const response = await fetch(addressOf(`maps/${name}.map`)).catch((cause) => {
    throw new Error(`${failed} Is the network there?`, { cause });
  });
  if (!response.ok) throw new Error(`${failed} The server says ${response.status}.`);
  return { ...parseMap(await response.text()), start: map.start, goal: map.goal };
}

/** A bundled map's text, in the MovingAI format. It is parsed here, and not by the package as all other files
 * are, so that the first map is there before the package has been loaded.
 * @param {string} text */
export function parseMap(text) {
  const lines = text.split(/\r?\n/);
  const [width, height] = ["width", "height"].map((word) => {
    const line = lines.slice(0, 4).find((header) => header.startsWith(`${word} `)) ?? "";
    return Number(line.slice(word.length));
  });
  const why = whyNoSize(width, height);
  if (why !== "") throw new RangeError(why);
  const rows = lines.slice(4, 4 + height);
  if (lines[3] !== "map" || rows.length < height || rows.some((row) => row.length !== width)) {
    throw new Error("The map has not as many cells as its header says.");
  }
  const cells = new Uint8Array(width * height);
  rows.forEach((row, y) => {
    for (let x = 0; x < width; x++) cells[y * width + x] = ".GS".includes(row[x]) ? 0 : 1;
  });
  return { width, height, cells };
}
