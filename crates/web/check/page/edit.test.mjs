// Walls: drawn, erased, filled, taken back.

import assert from "node:assert/strict";
import { test } from "node:test";
import { badge, drag, emptyRows, generate, lanes, loadRows, place, rows, scene, setLanes } from "../act.mjs";
import { picture, Site, settled } from "../browser.mjs";

const site = new Site();

/** A window with an empty map of 20 × 12 cells, ends at its left and right. */
async function open() {
  const page = await site.open();
  await setLanes(page, { engine: "astar" });
  await loadRows(page, emptyRows(20, 12), [1, 6], [18, 6]);
  return page;
}

/** @param {import("playwright-core").Page} page @param {string} name */
const tool = (page, name) => page.getByRole("button", { name, exact: true }).click();
/** @param {string[]} map */
const walls = (map) => map.join("").split("#").length - 1;
/** @param {import("playwright-core").Page} page */
async function lengthNow(page) {
  await settled(page);
  return (await lanes(page))[0].answer.length;
}

test("a drawn wall is a line of cells without gaps, and the path goes around it", async () => {
  const page = await open();
  assert.equal(await lengthNow(page), 17);
  await tool(page, "Draw");
  assert.equal(
    await page.getByRole("button", { name: "Draw", exact: true }).getAttribute("aria-pressed"),
    "true",
  );
  await drag(
    page,
    [
      [10, 0],
      [10, 9],
    ],
    3,
  );
  const map = await rows(page);
  for (let y = 0; y <= 9; y += 1) assert.equal(map[y][10], "#", `row ${y}: ${map[y]}`);
  assert.ok((await lengthNow(page)) > 20);
  await picture(page, "edit-drawn");

  await tool(page, "Erase");
  await drag(page, [
    [10, 6],
    [10, 6],
  ]);
  assert.equal((await rows(page))[6][10], ".");
  assert.equal(await lengthNow(page), 17);
});

test("a rectangle, and a fill", async () => {
  const page = await open();
  await tool(page, "Rectangle");
  await drag(page, [
    [5, 2],
    [8, 4],
  ]);
  const map = await rows(page);
  assert.equal(walls(map), 12, map.join("\n"));
  for (const [x, y] of [
    [5, 2],
    [8, 2],
    [5, 4],
    [8, 4],
  ])
    assert.equal(map[y][x], "#");

  await tool(page, "Fill");
  const inside = await place(page, 0, 0);
  await page.mouse.click(inside.x, inside.y);
  const filled = await rows(page);
  assert.ok(walls(filled) > 200, `the fill takes the connected area:\n${filled.join("\n")}`);
  await page.getByRole("button", { name: "Undo" }).click();
  assert.deepEqual(await rows(page), map);
});

test("Shift and the other button do the opposite of a tool", async () => {
  const page = await open();
  await tool(page, "Draw");
  const stroke = /** @type {[number, number][]} */ ([
    [4, 2],
    [9, 2],
  ]);
  const row = async () => (await rows(page))[2].slice(3, 11);
  await drag(page, stroke);
  assert.equal(await row(), ".######.");
  await page.keyboard.down("Shift");
  await drag(page, stroke);
  await page.keyboard.up("Shift");
  assert.equal(await row(), "........");
  await tool(page, "Erase");
  await page.keyboard.down("Shift");
  await drag(page, stroke);
  await page.keyboard.up("Shift");
  assert.equal(await row(), ".######.");
  await tool(page, "Draw");
  await drag(page, stroke, 6, "right");
  assert.equal(await row(), "........");
});

test("an end lands on the cell or the corner under the pointer; Escape puts it back", async () => {
  const page = await open();
  for (const placement of ["center", "corner"]) {
    await setLanes(page, { placement });
    await settled(page);
    const shift = placement === "corner" ? 0.5 : 0;
    await drag(page, [await badge(page, "goal"), [12 - shift, 3 - shift]]);
    assert.deepEqual((await scene(page)).goal, [12, 3], placement);
    const [from, to] = [await place(page, ...(await badge(page, "goal"))), await place(page, 5, 9)];
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move(to.x, to.y, { steps: 4 });
    assert.notDeepEqual((await scene(page)).goal, [12, 3], placement);
    await page.keyboard.press("Escape");
    assert.deepEqual((await scene(page)).goal, [12, 3], placement);
    await page.mouse.up();
    assert.deepEqual((await scene(page)).goal, [12, 3], placement);
    await page.keyboard.press("Control+z");
    assert.deepEqual((await scene(page)).goal, [18, 6], "the drag before is one step of undo");
  }
});

test("each stroke is one step of undo and redo", async () => {
  const page = await open();
  const undo = page.getByRole("button", { name: "Undo" });
  const redo = page.getByRole("button", { name: "Redo" });
  const states = [await rows(page)];
  await tool(page, "Draw");
  for (const x of [4, 7, 13]) {
    await drag(page, [
      [x, 1],
      [x, 5],
      [x, 8],
    ]);
    states.push(await rows(page));
  }
  const lengths = [await lengthNow(page)];
  for (const state of [...states].reverse().slice(1)) {
    await undo.click();
    assert.deepEqual(await rows(page), state);
  }
  for (const state of states.slice(1)) {
    await page.keyboard.press("Control+Shift+Z");
    assert.deepEqual(await rows(page), state);
  }
  lengths.push(await lengthNow(page));
  assert.equal(lengths[0], lengths[1]);
  await page.keyboard.press("Control+Z");
  assert.deepEqual(await rows(page), states[2]);
  assert.equal((await scene(page)).canRedo, true);
  // The button follows in a moment: this waits until it can be pressed, and does not press it.
  await redo.click({ trial: true });
});

test("the memory of an engine does not grow with edits", async () => {
  const context = await site.context();
  await context.addInitScript(() => {
    /** The memory that workers told last, in bytes. */
    const memory = { last: 0 };
    const Own = Worker;
    Object.assign(globalThis, {
      memory,
      Worker: class extends Own {
        /** @param {string | URL} address @param {WorkerOptions} [options] */
        constructor(address, options) {
          super(address, options);
          this.addEventListener("message", ({ data }) => {
            if (data.type === "answer") memory.last = data.memory;
          });
        }
      },
    });
  });
  const page = await site.open({ context });
  await setLanes(page, { engine: "astar" });
  await generate(page, "rooms", 512);
  await settled(page, 60_000);
  const seen = [];
  for (let edit = 0; edit < 90; edit += 1) {
    await page.evaluate((edit) => {
      /** @type {any} */ (globalThis).mediant.model.paint([edit], edit % 2 === 0);
      /** @type {any} */ (globalThis).mediant.model.moveEnd("goal", [500, 400 + edit]);
    }, edit);
    await settled(page);
    seen.push(await page.evaluate(() => /** @type {any} */ (globalThis).memory.last));
  }
  assert.ok(seen[9] > 0 && seen[89] < 1.5 * seen[9], `${seen[9]} bytes, then ${seen[89]}`);
});

test("many edits, while four engines search", async () => {
  const page = await open();
  await setLanes(
    page,
    { engine: "jps-block" },
    { engine: "subgoal" },
    { engine: "hpa" },
    { engine: "anya", k: "any", placement: "corner" },
  );
  await settled(page);
  await tool(page, "Draw");
  for (let x = 3; x < 17; x += 2)
    await drag(
      page,
      [
        [x, x % 4 === 1 ? 0 : 2],
        [x, x % 4 === 1 ? 9 : 11],
      ],
      4,
    );
  await settled(page);
  const answers = await lanes(page);
  for (const { answer, phase, message } of answers) {
    assert.equal(phase, "done", message);
    assert.equal(answer.status, "found");
  }
  assert.ok(Math.abs(answers[0].answer.length - answers[1].answer.length) < 1e-6);
  assert.ok(answers[2].answer.length >= answers[0].answer.length - 1e-6);
  await picture(page, "edit-four-engines");
});
