// A race of four lanes: played, paused, stepped, at the same pace and in real time.

import assert from "node:assert/strict";
import { test } from "node:test";
import { lanes, scene } from "../act.mjs";
import { picture, Site, settled } from "../browser.mjs";

/** @typedef {import("playwright-core").Page} Page */

const site = new Site();

/** A window with a race of four lanes. */
async function open() {
  const page = await site.open();
  const presets = page.getByRole("combobox", { name: "Set up a race" });
  const options = await presets.locator("option").allTextContents();
  await presets.selectOption({ label: options.find((text) => text.includes("canonical")) ?? options[1] });
  await settled(page);
  assert.equal((await scene(page)).lanes.length, 4);
  // It plays by itself.
  await press(page, /^Pause/);
  return page;
}

/** @param {Page} page */
const player = (page) =>
  page.evaluate(() => {
    const { player, lanes } = /** @type {any} */ (globalThis).mediant;
    const { mode, playing, position, length } = player;
    const each = lanes.list.map((/** @type {any} */ _, /** @type {number} */ lane) => ({
      shown: player.shown(lane),
      arrived: player.arrived(lane),
    }));
    return { mode, playing, position, length, each };
  });

/** @param {Page} page @param {string | RegExp} name */
const press = (page, name) =>
  page.getByRole("group", { name: "Playback" }).getByRole("button", { name }).click();

test("a race that is chosen starts from the beginning, when all lanes have answered", async () => {
  const page = await site.open();
  const log = await page.evaluate(async () => {
    const { player, lanes } = /** @type {any} */ (globalThis).mediant;
    /** @type {{ position: number, playing: boolean, ended: boolean }[]} */
    const seen = [];
    player.addEventListener("change", () => {
      const ended = lanes.list.every((/** @type {any} */ { phase, stale }) => phase === "done" && !stale);
      seen.push({ position: player.position, playing: player.playing, ended });
    });
    const presets = /** @type {HTMLSelectElement} */ (document.querySelector("#race select"));
    presets.selectedIndex = 1;
    presets.dispatchEvent(new Event("change"));
    while (player.position < player.length / 3 || !player.playing) await new Promise(requestAnimationFrame);
    return seen;
  });
  const first = log.findIndex(({ playing }) => playing);
  assert.ok(
    first >= 0 && log.slice(0, first).every(({ position }) => position === 0),
    "nothing is shown before",
  );
  assert.ok(log.slice(first).every(({ ended }) => ended));
  assert.ok(log[first].position < 30, `${log[first].position}`);
  await page.waitForFunction(() => !(/** @type {any} */ (globalThis).mediant.player.playing));
  assert.ok((await player(page)).each.every(({ arrived }) => arrived));
});

test("four lanes side by side, with one row each", async () => {
  const page = await open();
  assert.equal(await page.getByRole("table").locator("tbody tr").count(), 4);
  const answers = await lanes(page);
  const lengths = answers.map(({ answer }) => answer.length);
  for (const length of lengths) assert.ok(Math.abs(length - lengths[0]) < 1e-6, "all four are optimal");
  assert.ok(await page.getByRole("button", { name: "Add a lane" }).isDisabled());
  await picture(page, "race");
});

test("the same pace: play, pause, one expansion on and back, beginning and end", async () => {
  const page = await open();
  await press(page, "To the beginning");
  const first = await player(page);
  assert.equal(first.position, 0);
  assert.ok(first.each.every(({ arrived }) => !arrived));
  await press(page, "One expansion on");
  await press(page, "One expansion on");
  assert.equal((await player(page)).position, 2);
  await press(page, "One expansion back");
  assert.equal((await player(page)).position, 1);

  await press(page, /^Play/);
  await page.waitForFunction(() => /** @type {any} */ (globalThis).mediant.player.position > 5);
  await picture(page, "race-playing");
  await press(page, /^Pause/);
  const paused = await player(page);
  assert.equal(paused.playing, false);
  await page.waitForTimeout(100);
  assert.equal((await player(page)).position, paused.position);
  const answers = await lanes(page);
  const shown = paused.each.map(({ arrived }) => arrived);
  answers.forEach(({ answer }, lane) => {
    assert.equal(shown[lane], answer.expanded <= paused.position, `lane ${lane} after ${paused.position}`);
  });

  await press(page, "To the end");
  const last = await player(page);
  assert.equal(last.position, last.length);
  assert.ok(last.each.every(({ arrived }) => arrived));
});

test("in real time, who is faster arrives first", async () => {
  const page = await open();
  await page.getByRole("combobox", { name: "How fast each lane is shown" }).selectOption("time");
  assert.equal((await player(page)).mode, "time");
  await press(page, "To the beginning");
  await press(page, /^Play/);
  await page.waitForFunction(() => {
    const { player, lanes } = /** @type {any} */ (globalThis).mediant;
    return lanes.list.some((/** @type {any} */ _, /** @type {number} */ lane) => player.arrived(lane));
  });
  await press(page, /^Pause/);
  const { each } = await player(page);
  const times = (await lanes(page)).map(({ answer }) => answer.ms);
  const fastest = times.indexOf(Math.min(...times));
  assert.ok(each[fastest].arrived, `lane ${fastest} of ${times}`);
  await picture(page, "race-real-time");
});

test("the scrubber moves by keys", async () => {
  const page = await open();
  const scrubber = page.getByRole("slider", { name: "Position in the search" });
  await scrubber.focus();
  await page.keyboard.press("Home");
  assert.equal((await player(page)).position, 0);
  await page.keyboard.press("End");
  const { position, length } = await player(page);
  assert.equal(position, length);
});

test("lanes are added, chosen and removed", async () => {
  const page = await site.open();
  await page.getByRole("button", { name: "Add a lane" }).click();
  await settled(page);
  assert.equal((await scene(page)).lanes.length, 2);
  const second = page.getByRole("radio", { name: /^Lane 2/ });
  await second.focus();
  await page.keyboard.press("Space");
  assert.equal((await scene(page)).active, 1);
  await page.getByRole("combobox", { name: "Engine" }).selectOption("dijkstra");
  await settled(page);
  assert.deepEqual(
    (await scene(page)).lanes.map((/** @type {any} */ lane) => lane.engine),
    ["astar", "dijkstra"],
  );
  await page.getByRole("button", { name: "Remove lane 1" }).click();
  await settled(page);
  assert.deepEqual(
    (await scene(page)).lanes.map((/** @type {any} */ lane) => lane.engine),
    ["dijkstra"],
  );
});

test("every race that is offered runs", async () => {
  const page = await site.open();
  const presets = page.getByRole("combobox", { name: "Set up a race" });
  const count = (await presets.locator("option").count()) - 1;
  for (let at = 1; at <= count; at += 1) {
    await presets.selectOption({ index: at });
    await settled(page);
    for (const { phase, answer, message } of await lanes(page)) {
      assert.equal(phase, "done", message);
      assert.equal(answer.status, "found");
    }
    await picture(page, `race-offer-${at}`);
  }
});
