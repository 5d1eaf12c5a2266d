// The first sight moves by itself once: k goes from 2 to ∞ and comes to rest. Any input stops it.

import assert from "node:assert/strict";
import { test } from "node:test";
import { scene } from "../act.mjs";
import { picture, Site, settled } from "../browser.mjs";

/** @typedef {import("playwright-core").Page} Page */

const site = new Site();
const MOVES = /** @type {const} */ ({ reducedMotion: "no-preference" });

/** A first visit: every k that the page shows, with the time of it, and every sentence that it says.
 *  @param {object} [look] */
async function visit(look = MOVES) {
  const context = await site.context(look);
  await context.addInitScript(() => {
    const seen = { ks: /** @type {[string, number][]} */ ([]), said: /** @type {string[]} */ ([]) };
    Object.assign(globalThis, { seen });
    const note = () => {
      const k = document.getElementById("k-number")?.textContent?.split("= ")[1] ?? "";
      if (k && k !== seen.ks.at(-1)?.[0]) seen.ks.push([k, performance.now()]);
      const said = document.getElementById("summary")?.textContent ?? "";
      if (said && said !== seen.said.at(-1)) seen.said.push(said);
      requestAnimationFrame(note);
    };
    requestAnimationFrame(note);
  });
  return site.open({ context });
}

/** @param {Page} page @returns {Promise<{ ks: [string, number][], said: string[] }>} */
const seen = (page) => page.evaluate(() => /** @type {any} */ (globalThis).seen);
/** @param {Page} page */
const called = (page) => page.waitForFunction(() => document.body.classList.contains("calls"));
/** @param {Page} page */
const calls = (page) => page.locator(".call:visible").count();

test("k goes from 2 to ∞ through the steps that change the path, and rests at 3", async (t) => {
  const page = await visit();
  await called(page);
  const { ks } = await seen(page);
  const first = await page.evaluate(() => performance.getEntriesByName("first-path")[0].startTime);
  const at = ks.map(([k]) => k);
  // What index.html says before the scripts are there is no step.
  assert.deepEqual(at.slice(at.indexOf("2")), ["2", "3", "4", "5", "6", "7", "∞", "3"]);
  const took = ks[ks.length - 1][1] - first;
  t.diagnostic(`${took.toFixed(0)} ms from the first path to rest`);
  assert.ok(took > 2500 && took < 9000, `${took} ms`);
  await page.waitForFunction(() => /** @type {any} */ (globalThis).seen.said.length > 0);
  await page.waitForTimeout(900);
  const { said } = await seen(page);
  assert.equal(said.length, 1, said.join(" | "));
  assert.match(said[0], /from 2 to ∞.*from 92\.00 to 70\.03 cells.*k = 3.*74\.43/);
  const { lanes, canUndo } = await scene(page);
  assert.deepEqual([lanes.length, lanes[0].k, lanes[0].engine, canUndo], [1, 3, "astar", false]);
  assert.equal(await calls(page), 3, "at the knob and at both ends");
  await picture(page, "tour-over");
  await page.keyboard.press("]");
  assert.equal((await scene(page)).lanes[0].k, 4);
  assert.equal(await calls(page), 0);
});

test("the path turns into the next one: between the two there are others", async () => {
  const page = await visit();
  const paths = await page.evaluate(async () => {
    const { stage } = /** @type {any} */ (globalThis).mediant;
    const top = stage.panes[0].root.querySelector(".is-top");
    const drawn = new Set();
    for (let frame = 0; frame < 120; frame += 1) {
      await new Promise(requestAnimationFrame);
      drawn.add(top.toDataURL());
    }
    return drawn.size;
  });
  assert.ok(paths > 12, `${paths} pictures of the path`);
});

for (const [what, act] of /** @type {[string, (page: Page) => Promise<unknown>][]} */ ([
  ["a press", (page) => page.mouse.click(640, 140)],
  ["a key", (page) => page.keyboard.press("Shift")],
  ["the wheel", (page) => page.mouse.wheel(0, 40)],
  ["a finger", (page) => page.touchscreen.tap(640, 140)],
])) {
  test(`${what} stops it at once`, async () => {
    const page = await visit({ ...MOVES, hasTouch: true });
    const isAt5 = () => document.getElementById("k-number")?.textContent?.endsWith("5");
    await page.waitForFunction(isAt5, undefined, { polling: 20 });
    await act(page);
    const before = (await scene(page)).lanes[0].k;
    await page.waitForTimeout(1500);
    assert.equal((await scene(page)).lanes[0].k, before);
    assert.equal(await calls(page), 0);
    // The page speaks again.
    await page.waitForFunction(() => document.getElementById("summary")?.textContent?.startsWith("Found"));
  });
}

test("for eyes that want no motion nothing moves, but what can be dragged is said", async () => {
  const page = await visit({});
  await called(page);
  await page.waitForTimeout(1500);
  const { ks } = await seen(page);
  assert.deepEqual(
    ks.map(([k]) => k),
    ["3"],
  );
  assert.equal(await calls(page), 3);
});

for (const [width, height] of /** @type {const} */ ([
  [1440, 900],
  [1100, 720],
  [380, 760],
])) {
  test(`${width} pixels: the calls are whole, and beside what can be dragged`, async () => {
    const page = await visit({ viewport: { width, height } });
    await called(page);
    await page.waitForTimeout(100);
    const [call, knob] = [page.locator(".k-below .call"), page.locator("#k-ticks .now")];
    const [below, tick] = [await call.boundingBox(), await knob.boundingBox()];
    assert.ok(below && tick && Math.abs(below.x + below.width / 2 - tick.x - tick.width / 2) < 4);
    const found = await page.evaluate(() => {
      const { stage, model } = /** @type {any} */ (globalThis).mediant;
      const { left, right, top, bottom } = stage.panes[0].surface.getBoundingClientRect();
      return [...document.querySelectorAll(".stage-surface .call")].map((call, at) => {
        const box = call.getBoundingClientRect();
        const end = stage.place(0, ...(at ? model.goal : model.start));
        const isWhole = box.left >= left && box.right <= right && box.top >= top && box.bottom <= bottom;
        const away = Math.max(box.top - end.y, end.y - box.bottom);
        return { isWhole, away };
      });
    });
    assert.equal(found.length, 2);
    for (const { isWhole, away } of found) assert.ok(isWhole && away > 5 && away < 30, JSON.stringify(found));
  });
}

test("nothing moves at the second visit, or with a link", async () => {
  const page = await visit();
  await called(page);
  await page.reload();
  await settled(page);
  await page.waitForTimeout(1500);
  assert.deepEqual(
    (await seen(page)).ks.map(([k]) => k),
    ["3"],
  );
  assert.equal(await calls(page), 0);
  await page.getByRole("button", { name: "Share" }).click();
  await page.waitForFunction(() => location.hash.length > 9);
  const hash = await page.evaluate(() => location.hash);
  const other = await site.open({ hash, ...MOVES });
  await other.waitForTimeout(1500);
  assert.equal((await scene(other)).lanes[0].k, 3);
  assert.equal(await calls(other), 0);
});
