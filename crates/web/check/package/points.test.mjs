// Points between vertices, and paths at any angle between centers.

import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "../truth.mjs";

const { Grid, World } = await load();

const YARD = ["....", ".@@.", "...."];
const CENTERS = { k: "any", placement: "center" };

/** @param {number} a @param {number} b */
const near = (a, b) => assert.ok(Math.abs(a - b) < 1e-9, `${a}, not ${b}`);

/** The length of waypoints x, y, …. @param {ArrayLike<number>} path */
function lengthOf(path) {
  let length = 0;
  for (let i = 2; i < path.length; i += 2)
    length += Math.hypot(path[i] - path[i - 2], path[i + 1] - path[i - 1]);
  return length;
}

test("a path leads from point to point", () => {
  const space = Grid.fromRows(YARD).space({ k: "any" });
  const planner = space.prepare("anya").planner();
  const { path, distance } = planner.find([0.25, 0.5], [4, 2]);
  assert.ok(path instanceof Float64Array && space.holds(path));
  assert.deepEqual([...path.slice(0, 2), ...path.slice(-2)], [0.25, 0.5, 4, 2]);
  near(distance, lengthOf(path));
  near(planner.find(Float64Array.of(0.25, 0.5), [4, 2]).distance, distance);
  // Whole numbers are vertices, and others are rounded to 1/1024.
  assert.ok(planner.find([0, 0], [4.0, 2.0]).path instanceof Int32Array);
  assert.deepEqual([...planner.find([0.25001, 0.5], [4, 2]).path.slice(0, 2)], [0.25, 0.5]);
  assert.ok(space.isFree([0.5, 0.5]) && !space.isFree([1.5, 1.5]));
  assert.ok(space.sees([0.5, 0.5], [3.5, 0.75]) && !space.sees([0.5, 0.5], [3.5, 2.5]));
  const touched = space.touchedCells(path);
  assert.ok(touched instanceof Int32Array && touched.length > 4);
});

test("between centers paths bend at corners", () => {
  const space = Grid.fromRows([".@.", "..."]).space(CENTERS);
  assert.deepEqual(space.motion, { k: "any", placement: "center", gap: "closed" });
  const best = 1 + Math.SQRT2;
  for (const engine of ["anya", "subgoal"]) {
    const index = space.prepare(engine);
    const planner = index.planner();
    const answer = planner.find([0, 0], [2, 0]);
    assert.deepEqual([...answer.path], [0, 0, 0.5, 0.5, 1.5, 0.5, 2, 0]);
    near(answer.distance, best);
    near(answer.anyAngleLowerBound, best);
    assert.ok(space.holds(answer.path));
    const goals = index.goals([
      [2, 0],
      [0.25, 0.25],
    ]);
    assert.ok(goals.points() instanceof Float64Array);
    const [far, close] = planner.distances([0, 0], goals);
    near(far, best);
    near(close, Math.SQRT2 / 4);
    assert.equal(planner.nearest([0, 0], goals)?.goal, 1);
  }
  const field = space.field([0, 0]);
  near(field.get([2, 0]), best);
  assert.deepEqual(field.next([2, 0]), [1.5, 0.5]);
  assert.deepEqual([...(field.pathFrom([2, 0]) ?? [])], [2, 0, 1.5, 0.5, 0.5, 0.5, 0, 0]);
  assert.deepEqual(space.field([0.25, 0]).nearestSource([0, 0]), [0.25, 0]);
  // The straight line is all that is known of it from a path over N(k).
  const over = Grid.fromRows([".@.", "..."]).find([0, 0], [2, 0], { k: 5 });
  assert.deepEqual([over.distance, over.anyAngleLowerBound], [4, 2]);
  assert.throws(() => space.grid.space({ ...CENTERS, corners: "one" }), /gap/);
});

test("meters lead to meters", () => {
  const world = new World(60, 40, 0.05, [-1, -0.5]);
  const wall = `${".".repeat(30)}@${".".repeat(29)}`;
  const grid = Grid.fromRows(Array.from({ length: 40 }, (_, y) => (y < 5 ? ".".repeat(60) : wall)));
  for (const placement of /** @type {const} */ (["center", "corner"])) {
    const [start, goal] = [world.placeAt(-0.732, 0.123, placement), world.placeAt(1.618, 0.271, placement)];
    assert.ok(start && goal);
    const { path, distance } = grid.find(start, goal, { k: "any", placement });
    assert.ok(path);
    const meters = world.pointOf(path, placement);
    // To the half of 1/1024 of a cell, along each axis.
    [-0.732, 0.123].forEach((at, i) => assert.ok(Math.abs(meters[i] - at) <= 0.05 / 2048 + 1e-12, placement));
    near(lengthOf(meters), distance * 0.05);
  }
  assert.equal(world.placeAt(-1.1, 0), undefined);
});

test("where paths start at vertices points are refused", () => {
  const grid = Grid.fromRows(YARD);
  for (const how of [{}, { k: 4 }, { placement: "corner", k: 3 }]) {
    assert.throws(() => grid.path([0.5, 0], [2, 2], how), { code: "between-vertices" });
    assert.equal(grid.space(how).isFree([0.5, 0]), false);
  }
  assert.throws(() => grid.space({}).field([0.5, 0]), { code: "between-vertices" });
  assert.throws(() => grid.editCells([0.5, 0], true), { code: "argument" });
  for (const wrong of [
    [Number.NaN, 0],
    [0, Infinity],
  ]) {
    assert.throws(() => grid.path(wrong, [2, 2], { k: "any" }), TypeError);
  }
});
