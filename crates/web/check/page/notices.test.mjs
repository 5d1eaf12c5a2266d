// Notices: they cover nothing, and go by themselves or when they are dismissed.

import assert from "node:assert/strict";
import { test } from "node:test";
import { drop, message } from "../act.mjs";
import { picture, Site, settled } from "../browser.mjs";

/** @typedef {import("playwright-core").Page} Page */

const site = new Site();

/** What messages lie over: canvases and controls, as far as they are seen. @param {Page} page */
const covered = (page) =>
  page.evaluate(() => {
    const scroll = /** @type {Element} */ (document.querySelector(".scroll")).getBoundingClientRect();
    const notices = [...document.querySelectorAll(".message")].map((one) => one.getBoundingClientRect());
    const isCovered = (/** @type {Element} */ element) => {
      const box = element.getBoundingClientRect();
      const [top, bottom] = [Math.max(scroll.top, box.top), Math.min(scroll.bottom, box.bottom)];
      const isSeen = element.checkVisibility() && bottom > top;
      return notices.some((notice) => {
        const width = Math.min(notice.right, box.right) - Math.max(notice.left, box.left);
        const height = Math.min(notice.bottom, bottom) - Math.max(notice.top, top);
        return isSeen && width > 0.5 && height > 0.5;
      });
    };
    const all = [...document.querySelectorAll("canvas, button, input, select, summary, output")];
    const others = all.filter((element) => !element.closest(".message") && isCovered(element));
    return { messages: notices.length, covered: others.map((element) => element.outerHTML.slice(0, 90)) };
  });

for (const [width, height] of /** @type {const} */ ([
  [1440, 900],
  [820, 1180],
  [380, 760],
])) {
  test(`${width} pixels: notices cover nothing of the map or the controls`, async () => {
    const page = await site.open({ viewport: { width, height } });
    const map = () => page.locator(".stage-surface").boundingBox();
    const slider = page.getByRole("slider", { name: /^k,/ });
    await slider.focus();
    const before = await map();
    await page.keyboard.press("End");
    await message(page, /Anya searches every angle/);
    await settled(page);
    assert.deepEqual(await covered(page), { messages: 1, covered: [] });
    if (width >= 1100) assert.deepEqual(await map(), before, "the map stands still");
    // What is in use stays in sight.
    const [knob, notice] = [await slider.boundingBox(), await page.locator(".message").boundingBox()];
    assert.ok(knob && notice && knob.y + knob.height <= notice.y + 1, JSON.stringify([knob, notice]));
    await drop(page, { name: "a.exe", bytes: "MZ" });
    await page.locator("#messages").getByRole("alert").waitFor();
    assert.deepEqual(await covered(page), { messages: 2, covered: [] });
    await picture(page, `notices-${width}`);
    await page.locator(".message.error").getByRole("button", { name: "Dismiss" }).click();
    assert.equal((await covered(page)).messages, 1);
  });
}

test("a notice goes by itself", async () => {
  const page = await site.open();
  await page.locator('#k-ticks [data-place="13"]').click();
  await message(page, /Anya searches every angle/);
  await page.mouse.move(400, 300);
  await page.locator(".message").waitFor({ state: "detached", timeout: 15_000 });
});

test("what is wrong with a query stands beside the knob, not on the map", async () => {
  const page = await site.open();
  await page.evaluate(() => {
    const { model } = /** @type {any} */ (globalThis).mediant;
    const wall = Array.from({ length: model.height }, (_, y) => y * model.width + 30);
    model.paint(wall, true);
  });
  await settled(page);
  await page.locator("#worth").getByText("No path").waitFor();
  assert.deepEqual(await page.locator(".stage-surface").allTextContents(), [""]);
});
