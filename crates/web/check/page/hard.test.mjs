// Scenes that have no answer, or a late one.

import assert from "node:assert/strict";
import { test } from "node:test";
import { gunzipSync } from "node:zlib";
import {
  emptyRows,
  generate,
  isSentence,
  lanes,
  loadRows,
  message,
  rows,
  scene,
  setLanes,
  unfold,
} from "../act.mjs";
import { picture, Site, settled } from "../browser.mjs";

/** @typedef {import("playwright-core").Page} Page */

const site = new Site();

/** All text that is said of the lanes. @param {Page} page */
const said = async (page) =>
  (await page.locator(".race-status:visible, .worth.error:visible").allTextContents()).map((text) =>
    text.trim(),
  );

test("a map without a free cell", async () => {
  const page = await site.open();
  await loadRows(
    page,
    Array.from({ length: 6 }, () => "#".repeat(9)),
    [0, 0],
    [8, 5],
  );
  await settled(page);
  const texts = await said(page);
  assert.ok(texts.length > 0 && texts.every(isSentence), texts.join(" | "));
  await setLanes(
    page,
    { engine: "subgoal" },
    { engine: "jps-plus" },
    { engine: "hpa" },
    { engine: "anya", k: "any", placement: "corner" },
  );
  await settled(page);
  for (const { phase, answer, message } of await lanes(page)) {
    assert.ok(phase === "done" ? answer.status !== "found" : isSentence(message), `${phase} ${message}`);
  }
  for (const overlay of ["distances", "flow", "clearance", "rules", "search"]) {
    await page.getByRole("combobox", { name: "Show", exact: true }).selectOption(overlay);
    await page.waitForTimeout(150);
  }
  await picture(page, "all-blocked");
});

test("a map cannot be loaded: the page says so, keeps the scene, and can try again", async () => {
  const context = await site.context();
  await context.route("**/maps/cave.map?*", (route) => route.abort());
  const page = await site.open({ context });
  const before = await rows(page);
  const choose = async () => {
    await page.locator("#maps > summary").click();
    await page.locator("#maps").getByRole("button", { name: "Small cave", exact: true }).click();
  };
  await choose();
  assert.ok(isSentence(await message(page, /could not be loaded/)));
  assert.deepEqual(await rows(page), before);
  for (const complaint of site.taken()) assert.match(complaint, /cave\.map|ERR_FAILED/);
  await context.unroute("**/maps/cave.map?*");
  await choose();
  await page.waitForFunction(() => /** @type {any} */ (globalThis).mediant.model.source.name === "cave");
  await settled(page);
});

test("the engines cannot be loaded: the lane says so, and can try again", async () => {
  const context = await site.context();
  await context.route("**/light_bg.wasm.gz?*", (route) => route.abort());
  const page = await site.open({ context, start: false });
  await page.waitForFunction(() => /** @type {any} */ (globalThis).mediant?.lanes.list[0].phase === "failed");
  const texts = await said(page);
  assert.ok(texts.length > 0 && texts.every(isSentence), texts.join(" | "));
  assert.match(texts.join(" "), /engines could not be loaded/);
  await context.unroute("**/light_bg.wasm.gz?*");
  await page.getByRole("button", { name: "Start lane 1 again" }).click();
  await settled(page);
  const [{ answer }] = await lanes(page);
  assert.equal(answer.status, "found");
  for (const complaint of site.taken()) assert.match(complaint, /wasm|ERR_FAILED/);
});

for (const name of ["page.js.gz", "worker.js.gz"]) {
  test(`${name} cannot be loaded: the page says that it cannot start`, async () => {
    const context = await site.context();
    await context.route(`**/${name}?*`, (route) => route.fulfill({ status: 503 }));
    const page = await site.open({ context, start: false });
    const banner = page.getByRole("alert").filter({ hasText: /could not start/ });
    await banner.waitFor();
    assert.match((await banner.textContent()) ?? "", new RegExp(`503 for ${name}`));
    for (const complaint of site.taken()) assert.match(complaint, /503/);
  });
}

test("a server that has packed files unpacked does no harm", async () => {
  const context = await site.context();
  await context.route("**/*.gz?*", async (route) => {
    const response = await route.fetch();
    await route.fulfill({ response, body: gunzipSync(await response.body()) });
  });
  const page = await site.open({ context });
  const [{ answer }] = await lanes(page);
  assert.equal(answer.status, "found");
});

test("maps of one cell, of one row, and of one column", async () => {
  const page = await site.open();
  for (const [rows, start, goal] of /** @type {[string[], [number, number], [number, number]][]} */ ([
    [["."], [0, 0], [0, 0]],
    [["...................."], [0, 0], [19, 0]],
    [Array.from({ length: 20 }, () => "."), [0, 0], [0, 19]],
  ])) {
    await setLanes(
      page,
      { engine: "astar" },
      { engine: "jps-block" },
      { engine: "subgoal" },
      { engine: "chpa" },
    );
    await loadRows(page, rows, start, goal);
    for (const { answer } of await lanes(page)) {
      assert.equal(answer.status, "found");
      assert.equal(answer.length, rows.length + rows[0].length - 2);
    }
  }
});

test("ends in walls, and goals that cannot be reached, with and without the nearest vertex", async () => {
  const page = await site.open();
  const rows = emptyRows(20, 9).map((row) => `${row.slice(0, 9)}#${row.slice(10)}`);
  await setLanes(page, { engine: "astar" }, { engine: "jps-block" });
  await loadRows(page, rows, [2, 4], [17, 4]);
  for (const { answer } of await lanes(page)) assert.equal(answer.status, "unreachable");
  const texts = await said(page);
  assert.ok(texts.length >= 2 && texts.every(isSentence), texts.join(" | "));
  await picture(page, "unreachable");

  await unfold(page);
  await page.getByRole("checkbox", { name: /^Nearest/ }).check();
  await settled(page);
  for (const { answer } of await lanes(page)) {
    assert.equal(answer.status, "nearest");
    assert.deepEqual(answer.path.slice(-2), [8, 4]);
  }
  await picture(page, "nearest");

  for (const nearest of [true, false]) {
    await page.getByRole("checkbox", { name: /^Nearest/ }).setChecked(nearest);
    for (const [end, at] of /** @type {const} */ ([
      ["goal", [9, 4]],
      ["start", [9, 2]],
    ])) {
      await page.evaluate(
        ([end, at]) => /** @type {any} */ (globalThis).mediant.model.moveEnd(end, at),
        [end, at],
      );
      await settled(page);
      for (const { phase, answer } of await lanes(page)) {
        assert.equal(phase, "done");
        if (answer.status === "invalid") assert.ok(isSentence(answer.error.message), answer.error.message);
        else assert.notEqual(answer.status, "found");
      }
      assert.ok((await said(page)).every(isSentence));
    }
    await page.evaluate(() => /** @type {any} */ (globalThis).mediant.model.moveEnd("start", [2, 4]));
  }
});

/**
 * Counts frames while something runs: a page that does not answer draws none.
 * @param {Page} page @param {() => Promise<void>} run @returns {Promise<number>} the longest pause, in ms
 */
async function longestPause(page, run) {
  await page.evaluate(() => {
    const watch = { last: performance.now(), longest: 0, runs: true };
    Object.assign(globalThis, { watch });
    const frame = (/** @type {number} */ now) => {
      watch.longest = Math.max(watch.longest, now - watch.last);
      watch.last = now;
      if (watch.runs) requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  });
  await run();
  return page.evaluate(() => {
    const { watch } = /** @type {any} */ (globalThis);
    watch.runs = false;
    return watch.longest;
  });
}

for (const [what, phase, name, side, setup] of /** @type {const} */ ([
  ["a long search", "searching", "cave", 1024, { engine: "dijkstra", k: 12, placement: "corner" }],
  ["a long preparation", "preparing", "noise-20", 1024, { engine: "subgoal", k: "any", placement: "corner" }],
])) {
  test(`${what} is cancelled, and the page answers meanwhile`, async (t) => {
    const context = await site.context();
    await context.addInitScript(() => {
      /** The types of the workers' messages. @type {string[]} */
      const heard = [];
      const Own = Worker;
      Object.assign(globalThis, {
        heard,
        Worker: class extends Own {
          /** @param {string | URL} address @param {WorkerOptions} [options] */
          constructor(address, options) {
            super(address, options);
            this.addEventListener("message", ({ data }) => heard.push(data.type));
          }
        },
      });
    });
    const page = await site.open({ context });
    await generate(page, name, side);
    await settled(page, 60_000);
    const pause = await longestPause(page, async () => {
      await setLanes(page, setup);
      await page.waitForFunction(
        (phase) => /** @type {any} */ (globalThis).mediant.lanes.list[0].phase === phase,
        phase,
        { timeout: 60_000 },
      );
      await page.waitForTimeout(300);
      await picture(page, `busy-${phase}`);
    });
    t.diagnostic(`the longest time without a frame: ${pause.toFixed(0)} ms`);
    assert.ok(pause < 1500, `no frame for ${pause} ms`);
    await page.getByRole("button", { name: "Cancel lane 1" }).click();
    await page.waitForFunction(
      () => /** @type {any} */ (globalThis).mediant.lanes.list[0].phase === "cancelled",
    );
    const [text] = await said(page);
    assert.ok(/cancel/i.test(text), text);
    // The worker works no more: a search would tell each tenth of a second how far it is.
    await page.waitForTimeout(300);
    await page.evaluate(() => /** @type {any} */ (globalThis).heard.splice(0));
    await page.waitForTimeout(500);
    const heard = await page.evaluate(() => /** @type {any} */ (globalThis).heard);
    assert.deepEqual(heard, [], "a cancelled lane works on");
    // A cancelled lane can start again, or take another engine.
    await page.getByRole("button", { name: "Start lane 1 again" }).click();
    await page.waitForFunction(() => {
      const { phase } = /** @type {any} */ (globalThis).mediant.lanes.list[0];
      return phase === "searching" || phase === "preparing";
    });
    await setLanes(page, { engine: "jps-block" });
    await settled(page, 60_000);
    const [{ answer }] = await lanes(page);
    assert.equal(answer.status, "found");
    assert.equal((await scene(page)).lanes[0].engine, "jps-block");
  });
}
