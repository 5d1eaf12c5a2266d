// The colors of the canvases, at places of the map where they are known.

import assert from "node:assert/strict";
import { test } from "node:test";
import { colorsAt, emptyRows, isColor, lanes, loadRows, setLanes, token } from "../act.mjs";
import { Site, settled } from "../browser.mjs";
import { load, spaceOf } from "../truth.mjs";

/** @typedef {import("playwright-core").Page} Page */
/** @typedef {[number, number]} Point */

const site = new Site();
const [WIDTH, HEIGHT] = [12, 8];

/** A window with a map of 12 × 8 cells. @param {object[]} setups */
async function open(...setups) {
  const page = await site.open();
  await show(page, "none");
  await loadRows(page, emptyRows(WIDTH, HEIGHT), [1, 4], [10, 4]);
  await setLanes(page, ...setups);
  await settled(page);
  return page;
}

/** @param {Page} page @param {string} overlay */
const show = (page, overlay) =>
  page.evaluate((overlay) => /** @type {any} */ (globalThis).mediant.model.set({ overlay }), overlay);

/** Calls a method of the model. @param {Page} page @param {string} name @param {any[]} values */
const call = (page, name, ...values) =>
  page.evaluate(
    ([name, values]) => /** @type {any} */ (globalThis).mediant.model[name](...values),
    [name, values],
  );

/** Places along a way, so many on each leg. @param {number[]} path @param {number} shift
 *  @param {number} count */
function along(path, shift, count) {
  /** @type {Point[]} */
  const places = [];
  for (let i = 0; i + 3 < path.length; i += 2) {
    for (let n = 1; n < count; n += 1) {
      const at = (/** @type {number} */ c) => path[c] + ((path[c + 2] - path[c]) * n) / count + shift;
      places.push([at(i), at(i + 1)]);
    }
  }
  return places;
}

/** The share of the places that have a color. @param {Page} page @param {Point[]} places @param {string} name
 *  @param {number} [lane] */
async function share(page, places, name, lane = 0) {
  const [color, found] = [await token(page, name), await colorsAt(page, places, lane)];
  return found.filter((one) => isColor(one, color)).length / places.length;
}

test("a path goes through centers of cells, or along the lines between them; ends lie on it", async () => {
  const page = await open({ engine: "astar" });
  for (const [placement, y] of /** @type {const} */ ([
    ["center", 4.5],
    ["corner", 4],
  ])) {
    await setLanes(page, { placement });
    await settled(page);
    const row = (/** @type {number} */ y) => [2.3, 4.6, 6.2, 8.7].map((x) => /** @type {Point} */ ([x, y]));
    assert.equal(await share(page, row(y), "lane-0"), 1, `the path at ${placement}s`);
    for (const beside of [y - 0.5, y + 0.5]) assert.equal(await share(page, row(beside), "lane-0"), 0);
    await call(page, "moveEnd", "start", [5, 1]);
    await call(page, "moveEnd", "goal", [5, 6]);
    await settled(page);
    const column = (/** @type {number} */ x) => [2.3, 3.6, 4.7].map((y) => /** @type {Point} */ ([x, y]));
    const shift = y - 4;
    assert.equal(await share(page, column(5 + shift), "lane-0"), 1, `the path down at ${placement}s`);
    for (const beside of [4.5, 5.5]) assert.equal(await share(page, column(beside + shift), "lane-0"), 0);
    await call(page, "undo");
    await call(page, "undo");
    await settled(page);
    // The letter is in the middle of the badge.
    const pixel = await page.evaluate(() => 1 / /** @type {any} */ (globalThis).mediant.stage.view.scale);
    for (const [name, x] of /** @type {const} */ ([
      ["start", 1],
      ["goal", 10],
    ]))
      for (const side of [-8, 8])
        assert.equal(await share(page, [[x + shift + side * pixel, y]], name), 1, `${name} at ${placement}s`);
  }
});

test("walls are where cells are blocked, also after an edit and its undo", async () => {
  const page = await open({ engine: "astar" });
  const cell = 2 * WIDTH + 3;
  /** @type {Point[]} */
  const inside = [
    [3.2, 2.2],
    [3.8, 2.8],
    [3.5, 2.5],
  ];
  /** @type {Point[]} */
  const beside = [
    [2.8, 2.5],
    [4.2, 2.5],
    [3.5, 1.8],
    [3.5, 3.2],
  ];
  for (const [act, isWall] of /** @type {[() => Promise<void>, boolean][]} */ ([
    [async () => {}, false],
    [() => call(page, "paint", [cell], true), true],
    [() => call(page, "undo"), false],
    [() => call(page, "redo"), true],
  ])) {
    await act();
    assert.equal(await share(page, inside, "wall"), Number(isWall));
    assert.equal(await share(page, beside, "free"), 1);
  }
});

test("each pane draws the path of its lane, and the optimum where that is shorter", async () => {
  const page = await open({ k: 2, placement: "corner" }, { engine: "anya", k: "any", placement: "corner" });
  await call(page, "moveEnd", "start", [1, 1]);
  await call(page, "moveEnd", "goal", [10, 6]);
  await settled(page);
  await page.waitForFunction(() => {
    const { list } = /** @type {any} */ (globalThis).mediant.lanes;
    return list.every((/** @type {any} */ lane) => lane.answer.reference);
  });
  const [steps, straight] = (await lanes(page)).map(({ answer }) => along(answer.path, 0, 400));
  assert.ok((await share(page, steps, "lane-0", 0)) > 0.6);
  assert.ok((await share(page, straight, "lane-1", 1)) > 0.4, "dashed");
  assert.ok((await share(page, steps, "lane-1", 1)) < 0.1);
  assert.ok((await share(page, straight, "lane-0", 0)) < 0.2);
  assert.ok((await share(page, straight, "reference", 0)) > 0.9, "the optimum is a line above the path");
  // Badges of ends have the same color.
  const inner = straight.slice(40, -40);
  assert.equal(await share(page, inner, "reference", 1), 0, "an optimal path has none");
});

for (const colorScheme of /** @type {const} */ (["light", "dark"])) {
  test(`${colorScheme}: at every k the optimum is seen, over walls and what lies over the map`, async () => {
    const page = await site.open({ colorScheme });
    await setLanes(page, { k: 2, placement: "corner" });
    for (const [what, k, overlay] of /** @type {const} */ ([
      ["nothing", 2, "none"],
      ["nothing", 3, "none"],
      ["nothing", 5, "none"],
      ["the search", 4, "search"],
      ["distances", 3, "distances"],
      ["clearance", 6, "clearance"],
    ])) {
      await page.evaluate((k) => /** @type {any} */ (globalThis).mediant.model.setLane(0, { k }), k);
      await show(page, overlay);
      await settled(page);
      await page.waitForFunction(
        () => /** @type {any} */ (globalThis).mediant.lanes.list[0].answer.reference,
      );
      const [{ answer }] = await lanes(page);
      // Not below the badges of the ends.
      const line = along(Array.from(Object.values(answer.reference.path)), 0, 40).slice(20, -20);
      const seen = await share(page, line, "reference");
      assert.ok(seen > 0.95, `k = ${k}, ${what}: ${seen} of the line`);
    }
    // Between the path and the optimum there is a shade of the lane's color.
    await show(page, "none");
    await page.evaluate(() => /** @type {any} */ (globalThis).mediant.model.setLane(0, { k: 2 }));
    await loadRows(page, emptyRows(WIDTH, HEIGHT), [1, 1], [10, 6]);
    await page.waitForFunction(() => /** @type {any} */ (globalThis).mediant.lanes.list[0].answer.reference);
    const { path } = (await lanes(page))[0].answer;
    const side = path.some(
      (/** @type {number} */ x, /** @type {number} */ i) => i % 2 === 0 && x > 4 && path[i + 1] < 2,
    );
    const [between, outside] = await colorsAt(
      page,
      side
        ? [
            [8.5, 3.5],
            [2.5, 5.5],
          ]
        : [
            [2.5, 3.5],
            [8.5, 1.5],
          ],
    );
    assert.ok(!isColor(between, outside), `${between} and ${outside}`);
  });
}

test("from the nearest vertex a dotted line leads to the goal that cannot be reached", async () => {
  const page = await open({ engine: "astar" });
  const wall = Array.from({ length: HEIGHT }, (_, y) => y * WIDTH + 7);
  await call(page, "paint", wall, true);
  await call(page, "set", { nearest: true });
  await settled(page);
  assert.deepEqual((await lanes(page))[0].answer.path.slice(-2), [6, 4]);
  const line = along([7, 4, 9, 4], 0.5, 300);
  assert.ok((await share(page, line, "danger")) > 0.1);
  await call(page, "paint", wall.slice(0, 1), false);
  await settled(page);
  assert.equal(await share(page, line, "danger"), 0);
});

/** The parts of the map that the page shows, once they are those of the first lane. @param {Page} page
 *  @param {string} placement */
async function partsOf(page, placement) {
  await page.waitForFunction((placement) => {
    const { parts, list } = /** @type {any} */ (globalThis).mediant.lanes;
    return parts?.placement === placement && !list[0].stale;
  }, placement);
  return page.evaluate(() => {
    const { width, values } = /** @type {any} */ (globalThis).mediant.lanes.parts;
    return { width, values: /** @type {number[]} */ (Array.from(values)) };
  });
}

test("without a path, what the start reaches is shaded, and what the goal reaches is striped", async () => {
  const page = await open({ engine: "astar" });
  const mediant = await load();
  // Two walls that touch at a corner: closed for a path, but at corners with open gaps.
  const at = Array.from({ length: HEIGHT }, (_, y) => (y < 4 ? 6 : 5));
  const wall = at.map((x, y) => y * WIDTH + x);
  const rows = at.map((x) => `${".".repeat(x)}#${".".repeat(WIDTH - x - 1)}`);
  await call(page, "paint", wall, true);
  for (const change of [
    { k: 3 },
    { k: 5, corners: "one" },
    { k: 2 },
    { placement: "corner", gap: "closed" },
  ]) {
    await setLanes(page, change);
    await settled(page);
    const setup = { k: 3, placement: "center", corners: "never", gap: "open", ...change };
    const space = spaceOf(mediant, rows, setup);
    const { width, values } = await partsOf(page, setup.placement);
    assert.equal(width, WIDTH + (setup.placement === "corner" ? 1 : 0));
    const reaches = (/** @type {number[]} */ end, /** @type {number[]} */ vertex) =>
      space.isFree(vertex) && space.connected(end, vertex);
    values.forEach((value, v) => {
      const vertex = [v % width, Math.floor(v / width)];
      const truth = reaches([1, 4], vertex) ? 1 : reaches([10, 4], vertex) ? 2 : 0;
      assert.equal(value, truth, `${JSON.stringify(change)}: vertex ${vertex}`);
    });
    const row = [2.3, 9.3, 10.3, 11.3].map((x) => /** @type {Point} */ ([x, 1.3]));
    const [left, ...right] = await colorsAt(page, row);
    assert.ok(isColor(left, await token(page, "part-start")), `${left}`);
    const [goal, stripe] = [await token(page, "part-goal"), await token(page, "part-stripe")];
    assert.ok(right.every((color) => isColor(color, goal) || isColor(color, stripe)));
    assert.ok(right.some((color) => isColor(color, stripe)));
    const legend = (await page.locator(".stage-legend").textContent()) ?? "";
    assert.match(legend, /start reaches this.*goal is in this/s);
    assert.match((await page.locator("#worth").textContent()) ?? "", /walls part the start, shaded/);
  }
  await call(page, "paint", [wall[2]], false);
  await settled(page);
  await page.waitForFunction(() => !(/** @type {any} */ (globalThis).mediant.lanes.parts));
  assert.equal(await share(page, [[2.3, 1.3]], "free"), 1);
});

test("as much of the search is drawn as the player shows, and the path at its end", async () => {
  const page = await open({ engine: "dijkstra", k: 3 });
  await show(page, "search");
  /** @type {Point[]} */
  const centers = [];
  for (let y = 0; y < HEIGHT; y += 1) for (let x = 0; x < WIDTH; x += 1) centers.push([x + 0.5, y + 0.5]);
  const free = await token(page, "free");
  for (const position of [0, 1, 2, 9, 20]) {
    const seen = await page.evaluate((position) => {
      const { player, lanes } = /** @type {any} */ (globalThis).mediant;
      player.seek(position);
      const { steps } = lanes.list[0].answer;
      let [count, end] = [0, 0];
      for (; end < steps.length && (count += steps[end] & 1) <= position; end += 1);
      const shown = position === 0 ? [] : steps.slice(0, end);
      return Array.from(shown, (/** @type {number} */ step) => step >>> 1);
    }, position);
    const colors = await colorsAt(page, centers);
    const ends = [4 * WIDTH + 1, 4 * WIDTH + 10];
    colors.forEach((color, at) => {
      if (!ends.includes(at))
        assert.equal(!isColor(color, free), seen.includes(at), `vertex ${at} after ${position} expansions`);
    });
    assert.equal(await share(page, [[5.2, 4.5]], "lane-0"), 0, `no path after ${position} expansions`);
  }
  await page.evaluate(() => {
    const { player } = /** @type {any} */ (globalThis).mediant;
    player.seek(player.length);
  });
  assert.equal(await share(page, [[5.2, 4.5]], "lane-0"), 1);
});

test("canvases follow the theme of the page and of the system", async () => {
  const page = await open({ engine: "astar" });
  await call(page, "paint", [2 * WIDTH + 3], true);
  // Waits until the canvases have the colors of the theme: the browser tells of a change when it will.
  const seen = async (other = "") => {
    for (let look = 0; ; look += 1) {
      const found = await colorsAt(page, [
        [3.5, 2.5],
        [6.5, 2.5],
        [5.2, 4.5],
      ]);
      const colors = await Promise.all(["wall", "free", "lane-0"].map((name) => token(page, name)));
      const isDone = String(found[1]) !== other && found.every((color, at) => isColor(color, colors[at]));
      if (isDone) return String(found[1]);
      if (look === 50) return `${found.join(" ")}, not ${colors.join(" ")}`;
      await page.waitForTimeout(100);
    }
  };
  const light = await seen();
  await page.emulateMedia({ colorScheme: "dark" });
  const dark = await seen(light);
  // A color as numbers, not a sentence of what was awaited.
  for (const color of [light, dark]) assert.match(color, /^\d+,\d+,\d+$/);
  const button = page.getByRole("button", { name: /^Theme/ });
  await button.click();
  assert.equal(await seen(dark), light);
  await button.click();
  assert.equal(await seen(light), dark);
});

test("fields are of the active lane's motion, of the goal, the map and the agent as they are", async () => {
  const page = await open({ k: 2 }, { k: 3, corners: "always" });
  const mediant = await load();
  await show(page, "distances");
  for (const [act, what] of /** @type {[() => Promise<void>, string][]} */ ([
    [async () => {}, "lane 1"],
    [() => call(page, "set", { active: 1 }), "lane 2"],
    [() => call(page, "moveEnd", "goal", [7, 2]), "another goal"],
    [() => call(page, "paint", [2 * WIDTH + 3, 3 * WIDTH + 3, 4 * WIDTH + 3], true), "a wall"],
    [() => call(page, "set", { radius: 1 }), "a disc"],
  ])) {
    await act();
    const { rows, setup, goal, radius } = await page.evaluate(() => {
      const { cells, lanes, active, goal, radius } = /** @type {any} */ (globalThis).mediant.model;
      const text = Array.from(cells, (cell) => (cell ? "#" : ".")).join("");
      return { rows: text.match(/.{12}/g) ?? [], setup: lanes[active], goal, radius };
    });
    const truth = Array.from(spaceOf(mediant, rows, setup, radius).field(goal).distances(), Math.fround);
    await page
      .waitForFunction(
        (truth) => {
          const { field } = /** @type {any} */ (globalThis).mediant.lanes;
          const isSame = (/** @type {number} */ value, /** @type {number} */ at) =>
            truth[at] === null ? value === Infinity : value === truth[at];
          return field?.kind === "distances" && field.values.every(isSame);
        },
        truth.map((value) => (value === Infinity ? null : value)),
        { timeout: 10_000 },
      )
      .catch(() => {
        assert.fail(`${what}: the distances are others than the package's`);
      });
    const active = await page.evaluate(() => /** @type {any} */ (globalThis).mediant.model.active);
    // A disc does not fit along the border, which is hatched in all panes.
    if (radius > 0) continue;
    /** @type {Point[]} */
    const far = [
      [0.2, 0.8],
      [0.3, 6.2],
    ];
    assert.ok((await share(page, far, "free", active)) < 1, `${what}: colors in the active pane`);
    assert.equal(await share(page, far, "free", 1 - active), 1, `${what}: none in the other`);
  }
});
