// The page's decisions before it asks an engine, and after: when a query is sent, what a worker is told of
// the map, how an agent walks. Pure functions, against slow and obvious ones.
// `SEED=… node --test` repeats a run.

import assert from "node:assert/strict";
import { test } from "node:test";
import { Random } from "../page/src/model/generate/random.js";
import { errandOf, mayWalk, need, newAgent, take } from "../page/src/search/agent.js";
import { copy, Feed, union } from "../page/src/search/feed.js";
import { motionKey, motionOf, optionsOf, setupKey } from "../page/src/search/protocol.js";
import { advance, meets, placesAround, rest } from "../page/src/search/walk.js";
import { PATIENCE, PAUSE, PREPARING, QUICK, whatNow } from "../page/src/search/when.js";

const SEED = Number(process.env.SEED ?? 1);

/** Nothing under way, at time 1000. @param {object} change */
const now = (change) =>
  whatNow({ now: 1000, gesture: "", took: 0, pauseEnds: 0, sent: null, isOther: false, ...change });
/** A query that was sent so long ago. @param {number} age @param {boolean} [isPreparing] */
const sent = (age, isPreparing = false) => ({ at: 1000 - age, isPreparing });

test("a query is sent at once if none is under way", () => {
  for (const gesture of ["", "end", "cells"]) assert.equal(now({ gesture }), "send");
  assert.equal(now({ gesture: "cells", took: QUICK, pauseEnds: 2000 }), "send", "a quick index");
  assert.equal(now({ gesture: "end", took: QUICK + 1, pauseEnds: 2000 }), "send", "no cells change");
});

test("a slow index waits for a pause in drawing", () => {
  const drawing = { gesture: "cells", took: QUICK + 1, pauseEnds: 1000 + PAUSE };
  assert.deepEqual(now(drawing), { until: 1000 + PAUSE });
  assert.equal(now({ ...drawing, pauseEnds: 1000 }), "send");
});

test("a search gives way to a newer query: at once to another scene, in a drag if it takes long", () => {
  assert.equal(now({ sent: sent(1), isOther: true }), "send");
  for (const gesture of ["", "end", "cells"]) {
    assert.equal(now({ sent: sent(1), gesture }), "await", gesture);
    assert.equal(now({ sent: sent(PATIENCE + 1), gesture }), "send", gesture);
  }
  assert.equal(now({ sent: sent(1), gesture: "cells", isOther: true }), "await");
});

test("a preparation cannot pause: its worker is replaced, if it is of no use and takes long", () => {
  assert.equal(now({ sent: sent(PREPARING + 1, true), isOther: true }), "replace");
  assert.equal(now({ sent: sent(PREPARING - 1, true), isOther: true }), "await");
  assert.equal(now({ sent: sent(PREPARING + 1, true) }), "await", "ends do not matter to an index");
});

const SETUP = { engine: "astar", k: 3, placement: "center", corners: "one", gap: "closed", smooth: "taut" };

test("a setup's motion and options are the package's; equal keys are of setups that search the same", () => {
  assert.deepEqual(motionOf(SETUP), { k: 3, placement: "center", corners: "one" });
  const corner = { ...SETUP, placement: "corner" };
  assert.deepEqual(motionOf(corner), { k: 3, placement: "corner", gap: "closed" });
  assert.deepEqual(optionsOf(SETUP), { smooth: "taut" });
  assert.deepEqual(optionsOf({ ...SETUP, smooth: "" }), {});
  assert.equal(motionKey(SETUP), motionKey({ ...SETUP, gap: "open" }), "gaps matter at corners only");
  assert.equal(motionKey(corner), motionKey({ ...corner, corners: "never" }));
  for (const change of [{ k: 4 }, { placement: "corner" }, { corners: "never" }])
    assert.notEqual(motionKey(SETUP), motionKey({ ...SETUP, ...change }));
  assert.notEqual(motionKey(corner), motionKey({ ...corner, gap: "open" }));
  for (const change of [{ engine: "jps" }, { smooth: "" }, { k: "any" }])
    assert.notEqual(setupKey(SETUP), setupKey({ ...SETUP, ...change }));
});

test(`a worker's map follows the model's by rectangles (SEED=${SEED})`, () => {
  for (let round = 0; round < 200; round++) {
    const random = new Random(SEED + round);
    /** @type {any} */
    let map = { width: 0, height: 0, cells: new Uint8Array(0), costs: null };
    /** @type {any} */
    const model = { width: 0, height: 0, cells: map.cells, costs: null };
    const load = () => {
      [model.width, model.height] = [random.between(1, 9), random.between(1, 9)];
      model.cells = Uint8Array.from({ length: model.width * model.height }, () => random.below(2));
      model.costs = random.chance(50) ? model.cells.map(() => random.between(1, 8)) : null;
    };
    load();
    const feed = new Feed(model);
    for (let step = 0; step < 12; step++) {
      if (random.chance(10)) {
        load();
        feed.note({ map: true });
      }
      for (let edits = random.below(4); edits > 0; edits--) {
        const [x, y] = [random.below(model.width), random.below(model.height)];
        const rect = {
          x,
          y,
          width: random.between(1, model.width - x),
          height: random.between(1, model.height - y),
        };
        const cell = random.between(y, y + rect.height - 1) * model.width + x;
        model.cells[cell] ^= 1;
        // Land may come and go by a stroke.
        if (random.chance(20)) {
          model.costs = model.costs ? null : new Uint8Array(model.cells.length).fill(1);
          feed.note({ cells: { x: 0, y: 0, width: model.width, height: model.height } });
        }
        if (model.costs) model.costs[cell] = random.between(1, 8);
        feed.note({ cells: rect });
      }
      const { map: whole, patch } = feed.take();
      if (whole) map = whole;
      for (let i = 0; patch && i < patch.cells.length; i++) {
        const [column, row] = [i % patch.width, Math.floor(i / patch.width)];
        const cell = (patch.y + row) * map.width + patch.x + column;
        map.cells[cell] = patch.cells[i];
        if (map.costs) map.costs[cell] = patch.costs[i];
      }
      assert.deepEqual(map, { ...model }, `SEED=${SEED} round ${round} step ${step}`);
      assert.notEqual(map.cells, model.cells, "a copy: the buffer is handed over");
    }
    assert.deepEqual(feed.take(), {}, "what is known is not told again");
  }
});

test("rectangles: the smallest around two, and their cells", () => {
  const [a, b] = [
    { x: 1, y: 5, width: 2, height: 1 },
    { x: 4, y: 2, width: 3, height: 2 },
  ];
  const both = { x: 1, y: 2, width: 6, height: 4 };
  assert.deepEqual([union(a, b), union(b, a), union(a, a)], [both, both, a]);
  const cells = Uint8Array.from({ length: 12 }, (_, i) => i);
  assert.deepEqual([...copy(cells, 4, { x: 1, y: 1, width: 2, height: 2 })], [5, 6, 9, 10]);
});

/** An agent on its way. @param {number[]} path @param {number} next @param {number} x @param {number} y */
const agent = (path, next, x, y) => ({ ...newAgent(1), path: Int32Array.from(path), next, x, y, needs: "" });

test("an agent walks as far as it is told, around the turns of its path", () => {
  const one = agent([0, 0, 3, 0, 3, 4], 1, 0.5, 0.5);
  assert.equal(advance(one, 2, 0.5), false);
  assert.deepEqual([one.x, one.y, one.next], [2.5, 0.5, 1]);
  assert.equal(advance(one, 3, 0.5), false);
  assert.deepEqual([one.x, one.y, one.next], [3.5, 2.5, 2]);
  assert.equal(advance(one, 2.5, 0.5), true);
  assert.deepEqual([one.x, one.y], [3.5, 4.5]);
});

test("what is left of a path begins at the last vertex that was passed", () => {
  const path = [0, 0, 6, 3, 6, 8];
  for (const [x, y, next, left] of [
    [0.5, 0.5, 0, path],
    [1.5, 1, 1, [0, 0, 6, 3, 6, 8]],
    [3.5, 2, 1, [2, 1, 6, 3, 6, 8]],
    [6.5, 3.5, 1, [6, 3, 6, 3, 6, 8]],
    [6.5, 6.25, 2, [6, 5, 6, 8]],
    [6.5, 8.5, 3, [6, 8]],
  ])
    assert.deepEqual([...rest(agent(path, next, x, y), 0.5)], left, `${x}, ${y}`);
  assert.deepEqual(placesAround({ x: 2.75, y: 3.6 }, 0.5).slice(0, 4), [2, 3, 3, 3]);
});

test("only a change near what is left of the way is looked at", () => {
  const one = agent([0, 0, 9, 0, 9, 9], 2, 9.5, 4.5);
  const cell = (/** @type {number} */ x, /** @type {number} */ y) => ({ x, y, width: 1, height: 1 });
  assert.ok(meets(one, cell(9, 7), 1));
  assert.ok(meets(one, cell(11, 7), 1), "as near as the margin");
  for (const [x, y] of [
    [12, 7],
    [9, 12],
    [30, 4],
  ])
    assert.ok(!meets(one, cell(x, y), 1), `${x}, ${y}`);
  assert.ok(!meets(agent([0, 0, 9, 0], 1, 8.5, 0.5), cell(4, 9), 1), "beside the way");
});

test("an agent keeps a way that holds, takes another one, and stops before a wall meanwhile", () => {
  const one = agent([0, 0, 5, 0], 1, 1.5, 0.5);
  need(one, "check");
  assert.deepEqual([...errandOf(one, 0.5).path], [1, 0, 5, 0]);
  const map = { width: 6, height: 1, cells: Uint8Array.of(0, 0, 1, 0, 0, 0) };
  assert.equal(mayWalk(one, map), false);
  assert.equal(mayWalk(one, { ...map, cells: new Uint8Array(6) }), true);
  assert.equal(take(one, { agent: 1, kept: true, path: null }, true, 0.5), true);
  assert.deepEqual([one.state, one.fresh, one.needs, one.next], ["walking", false, "", 1]);
  need(one, "check");
  assert.equal(take(one, { agent: 1, kept: false, path: Int32Array.of(1, 0, 1, 1) }, false, 0.5), true);
  assert.deepEqual([one.fresh, one.next, one.needs], [true, 0, "check"], "asked before the last change");
  assert.equal(take(one, { agent: 1, kept: false, path: null }, true, 0.5), false);
  assert.equal(one.state, "stuck");
  need(one, "place");
  need(one, "check");
  assert.equal(one.needs, "place", "who starts anew does so");
});
