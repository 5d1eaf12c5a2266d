// The actions of tests on the page, and their readings, by the object `mediant` that main.js leaves there.

import { settled } from "./browser.mjs";

/** @typedef {import("playwright-core").Page} Page */
/** @typedef {[number, number]} Point */

/** A map of these rows, `#` for a wall, in place of the one that is there.
 *  @param {Page} page @param {string[]} rows @param {Point} start @param {Point} goal */
export async function loadRows(page, rows, start, goal) {
  await page.evaluate(
    ([rows, start, goal]) => {
      const cells = Uint8Array.from([...rows.join("")], (cell) => (cell === "#" ? 1 : 0));
      const source = { kind: "file", name: "test.map" };
      const { model } = /** @type {any} */ (globalThis).mediant;
      model.load({ width: rows[0].length, height: rows.length, cells, source, start, goal });
    },
    /** @type {[string[], Point, Point]} */ ([rows, start, goal]),
  );
  await settled(page);
}

/** An empty map without ends in the way. @param {number} width @param {number} height */
export const emptyRows = (width, height) => Array.from({ length: height }, () => ".".repeat(width));

/** A generated map. @param {Page} page @param {string} name @param {number} side @param {number} [seed] */
export async function generate(page, name, side, seed = 1) {
  await page.evaluate(
    async ([name, side, seed]) => {
      const { model, loadMap } = /** @type {any} */ (globalThis).mediant;
      model.load(await loadMap({ kind: "generated", name, side, seed }));
    },
    /** @type {[string, number, number]} */ ([name, side, seed]),
  );
}

/** The map as rows. @param {Page} page @returns {Promise<string[]>} */
export const rows = (page) =>
  page.evaluate(() => {
    const { width, height, cells } = /** @type {any} */ (globalThis).mediant.model;
    const text = Array.from(cells, (cell) => (cell ? "#" : ".")).join("");
    return Array.from({ length: height }, (_, y) => text.slice(y * width, (y + 1) * width));
  });

/** The scene, without its cells. @param {Page} page @returns {Promise<any>} */
export const scene = (page) =>
  page.evaluate(() => {
    const { model } = /** @type {any} */ (globalThis).mediant;
    const { width, height, version, source, edited, start, goal, lanes, active } = model;
    const { overlay, nearest, radius, agents, canUndo, canRedo } = model;
    return JSON.parse(
      JSON.stringify({
        width,
        height,
        version,
        source,
        edited,
        start,
        goal,
        lanes,
        active,
        overlay,
        nearest,
        radius,
        agents,
        canUndo,
        canRedo,
      }),
    );
  });

/** The lanes with their answers, without the steps. @param {Page} page @returns {Promise<any[]>} */
export const lanes = (page) =>
  page.evaluate(() =>
    /** @type {any} */ (globalThis).mediant.lanes.list.map((/** @type {any} */ lane) => {
      const { phase, stale, message, answer, index, expanded, progress } = lane;
      const { steps, path, ...rest } = answer ?? {};
      const seen = answer && { ...rest, path: Array.from(path), events: steps?.length ?? null };
      return { phase, stale, message, index, expanded, progress, answer: seen };
    }),
  );

/** Sets lanes: what is not said is A*, k = 3, at centers. @param {Page} page @param {object[]} setups */
export async function setLanes(page, ...setups) {
  await page.evaluate((setups) => {
    const usual = { engine: "astar", k: 3, placement: "center", corners: "never", gap: "open", smooth: "" };
    const { model } = /** @type {any} */ (globalThis).mediant;
    model.setLanes(setups.map((setup) => ({ ...usual, ...setup })));
  }, setups);
}

/** The pixels in the window of a cell's center, or of another place of the map.
 *  @param {Page} page @param {number} x @param {number} y @param {number} [lane] */
export const place = (page, x, y, lane = 0) =>
  page.evaluate(
    ([lane, x, y]) => /** @type {any} */ (globalThis).mediant.stage.place(lane, x, y),
    [lane, x + 0.5, y + 0.5],
  );

/** The colors that a pane shows at these places of the map, in cells: all its layers on each other.
 *  @param {Page} page @param {Point[]} places @param {number} [lane] @returns {Promise<number[][]>} */
export const colorsAt = (page, places, lane = 0) =>
  page.evaluate(
    async ([places, lane]) => {
      // A change is drawn in the next frame.
      for (let frame = 0; frame < 2; frame += 1) await new Promise(requestAnimationFrame);
      const pane = /** @type {any} */ (globalThis).mediant.stage.panes[lane];
      const { left, top, scale, width, height } = pane.frame;
      const all = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
      if (!all) throw new Error("no canvas");
      for (const layer of pane.root.querySelectorAll("canvas")) all.drawImage(layer, 0, 0);
      const { data } = all.getImageData(0, 0, width, height);
      return places.map(([x, y]) => {
        const [column, row] = [Math.floor(left + x * scale), Math.floor(top + y * scale)];
        return Array.from(data.subarray(4 * (row * width + column), 4 * (row * width + column) + 3));
      });
    },
    /** @type {[Point[], number]} */ ([places, lane]),
  );

/** A color of the theme. @param {Page} page @param {string} name @returns {Promise<number[]>} */
export const token = (page, name) =>
  page.evaluate((name) => {
    const canvas = document.createElement("canvas");
    const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    context.fillStyle = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
    context.fillRect(0, 0, 1, 1);
    return [...context.getImageData(0, 0, 1, 1).data.slice(0, 3)];
  }, `--${name}`);

/** Whether colors are the same, but for smoothing. @param {number[]} a @param {number[]} b */
export const isColor = (a, b) => a.every((part, i) => Math.abs(part - b[i]) <= 24);

/** Drags the pointer over these cells.
 *  @param {Page} page @param {Point[]} cells @param {number} [steps] @param {"left" | "right"} [button] */
export async function drag(page, cells, steps = 6, button = "left") {
  const places = [];
  for (const [x, y] of cells) places.push(await place(page, x, y));
  await page.mouse.move(places[0].x, places[0].y);
  await page.mouse.down({ button });
  for (const { x, y } of places.slice(1)) await page.mouse.move(x, y, { steps });
  await page.mouse.up({ button });
}

/** The place of an end's badge: its cell's center, or a corner of cells.
 *  @param {Page} page @param {"start" | "goal"} end @returns {Promise<Point>} as `place` takes it */
export const badge = (page, end) =>
  page.evaluate((end) => {
    const { model } = /** @type {any} */ (globalThis).mediant;
    const shift = model.lanes[model.active].placement === "corner" ? 0.5 : 0;
    return [model[end][0] - shift, model[end][1] - shift];
  }, end);

/** Unfolds the rules of motion. @param {Page} page */
export const unfold = (page) => page.locator("#engine summary").click();

/** Drops files. @param {Page} page @param {{ name: string, bytes: Uint8Array | string }[]} files */
export async function drop(page, ...files) {
  const list = files.map(({ name, bytes }) => ({ name, bytes: Array.from(Buffer.from(bytes)) }));
  const dataTransfer = await page.evaluateHandle((list) => {
    const transfer = new DataTransfer();
    for (const { name, bytes } of list) transfer.items.add(new File([new Uint8Array(bytes)], name));
    return transfer;
  }, list);
  for (const event of ["dragenter", "dragover", "drop"])
    await page.dispatchEvent("main", event, { dataTransfer });
}

/** The messages over the stage. @param {Page} page @returns {Promise<string[]>} */
export const messages = (page) => page.locator("#messages .message p").allTextContents();

/** Waits for a message and returns it. @param {Page} page @param {RegExp} pattern */
export async function message(page, pattern) {
  const found = page.locator("#messages .message p").filter({ hasText: pattern });
  await found.first().waitFor({ timeout: 10_000 });
  return (await found.first().textContent()) ?? "";
}

/** Whether a text is a sentence for people. It may begin with the name of a file. @param {string} text */
export const isSentence = (text) =>
  /^\S.{8,}[.!?]$/s.test(text.trim()) && !/undefined|NaN|\[object/.test(text);

/** The value below which this share of the numbers lies. @param {number[]} numbers @param {number} share */
export function quantile(numbers, share) {
  const sorted = [...numbers].sort((a, b) => a - b);
  return sorted[Math.min(sorted.length - 1, Math.floor(sorted.length * share))];
}
