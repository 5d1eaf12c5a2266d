// Overlays of the map, and agents that walk on it.

import assert from "node:assert/strict";
import { test } from "node:test";
import { drag, emptyRows, loadRows, place, rows, scene, setLanes, unfold } from "../act.mjs";
import { picture, Site, settled } from "../browser.mjs";
import { load, spaceOf } from "../truth.mjs";

/** @typedef {import("playwright-core").Page} Page */

const site = new Site();

/** The pictures of the stage's canvases, without the words beside, so that a test sees whether something else
 *  is drawn. @param {Page} page */
const colors = (page) =>
  page
    .locator(".stage canvas")
    .evaluateAll((all) => all.map((one) => /** @type {HTMLCanvasElement} */ (one).toDataURL()).join());

test("each overlay shows something else", async () => {
  const page = await site.open();
  const show = page.getByRole("combobox", { name: "Show", exact: true });
  // Walls that touch at a corner: there the rules differ, at both placements.
  const map = ["....#.......", "....#.......", "...#........", "...#........", "............"];
  await loadRows(page, map, [1, 0], [10, 3]);
  const seen = new Set();
  const overlays = await show
    .locator("option")
    .evaluateAll((options) => options.map((option) => /** @type {HTMLOptionElement} */ (option).value));
  assert.deepEqual([...overlays].sort(), ["clearance", "distances", "flow", "none", "rules", "search"]);
  for (const placement of ["center", "corner"]) {
    await setLanes(page, { placement });
    for (const overlay of overlays) {
      await show.selectOption(overlay);
      await settled(page);
      if (["clearance", "distances", "flow"].includes(overlay)) {
        await page.waitForFunction(
          (kind) => /** @type {any} */ (globalThis).mediant.lanes.field?.kind === kind,
          overlay,
        );
        const { values, size } = await page.evaluate(() => {
          const { values, width, height } = /** @type {any} */ (globalThis).mediant.lanes.field;
          return { values: values.length, size: width * height };
        });
        assert.equal(values, size);
      }
      await page.waitForTimeout(250);
      seen.add(await colors(page));
      await picture(page, `show-${overlay}-${placement}`);
    }
  }
  assert.equal(seen.size, 2 * overlays.length);
});

/** @param {Page} page */
const overlay = async (page) => (await scene(page)).overlay;

test("the search is shown when it is played, in a race, or under Show, and not before", async () => {
  const play = (/** @type {Page} */ page) =>
    page.getByRole("group", { name: "Playback" }).getByRole("button", { name: /^Play/ }).click();
  const [blank, ...acts] = /** @type {((page: Page) => Promise<unknown>)[]} */ ([
    async () => {},
    play,
    (page) => page.keyboard.press(","),
    (page) => page.getByRole("button", { name: "Add a lane" }).click(),
    (page) => page.getByRole("combobox", { name: "Set up a race" }).selectOption({ index: 2 }),
    (page) => page.getByRole("combobox", { name: "Show", exact: true }).selectOption("search"),
  ]);
  const before = await site.open();
  await blank(before);
  const first = await colors(before);
  assert.equal(await overlay(before), "none");
  for (const act of acts) {
    const page = await site.open();
    await act(page);
    await settled(page);
    assert.equal(await overlay(page), "search", String(act));
    await page.waitForTimeout(300);
    assert.notEqual(await colors(page), first);
    await page.close();
  }
  // What somebody chose stays.
  await before.getByRole("combobox", { name: "Show", exact: true }).selectOption("clearance");
  await play(before);
  assert.equal(await overlay(before), "clearance");
});

test("a disc as the agent: what is too narrow is shown", async () => {
  const page = await site.open();
  await unfold(page);
  const radius = page.getByRole("slider", { name: "Agent radius" });
  await radius.focus();
  for (let step = 0; step < 4; step += 1) await page.keyboard.press("ArrowRight");
  await settled(page);
  await page.waitForFunction(() => /** @type {any} */ (globalThis).mediant.lanes.tooNarrow);
  assert.equal(await page.evaluate(() => /** @type {any} */ (globalThis).mediant.model.radius), 1);
  const { lanes: setups } = await scene(page);
  const truth = spaceOf(await load(), await rows(page), setups[0], 1).grid.cells();
  // The keys told of smaller discs on the way to this one.
  await page.waitForFunction(
    (truth) => String(/** @type {any} */ (globalThis).mediant.lanes.tooNarrow) === truth,
    String(truth),
  );
  await picture(page, "radius");
});

/** @param {Page} page */
const agents = (page) =>
  page.evaluate(() => {
    const { walkers, model } = /** @type {any} */ (globalThis).mediant;
    const { width, cells } = model;
    const list = walkers.list.map((/** @type {any} */ { x, y, state }) => ({
      x,
      y,
      state,
      isInWall: cells[Math.floor(y) * width + Math.floor(x)] === 1,
    }));
    return { walking: walkers.walking, counts: { ...walkers.counts }, list };
  });

test("agents walk to the goal; who is not affected by a new wall keeps its way", async (t) => {
  const page = await site.open();
  await setLanes(page, { engine: "jps-block" });
  await loadRows(page, emptyRows(36, 20), [1, 10], [33, 10]);
  await page.getByRole("spinbutton", { name: "Number" }).fill("30");
  await page.getByRole("button", { name: "Walk" }).click();
  await page.waitForFunction(() => /** @type {any} */ (globalThis).mediant.walkers.counts.walking > 20);
  const before = await agents(page);
  assert.equal(before.list.length, 30);
  await page.waitForFunction((before) => {
    const { list } = /** @type {any} */ (globalThis).mediant.walkers;
    const far = list.map((/** @type {any} */ { x, y }, /** @type {number} */ at) =>
      Math.hypot(x - before[at].x, y - before[at].y),
    );
    return far.filter((/** @type {number} */ cells) => cells > 0.1).length > 10;
  }, before.list);
  // A cell near many ways, which cuts off few of them.
  const asked = await page.evaluate(async () => {
    const { walkers, model } = /** @type {any} */ (globalThis).mediant;
    const at = () => new Promise(requestAnimationFrame);
    while (walkers.list.some((/** @type {any} */ { needs }) => needs)) await at();
    const old = new Map(walkers.list.map((/** @type {any} */ { id, path }) => [id, path]));
    model.paint([6 * model.width + 20], true);
    const looked = walkers.list.filter((/** @type {any} */ { needs }) => needs === "check");
    while (looked.some((/** @type {any} */ { needs }) => needs === "check")) await at();
    const kept = looked.filter((/** @type {any} */ { id, path }) => path === old.get(id)).length;
    return { looked: looked.length, kept, replanned: walkers.counts.replanned };
  });
  assert.ok(asked.looked >= 3 && asked.kept > asked.looked / 2, JSON.stringify(asked));
  assert.equal(asked.replanned, asked.looked - asked.kept, JSON.stringify(asked));
  await page.getByRole("button", { name: "Draw", exact: true }).click();
  await drag(
    page,
    [
      [24, 5],
      [24, 16],
    ],
    8,
  );
  // Many have to go around the wall.
  await page.waitForFunction(() => /** @type {any} */ (globalThis).mediant.walkers.counts.replanned > 2);
  const { counts } = await agents(page);
  t.diagnostic(`${counts.kept} kept their way, ${counts.replanned} replanned, ${counts.ms.toFixed(2)} ms`);
  await picture(page, "agents");
  // They arrive, and nobody walks through the wall.
  const arrived = new Set();
  for (let look = 0; look < 240 && arrived.size < 12; look += 1) {
    const { list } = await agents(page);
    for (const [at, { x, y, state, isInWall }] of list.entries()) {
      assert.ok(!isInWall, `an agent is in a wall at ${x}, ${y}`);
      if (state === "arrived") arrived.add(at);
    }
    await page.waitForTimeout(250);
  }
  assert.ok(arrived.size >= 12, `${arrived.size} of 30 arrived`);
  await page.getByRole("button", { name: /^(Stop|Walk)$/ }).click();
});

/** The number of pixels of agents on the upper canvas. @param {Page} page @returns {Promise<number>} */
const pixelsOfAgents = (page) =>
  page.evaluate(async () => {
    await new Promise(requestAnimationFrame);
    const { stage } = /** @type {any} */ (globalThis).mediant;
    const canvas = stage.panes[0].root.querySelector(".is-top");
    const { width, height } = canvas;
    const copy = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
    if (!copy) throw new Error("no canvas");
    copy.drawImage(canvas, 0, 0);
    const { data } = copy.getImageData(0, 0, width, height);
    const css = getComputedStyle(document.documentElement).getPropertyValue("--agent").trim();
    const color = [1, 3, 5].map((at) => Number.parseInt(css.slice(at, at + 2), 16));
    let count = 0;
    for (let i = 0; i < data.length; i += 4) {
      const isSame = color.every((part, c) => Math.abs(data[i + c] - part) < 9);
      if (isSame && data[i + 3] > 250) count += 1;
    }
    return count;
  });

test("agents are seen at every zoom: of a least size", async () => {
  const page = await site.open();
  for (const scale of [20, 3, 1]) {
    const [width, height] = [Math.round(900 / scale), Math.round(400 / scale)];
    const middle = Math.round(height / 2);
    await loadRows(page, emptyRows(width, height), [1, middle], [width - 2, middle]);
    await page.evaluate(() => /** @type {any} */ (globalThis).mediant.model.set({ agents: 3 }));
    await page.waitForFunction(() => /** @type {any} */ (globalThis).mediant.walkers.counts.walking === 3);
    const own = await pixelsOfAgents(page);
    // Three discs of radius 6.5 have 398 pixels, but for those that hide one another.
    assert.ok(own > 220, `${own} pixels of agents at ${scale} pixels a cell`);
    await page.evaluate(() => /** @type {any} */ (globalThis).mediant.model.set({ agents: 0 }));
  }
});

test("zoom and pan: the map stays under the pointer", async () => {
  const page = await site.open();
  const before = await place(page, 20, 10);
  await page.mouse.move(before.x, before.y);
  const scale = () => page.evaluate(() => /** @type {any} */ (globalThis).mediant.stage.view.scale);
  const old = await scale();
  await page.mouse.wheel(0, -400);
  await page.waitForFunction((old) => /** @type {any} */ (globalThis).mediant.stage.view.scale > old, old);
  const after = await place(page, 20, 10);
  const [left, right] = [await place(page, 0, 0), await place(page, 10, 0)];
  assert.ok(right.x - left.x > 150, "zoomed in");
  assert.ok(Math.hypot(after.x - before.x, after.y - before.y) < 3, `${JSON.stringify([before, after])}`);
  await page.getByRole("button", { name: "Zoom out" }).click();
  await page.getByRole("button", { name: "Zoom in" }).click();
  await page.getByRole("button", { name: "Fit the map" }).click();
  assert.equal(await scale(), old);
  const fitted = await place(page, 20, 10);
  assert.ok(Math.hypot(fitted.x - before.x, fitted.y - before.y) < 1);
});
