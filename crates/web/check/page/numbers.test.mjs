// The numbers that the page says of a path, against those of the package: lengths under every rule, excess,
// certificate, codes of errors, what is saved of which lane.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { emptyRows, lanes, loadRows, rows, scene, setLanes } from "../act.mjs";
import { Site, settled } from "../browser.mjs";
import { lengthOf, load, spaceOf } from "../truth.mjs";

/** @typedef {import("playwright-core").Page} Page */

const site = new Site();
/** Two walls that touch at a corner, with a way around. */
const GAP = ["....#....", "....#....", "....#....", "...#.....", "...#.....", "...#.....", "........."];

/** Waits for the optimum of every lane, which comes after its answer. @param {Page} page */
async function judged(page) {
  await settled(page);
  await page.waitForFunction(() => {
    const { list } = /** @type {any} */ (globalThis).mediant.lanes;
    return list.every((/** @type {any} */ lane) => lane.answer.reference);
  });
  return lanes(page);
}

/** A setup with all its fields. @param {object} change */
const setup = (change) => ({
  engine: "astar",
  k: 3,
  placement: "center",
  corners: "never",
  gap: "open",
  smooth: "",
  ...change,
});

/** @param {number} a @param {number} b @param {string} what */
const near = (a, b, what) => assert.ok(Math.abs(a - b) < 1e-9, `${what}: ${a}, not ${b}`);

test("each rule of motion and smoothing have the length that the package finds", async () => {
  const page = await site.open();
  const mediant = await load();
  await loadRows(page, GAP, [2, 2], [6, 4]);
  const closed = { placement: "corner", gap: "closed" };
  for (const changes of [
    [{ corners: "never" }, { corners: "one" }, { corners: "always" }],
    [{ placement: "corner", gap: "open" }, closed],
    [closed, { ...closed, smooth: "taut" }],
    [{ k: 2 }, { k: 4 }],
    // At any angle between centers: gaps are closed, unless corners are always cut.
    [
      { engine: "anya", k: "any" },
      { engine: "anya", k: "any", corners: "always" },
    ],
  ]) {
    const setups = changes.map(setup);
    await setLanes(page, ...changes);
    await settled(page);
    const answers = await lanes(page);
    const lengths = setups.map((setup) => lengthOf(mediant, GAP, setup, [2, 2], [6, 4]));
    assert.equal(new Set(lengths).size, lengths.length, `the map tells these apart: ${lengths}`);
    answers.forEach(({ answer }, lane) => near(answer.length, lengths[lane], JSON.stringify(setups[lane])));
  }
});

test("a disc goes where it fits", async () => {
  const page = await site.open();
  const mediant = await load();
  const wall = `${".".repeat(12)}#${".".repeat(11)}`;
  const map = emptyRows(24, 13).map((row, y) => (y === 6 || y > 9 ? row : wall));
  await loadRows(page, map, [4, 6], [20, 6]);
  await setLanes(page, {}, { placement: "corner", k: 4 });
  const seen = [];
  for (const radius of [0, 1]) {
    await page.evaluate((radius) => /** @type {any} */ (globalThis).mediant.model.set({ radius }), radius);
    await settled(page);
    const { lanes: setups } = await scene(page);
    (await lanes(page)).forEach(({ answer }, lane) => {
      assert.equal(answer.status, "found");
      const truth = lengthOf(mediant, map, setups[lane], [4, 6], [20, 6], radius);
      near(answer.length, truth, `lane ${lane}, radius ${radius}`);
      seen.push(answer.length);
    });
  }
  assert.ok(seen[2] > seen[0] + 1 && seen[3] > seen[1] + 1, `around: ${seen}`);
});

test("excess and certificate are those of the lane's path and motion", async () => {
  const page = await site.open();
  const mediant = await load();
  await loadRows(page, GAP, [1, 0], [7, 5]);
  const setups = [
    setup({ placement: "corner", k: 3, gap: "closed" }),
    setup({ placement: "corner", k: 2 }),
    setup({ engine: "theta", placement: "corner", gap: "closed" }),
    setup({ engine: "hpa", k: 2 }),
  ];
  await setLanes(page, ...setups);
  const answers = await judged(page);
  const percent = (/** @type {number} */ ratio) => {
    const text = ((ratio - 1) * 100).toFixed(2);
    return Number(text) === 0 ? "0 %" : `+${text} %`;
  };
  for (const [lane, one] of setups.entries()) {
    const { answer } = answers[lane];
    const judge = { ...one, engine: "anya", k: "any" };
    const best = lengthOf(mediant, GAP, judge, [1, 0], [7, 5]);
    near(answer.reference.length, best, `lane ${lane + 1}'s optimum`);
    assert.equal(answer.reference.what, "any");
    const found = spaceOf(mediant, GAP, one).prepare(one.engine).planner().find([1, 0], [7, 5]);
    const bound = Math.max(found.distance / found.anyAngleLowerBound, 1);
    assert.equal(answer.bound, bound, `lane ${lane + 1}'s certificate`);
    await page.evaluate((active) => /** @type {any} */ (globalThis).mediant.model.set({ active }), lane);
    const figures = page.locator("#readout dd.value");
    const expected = [answer.length.toFixed(2), percent(answer.length / best)];
    await page
      .waitForFunction(
        (expected) => {
          const found = [...document.querySelectorAll("#readout dd.value")].map(
            ({ textContent }) => textContent,
          );
          return String(found) === String(expected);
        },
        expected,
        { timeout: 10_000 },
      )
      .catch(() => {});
    assert.deepEqual(await figures.allTextContents(), expected, `lane ${lane + 1}`);
    const cell = (/** @type {string} */ name) =>
      page.locator(`tbody tr:nth-child(${lane + 1}) td[data-label="${name}"]`).textContent();
    assert.equal(await cell("Length"), expected[0]);
    assert.equal(await cell("Expansions"), String(answer.expanded));
    assert.equal(await cell("Excess"), expected[1]);
    // What is proven is in the race alone.
    const proven = percent(bound).replace("+", "");
    assert.equal(await cell("Certificate"), bound === 1 ? proven : `≤ ${proven}`);
  }
  const fewest = Math.min(...answers.map(({ answer }) => answer.expanded));
  const best = await page
    .locator('td[data-label="Expansions"]')
    .evaluateAll((cells) => cells.map((cell) => cell.classList.contains("best")));
  assert.deepEqual(
    best,
    answers.map(({ answer }) => answer.expanded === fewest),
  );
});

test("an invalid query has the package's code and text", async () => {
  const page = await site.open();
  const mediant = await load();
  await setLanes(page, {});
  await loadRows(page, GAP, [4, 0], [7, 5]);
  const [{ answer }] = await lanes(page);
  assert.equal(answer.status, "invalid");
  const { lanes: setups } = await scene(page);
  assert.throws(
    () => lengthOf(mediant, GAP, setups[0], [4, 0], [7, 5]),
    (/** @type {any} */ error) => {
      assert.equal(answer.error.code, error.code);
      assert.ok(
        answer.error.message.toLowerCase().includes(error.message.toLowerCase()),
        answer.error.message,
      );
      return true;
    },
  );
});

/** The text that a button of the menu saves. @param {Page} page @param {RegExp} what */
async function saved(page, what) {
  await page.locator("#save > summary").click();
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.locator("#save").getByRole("button", { name: what }).click(),
  ]);
  return readFileSync(await download.path(), "utf8");
}

test("the search and the picture that are saved are those of the active lane", async () => {
  const page = await site.open();
  const mediant = await load();
  await loadRows(page, GAP, [1, 0], [7, 5]);
  const setups = [setup({ k: 2 }), setup({ engine: "dijkstra", k: 4, placement: "corner" })];
  await setLanes(page, ...setups);
  await settled(page);
  const files = [];
  for (const [active, one] of setups.entries()) {
    await page.evaluate((active) => /** @type {any} */ (globalThis).mediant.model.set({ active }), active);
    const planner = spaceOf(mediant, await rows(page), one)
      .prepare(one.engine)
      .planner();
    const trace = new mediant.Trace(true);
    planner.find([1, 0], [7, 5], undefined, trace);
    assert.equal(await saved(page, /Posthoc/), trace.posthoc(planner, [1, 0], [7, 5]), `lane ${active + 1}`);
    files.push(await saved(page, /SVG/));
  }
  await setLanes(page, setups[1]);
  await settled(page);
  assert.equal(await saved(page, /SVG/), files[1]);
  assert.notEqual(files[0], files[1]);
});
