// Computations of the stage: the part of a search that is shown, the part of the map that is seen, the cells
// of a rectangle and of a fill. Against slow and obvious functions. `SEED=… node --test` repeats a run.

import assert from "node:assert/strict";
import { test } from "node:test";
import { Random } from "../page/src/model/generate/random.js";
import { Model } from "../page/src/model/model.js";
import { fill, inMap } from "../page/src/stage/gestures.js";
import { expansionEnds, Player } from "../page/src/stage/player.js";
import { View } from "../page/src/stage/view.js";

const SEED = Number(process.env.SEED ?? 1);

/** A recorded search: vertices are expanded, each with the ones that it generates. @param {Random} random */
function recorded(random) {
  const steps = [];
  for (let count = random.between(1, 9); count > 0; count--) {
    steps.push(2 * random.below(100) + 1);
    for (let more = random.below(4); more > 0; more--) steps.push(2 * random.below(100));
  }
  return Uint32Array.from([0, ...steps]);
}

/** The number of steps of the first `n` expansions. @param {Uint32Array} steps @param {number} n */
function slowEnd(steps, n) {
  let seen = 0;
  for (let i = 0; i < steps.length; i++) {
    seen += steps[i] & 1;
    if (seen > n) return i;
  }
  return steps.length;
}

/** A player of lanes with these answers. @param {object[]} answers */
function playing(answers) {
  const list = answers.map((answer) => ({ answer }));
  const lanes = Object.assign(new EventTarget(), { list });
  return { lanes, player: new Player(/** @type {any} */ (lanes)) };
}

test(`as many expansions of each lane are shown, each with what it generated (SEED=${SEED})`, () => {
  for (let round = 0; round < 200; round++) {
    const random = new Random(SEED + round);
    const answers = Array.from({ length: random.between(1, 4) }, () => {
      const steps = recorded(random);
      const expanded = steps.reduce((sum, step) => sum + (step & 1), 0);
      return { steps, expanded, ms: random.between(1, 50), path: new Int32Array(2) };
    });
    const { player } = playing(answers);
    const what = `SEED=${SEED} round ${round}`;
    assert.equal(player.length, Math.max(...answers.map(({ expanded }) => expanded)), what);
    assert.equal(player.position, player.length, "a new answer is shown whole");
    for (let n = 0; n <= player.length; n++) {
      player.seek(n);
      answers.forEach(({ steps, expanded }, lane) => {
        const end = n === 0 ? 0 : slowEnd(steps, n);
        assert.equal(player.shown(lane), end, `${what}, lane ${lane} at ${n}`);
        assert.equal(player.arrived(lane), n >= expanded, `${what}, lane ${lane} at ${n}`);
      });
    }
    player.mode = "time";
    assert.equal(player.length, Math.max(...answers.map(({ ms }) => ms)), what);
    for (const time of [0, 0.5, 3, 7.25, player.length]) {
      player.seek(time);
      answers.forEach(({ steps, expanded, ms }, lane) => {
        const share = Math.min(1, time / ms);
        const n = time >= player.length ? expanded : Math.floor(share * expanded);
        const end = n === 0 ? 0 : slowEnd(steps, n);
        assert.equal(player.shown(lane), end, `${what}, lane ${lane} at ${time} ms`);
        assert.equal(player.arrived(lane), time >= Math.min(ms, player.length), `${what} at ${time} ms`);
      });
    }
  }
});

test("the player keeps its share between the modes, steps by one, and stays within the search", () => {
  const steps = Uint32Array.of(0, 1, 2, 3, 5, 7);
  assert.deepEqual([...expansionEnds(steps)], [3, 4, 5, 6]);
  const answer = { steps, expanded: 4, ms: 10, path: new Int32Array(2) };
  const { lanes, player } = playing([answer]);
  player.seek(1);
  player.step(1);
  assert.equal(player.position, 2);
  player.mode = "time";
  assert.equal(player.position, 5);
  player.step(-1);
  assert.equal(player.position, 2.5);
  player.mode = "pace";
  for (const [to, at] of [
    [99, 4],
    [-1, 0],
  ]) {
    player.seek(to);
    assert.equal(player.position, at);
  }
  player.seek(1);
  answer.reference = { length: 1 };
  lanes.dispatchEvent(new Event("change"));
  assert.equal(player.position, 1, "what comes after an answer is no new answer");
  lanes.list = [{ answer: { ...answer, path: new Int32Array(2) } }];
  lanes.dispatchEvent(new Event("change"));
  assert.equal(player.position, 4, "a new answer is shown whole");
});

test("a search without steps is shown when all its expansions are over", () => {
  const { player } = playing([{ steps: null, expanded: 7, ms: 2, path: new Int32Array(2) }]);
  player.seek(6);
  assert.deepEqual([player.shown(0), player.arrived(0)], [0, false]);
  player.seek(7);
  assert.equal(player.arrived(0), true);
});

/** A map of these rows. @param {string[]} rows */
function modelOf(rows) {
  const model = new Model();
  const cells = Uint8Array.from([...rows.join("")], (cell) => (cell === "#" ? 1 : 0));
  const source = /** @type {const} */ ({ kind: "file", name: "x.map" });
  model.load({ width: rows[0].length, height: rows.length, cells, source, start: [0, 0], goal: [0, 0] });
  return model;
}
/** @param {Model} model */
const rowsOf = ({ width, height, cells }) =>
  Array.from({ length: height }, (_, y) =>
    [...cells.subarray(y * width, (y + 1) * width)].map((cell) => (cell ? "#" : ".")).join(""),
  );

test("a fill takes the cells that are connected by edges, and no others", () => {
  const rows = ["..#..", "..#..", "##.##", "..#..", "....."];
  const filled = (/** @type {[number, number]} */ at) => {
    const model = modelOf(rows);
    fill(model, at);
    return rowsOf(model);
  };
  assert.deepEqual(filled([0, 0]), ["###..", "###..", "##.##", "..#..", "....."]);
  assert.deepEqual(filled([4, 1]), ["..###", "..###", "##.##", "..#..", "....."]);
  assert.deepEqual(filled([2, 2]), ["..#..", "..#..", "#####", "..#..", "....."]);
  assert.deepEqual(filled([0, 4]), ["..#..", "..#..", "##.##", "#####", "#####"]);
  assert.deepEqual(filled([0, 2]), ["..#..", "..#..", "...##", "..#..", "....."]);
  const model = modelOf(rows);
  fill(model, [0, 0]);
  model.undo();
  assert.deepEqual(rowsOf(model), rows, "one step of undo");
});

test("the part of a rectangle inside of the map", () => {
  const model = modelOf(["....", "....", "...."]);
  for (const [rect, part] of [
    [
      [1, 1, 2, 1],
      [1, 1, 2, 1],
    ],
    [
      [-1, -2, 3, 3],
      [0, 0, 2, 1],
    ],
    [
      [3, 2, 9, 9],
      [3, 2, 1, 1],
    ],
    [
      [4, 0, 2, 2],
      [4, 0, 0, 2],
    ],
  ]) {
    const [x, y, width, height] = rect;
    const { x: left, y: top, width: wide, height: high } = inMap(model, { x, y, width, height });
    assert.deepEqual([left, top, wide, high], part);
  }
});

test(`the map stays under the pointer while it zooms, and is moved by as much as it (SEED=${SEED})`, () => {
  for (let round = 0; round < 300; round++) {
    const random = new Random(SEED + round);
    const view = new View();
    const [width, height] = [random.between(300, 1500), random.between(200, 1000)];
    view.setMap(random.between(8, 900), random.between(8, 900));
    view.setPane(width, height, random.pick([1, 1.25, 2]));
    const { left, top, scale } = view.frame(width, height);
    const [right, bottom] = [left + view.map[0] * scale, top + view.map[1] * scale];
    const what = `SEED=${SEED} round ${round}`;
    assert.ok(left >= 0 && top >= 0 && right <= width * view.dpr && bottom <= height * view.dpr, what);
    // A place of the map, in pixels from the center of the pane.
    const [dx, dy] = view.map.map((side) => (random.between(-30, 30) / 100) * side * view.scale);
    const at = () => View.place(view.frame(width, height), width / 2 + dx, height / 2 + dy);
    const pixel = () => 1.5 / (view.scale * view.dpr);
    const before = at();
    view.zoom(random.pick([0.9, 1.3, 1.7]), dx, dy);
    at().forEach((place, i) => assert.ok(Math.abs(place - before[i]) <= 2 * pixel(), `${what}: zoom`));
    const [old, by] = [at(), [random.between(-3, 3), random.between(-3, 3)]];
    view.pan(by[0], by[1]);
    at().forEach((place, i) => {
      assert.ok(Math.abs(place + by[i] / view.scale - old[i]) <= 2 * pixel(), `${what}: pan`);
    });
  }
});

test("a cell that the keyboard goes to is seen", () => {
  const view = new View();
  view.setMap(100, 100);
  view.setPane(400, 300, 1);
  view.zoom(8);
  for (const [x, y] of [
    [0, 0],
    [99, 99],
    [0, 99],
    [50, 3],
  ]) {
    view.reveal(x, y);
    const { left, top, scale } = view.frame(400, 300);
    const [px, py] = [left + (x + 0.5) * scale, top + (y + 0.5) * scale];
    assert.ok(px > 0 && px < 400 && py > 0 && py < 300, `${x}, ${y} is at ${px}, ${py}`);
  }
});
