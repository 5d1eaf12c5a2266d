// Draws the pictures of docs/web.md: `node crates/web/check/check.mjs --gallery`.
//
// Each is a window of the page in which something was done, kept as a PNG of few colors: git carries every
// version of a picture for ever.

import assert from "node:assert/strict";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { serve } from "../serve.mjs";
import { drag, drop, emptyRows, generate, loadRows, setLanes } from "./act.mjs";
import { settled as answered, launch } from "./browser.mjs";
import { quantized } from "./colors.mjs";
import { png } from "./pictures.mjs";
import { ROOT } from "./places.mjs";

/** @typedef {import("playwright-core").Page} Page */
/** @typedef {import("playwright-core").BrowserContextOptions} Look */

const FOLDER = join(ROOT, "docs/web");
const [MOST, MOST_IN_ALL] = [300_000, 1_500_000];

/** Until all lanes have answered, and their times have settled. @param {Page} page */
async function settled(page) {
  await answered(page);
  await page.waitForFunction(() =>
    /** @type {any} */ (globalThis).mediant.lanes.list.every(
      (/** @type {any} */ lane) => !lane.answer || lane.answer.settled,
    ),
  );
}

/** @param {Page} page @param {string} name */
const race = (page, name) =>
  page.getByRole("combobox", { name: "Set up a race" }).selectOption({ label: name });
/** @param {Page} page @param {number} share of the whole search */
const at = (page, share) =>
  page.evaluate((share) => {
    const { player } = /** @type {any} */ (globalThis).mediant;
    player.pause();
    player.pause();
    player.seek(Math.round(player.length * share));
  }, share);
/** @param {Page} page @param {string} overlay */
const show = (page, overlay) =>
  page.evaluate((overlay) => /** @type {any} */ (globalThis).mediant.model.set({ overlay }), overlay);

/** @type {{ name: string, look?: Look, run: (page: Page) => Promise<unknown> }[]} */
const PICTURES = [
  { name: "first", run: async () => {} },
  {
    name: "k-infinity",
    run: async (page) => {
      await page.getByRole("slider", { name: /^k\b/ }).focus();
      await page.keyboard.press("End");
    },
  },
  {
    name: "race",
    look: { colorScheme: "dark" },
    run: async (page) => {
      await race(page, "k = 2, 3, 4, ∞");
      await settled(page);
      await at(page, 0.5);
    },
  },
  {
    name: "engines",
    run: async (page) => {
      await generate(page, "rooms", 128);
      await race(page, "A*, canonical, JPS, block JPS");
      await settled(page);
      await at(page, 1);
    },
  },
  {
    name: "large",
    run: async (page) => {
      await setLanes(page, { engine: "subgoal" });
      await generate(page, "cave", 512, 2);
      await show(page, "search");
    },
  },
  {
    name: "land",
    run: async (page) => {
      await setLanes(page, { k: 4 });
      await generate(page, "landscape", 128);
      await page.waitForFunction(() => /** @type {any} */ (globalThis).mediant.lanes.ladder.size === 7);
    },
  },
  {
    name: "distances",
    run: async (page) => {
      await generate(page, "islands", 256, 4);
      await show(page, "distances");
    },
  },
  {
    name: "flow",
    look: { colorScheme: "dark" },
    run: (page) => show(page, "flow"),
  },
  {
    name: "clearance",
    run: async (page) => {
      await generate(page, "cave", 128, 3);
      await show(page, "clearance");
      await page.evaluate(() => /** @type {any} */ (globalThis).mediant.model.set({ radius: 1 }));
    },
  },
  {
    name: "agents",
    run: async (page) => {
      await setLanes(page, { engine: "jps-block" });
      await generate(page, "warehouse", 64, 2);
      await settled(page);
      await page.getByRole("spinbutton", { name: "Number" }).fill("60");
      await page.getByRole("button", { name: "Walk" }).click();
      await page.waitForTimeout(2500);
    },
  },
  {
    name: "drawn",
    run: async (page) => {
      await setLanes(page, { engine: "anya", k: "any", placement: "corner" });
      await loadRows(page, emptyRows(48, 30), [3, 15], [44, 15]);
      await page.getByRole("button", { name: "Draw", exact: true }).click();
      for (const walls of ["12 4 26", "22 0 20", "22 24 29", "34 8 29"]) {
        const [x, from, to] = walls.split(" ").map(Number);
        const ends = /** @type {[number, number][]} */ ([
          [x, from],
          [x, to],
        ]);
        await drag(page, ends, 12);
      }
    },
  },
  {
    name: "cut",
    run: async (page) => {
      await page.getByRole("button", { name: "Draw", exact: true }).click();
      /** @type {[number, number][]} */
      const wall = [
        [33, 0],
        [33, 35],
      ];
      await drag(page, wall, 40);
    },
  },
  {
    name: "scenario",
    look: { colorScheme: "dark" },
    run: async (page) => {
      const name = "archipelago.map.scen";
      await drop(page, { name, bytes: readFileSync(join(ROOT, "crates/cli/maps", name)) });
      await page.getByRole("spinbutton", { name: "Query" }).fill("40");
      await page.keyboard.press("Enter");
    },
  },
  { name: "phone", look: { viewport: { width: 380, height: 760 }, hasTouch: true }, run: async () => {} },
  {
    name: "phone-dark",
    look: { viewport: { width: 380, height: 760 }, hasTouch: true, colorScheme: "dark" },
    run: async (page) => {
      await page.getByRole("tab", { name: "Race" }).click();
      await race(page, "k = 2, 3, 4, ∞");
      await settled(page);
      await at(page, 0.6);
      await page.evaluate(() => document.querySelector(".scroll")?.scrollTo(0, 0));
    },
  },
];

/** The pixels of a window, red, green, blue. @param {Page} page */
async function pixels(page) {
  const shot = (await page.screenshot()).toString("base64");
  // A page without the rules of ours reads the picture.
  const reader = await page.context().newPage();
  const read = await reader.evaluate(async (shot) => {
    const image = new Image();
    image.src = `data:image/png;base64,${shot}`;
    await image.decode();
    const { width, height } = image;
    const context = /** @type {CanvasRenderingContext2D} */ (
      Object.assign(document.createElement("canvas"), { width, height }).getContext("2d")
    );
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, width, height);
    let text = "";
    for (let from = 0; from < data.length; from += 32768) {
      text += String.fromCharCode(...data.subarray(from, from + 32768));
    }
    return { width, height, text: btoa(text) };
  }, shot);
  await reader.close();
  return { width: read.width, height: read.height, data: Buffer.from(read.text, "base64") };
}

async function main() {
  mkdirSync(FOLDER, { recursive: true });
  const { address, close } = await serve();
  const browser = await launch();
  let total = 0;
  for (const { name, look, run } of PICTURES) {
    const context = await browser.newContext({
      viewport: { width: 1200, height: 780 },
      colorScheme: "light",
      reducedMotion: "reduce",
      ...look,
    });
    const page = await context.newPage();
    await page.goto(address);
    await settled(page);
    await run(page);
    await settled(page, 60_000);
    // References, fields and the last frames come a little later.
    await page.waitForTimeout(1200);
    const { width, height, data } = await pixels(page);
    const { places, palette } = quantized(data, 256);
    const bytes = png(width, height, places, palette);
    assert.ok(bytes.length < MOST, `${name}.png has ${bytes.length} bytes`);
    writeFileSync(join(FOLDER, `${name}.png`), bytes);
    total += bytes.length;
    console.log(`${name}.png: ${width} × ${height}, ${bytes.length} bytes`);
    await context.close();
  }
  await browser.close();
  await close();
  assert.ok(total < MOST_IN_ALL, `the pictures have ${total} bytes in all`);
  console.log(`${PICTURES.length} pictures, ${total} bytes`);
}

await main();
