// Land, on which steps cost differently: painted, searched, shared, taken back; and what k is worth on it.

import assert from "node:assert/strict";
import { test } from "node:test";
import {
  colorsAt,
  drag,
  emptyRows,
  generate,
  isColor,
  lanes,
  loadRows,
  message,
  rows,
  scene,
  setLanes,
  token,
} from "../act.mjs";
import { picture, Site, settled } from "../browser.mjs";
import { load } from "../truth.mjs";

/** @typedef {import("playwright-core").Page} Page */

const site = new Site();

/** The costs of the map's cells; null if all are 1. @param {Page} page @returns {Promise<number[] | null>} */
const costs = (page) =>
  page.evaluate(() => {
    const { costs } = /** @type {any} */ (globalThis).mediant.model;
    return costs && Array.from(costs);
  });

/** The grid of the page's map, by the package. @param {any} mediant @param {Page} page */
async function gridOf(mediant, page) {
  const [map, land] = [await rows(page), await costs(page)];
  const cells = Uint8Array.from([...map.join("")], (cell) => Number(cell === "#"));
  return new mediant.Grid(map[0].length, map.length, cells, land ? { costs: land } : {});
}

/** @param {Page} page */
const brush = (page) => page.getByRole("combobox", { name: /^Brush/ });

/** An empty map of 20 × 12 cells. */
async function open() {
  const page = await site.open();
  await setLanes(page, { engine: "astar" });
  await loadRows(page, emptyRows(20, 12), [1, 6], [18, 6]);
  return page;
}

/** Waits until the first lane has failed, and returns why. @param {Page} page @param {RegExp} pattern */
async function failure(page, pattern) {
  await page.waitForFunction((source) => {
    const { phase, message } = /** @type {any} */ (globalThis).mediant.lanes.list[0];
    return phase === "failed" && new RegExp(source, "i").test(message);
  }, pattern.source);
  return (await lanes(page))[0].message;
}

/** Waits until the cost of each k is known. @param {Page} page */
const ladderOf = async (page) => {
  await page.waitForFunction(() => /** @type {any} */ (globalThis).mediant.lanes.ladder.size === 7);
  return page.evaluate(() => [.../** @type {any} */ (globalThis).mediant.lanes.ladder]);
};

test("a swamp is painted, the path goes around it, and undo takes it back", async () => {
  const page = await open();
  const mediant = await load();
  await brush(page).selectOption({ label: "Swamp, 8" });
  assert.equal(
    await page.getByRole("button", { name: "Draw", exact: true }).getAttribute("aria-pressed"),
    "true",
  );
  await drag(page, [
    [10, 3],
    [10, 9],
  ]);
  await settled(page);
  const land = await costs(page);
  for (let y = 3; y <= 9; y += 1) assert.equal(land?.[y * 20 + 10], 8, `row ${y}`);
  const [{ answer }] = await lanes(page);
  const found = (await gridOf(mediant, page)).find([1, 6], [18, 6], { k: 3 });
  assert.deepEqual([answer.cost, answer.length], [found.cost, found.length]);
  assert.ok(answer.cost > 17 && answer.cost < 17 + 7, `${answer.cost}`);
  const [swamp] = await colorsAt(page, [[10.5, 4.5]]);
  assert.ok(isColor(swamp, await token(page, "--land-swamp")) || swamp[0] > swamp[2], `${swamp}`);
  assert.ok(await page.locator(".land-legend").isVisible());
  const text = (await page.locator("#readout").textContent()) ?? "";
  assert.match(text, new RegExp(`Cost${found.cost.toFixed(2)}`));
  await picture(page, "land-drawn");
  await page.getByRole("button", { name: "Undo" }).click();
  await settled(page);
  assert.equal(await costs(page), null);
  assert.equal((await lanes(page))[0].answer.length, 17);
  assert.ok(!(await page.locator(".land-legend").isVisible()));
  await page.getByRole("button", { name: "Redo" }).click();
  await settled(page);
  assert.deepEqual(await costs(page), land);
  assert.equal((await lanes(page))[0].answer.cost, found.cost);
});

test("what k is worth on a landscape: the cost of each k, as the package finds it", async () => {
  const page = await site.open();
  const mediant = await load();
  await page.locator("#maps summary").click();
  await page.getByRole("combobox", { name: "Size" }).selectOption("64");
  await page.getByRole("button", { name: "Landscape" }).click();
  await settled(page);
  const { lanes: setups, start, goal } = await scene(page);
  const grid = await gridOf(mediant, page);
  const { placement, gap } = setups[0];
  const ladder = await ladderOf(page);
  let last = Infinity;
  for (const [k, rung] of ladder) {
    const { cost, length } = grid.find(start, goal, { k, placement, gap });
    assert.deepEqual(rung, { cost, length }, `k = ${k}`);
    assert.ok(cost <= last + 1e-9, `k = ${k}`);
    last = cost;
  }
  const table = page.locator(".ladder");
  const lines = await table.locator("tbody tr").allTextContents();
  assert.equal(lines.length, 7);
  for (const [at, [, { cost }]] of ladder.entries()) assert.match(lines[at], new RegExp(cost.toFixed(2)));
  await picture(page, "land-ladder");
  // A row takes its k.
  await table.getByRole("button", { name: "k = 6" }).click();
  await settled(page);
  assert.equal((await scene(page)).lanes[0].k, 6);
  assert.equal((await lanes(page))[0].answer.cost, ladder.find(([k]) => k === 6)[1].cost);
});

test("beyond k = 8, and for engines without costs, the page says so, and goes on", async () => {
  const page = await site.open();
  await generate(page, "landscape", 64);
  await settled(page);
  for (const k of [9, "any"]) {
    await page.evaluate((k) => {
      const { model } = /** @type {any} */ (globalThis).mediant;
      model.setLane(0, { k });
    }, k);
    const why = await failure(page, k === 9 ? /k = 9/ : /k = any/);
    assert.match(why, /On costs of cells .*from 2 to 8/);
    assert.match((await page.locator("#worth").textContent()) ?? "", /from 2 to 8/);
  }
  await picture(page, "land-beyond");
  await page.getByRole("slider", { name: /^k,/ }).focus();
  await page.keyboard.press("Home");
  await settled(page);
  assert.equal((await lanes(page))[0].answer.status, "found");
  await page.getByRole("combobox", { name: "Engine" }).selectOption("jps");
  await failure(page, /jps knows no costs of cells/i);
  await page.keyboard.press("]");
  await message(page, /JPS knows no costs\. A\* searches the land instead\./);
  await settled(page);
  assert.equal((await lanes(page))[0].answer.status, "found");
});

test("links and files keep the land", async () => {
  const page = await open();
  await generate(page, "landscape", 64);
  await brush(page).selectOption({ label: "Forest, 4" });
  await drag(page, [
    [20, 20],
    [30, 26],
  ]);
  await settled(page);
  const [expected, map] = [await costs(page), await rows(page)];
  assert.equal((await scene(page)).edited, true);
  await page.evaluate(() => Object.assign(navigator, { share: undefined }));
  const hash = await page.evaluate(async () => {
    await new Promise((done) => setTimeout(done, 50));
    /** @type {HTMLButtonElement} */ (document.getElementById("share")).click();
    for (let tries = 0; tries < 100 && location.hash.length < 9; tries += 1)
      await new Promise((done) => setTimeout(done, 50));
    return location.hash;
  });
  assert.match(hash, /~t4\./);
  const other = await site.open({ hash });
  assert.deepEqual([await costs(other), await rows(other)], [expected, map]);
  assert.equal((await lanes(other))[0].answer.cost, (await lanes(page))[0].answer.cost);
});

test("costs to the goal as colors; lanes of a race; agents", async () => {
  const page = await site.open();
  await generate(page, "landscape", 128);
  await setLanes(page, { k: 2 }, { k: 3 }, { k: 5 });
  await settled(page);
  await page.waitForTimeout(200);
  const heads = await page.locator(".race-table thead th:visible").allTextContents();
  assert.ok(heads.includes("Cost") && heads.includes("Length") && !heads.includes("Certificate"), `${heads}`);
  await picture(page, "land-race");
  await setLanes(page, { k: 4 });
  await page.evaluate(() => /** @type {any} */ (globalThis).mediant.model.set({ overlay: "distances" }));
  await page.waitForFunction(() => /** @type {any} */ (globalThis).mediant.lanes.field);
  await settled(page);
  const { field, start, cost } = await page.evaluate(() => {
    const { lanes, model } = /** @type {any} */ (globalThis).mediant;
    const { values, width } = lanes.field;
    const [x, y] = model.start;
    return { field: values[y * width + x], start: model.start, cost: lanes.list[0].answer.cost };
  });
  assert.ok(Math.abs(field - cost) < 1e-3 * cost, `${field} at ${start}, ${cost}`);
  assert.match((await page.locator(".stage-legend").textContent()) ?? "", /cost 0/);
  await picture(page, "land-costs");
  await page.evaluate(() => /** @type {any} */ (globalThis).mediant.model.set({ agents: 5, radius: 1 }));
  await page.waitForFunction(() => /** @type {any} */ (globalThis).mediant.walkers.counts.walking > 0);
});

test("by the keyboard: L takes a brush, Space draws land, and what it is, is said", async () => {
  const page = await open();
  await page.locator(".stage-surface").focus();
  for (let press = 0; press < 2; press += 1) await page.keyboard.press("l");
  await page.waitForFunction(() =>
    /Brush: Grass, 2/.test(document.getElementById("summary")?.textContent ?? ""),
  );
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("ArrowRight");
  await page.keyboard.down(" ");
  await page.keyboard.press("ArrowRight");
  await page.keyboard.up(" ");
  const land = await costs(page);
  assert.equal(land?.filter((cost) => cost === 2).length, 2);
  await page.waitForFunction(() =>
    /grass, cost 2/.test(document.getElementById("summary")?.textContent ?? ""),
  );
  // Once more takes it away.
  await page.keyboard.press(" ");
  assert.equal((await costs(page))?.filter((cost) => cost === 2).length, 1);
  await page.keyboard.press("Control+z");
  assert.deepEqual(await costs(page), land);
});

for (const width of [380, 820]) {
  test(`on a window of ${width} pixels nothing is cut off`, async () => {
    const page = await site.open({ viewport: { width, height: 800 }, colorScheme: "dark" });
    await generate(page, "landscape", 128);
    await settled(page);
    await ladderOf(page);
    const { scroll, inner } = await page.evaluate(() => ({
      scroll: document.documentElement.scrollWidth,
      inner: innerWidth,
    }));
    assert.ok(scroll <= inner, `${scroll} in ${inner}`);
    await picture(page, `land-${width}`);
  });
}
