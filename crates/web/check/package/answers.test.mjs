// Answers, traces, fields and pictures, compared with each other and with single queries.

import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "../truth.mjs";

const ROWS = ["...#....", ".#.#.##.", ".#...#..", ".#####..", "........"];
/** @type {[number, number]} */
const START = [0, 0];
/** @type {[number, number]} */
const GOAL = [7, 0];

const mediant = await load();
const grid = mediant.Grid.fromRows(ROWS);
/** @param {string} engine @param {object} motion */
const planner = (engine, motion = {}) => grid.space(motion).prepare(engine).planner();

test("a lower bound holds: the length of a shortest path, nothing where the engine promises nothing", () => {
  const best = planner("dijkstra").find(START, GOAL);
  for (const { name, optimal } of [
    { name: "astar", optimal: true },
    { name: "jps", optimal: true },
    { name: "subgoal", optimal: true },
    { name: "hpa", optimal: false },
    { name: "chpa", optimal: false },
  ]) {
    const answer = planner(name).find(START, GOAL);
    assert.equal(answer.status, "found");
    assert.equal(answer.lowerBound, optimal ? answer.distance : 0, name);
    assert.ok(answer.distance >= best.distance - 1e-9, name);
  }
  const stopped = planner("astar").find(START, GOAL, { maxExpansions: 3 });
  assert.equal(stopped.status, "stopped");
  assert.ok(stopped.lowerBound > 0 && stopped.lowerBound <= best.distance, `${stopped.lowerBound}`);
  assert.deepEqual([...stopped.best.slice(0, 2)], START);
});

test("distances and nearest goals are those of single queries; labels expand nothing", () => {
  const free = [];
  for (let v = 0; v < grid.width * grid.height; v += 1) {
    const at = /** @type {[number, number]} */ ([v % grid.width, Math.floor(v / grid.width)]);
    if (!grid.isBlocked(...at)) free.push(at);
  }
  for (const motion of [{}, { k: 4, placement: "corner" }, { k: "any" }]) {
    for (const options of [{}, { levels: "contracted" }, { memory: 1 }]) {
      const index = grid.space(motion).prepare("subgoal", options);
      const planner = index.planner();
      const what = JSON.stringify([motion, options]);
      assert.equal(index.levels, options.memory || options.levels ? "contracted" : "labels", what);
      const goals = index.goals(free.filter((_, at) => at % 3 === 0));
      const list = [...goals.points()];
      for (const start of free) {
        const distances = planner.distances(start, goals);
        assert.ok(distances instanceof Float64Array && distances.length === goals.length);
        distances.forEach((distance, at) => {
          const goal = /** @type {[number, number]} */ (list.slice(2 * at, 2 * at + 2));
          const trace = new mediant.Trace();
          const found = planner.find(start, goal, undefined, trace);
          assert.ok(Math.abs(found.distance - distance) < 1e-8, `${what}: ${start} to ${goal}`);
          assert.ok(Math.abs(planner.distance(start, goal) - distance) < 1e-8);
          if (index.levels === "labels") assert.deepEqual([trace.expanded, trace.steps().length], [0, 0]);
        });
        const { goal, distance } = planner.nearest(start, goals);
        assert.ok(Math.abs(distance - Math.min(...distances)) < 1e-8, what);
        assert.ok(Math.abs(distances[goal] - distance) < 1e-8, what);
      }
      goals.free();
    }
  }
});

test("wishes: nearest, snap, a greatest cost", () => {
  const walled = mediant.Grid.fromRows(["..#.", "..#.", "..#."]).space().prepare("astar").planner();
  const no = walled.find(START, [3, 0]);
  assert.deepEqual([no.status, no.distance, no.lowerBound], ["unreachable", Infinity, Infinity]);
  assert.equal(no.path, undefined);
  const near = walled.find(START, [3, 0], { nearest: true });
  assert.deepEqual([near.status, ...near.path.slice(-2)], ["nearest", 1, 0]);
  const onWall = /** @type {const} */ ([2, 1]);
  assert.throws(() => walled.find(START, onWall), { code: "goal-blocked" });
  const snapped = walled.find(START, onWall, { snap: true });
  assert.equal(snapped.status, "found");
  assert.ok(snapped.path.at(-2) !== 2, `${snapped.path}`);
  const { distance } = planner("astar").find(START, GOAL);
  assert.equal(planner("astar").find(START, GOAL, { maxCost: distance + 1 }).status, "found");
  const dear = planner("astar").find(START, GOAL, { maxCost: distance - 1 });
  assert.deepEqual([dear.status, dear.stoppedBy], ["stopped", "cost"]);
});

test("a trace counts its steps", () => {
  for (const [engine, motion] of /** @type {const} */ ([
    ["astar", {}],
    ["dijkstra", { k: 4, placement: "corner" }],
    ["jps", {}],
  ])) {
    const trace = new mediant.Trace();
    planner(engine, motion).find(START, GOAL, undefined, trace);
    const steps = [...trace.steps()];
    const count = (/** @type {number} */ kind) => steps.filter((step) => step % 2 === kind).length;
    assert.deepEqual([trace.expanded, trace.generated], [count(1), count(0)], engine);
    const row = grid.width + (motion.placement === "corner" ? 1 : 0);
    assert.equal(steps[1], 2 * (START[1] * row + START[0]) + 1, "the start is expanded first");
    assert.equal(trace.scanned > 0, engine === "jps", engine);
  }
});

test("a field says of every vertex what a query says, and its flow leads to the next one", () => {
  for (const motion of [{}, { k: 4, corners: "always" }, { k: 3, placement: "corner" }]) {
    const space = grid.space(motion);
    const [field, one] = [space.field(GOAL), planner("dijkstra", motion)];
    const [distances, flow] = [field.distances(), field.flow()];
    for (let y = 0; y < field.height; y += 1) {
      for (let x = 0; x < field.width; x += 1) {
        const [at, what] = [y * field.width + x, `${JSON.stringify(motion)} at ${x}, ${y}`];
        assert.equal(field.get([x, y]), distances[at], what);
        const distance = space.isFree([x, y]) ? one.find([x, y], GOAL).distance : Infinity;
        assert.ok(distance === distances[at] || Math.abs(distance - distances[at]) < 1e-9, what);
        const next = field.next([x, y]);
        const [dx, dy] = next ? [next[0] - x, next[1] - y] : [0, 0];
        const far = Math.hypot(dx, dy) || 1;
        assert.ok(Math.abs(flow[2 * at] - dx / far) + Math.abs(flow[2 * at + 1] - dy / far) < 1e-6, what);
      }
    }
  }
});

test("all that is put into a picture changes it", () => {
  const trace = new mediant.Trace();
  const { path } = planner("astar").find(START, GOAL, undefined, trace);
  const field = grid.space().field(GOAL);
  const parts = {
    nothing: () => {},
    path: (picture) => picture.path("way", path),
    searched: (picture) => picture.searched(trace),
    field: (picture) => picture.field(field),
    start: (picture) => picture.start(START),
    goal: (picture) => picture.goal(GOAL),
    "goal elsewhere": (picture) => picture.goal(START),
    radius: (picture) => {
      picture.radius(0.4);
      picture.path("way", path);
    },
    "less large": (picture) => picture.largestSide(300),
  };
  for (const kind of /** @type {const} */ (["svg", "png"])) {
    const seen = new Map();
    for (const [name, add] of Object.entries(parts)) {
      const picture = new mediant.Picture(grid, "center");
      add(picture);
      const drawn = String(picture[kind]());
      assert.ok(!seen.has(drawn), `${kind}: ${name} is like ${seen.get(drawn)}`);
      seen.set(drawn, name);
      picture.free();
    }
  }
});

test("an index's certificate is that of its motion", () => {
  for (const k of [2, 3, 4, 6]) {
    for (const motion of [{ k, placement: "corner" }, { k }]) {
      const index = grid.space(motion).prepare("astar");
      assert.equal(index.bound, mediant.bound(motion), JSON.stringify(motion));
      assert.ok(index.bound > 1 && index.bound < 1.5);
      assert.deepEqual([index.optimal, index.engine], [true, "astar"]);
    }
  }
  assert.equal(mediant.bound({ k: 3, corners: "always" }), undefined);
  assert.equal(grid.space({ k: "any", placement: "corner" }).prepare("anya").bound, 1);
});
