// The scene and its undo against a slow model that keeps a copy of every state.
// `SEED=… node --test` repeats a run.

import assert from "node:assert/strict";
import { test } from "node:test";

import { findEnds } from "../page/src/model/ends.js";
import { Random } from "../page/src/model/generate/random.js";
import { History } from "../page/src/model/history.js";
import { loadMap, parseMap } from "../page/src/model/maps.js";
import { Model } from "../page/src/model/model.js";

const SEED = Number(process.env.SEED ?? 1);

/** A model with what its events said since they were read last. */
function watched() {
  const model = new Model();
  const told = [];
  model.addEventListener("change", ({ detail }) => told.push(detail));
  return { model, read: () => told.splice(0) };
}

function empty(width, height) {
  const source = { kind: "empty", width, height };
  const ends = { start: [0, 0], goal: [width - 1, height - 1] };
  return { source, width, height, cells: new Uint8Array(width * height), ...ends };
}

/** All that undo brings back. */
function stateOf({ width, height, cells, costs, start, goal, source, edited }) {
  const land = costs && [...costs];
  return JSON.stringify({ width, height, cells: [...cells], land, start, goal, source, edited });
}

function randomMap(random, number) {
  const map = empty(random.between(1, 9), random.between(1, 9));
  const cells = map.cells.map(() => random.below(2));
  const costs = random.chance(50) ? map.cells.map(() => random.pick([1, 2, 8])) : null;
  return { ...map, cells, costs, source: { kind: "file", name: `map ${number}` } };
}

/** A change of the model that must be one step of undo, or none if it changes nothing. */
function change(model, random, number) {
  const cell = () => random.below(model.cells.length + 2) - 1;
  const cells = () => Array.from({ length: random.below(6) }, cell);
  const point = () => [random.between(-1, model.width), random.between(-1, model.height)];
  const end = () => random.pick(["start", "goal"]);
  const cost = () => random.pick([1, 1, 2, 4, 8]);
  switch (random.below(8)) {
    case 0:
      return model.paint(cells(), random.chance(50));
    case 6:
      return model.setCosts(cells(), cost());
    case 7:
      model.beginGesture("cells");
      model.paintLand(cells(), cost());
      return model.endGesture();
    case 1:
      return model.moveEnd(end(), point());
    case 2:
      return random.chance(20) ? model.load(randomMap(random, number)) : undefined;
    default:
      model.beginGesture("cells");
      for (let i = random.below(5); i > 0; i--) {
        if (random.chance(20)) {
          model.beginGesture("end");
          model.moveEnd(end(), point());
          model.endGesture();
        } else {
          model.paint(cells(), random.chance(50));
        }
      }
      return model.endGesture();
  }
}

test(`undo and redo lead to the states that there were (SEED=${SEED})`, () => {
  for (let round = 0; round < 60; round++) {
    const random = new Random(SEED + round);
    const model = new Model();
    model.load(empty(random.between(1, 40), random.between(1, 8)));
    let [states, now] = [[stateOf(model)], 0];
    for (let step = 0; step < 120; step++) {
      const before = stateOf(model);
      if (random.chance(30)) {
        model.undo();
        now = Math.max(0, now - 1);
        // biome-ignore lint/suspicious/noDuplicateElseIf: each call draws another number.
      } else if (random.chance(30)) {
        model.redo();
        now = Math.min(states.length - 1, now + 1);
      } else {
        change(model, random, round * 1000 + step);
        if (stateOf(model) !== before) states = [...states.slice(0, ++now), stateOf(model)];
      }
      assert.equal(stateOf(model), states[now], `SEED=${SEED} round ${round} step ${step}`);
      assert.equal(model.canUndo, now > 0, `SEED=${SEED} round ${round} step ${step}`);
      assert.equal(model.canRedo, now < states.length - 1, `SEED=${SEED} round ${round} step ${step}`);
      assert.equal(model.gesture, "");
    }
  }
});

test("a change event has the smallest rectangle, and what is so already is no change", () => {
  const { model, read } = watched();
  model.load(empty(10, 10));
  assert.deepEqual(read(), [{ map: true }]);
  const version = model.version;
  model.paint([23, 41, 23, -1, 100, 2.5, NaN], true);
  assert.deepEqual(read(), [{ cells: { x: 1, y: 2, width: 3, height: 3 } }]);
  assert.ok(model.version > version);
  model.paint([23, 41], true);
  model.moveEnd("start", [0, 0]);
  model.set({ overlay: "none", active: 0 });
  model.setLane(0, { k: model.lanes[0].k });
  assert.deepEqual(read(), []);
  assert.equal(model.edited, true);
  model.paint([23, 41], false);
  assert.equal(model.edited, false, "the cells are those of the source again");
});

test("a gesture is one step, tells its begin and end, and can be undone before its end", () => {
  const { model, read } = watched();
  model.load(empty(4, 4));
  read();
  model.beginGesture("cells");
  model.beginGesture("end");
  assert.equal(model.gesture, "cells");
  model.paint([1], true);
  model.paint([2], true);
  model.endGesture();
  assert.equal(model.gesture, "cells");
  assert.equal(model.canUndo, true);
  model.undo();
  assert.equal(model.cells[1] + model.cells[2], 0);
  model.paint([3], true);
  model.endGesture();
  model.endGesture();
  assert.equal(model.gesture, "");
  assert.deepEqual(
    read().filter((change) => "gesture" in change),
    [{ gesture: true }, { gesture: true }],
  );
  model.undo();
  assert.equal(model.cells[3], 0);
  assert.equal(model.canUndo, false);
});

test("the first map leaves nothing to undo, the next ones do", () => {
  const model = new Model();
  assert.equal(model.canUndo, false);
  model.load(empty(3, 3));
  assert.equal(model.canUndo, false);
  model.paint([4], true);
  model.load(empty(5, 5));
  model.undo();
  assert.deepEqual([model.width, model.cells[4], model.edited], [3, 1, true]);
  model.undo();
  assert.deepEqual([model.cells[4], model.edited, model.canUndo], [0, false, false]);
});

test("the model takes a copy of the cells, clamps ends, and refuses what is no map", () => {
  const model = new Model();
  const map = empty(6, 3);
  model.load({ ...map, start: [-5, 99], goal: [2.4, 1] });
  assert.deepEqual(
    [model.start, model.goal],
    [
      [0, 2],
      [2, 1],
    ],
  );
  model.moveEnd("goal", [NaN, 1000]);
  assert.deepEqual(model.goal, [0, 2]);
  model.paint([0], true);
  assert.equal(map.cells[0], 0);
  const before = stateOf(model);
  assert.throws(() => model.load({ ...map, width: 7 }), /6|7/);
  assert.throws(() => model.load({ ...map, width: 0, height: 0, cells: new Uint8Array(0) }), RangeError);
  assert.throws(() => model.load({ ...map, width: 8192, height: 4096 }), /too large/);
  assert.throws(() => model.load(empty(4096, 4097)), /too large/);
  assert.throws(() => model.load(empty(32_769, 1)), /1 to 32768/);
  assert.equal(stateOf(model), before);
  for (const [width, height] of [
    [4096, 4096],
    [32_768, 1],
    [1, 1],
  ]) {
    model.load(empty(width, height));
    assert.deepEqual([model.width, model.height], [width, height]);
  }
});

test("lanes: 1 to 4, known fields; numbers are brought into their bounds", () => {
  const { model, read } = watched();
  for (let i = 0; i < 6; i++) model.addLane();
  assert.equal(model.lanes.length, 4);
  assert.equal(model.active, 3);
  model.setLane(2, { engine: "anya", k: "any", placement: "corner" });
  model.set({ active: 2 });
  read();
  model.removeLane(0);
  assert.deepEqual([model.active, model.lanes[1].engine], [1, "anya"]);
  assert.deepEqual(read(), [{ lanes: true, active: true }]);
  for (let i = 0; i < 6; i++) model.removeLane(0);
  assert.equal(model.lanes.length, 1);
  const wrong = [{ k: 1 }, { k: 13 }, { k: "3" }, { corners: "two" }, { smooth: null }, { engine: "A *" }];
  for (const bad of [...wrong, { x: 1 }]) {
    assert.throws(() => model.setLane(0, bad), RangeError, JSON.stringify(bad));
  }
  assert.throws(() => model.setLanes([]), RangeError);
  model.set({ active: 9, radius: -1, agents: 1e9, overlay: "nothing", nearest: 1 });
  const { active, radius, agents, overlay, nearest } = model;
  assert.deepEqual([active, radius, agents, overlay, nearest], [0, 0, 400, "none", false]);
});

test("undo keeps within its memory and forgets the oldest steps first", () => {
  const history = new History(10_000);
  const step = (n) => ({ cells: new Uint32Array(500), ends: null, map: null, n });
  for (let n = 0; n < 20; n++) history.push(step(n));
  assert.ok(history.bytes <= 10_000);
  const undone = [];
  while (history.canUndo) history.undo(({ n }) => undone.push(n));
  assert.deepEqual(undone, [19, 18, 17, 16]);
  const model = new Model();
  model.load(empty(4096, 1024));
  // Each stroke fills a map of 4 million cells.
  const all = Uint32Array.from({ length: 4096 * 1024 }, (_, i) => i);
  for (let i = 0; i < 4; i++) model.paint(all, i % 2 === 0);
  for (let i = 0; i < 4; i++) model.undo();
  assert.equal(model.canUndo, false);
});

test("ends are free, connected and far apart", () => {
  const rows = ["..#.......", "..#######.", "##........", "..#...####"];
  const cells = Uint8Array.from(rows.join(""), (letter) => (letter === "#" ? 1 : 0));
  const { start, goal } = findEnds(10, 4, cells);
  for (const [x, y] of [start, goal]) assert.equal(rows[y][x], ".");
  assert.ok(start[0] <= goal[0]);
  assert.ok(Math.hypot(goal[0] - start[0], goal[1] - start[1]) > 4, `${start} ${goal}`);
  assert.deepEqual(findEnds(10, 4, cells, { start: [0, 0] }).start, [0, 0]);
  assert.deepEqual(findEnds(2, 2, Uint8Array.of(1, 1, 1, 1)), { start: [0, 0], goal: [1, 1] });
});

test("bundled maps are read; what is damaged is refused with a sentence", async () => {
  const { width, height, cells } = parseMap("type octile\nheight 2\nwidth 3\nmap\n.GS\n@TW\n");
  assert.deepEqual([width, height, ...cells], [3, 2, 0, 0, 0, 1, 1, 1]);
  assert.throws(() => parseMap("type octile\nheight 2\nwidth 3\nmap\n.G\n@TW\n"), /cells/);
  assert.throws(() => parseMap("<html>"), /cells/);
  await assert.rejects(loadMap({ kind: "bundled", name: "../x" }), /no bundled map/);
  await assert.rejects(loadMap({ kind: "file", name: "x.map" }), /open it/);
});
