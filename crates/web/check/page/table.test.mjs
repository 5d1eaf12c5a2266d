// The table of lanes and the captions: the winner, proofs, and names that can be read.

import assert from "node:assert/strict";
import { test } from "node:test";
import { emptyRows, lanes, loadRows, messages, scene, setLanes } from "../act.mjs";
import { picture, Site, settled } from "../browser.mjs";

/** @typedef {import("playwright-core").Page} Page */

const site = new Site();

/** @param {Page} page @param {number} lane @param {string} column */
const cell = (page, lane, column) =>
  page.locator("#race tbody tr").nth(lane).locator(`td[data-label="${column}"]`);

test("what was refused wins nothing", async () => {
  const page = await site.open();
  // The goal is in a wall for centers, and on its edge for corners.
  await loadRows(page, ["....", "....", "...#"], [0, 0], [3, 2]);
  await setLanes(page, {}, { placement: "corner" });
  await settled(page);
  await page.getByText("blocked").first().waitFor();
  for (const column of ["Expansions", "Time"]) {
    assert.equal(await cell(page, 0, column).textContent(), "–", column);
  }
  assert.equal(await page.locator("#race td.best").count(), 0);
});

test("an optimal path at any angle is certified with 0 %, between corners and between centers", async () => {
  const page = await site.open();
  await loadRows(page, emptyRows(12, 12), [0, 0], [9, 4]);
  await setLanes(page, { engine: "theta" }, { engine: "anya", k: "any", placement: "corner" });
  await settled(page);
  await page.waitForFunction(() => {
    const { list } = /** @type {any} */ (globalThis).mediant.lanes;
    return list.every((/** @type {any} */ lane) => lane.answer?.reference);
  });
  await page.waitForTimeout(100);
  assert.equal(await cell(page, 1, "Certificate").textContent(), "0 %");
  // √97, the straight line.
  assert.equal(await cell(page, 0, "Certificate").textContent(), "0 %");
  assert.equal(await cell(page, 0, "Excess").textContent(), "0 %");
});

test("hub labels expand nothing, and the page says so", async () => {
  const page = await site.open();
  await loadRows(page, ["........", "..####..", "........"], [3, 0], [4, 2]);
  await setLanes(page, { engine: "subgoal" }, {});
  await settled(page);
  await page.waitForTimeout(100);
  const [labels, searched] = await lanes(page);
  assert.deepEqual([labels.index.levels, labels.index.searchedBy], ["labels", "subgoal"]);
  assert.deepEqual([labels.answer.expanded, labels.answer.events], [0, 0]);
  assert.deepEqual([searched.index.levels, searched.index.searchedBy], [undefined, "astar"]);
  assert.ok(Math.abs(labels.answer.length - searched.answer.length) < 1e-9);
  assert.equal(await cell(page, 0, "Expansions").textContent(), "no search");
  // The path over N(3) is not the shortest at any angle.
  await page.evaluate(() => /** @type {any} */ (globalThis).mediant.model.set({ overlay: "search" }));
  await page.waitForTimeout(100);
  const legend = await page.locator(".stage-legend").first().textContent();
  assert.equal(legend, "shortest at any angleno search: hub labels");
  // It wins no race of expansions; it arrives at once, and in real time when its time is over.
  const best = (/** @type {number} */ lane) =>
    cell(page, lane, "Expansions").evaluate((element) => element.classList.contains("best"));
  assert.equal(await best(0), false);
  const arrived = await page.evaluate(() => {
    const { player } = /** @type {any} */ (globalThis).mediant;
    const seen = [];
    for (const mode of ["pace", "time"]) {
      player.mode = mode;
      player.seek(0);
      seen.push(player.arrived(0), player.arrived(1));
    }
    return seen;
  });
  assert.deepEqual(arrived, [true, false, false, false]);
});

test("a caption is read out in parts", async () => {
  const page = await site.open();
  await loadRows(page, emptyRows(12, 12), [0, 0], [9, 4]);
  await setLanes(page, {});
  await settled(page);
  await page.getByRole("button", { name: "A*, k = 3", exact: true }).waitFor();
});

/** All text that eyes see. @param {Page} page */
const seen = (page) =>
  page.evaluate(() => {
    const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    const found = [];
    while (texts.nextNode()) {
      const { parentElement: parent, textContent } = texts.currentNode;
      const isSeen = parent?.checkVisibility() && !parent.closest("option, .sr-only, .stage-help, .skip");
      if (isSeen) found.push(textContent);
    }
    return found.join(" ");
  });

test("the length is said once: beside the knob, and in a race in its table", async () => {
  const page = await site.open();
  await loadRows(page, emptyRows(12, 12), [0, 0], [9, 4]);
  await setLanes(page, {});
  await settled(page);
  const said = async () => (await seen(page)).split("10.66").length - 1;
  await page.locator("#readout").getByText("10.66").waitFor();
  assert.equal(await said(), 1);
  for (const column of ["Length", "Excess", "Certificate"]) assert.ok(await cell(page, 0, column).isHidden());
  await page.getByRole("button", { name: "Add a lane" }).click();
  await settled(page);
  await page.waitForTimeout(100);
  assert.equal(await said(), 3, "beside the knob, and of each lane");
  for (const column of ["Length", "Excess", "Certificate"])
    assert.ok(await cell(page, 0, column).isVisible());
});

test("words are explained where they stand, with a picture, and not before they are needed", async () => {
  for (const viewport of [
    { width: 1440, height: 900 },
    { width: 380, height: 760 },
  ]) {
    const page = await site.open({ viewport });
    await page.waitForTimeout(200);
    assert.doesNotMatch(await seen(page), /excess|certificate|gaps/i);
    if (viewport.width < 700) await page.getByRole("tab", { name: "Race" }).click();
    await page.getByRole("button", { name: "Add a lane" }).click();
    for (const word of ["excess", "certificate", "expansion"]) await opens(page, word, viewport);
    if (viewport.width < 700) await page.getByRole("tab", { name: "Engine" }).click();
    await page.getByText("Rules of motion").click();
    for (const word of ["vertices", "gap", "smoothing"]) await opens(page, word, viewport);
  }
});

/** @param {Page} page @param {string} word @param {{ width: number, height: number }} viewport */
async function opens(page, word, { width, height }) {
  await page.getByRole("button", { name: `What is meant by ${word}?` }).click();
  const note = page.getByRole("note").filter({ hasText: word });
  await note.waitFor();
  assert.ok(await note.locator("svg").first().isVisible(), word);
  const box = await note.boundingBox();
  assert.ok(box && box.x >= 0 && box.y >= 0, `${word}: ${JSON.stringify(box)}`);
  assert.ok(box.x + box.width <= width && box.y + box.height <= height, `${word}: ${JSON.stringify(box)}`);
  await picture(page, `note-${word}-${width}`);
  await page.keyboard.press("Escape");
  await note.waitFor({ state: "hidden" });
}

test("where the agent does not fit, the sentence says so", async () => {
  const page = await site.open();
  await loadRows(page, emptyRows(12, 12), [0, 0], [6, 6]);
  await setLanes(page, {});
  await page.evaluate(() => /** @type {any} */ (globalThis).mediant.model.set({ radius: 2 }));
  await settled(page);
  await page
    .getByText("An agent of radius 2 does not fit at the start (0, 0): move the start, or make")
    .first()
    .waitFor();
  assert.deepEqual(await messages(page), []);
});

for (const [width, height] of /** @type {const} */ ([
  [1440, 900],
  [1100, 760],
  [380, 760],
])) {
  test(`${width} pixels: four engines are told by their captions, and no lane is out of reach`, async () => {
    const page = await site.open({ viewport: { width, height } });
    await setLanes(
      page,
      ...["theta", "lazy-theta", "subgoal", "anya"].map((engine) => {
        const k = engine === "anya" ? "any" : 3;
        return { engine, k, placement: "corner" };
      }),
    );
    await settled(page);
    assert.equal((await scene(page)).lanes.length, 4);
    await page.waitForTimeout(300);
    const found = await page.evaluate(() => {
      const box = (/** @type {Element | null} */ element) => element?.getBoundingClientRect();
      const names = [...document.querySelectorAll(".stage-engine")].map((name) => box(name)?.width ?? 0);
      const panes = [...document.querySelectorAll(".stage-pane")];
      const pane = panes.find((pane) => pane.querySelector(".stage-optimum"));
      const part = (/** @type {string} */ name) => box(pane?.querySelector(name) ?? null);
      const [k, legend] = [part(".stage-k"), part(".stage-legend")];
      const scroll = document.querySelector(".race-scroll");
      const hidden = scroll ? scroll.scrollWidth - scroll.clientWidth : 0;
      const covered = k && legend?.width && legend.top < k.bottom ? k.right - legend.left : 0;
      return { names, hidden, covered };
    });
    // "Anya" takes 34 pixels.
    for (const name of found.names) assert.ok(name > 30, `${found.names}`);
    assert.ok(found.covered <= 0, `the legend covers ${found.covered} pixels of k`);
    assert.ok(found.hidden <= 0, `${found.hidden} pixels of the table are hidden`);
  });
}
