// The knob k, at all its values.

import assert from "node:assert/strict";
import { test } from "node:test";
import { lanes, rows, scene, setLanes, unfold } from "../act.mjs";
import { picture, Site, settled } from "../browser.mjs";
import { lengthOf, load } from "../truth.mjs";

const site = new Site();

test("the slider goes through all k to ∞, and paths get shorter as k grows", async () => {
  const page = await site.open();
  const mediant = await load();
  await setLanes(page, { engine: "astar", placement: "corner" });
  const slider = page.getByRole("slider", { name: /^k,/ });
  await slider.focus();
  await page.keyboard.press("Home");
  let last = Infinity;
  const map = await rows(page);
  const [from, to] = await slider.evaluate((input) => {
    const { min, max } = /** @type {HTMLInputElement} */ (input);
    return [Number(min), Number(max)];
  });
  assert.equal(to - from, 11, "k is 2 to 12, then ∞");
  for (let at = from; at <= to; at += 1) {
    await settled(page);
    const { lanes: setups, start, goal } = await scene(page);
    const k = at === to ? "any" : at;
    assert.equal(setups[0].k, k);
    assert.match(
      (await page.locator("#k-number").textContent()) ?? "",
      at === to ? /∞/ : new RegExp(`${at}$`),
    );
    const [{ answer }] = await lanes(page);
    assert.equal(answer.status, "found");
    const truth = lengthOf(mediant, map, setups[0], start, goal);
    assert.ok(Math.abs(answer.length - truth) < 1e-9, `k = ${k}: ${answer.length}, not ${truth}`);
    assert.ok(answer.length <= last + 1e-9, `k = ${k}: ${answer.length} is longer than ${last}`);
    last = answer.length;
    if ([2, 3, 5].includes(at) || at === to) await picture(page, `k-${k}`);
    // Without Shift it would go to the next k that changes the path.
    await page.keyboard.press("Shift+ArrowRight");
  }
});

/** Waits until the best path of each k is known. @param {import("playwright-core").Page} page */
const known = (page) =>
  page.waitForFunction(() => /** @type {any} */ (globalThis).mediant.lanes.isLadderWhole);

test("k that give the same path are one step of the keys and the bars, and each can be chosen", async () => {
  const page = await site.open();
  await known(page);
  const k = async () => (await scene(page)).lanes[0].k;
  const slider = page.getByRole("slider", { name: /^k,/ });
  await slider.focus();
  const seen = [];
  for (const [key, presses] of /** @type {const} */ ([
    ["ArrowRight", 6],
    ["ArrowLeft", 6],
    ["]", 5],
    ["[", 1],
  ])) {
    for (let press = 0; press < presses; press += 1) {
      await page.keyboard.press(key);
      seen.push(await k());
    }
  }
  // On this map k = 7 to 12 differ by less than a hundredth of a cell.
  const up = [4, 5, 6, 7, "any", "any"];
  assert.deepEqual(seen, [...up, 7, 6, 5, 4, 3, 2, 3, 4, 5, 6, 7, 6]);
  const same = page.locator("#k-same");
  assert.equal(await same.textContent(), "The same path: k = 7 to 12");
  // The bars of a step are one; a tick is its k alone.
  const bars = await page.locator("#k-bars").boundingBox();
  if (!bars) throw new Error("no bars");
  await page.mouse.click(bars.x + (8.5 / 12) * bars.width, bars.y + bars.height / 2);
  assert.equal(await k(), 7);
  for (const exact of [10, 12]) {
    await page.locator(`#k-ticks [data-place="${exact}"]`).click();
    assert.equal(await k(), exact);
  }
  await slider.focus();
  await page.keyboard.press("Shift+ArrowLeft");
  assert.equal(await k(), 11);
  await page.keyboard.press("ArrowRight");
  assert.equal(await k(), "any");
});

test("the knob skips nothing that an engine may change, or that is not known", async () => {
  const page = await site.open();
  const mediant = await load();
  for (const setup of [{ engine: "theta" }, { engine: "astar", smooth: "taut" }]) {
    await setLanes(page, { placement: "corner", k: 7, ...setup });
    await settled(page);
    await known(page);
    await page.keyboard.press("]");
    assert.equal((await scene(page)).lanes[0].k, 8, JSON.stringify(setup));
  }
  // What is known is what the package finds, at centers, too.
  await setLanes(page, { placement: "center", k: 7 });
  await settled(page);
  await known(page);
  const [map, { start, goal, lanes: setups }] = [await rows(page), await scene(page)];
  const found = await page.evaluate(() => [.../** @type {any} */ (globalThis).mediant.lanes.ladder]);
  assert.equal(found.length, 12);
  for (const [k, { length }] of found) {
    const engine = k === "any" ? "anya" : "astar";
    const truth = lengthOf(mediant, map, { ...setups[0], engine, k }, start, goal);
    assert.ok(Math.abs(length - truth) < 1e-9, `k = ${k}: ${length}, not ${truth}`);
  }
});

test("the brackets change k, the number of moves is said", async () => {
  const page = await site.open();
  await page.keyboard.press("]");
  assert.equal((await scene(page)).lanes[0].k, 4);
  await page.getByText("16 moves").first().waitFor();
  const star = (/** @type {number} */ count) =>
    page.waitForFunction((count) => document.querySelectorAll("#star .move").length === count, count);
  await star(16);
  await page.keyboard.press("[");
  await page.getByText("8 moves").first().waitFor();
  await star(8);
});

test("an engine that made way for ∞ is back when k is finite; what k is worth is the package's", async () => {
  const page = await site.open();
  const mediant = await load();
  await setLanes(page, { engine: "jps-block", placement: "corner", gap: "closed" });
  const slider = page.getByRole("slider", { name: /^k,/ });
  await slider.focus();
  await page.keyboard.press("End");
  assert.equal((await scene(page)).lanes[0].engine, "anya");
  await page.keyboard.press("Shift+ArrowLeft");
  for (let k = 12; k >= 2; k -= 1) {
    const bound = mediant.bound({ k, placement: "corner", gap: "closed" });
    const percent = ((bound - 1) * 100).toFixed(2);
    await page.waitForFunction(
      (text) => document.querySelector("#worth")?.textContent?.startsWith(text),
      `On any map, with k = ${k}: at most ${Number(percent) === 0 ? "" : percent}`,
    );
    if (k <= 3) {
      const { engine, gap } = (await scene(page)).lanes[0];
      assert.deepEqual([engine, gap], ["jps-block", "closed"]);
    }
    await page.keyboard.press("Shift+ArrowLeft");
  }
});

test("every engine answers, with what the package finds", async () => {
  const page = await site.open();
  const mediant = await load();
  const map = await rows(page);
  const select = page.getByRole("combobox", { name: "Engine" });
  const names = await select
    .locator("option")
    .evaluateAll((options) => options.map((option) => /** @type {HTMLOptionElement} */ (option).value));
  assert.deepEqual(
    [...names].sort(),
    mediant
      .engines()
      .map((/** @type {any} */ { name }) => name)
      .sort(),
  );
  for (const name of names) {
    await select.selectOption(name);
    await settled(page);
    const { lanes: setups, start, goal } = await scene(page);
    assert.equal(setups[0].engine, name);
    const [{ answer, phase, message }] = await lanes(page);
    assert.equal(phase, "done", `${name}: ${message}`);
    const truth = lengthOf(mediant, map, setups[0], start, goal);
    assert.ok(Math.abs(answer.length - truth) < 1e-9, `${name}: ${answer.length}, not ${truth}`);
  }
});

test("rules of motion change the answer, and what does not go together says why", async () => {
  const page = await site.open();
  await setLanes(page, { engine: "astar" });
  await unfold(page);
  for (const rule of ["always", "one", "never"]) {
    await page.getByRole("group", { name: "Corner cutting" }).getByText(rule, { exact: true }).click();
    await settled(page);
    assert.equal((await scene(page)).lanes[0].corners, rule);
  }
  await page.getByRole("group", { name: "Vertices" }).getByText("corners", { exact: true }).click();
  for (const rule of ["closed", "open"]) {
    await page.getByRole("group", { name: "Gaps" }).getByText(rule, { exact: true }).click();
    await settled(page);
    assert.equal((await scene(page)).lanes[0].gap, rule);
  }
  await page.getByRole("group", { name: "Smoothing" }).getByText("taut", { exact: true }).click();
  await settled(page);
  assert.equal((await scene(page)).lanes[0].smooth, "taut");
  const [{ answer }] = await lanes(page);
  assert.equal(answer.status, "found");
});
