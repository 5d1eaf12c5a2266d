// Ends that are dragged: the path follows within a frame, on maps as large as those of games.

import assert from "node:assert/strict";
import { test } from "node:test";
import { badge, generate, lanes, place, quantile, rows, scene, setLanes } from "../act.mjs";
import { picture, Site, settled } from "../browser.mjs";
import { lengthOf, load } from "../truth.mjs";

const site = new Site();
const FRAME = 16;

/**
 * Drags the goal through the map for about two seconds, as a hand does, and returns what the page measured.
 * @param {import("playwright-core").Page} page @param {number} [steps]
 */
async function dragThrough(page, steps = 120) {
  const { width, height } = await scene(page);
  const at = await badge(page, "goal");
  const from = await place(page, ...at);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  for (let step = 1; step <= steps; step += 1) {
    const turn = (step / steps) * 2 * Math.PI;
    const x = Math.round(width * (0.5 + 0.4 * Math.cos(turn)));
    const y = Math.round(height * (0.5 + 0.4 * Math.sin(2 * turn)));
    const to = await place(page, x, y);
    await page.mouse.move(to.x, to.y);
    await page.waitForTimeout(10);
  }
  await page.mouse.up();
  await settled(page);
  return page.evaluate(() => {
    const { frames, latencies } = /** @type {any} */ (globalThis).mediant.stage;
    return { frames: [...frames], latencies: [...latencies] };
  });
}

for (const [name, side, setup] of /** @type {const} */ ([
  ["rooms", 512, { engine: "jps-block" }],
  ["city", 512, { engine: "jps-block", placement: "corner" }],
  ["cave", 1024, { engine: "subgoal" }],
])) {
  const title = `${name} of ${side} × ${side} cells, ${setup.engine}`;
  test(`${title}: frames of a drag take less than ${FRAME} ms`, async (t) => {
    const page = await site.open();
    await setLanes(page, setup);
    await generate(page, name, side);
    await settled(page, 60_000);
    // As everywhere, code that has run a little is faster.
    await dragThrough(page, 40);
    const { frames, latencies } = await dragThrough(page);
    const [work, delay] = [quantile(frames, 0.95), quantile(latencies, 0.95)];
    t.diagnostic(
      `${frames.length} frames, p95 ${work.toFixed(2)} ms, greatest ${Math.max(...frames).toFixed(2)} ms`,
    );
    t.diagnostic(
      `pointer to path: median ${quantile(latencies, 0.5).toFixed(1)} ms, p95 ${delay.toFixed(1)} ms`,
    );
    assert.ok(frames.length > 30, `only ${frames.length} frames were drawn`);
    assert.ok(latencies.length > 20, `only ${latencies.length} paths were drawn`);
    assert.ok(work < FRAME, `the page works ${work} ms in a frame`);
    await picture(page, `drag-${side}-${setup.engine}-${setup.placement ?? "center"}`);
  });
}

test("both ends can be dragged, and the path ends where they are", async () => {
  const page = await site.open();
  for (const end of /** @type {const} */ (["start", "goal"])) {
    const from = await badge(page, end);
    const { width, height, [end]: before } = await scene(page);
    const [x, y] = await page.evaluate(
      ([width, height]) => {
        const { cells } = /** @type {any} */ (globalThis).mediant.model;
        // A free cell among free cells, in the middle of the map.
        const isOpen = (/** @type {number} */ at) =>
          [0, 1, -1, width, -width, width + 1, -width - 1].every((by) => cells[at + by] === 0);
        const middle = Math.floor(height / 2) * width + Math.floor(width / 2);
        let at = middle;
        while (!isOpen(at)) at += 1;
        return [at % width, Math.floor(at / width)];
      },
      [width, height],
    );
    const [a, b] = [await place(page, ...from), await place(page, x, y)];
    await page.mouse.move(a.x, a.y);
    await page.mouse.down();
    await page.mouse.move((a.x + b.x) / 2, (a.y + b.y) / 2);
    await page.mouse.move(b.x, b.y);
    await page.mouse.up();
    await settled(page);
    const { [end]: after, start, goal } = await scene(page);
    assert.notDeepEqual(after, before);
    assert.ok(Math.hypot(after[0] - x - 0.5, after[1] - y - 0.5) < 1.5, `${after} is far from ${x}, ${y}`);
    const [{ answer }] = await lanes(page);
    assert.equal(answer.status, "found");
    assert.deepEqual(answer.path.slice(0, 2), start);
    assert.deepEqual(answer.path.slice(-2), goal);
    // The ends of a drag are one step back.
    await page.getByRole("button", { name: "Undo" }).click();
    assert.deepEqual((await scene(page))[end], before);
    await page.getByRole("button", { name: "Redo" }).click();
    assert.deepEqual((await scene(page))[end], after);
    await settled(page);
  }
});

test("of many changes the last one wins, and no answer of another scene is called fresh", async () => {
  const page = await site.open();
  await setLanes(page, { engine: "dijkstra" });
  await generate(page, "rooms", 256);
  await settled(page, 60_000);
  const { fresh, stale, wrong } = await page.evaluate(async () => {
    const { model, lanes } = /** @type {any} */ (globalThis).mediant;
    const seen = { fresh: 0, stale: 0, wrong: 0 };
    const look = () => {
      const { answer, stale, phase } = lanes.list[0];
      if (!answer || phase !== "done") return;
      const isOfNow = `${answer.start} ${answer.goal}` === `${model.start} ${model.goal}`;
      if (stale) seen.stale += 1;
      else if (isOfNow) seen.fresh += 1;
      else seen.wrong += 1;
    };
    lanes.addEventListener("change", look);
    model.beginGesture("end");
    for (let move = 0; move < 120; move += 1) {
      model.moveEnd("goal", [20 + move, 30 + (move % 7)]);
      // A turn of the browser, so that answers come in between.
      await new Promise((done) => setTimeout(done, move % 5));
    }
    model.endGesture();
    lanes.removeEventListener("change", look);
    return seen;
  });
  assert.equal(wrong, 0, `${wrong} answers of other ends were called fresh`);
  assert.ok(stale + fresh > 0, "no answer came while the end was dragged");
  await settled(page);
  assert.deepEqual((await lanes(page))[0].answer.goal, (await scene(page)).goal);

  // The same of setups: each change gives up the search under way.
  await generate(page, "rooms", 64);
  const seen = await page.evaluate(async () => {
    const { model } = /** @type {any} */ (globalThis).mediant;
    for (let change = 0; change < 90; change += 1) {
      model.setLane(0, { k: 2 + (change % 4), engine: change % 3 ? "astar" : "dijkstra" });
      await new Promise((done) => setTimeout(done, change % 9));
    }
    return model.lanes[0];
  });
  await settled(page);
  const mediant = await load();
  const ends = await scene(page);
  const truth = lengthOf(mediant, await rows(page), seen, ends.start, ends.goal);
  const [{ answer }] = await lanes(page);
  assert.ok(Math.abs(answer.length - truth) < 1e-9, `${answer.length}, not ${truth}`);
});

test("a drag beyond the map, and with the other button, breaks nothing", async () => {
  const page = await site.open();
  const from = await place(page, ...(await badge(page, "goal")));
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  for (const [x, y] of [
    [-50, -50],
    [5000, 20],
    [700, 5000],
    [from.x, from.y],
  ])
    await page.mouse.move(x, y);
  await page.mouse.down({ button: "right" });
  await page.mouse.up({ button: "right" });
  await page.keyboard.press("Escape");
  await page.mouse.up();
  await settled(page);
  const { start, goal, width, height } = await scene(page);
  for (const [x, y] of [start, goal]) assert.ok(x >= 0 && y >= 0 && x <= width && y <= height);
});
