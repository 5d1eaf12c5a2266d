// Overlays of the map, and agents that walk on it.

import assert from "node:assert/strict";
import { test } from "node:test";
import { drag, emptyRows, loadRows, place, rows, scene, setLanes } from "../act.mjs";
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

test("a disc as the agent: what is too narrow is shown", async () => {
  const page = await site.open();
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
