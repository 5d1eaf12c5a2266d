// A scene that goes elsewhere: by a link, by a file, as a picture, as a search for the Posthoc visualizer.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { drag, drop, isSentence, lanes, message, rows, scene, setLanes } from "../act.mjs";
import { picture, Site, settled } from "../browser.mjs";

/** @typedef {import("playwright-core").Page} Page */

const site = new Site();
const READS = { permissions: ["clipboard-read", "clipboard-write"] };

/** The parts of the scene that a link and a file must keep. @param {Page} page */
async function all(page) {
  const { start, goal, lanes: setups, active, overlay, nearest, radius } = await scene(page);
  const lengths = (await lanes(page)).map(({ answer }) => answer.length);
  return { start, goal, setups, active, overlay, nearest, radius, lengths, map: await rows(page) };
}

/** A scene that differs from the first in everything. @param {Page} page */
async function change(page) {
  await page.getByRole("button", { name: "Draw", exact: true }).click();
  await drag(
    page,
    [
      [20, 3],
      [22, 30],
    ],
    10,
  );
  await setLanes(
    page,
    { engine: "jps", placement: "corner", k: 4, gap: "closed" },
    { engine: "canonical", corners: "always", k: 5, smooth: "taut" },
    { engine: "anya", k: "any", placement: "corner" },
  );
  await page.evaluate(() => {
    /** @type {any} */ (globalThis).mediant.model.set({ active: 1, nearest: true, overlay: "clearance" });
  });
  await settled(page);
}

/** @param {Page} page */
async function linkOf(page) {
  await page.getByRole("button", { name: "Share" }).click();
  await message(page, /link/);
  return page.evaluate(() => navigator.clipboard.readText());
}

/** Saves a file by the menu, and gives its name and content. @param {Page} page @param {RegExp} what */
async function save(page, what) {
  await page.locator("#save > summary").click();
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.locator("#save").getByRole("button", { name: what }).click(),
  ]);
  const bytes = readFileSync(await download.path());
  return { name: download.suggestedFilename(), text: bytes.toString("utf8"), bytes };
}

test("a link opens the same scene with the same lengths in another browser", async () => {
  const page = await site.open(READS);
  await change(page);
  const [expected, link] = [await all(page), await linkOf(page)];
  assert.ok(link.startsWith(site.address) && link.length < 4000, link);
  const other = await site.open({ hash: link.slice(site.address.length), ...READS });
  assert.deepEqual(await all(other), expected);
  await picture(other, "from-link");
  // The link of the same scene is the same link.
  assert.equal(await linkOf(other), link);
});

test("a link keeps what lies over the map, also one of before, which left the search out", async () => {
  const page = await site.open(READS);
  const blank = await linkOf(page);
  assert.match(blank, /~onone~/);
  await page.getByRole("combobox", { name: "Show", exact: true }).selectOption("search");
  const searched = await linkOf(page);
  assert.doesNotMatch(searched, /~o/);
  for (const [link, overlay] of [
    [blank, "none"],
    [searched, "search"],
  ]) {
    const other = await site.open({ hash: link.slice(site.address.length) });
    assert.equal((await scene(other)).overlay, overlay);
  }
});

test("the address holds what was shared, and another link in the same window opens its scene", async () => {
  const page = await site.open(READS);
  await change(page);
  const [expected, link] = [await all(page), await linkOf(page)];
  assert.equal(page.url(), link);
  const other = await site.open(READS);
  const hash = link.slice(link.indexOf("#"));
  await other.evaluate((hash) => (location.hash = hash), hash);
  await other.waitForFunction(() => /** @type {any} */ (globalThis).mediant.model.lanes.length === 3);
  await settled(other);
  assert.deepEqual(await all(other), expected);
});

test("a link that was cut or changed is refused in a sentence, and the page works", async () => {
  const page = await site.open(READS);
  await change(page);
  const hash = (await linkOf(page)).slice(site.address.length);
  const middle = Math.floor(hash.length / 2);
  const swapped = hash.slice(0, middle) + (hash[middle] === "a" ? "b" : "a") + hash.slice(middle + 1);
  for (const broken of [hash.slice(0, middle), swapped, "#x", "#%", `#${"~".repeat(300)}`]) {
    const other = await site.open({ hash: broken });
    const text = await message(other, /link/i);
    assert.ok(isSentence(text), text);
    assert.equal((await lanes(other))[0].answer.status, "found");
    await other.close();
  }
});

test("a saved scene is opened again", async () => {
  const page = await site.open();
  await change(page);
  const expected = await all(page);
  const { name, text } = await save(page, /^Scene/);
  JSON.parse(text);
  const other = await site.open();
  await drop(other, { name, bytes: text });
  await message(other, /open/);
  await settled(other);
  assert.deepEqual(await all(other), expected);
});

test("the map, pictures and the search are saved", async () => {
  const page = await site.open();
  const map = await save(page, /^Map/);
  assert.match(map.name, /\.map$/);
  const saved = map.text
    .trim()
    .split("\n")
    .slice(4)
    .map((row) => row.replaceAll("@", "#"));
  assert.deepEqual(saved, await rows(page));
  const png = await save(page, /PNG/);
  assert.equal(png.bytes.subarray(1, 4).toString("latin1"), "PNG");
  const svg = await save(page, /SVG/);
  assert.match(svg.text, /^<svg[\s\S]*<\/svg>\s*$/);
  const trace = await save(page, /Posthoc/);
  const { events } = JSON.parse(trace.text);
  assert.ok(events.length > 100, `${events.length} events`);
});
