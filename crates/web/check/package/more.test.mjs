// Certificates, spacing, worlds, scenarios, exceptions and scattered edits, against edits and single
// queries.

import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "../truth.mjs";

const mediant = await load();
const { Grid, Scenario, World, spaced } = mediant;

/** Numbers from 0 to 1, the same on every run. @param {number} seed */
function random(seed) {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

/** @param {() => number} next @param {number} width @param {number} height @param {number} density */
function randomGrid(next, width, height, density) {
  const cells = Uint8Array.from({ length: width * height }, () => Number(next() < density));
  return new Grid(width, height, cells);
}

/** @param {() => number} next @param {number} count @param {number} width @param {number} height */
function randomCells(next, count, width, height) {
  return Array.from({ length: count }, () => [Math.floor(next() * width), Math.floor(next() * height)]);
}

test("a certificate is a bound on the path at any angle between the same corners", () => {
  const next = random(7);
  let bounds = 0;
  for (let trial = 0; trial < 12; trial += 1) {
    const grid = randomGrid(next, 14, 11, 0.25);
    const exact = grid.space({ k: "any" }).prepare("anya").planner();
    const corners = grid.space({ k: "any" });
    const ends = randomCells(next, 12, 15, 12).filter((at) => corners.isFree(at));
    for (const motion of [{ k: 2 }, { k: 3 }, { k: 5 }, { k: "any" }]) {
      const planner = grid
        .space({ placement: "corner", ...motion })
        .prepare()
        .planner();
      for (let at = 1; at < ends.length; at += 1) {
        const [start, goal] = [ends[at - 1], ends[at]];
        const answer = planner.find(start, goal);
        if (answer.path === undefined) {
          assert.equal(answer.anyAngleLowerBound, undefined);
          continue;
        }
        const straight = Math.hypot(start[0] - goal[0], start[1] - goal[1]);
        assert.ok(answer.anyAngleLowerBound <= exact.find(start, goal).distance * (1 + 1e-9));
        assert.ok(answer.anyAngleLowerBound >= straight * (1 - 1e-9));
        bounds += 1;
      }
    }
  }
  assert.ok(bounds > 100, `${bounds}`);
});

test("points along a path lie evenly, from its start to its end", () => {
  const path = Int32Array.of(0, 0, 2, 0, 2, 1);
  assert.deepEqual([...spaced(path, 1.25)], [0, 0, 1.25, 0, 2, 0.5, 2, 1]);
  assert.deepEqual([...spaced(path, 99)], [0, 0, 2, 1]);
  assert.deepEqual([...spaced(Int32Array.of(3, 4), 1)], [3, 4]);
  assert.equal(spaced(new Int32Array(), 1).length, 0);
  for (const spacing of [0, -1, Number.NaN]) assert.throws(() => spaced(path, spacing), { code: "number" });
  assert.throws(() => spaced(path, 1e-12), { code: "memory" });
  assert.throws(() => spaced(path, "1"), TypeError);
});

test("a world is that of a ROS map, or made by hand, and stays with the map", () => {
  const text = (/** @type {string} */ all) => new TextEncoder().encode(all);
  const yaml =
    "image: a.pgm\nresolution: 0.5\norigin: [1, 2, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.25\n";
  const read = Grid.read("a.yaml", text(yaml), { "a.pgm": text(`P2 4 3 255 ${"254 ".repeat(12)}`) });
  const world = new World(4, 3, 0.5, [1, 2]);
  for (const grid of [
    read,
    new Grid(4, 3, new Uint8Array(12)).withWorld(world),
    read.edit(0, 0, 1, 1, Uint8Array.of(1)),
    read.editCells([0, 0], true),
    read.forSquare(2),
    read.forDisc({ meters: 0.2 }),
    read.space().grid,
    read.space().prepare("hpa").space.grid,
    read.space().edit(0, 0, 1, 1, Uint8Array.of(1)).grid,
  ]) {
    const found = grid.world;
    assert.deepEqual([found.resolution, found.width, found.height, ...found.origin], [0.5, 4, 3, 1, 2, 0]);
  }
  assert.equal(Grid.fromRows([".."]).world, undefined);
  assert.equal(read.withWorld().world, undefined);
  assert.deepEqual(world.vertexAt(1.25, 2.25), [0, 2]);
  assert.deepEqual(world.vertexAt(1.6, 2.1, "corner"), [1, 3]);
  assert.equal(world.vertexAt(0, 0), undefined);
  assert.deepEqual(
    [
      ...world.pointOf([
        [0, 2],
        [3, 0],
      ]),
    ],
    [1.25, 2.25, 2.75, 3.25],
  );
  assert.deepEqual([...world.pointOf([0, 3], "corner")], [1, 2]);
  assert.equal(world.cells(3), 6);
  assert.throws(() => new World(4, 3, 0), { code: "argument", message: /resolution/ });
  assert.throws(() => new World(0, 3, 1), { code: "map-size" });
  assert.throws(() => new World(4, 3, 1, [1]), TypeError);
  assert.throws(() => new World(4, 3, 1, [1, Infinity]), { code: "argument", message: /origin/ });
  assert.throws(() => Grid.fromRows([".."]).withWorld(world), { code: "argument", message: /4 × 3/ });
});

test("a radius in meters is that in cells", () => {
  const grid = randomGrid(random(3), 40, 30, 0.03).withWorld(new World(40, 30, 0.05));
  assert.equal(grid.forDisc({ meters: 0.08 }).id, grid.forDisc(1.6).id);
  assert.throws(() => grid.withWorld().forDisc({ meters: 1 }), { code: "argument", message: /no place/ });
  assert.throws(() => grid.forDisc({ metres: 1 }), { code: "argument", message: /keys are meters/ });
  assert.throws(() => grid.forDisc({}), { code: "argument" });
  assert.throws(() => grid.forDisc({ meters: -1 }), { code: "argument" });
});

test("scattered edits", () => {
  const next = random(5);
  const grid = randomGrid(next, 70, 17, 0.4);
  for (const count of [0, 1, 2, 300]) {
    const cells = randomCells(next, count, 70, 17);
    const values = Uint8Array.from(cells, () => Number(next() < 0.5));
    const wanted = grid.cells();
    cells.forEach(([x, y], at) => {
      wanted[y * 70 + x] = values[at];
    });
    assert.equal(grid.editCells(cells, values).id, new Grid(70, 17, wanted).id);
    for (const [x, y] of cells) wanted[y * 70 + x] = 1;
    assert.equal(grid.editCells(cells, true).id, new Grid(70, 17, wanted).id);
  }
  assert.throws(() => grid.editCells([[70, 0]], true), { code: "edit-outside" });
  assert.throws(
    () =>
      grid.editCells(
        [
          [0, 0],
          [1, 1],
        ],
        Uint8Array.of(1),
      ),
    { code: "argument" },
  );
  assert.throws(() => grid.editCells([0, 0], Uint8Array.of(2)), { code: "argument" });
  assert.throws(() => grid.editCells([0, 0], 1), TypeError);
});

test("exceptions are edits, for one query", () => {
  const next = random(9);
  const grid = randomGrid(next, 33, 19, 0.25);
  for (const engine of ["subgoal", "jps"]) {
    const planner = grid.space().prepare(engine).planner();
    for (let trial = 0; trial < 30; trial += 1) {
      const [start, goal, ...cells] = randomCells(next, 20, 33, 19);
      const [blocked, free] = [cells.slice(0, 9), cells.slice(9)];
      const answer = planner.findExcept(start, goal, { blocked, free, freeEnds: true });
      const edited = grid.editCells(blocked, true).editCells(free, false).editCells([start, goal], false);
      const wanted = edited.space().prepare("astar").planner().find(start, goal);
      assert.deepEqual([answer.status, answer.distance], [wanted.status, wanted.distance]);
      if (answer.path) edited.space().check(answer.path);
    }
  }
  const planner = Grid.fromRows(["..#", "..."]).space().prepare("astar").planner();
  assert.throws(() => planner.findExcept([0, 0], [2, 0], {}), { code: "goal-blocked" });
  assert.equal(planner.findExcept([0, 0], [2, 0], { freeEnds: true }).distance, 2);
  assert.equal(
    planner.findExcept([0, 0], [1, 0], { blocked: [1, 1] }, { maxExpansions: 0 }).stoppedBy,
    "expansions",
  );
  assert.throws(() => planner.findExcept([0, 0], [1, 0], { free: [3, 0] }), { code: "edit-outside" });
  assert.throws(() => planner.findExcept([0, 0], [1, 0], { blockd: [1, 1] }), { code: "argument" });
});

test("scenarios", () => {
  const text = [
    "version 1",
    "3\tmaps/a b.map\t4\t3\t0\t1\t3\t2\t3.5",
    "0\tmaps/a b.map\t4\t3\t1\t0\t1\t0\t0",
    "9\tb.map\t7\t3\t6\t2\t0\t0\t0",
    "",
  ].join("\n");
  const scenario = Scenario.read(new TextEncoder().encode(text));
  assert.equal(scenario.length, 3);
  assert.deepEqual([...scenario.starts()], [0, 1, 1, 0, 6, 2]);
  assert.deepEqual([...scenario.goals()], [3, 2, 1, 0, 0, 0]);
  assert.deepEqual([...scenario.lengths()], [3.5, 0, Number.NaN]);
  assert.deepEqual([...scenario.buckets()], [3, 0, 9]);
  assert.deepEqual(scenario.maps(), ["maps/a b.map", "maps/a b.map", "b.map"]);
  assert.throws(() => scenario.check(new Grid(4, 3, new Uint8Array(12))), {
    code: "mismatch",
    message: /instance 2 .* 7 × 3 cells, found .* 4 × 3 cells/,
  });
  assert.throws(() => Scenario.read(new Uint8Array()), { code: "scenario-format" });
});

test("the nearest source of a field", () => {
  const field = Grid.fromRows([".....", "####."])
    .space()
    .field([
      [0, 0],
      [4, 0],
    ]);
  assert.deepEqual([field.nearestSource([3, 0]), field.nearestSource([0, 1])], [[4, 0], undefined]);
});
