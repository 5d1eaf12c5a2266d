// Scenario files of the MovingAI benchmarks: their queries one by one, with the published lengths.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { drop, isSentence, lanes, message, rows, scene } from "../act.mjs";
import { picture, Site, settled } from "../browser.mjs";
import { ROOT } from "../places.mjs";

/** @typedef {import("playwright-core").Page} Page */

const site = new Site();

/** A file of a bundled map. @param {string} name */
const file = (name) => ({ name, bytes: readFileSync(join(ROOT, "crates/cli/maps", name)) });

/** The queries of a scenario: start x, y, goal x, y, length. @param {string} name */
const queriesOf = (name) =>
  file(name)
    .bytes.toString("utf8")
    .trim()
    .split("\n")
    .slice(1)
    .map((line) => line.split("\t").slice(4).map(Number));

/** @param {Page} page */
const bar = (page) => page.getByRole("group", { name: "Scenario" });

/** The query that is shown, when it was answered. @param {Page} page */
async function query(page) {
  await settled(page);
  await page.waitForTimeout(50);
  const { start, goal } = await scene(page);
  const text = (await bar(page).textContent()) ?? "";
  const number = Number(await bar(page).getByRole("spinbutton").inputValue());
  return { number, text, ends: [...start, ...goal] };
}

test("a scenario of the map on the page is gone through: next, previous, by number", async () => {
  const page = await site.open();
  const [before, all] = [await rows(page), queriesOf("archipelago.map.scen")];
  await drop(page, file("archipelago.map.scen"));
  await message(page, /40 queries/);
  assert.deepEqual(await rows(page), before, "the map stays");
  const first = await query(page);
  assert.deepEqual([first.number, first.ends], [1, all[0].slice(0, 4)]);
  assert.match(first.text, /archipelago\.map\.scen.*of 40/);
  const { placement, corners, k } = (await scene(page)).lanes[0];
  assert.deepEqual([placement, corners, k], ["center", "never", 3]);
  const next = bar(page).getByRole("button", { name: "Next query" });
  for (let at = 1; at < all.length; at += 1) {
    if (at % 2) await next.click();
    else await page.keyboard.press("n");
    const { number, ends, text } = await query(page);
    assert.deepEqual([number, ends], [at + 1, all[at].slice(0, 4)]);
    const [published, { answer }] = [all[at][4], (await lanes(page))[0]];
    assert.ok(Math.abs(answer.length - published) < 1e-6, `query ${at + 1}`);
    const length = published.toFixed(2);
    assert.ok(text.includes(`published: ${length}, here: ${length} (the same)`), text);
  }
  await next.click();
  assert.equal((await query(page)).number, 40, "there is none after the last");
  await picture(page, "scenario");
  await page.keyboard.press("b");
  assert.equal((await query(page)).number, 39);
  await bar(page).getByRole("button", { name: "Previous query" }).click();
  assert.equal((await query(page)).number, 38);
  const number = bar(page).getByRole("spinbutton", { name: "Query" });
  for (const [typed, shown] of /** @type {const} */ ([
    ["7", 7],
    ["9999", 40],
    ["0", 1],
  ])) {
    await number.fill(typed);
    await number.press("Enter");
    assert.deepEqual((await query(page)).ends, all[shown - 1].slice(0, 4));
  }
  await page.getByRole("button", { name: "Undo" }).click();
  assert.deepEqual((await query(page)).ends, all[39].slice(0, 4), "a query is one step of undo");
});

test("with other rules the two lengths are set apart; the bar closes", async () => {
  const page = await site.open();
  await drop(page, file("archipelago.map.scen"));
  await message(page, /40 queries/);
  const number = bar(page).getByRole("spinbutton", { name: "Query" });
  await number.fill("40");
  await number.press("Enter");
  await query(page);
  await page.locator('#k-ticks [data-place="5"]').click();
  const published = queriesOf("archipelago.map.scen")[39][4];
  const { text } = await query(page);
  const { length } = (await lanes(page))[0].answer;
  const less = ((1 - length / published) * 100).toFixed(2);
  assert.ok(text.includes(`here with k = 5, centers, never cut: ${length.toFixed(2)} (−${less} %)`), text);
  await bar(page).getByRole("button", { name: "Close the scenario" }).click();
  await bar(page).waitFor({ state: "hidden" });
  await page.keyboard.press("n");
  // Another map has other queries.
  await drop(page, file("archipelago.map.scen"));
  await bar(page).waitFor();
  await drop(page, file("cave.map"));
  await message(page, /cave\.map/);
  await bar(page).waitFor({ state: "hidden" });
});

test("a scenario of another map says so; with its map it opens", async () => {
  const page = await site.open();
  const before = [await rows(page), await scene(page)];
  const text = file("archipelago.map.scen").bytes.toString("utf8");
  for (const [scenario, map] of /** @type {const} */ ([
    [file("cave.map.scen"), "cave.map"],
    [{ name: "isles.scen", bytes: text.replaceAll("archipelago.map", "x/isles.map") }, "isles.map"],
  ])) {
    await drop(page, scenario);
    const said = await message(page, new RegExp(`is a scenario of ${map}, and this map is Archipelago, 72`));
    assert.ok(isSentence(said), said);
    assert.deepEqual([await rows(page), await scene(page)], before);
    assert.ok(await bar(page).isHidden());
  }
  await picture(page, "scenario-of-another-map");
  await drop(page, file("cave.map"), file("cave.map.scen"));
  await message(page, /cave\.map\.scen: \d+ queries/);
  const shown = await query(page);
  assert.deepEqual(shown.ends, queriesOf("cave.map.scen")[0].slice(0, 4));
  assert.match(shown.text, /\(the same\)/);
});

test("a broken scenario is refused in a sentence", async () => {
  const page = await site.open();
  for (const bytes of ["version 1\n", "version 1\n0 a.map 72\n", "MZ"]) {
    await drop(page, { name: "a.scen", bytes });
    const alert = page.locator("#messages").getByRole("alert");
    await alert.waitFor();
    const text = (await alert.locator("p").textContent()) ?? "";
    assert.ok(isSentence(text), text);
    await page.locator("#messages").getByRole("button", { name: "Dismiss" }).click();
  }
  assert.equal((await lanes(page))[0].phase, "done");
});
