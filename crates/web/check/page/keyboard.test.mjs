// The whole page by the keyboard alone.

import assert from "node:assert/strict";
import { test } from "node:test";
import { colorsAt, emptyRows, isColor, lanes, loadRows, rows, scene, setLanes, token } from "../act.mjs";
import { picture, Site, settled } from "../browser.mjs";

/** @typedef {import("playwright-core").Page} Page */

const site = new Site();

/** The element that has the focus: its tag, name and whether it is visible. @param {Page} page */
const focused = (page) =>
  page.evaluate(() => {
    const element = document.activeElement;
    if (!element || element === document.body) return "";
    const { width, height } = element.getBoundingClientRect();
    const label = element.getAttribute("aria-label") ?? element.textContent?.trim().slice(0, 30);
    const id = element.id ? `#${element.id}` : "";
    return `${element.tagName.toLowerCase()}${id} ${label} ${width > 0 && height > 0}`;
  });

/** Presses Tab until the element has the focus. @param {Page} page @param {string} selector */
async function tabTo(page, selector) {
  for (let press = 0; press < 80; press += 1) {
    await page.keyboard.press("Tab");
    if (await page.evaluate((selector) => document.activeElement?.matches(selector), selector)) return;
  }
  assert.fail(`Tab does not come to ${selector}`);
}

test("Tab goes through all controls and comes around", async () => {
  const page = await site.open();
  const seen = [];
  for (let press = 0; press < 100; press += 1) {
    await page.keyboard.press("Tab");
    const at = await focused(page);
    if (at === "" || (seen.length > 3 && at === seen[0])) break;
    seen.push(at);
  }
  assert.match(seen[0], /Skip/);
  assert.ok(seen.length > 20 && seen.length < 100, seen.join("\n"));
  for (const id of ["#open", "#share", "#theme", "#k-slider", "Zoom in", "Map, lane 1"]) {
    assert.ok(
      seen.some((at) => at.includes(id)),
      `${id} is not reached:\n${seen.join("\n")}`,
    );
  }
  assert.ok(
    seen.every((at) => at.endsWith("true")),
    `the focus is on something unseen:\n${seen.join("\n")}`,
  );
});

test("the focus is seen", async () => {
  const page = await site.open();
  for (const selector of ["#open", "#k-slider", ".stage-surface", "select"]) {
    await tabTo(page, selector);
    const ring = await page.evaluate(() => {
      const element = /** @type {Element} */ (document.activeElement);
      const { outlineStyle, outlineWidth, boxShadow } = getComputedStyle(element);
      const after = getComputedStyle(element, "::after");
      const isFramed = after.content !== "none" && Number.parseFloat(after.borderTopWidth) >= 1;
      return (
        (outlineStyle !== "none" && Number.parseFloat(outlineWidth) >= 1) || boxShadow !== "none" || isFramed
      );
    });
    assert.ok(ring, `${selector} shows no focus`);
  }
});

test("walls are drawn and ends are put by keys", async () => {
  const page = await site.open();
  await setLanes(page, { engine: "astar" });
  await loadRows(page, emptyRows(12, 8), [1, 4], [10, 4]);
  await tabTo(page, ".stage-surface");
  const cursor = () => page.evaluate(() => ({ .../** @type {any} */ (globalThis).mediant.stage.cursor }));
  // From where the cursor is to a cell.
  const go = async (/** @type {number} */ x, /** @type {number} */ y) => {
    const { x: fromX, y: fromY } = await cursor();
    for (let step = fromX; step !== x; step += Math.sign(x - fromX)) {
      await page.keyboard.press(x > fromX ? "ArrowRight" : "ArrowLeft");
    }
    for (let step = fromY; step !== y; step += Math.sign(y - fromY)) {
      await page.keyboard.press(y > fromY ? "ArrowDown" : "ArrowUp");
    }
  };
  await go(5, 1);
  await page.keyboard.down("Space");
  await go(5, 6);
  await page.keyboard.up("Space");
  const map = await rows(page);
  for (let y = 1; y <= 6; y += 1) assert.equal(map[y][5], "#", map.join("\n"));
  await settled(page);
  assert.ok((await lanes(page))[0].answer.length > 10);
  await go(2, 0);
  await page.keyboard.press("s");
  await go(9, 7);
  await page.keyboard.press("g");
  await settled(page);
  const { start, goal } = await scene(page);
  assert.deepEqual(
    [start, goal],
    [
      [2, 0],
      [9, 7],
    ],
  );
  await picture(page, "keyboard");
  await page.keyboard.press("Control+z");
  await page.keyboard.press("Control+z");
  await page.keyboard.press("Control+z");
  assert.deepEqual(await rows(page), emptyRows(12, 8));
});

test("k, the engine, the race, the map: all by keys", async () => {
  const page = await site.open();
  await tabTo(page, "#k-slider");
  await page.keyboard.press("End");
  await settled(page);
  assert.equal((await scene(page)).lanes[0].k, "any");
  await page.getByRole("combobox", { name: "Engine" }).focus();
  await page.keyboard.press("Home");
  await page.keyboard.press("ArrowDown");
  await settled(page);
  await page.locator("#maps > summary").focus();
  await page.keyboard.press("Enter");
  await page.getByRole("button", { name: "Maze", exact: true }).first().waitFor();
  await page.keyboard.press("Escape");
  assert.equal(await page.locator("#maps").getAttribute("open"), null);
  assert.match(await focused(page), /^summary/);
});

test("the cell of the keyboard is drawn and said, Shift goes far, Escape leaves a stroke", async () => {
  const page = await site.open();
  await setLanes(page, { engine: "astar" });
  await loadRows(page, emptyRows(24, 12), [1, 10], [22, 10]);
  await page.evaluate(() => {
    const { stage, model } = /** @type {any} */ (globalThis).mediant;
    model.set({ overlay: "none" });
    stage.addEventListener("say", (/** @type {CustomEvent} */ { detail }) => {
      Object.assign(globalThis, { said: detail });
    });
  });
  const said = () => page.evaluate(() => /** @type {any} */ (globalThis).said);
  await tabTo(page, ".stage-surface");
  for (let press = 0; press < 8; press += 1) await page.keyboard.press("ArrowUp");
  assert.equal(await said(), "Cell 1, 2: free.");
  await page.keyboard.press("Shift+ArrowRight");
  assert.equal(await said(), "Cell 9, 2: free.");
  // The frame of the cell, and the cell beside it.
  const [on, beside] = await colorsAt(page, [
    [9.5, 2.5],
    [10.5, 2.5],
  ]);
  assert.ok(isColor(beside, await token(page, "free")), `${beside}`);
  assert.ok(!isColor(on, beside), `the cell of the keyboard is not seen: ${on}`);
  await page.keyboard.down("Enter");
  await page.keyboard.press("Shift+ArrowRight");
  assert.equal((await rows(page))[2], `${".".repeat(9)}${"#".repeat(9)}${".".repeat(6)}`);
  assert.equal(await said(), "Cell 17, 2: wall.");
  await page.keyboard.press("Escape");
  await page.keyboard.up("Enter");
  assert.deepEqual(await rows(page), emptyRows(24, 12), "Escape leaves everything as it was");
  // The cell stays in the map.
  for (let press = 0; press < 3; press += 1) await page.keyboard.press("Shift+ArrowRight");
  assert.match(await said(), /^Cell 23, 2:/);
});
