// Costs of cells, compared with Dijkstra's algorithm over moves that are spelled out here.

import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "../truth.mjs";

const mediant = await load();
const { Grid } = mediant;

/** @typedef {[number, number]} Point */

/** Numbers from a seed. @param {number} seed */
function randomFrom(seed) {
  let state = seed;
  return (/** @type {number} */ below) => {
    state = (state * 1_103_515_245 + 12_345) % 2_147_483_648;
    return Math.floor((state / 2_147_483_648) * below);
  };
}

/** The cost of a straight move between centers, by samples along it; infinite through walls. Moves of N(4)
 *  only, whose shares of cells are quarters. @param {(x: number, y: number) => number} cost
 *  @param {Point} from @param {Point} by @param {[number, number]} size */
function moveCost(cost, [x, y], [dx, dy], [wide, high]) {
  if (dx !== 0 && dy !== 0 && Math.abs(dx) === Math.abs(dy)) {
    if (!Number.isFinite(cost(x + dx, y)) || !Number.isFinite(cost(x, y + dy))) return Infinity;
  }
  const pieces = 8;
  let sum = 0;
  for (let i = 0; i < pieces; i += 1) {
    const t = (i + 0.5) / pieces;
    sum += cost(Math.floor(x + 0.5 + t * dx), Math.floor(y + 0.5 + t * dy));
  }
  return (Math.hypot(dx * wide, dy * high) * sum) / pieces;
}

/** The least costs from a cell to all others. @param {number} width @param {number} height @param {number[]}
 *  costs @param {Int32Array} moves @param {Point} start @param {[number, number]} size */
function leastCosts(width, height, costs, moves, start, size) {
  const cost = (/** @type {number} */ x, /** @type {number} */ y) =>
    x < 0 || y < 0 || x >= width || y >= height ? Infinity : costs[y * width + x];
  const best = new Array(width * height).fill(Infinity);
  best[start[1] * width + start[0]] = 0;
  for (let changed = true; changed; ) {
    changed = false;
    for (let at = 0; at < best.length; at += 1) {
      if (best[at] === Infinity) continue;
      const from = /** @type {Point} */ ([at % width, Math.floor(at / width)]);
      for (let i = 0; i < moves.length; i += 2) {
        const by = /** @type {Point} */ ([moves[i], moves[i + 1]]);
        const to = best[at] + moveCost(cost, from, by, size);
        const place = (from[1] + by[1]) * width + from[0] + by[0];
        if (to < best[place] - 1e-9) [best[place], changed] = [to, true];
      }
    }
  }
  return best;
}

test("queries, fields, tables and steps agree with sums that are spelled out", () => {
  for (let seed = 1; seed <= 6; seed += 1) {
    const random = randomFrom(seed);
    const [width, height] = [6 + random(4), 5 + random(4)];
    const walls = Uint8Array.from({ length: width * height }, () => Number(random(10) < 2));
    walls[0] = 0;
    const costs = Array.from(walls, (wall) => (wall ? Infinity : 1 + random(8)));
    const size = /** @type {[number, number]} */ (seed % 2 ? [1, 1] : [3, 2]);
    const given = costs.map((cost) => (cost === Infinity ? 0 : cost));
    const grid = new Grid(width, height, walls, { costs: given, cellSize: size });
    assert.deepEqual([[...grid.costs()], grid.cellSize], [costs, size]);
    for (const k of [2, 3, 4]) {
      const what = `seed ${seed}, k = ${k}`;
      const expected = leastCosts(width, height, costs, mediant.moves(k), [0, 0], size);
      const space = grid.space({ k });
      const field = space.field([0, 0]);
      const planner = space.prepare().planner();
      for (let at = 0; at < expected.length; at += 1) {
        if (walls[at]) continue;
        const goal = /** @type {Point} */ ([at % width, Math.floor(at / width)]);
        const found = grid.find([0, 0], goal, { k });
        const near = (/** @type {number} */ value) =>
          assert.ok(value === expected[at] || Math.abs(value - expected[at]) < 1e-6, `${what}: ${value}`);
        near(found.distance);
        near(field.get(goal));
        near(planner.distance([0, 0], goal));
        planner.begin([0, 0], goal);
        let stepped = planner.step(1);
        while (!stepped) stepped = planner.step(1);
        assert.deepEqual(stepped, found, what);
        if (found.status !== "found") continue;
        near(found.cost);
        near(found.lowerBound);
        near(space.cost(found.path));
        assert.equal(found.anyAngleLowerBound, undefined);
        const { path } = found;
        let length = 0;
        for (let i = 2; i < path.length; i += 2) {
          length += Math.hypot(path[i] - path[i - 2], path[i + 1] - path[i - 1]);
        }
        assert.ok(Math.abs(length - found.length) < 1e-6, what);
      }
    }
  }
});

test("a road is worth a way around, and how much k is worth", () => {
  const grid = Grid.fromRows(["....", ".##.", "...."], {
    costs: Float32Array.of(5, 5, 5, 5, 1, 1, 1, 1, 1, 1, 1, 1),
  });
  const answer = grid.find([0, 0], [3, 0], { k: 3 });
  assert.deepEqual([answer.cost, answer.length, answer.distance], [11, 7, 11]);
  const plain = grid.withCosts().find([0, 0], [3, 0], { k: 3 });
  assert.deepEqual([plain.cost, plain.length, plain.distance], [undefined, undefined, 3]);
  assert.equal(grid.setup({ k: 5 }).split(":")[0], "astar");
  const index = grid.space({ k: 5 }).prepare();
  assert.deepEqual([index.guarantee, index.optimal, index.bound], ["cheapest(5)", true, undefined]);
});

test("edits: costs, walls, and indexes that follow", () => {
  const grid = new Grid(9, 3, new Uint8Array(27), { costs: new Array(27).fill(1) });
  const space = grid.space({ k: 3 });
  const index = space.prepare("astar");
  const changed = space.editCosts(
    [
      [4, 1],
      [4, 0],
    ],
    [5, null],
  );
  const repaired = index.repair(changed);
  const planner = index.planner();
  planner.follow(repaired);
  assert.deepEqual([...planner.find([0, 1], [8, 1]).path], [0, 1, 3, 1, 4, 2, 5, 1, 8, 1]);
  assert.equal(changed.grid.costs()[4], Infinity);
  const walled = grid.edit(4, 0, 1, 3, Uint8Array.of(1, 1, 1));
  assert.equal(walled.find([0, 1], [8, 1]).status, "unreachable");
  assert.throws(() => walled.edit(4, 0, 1, 1, Uint8Array.of(0)), { code: "cost", message: /editCosts/ });
  assert.throws(() => walled.editCells([[4, 1]], false), { code: "cost" });
  const opened = walled.editCosts([4, 1], 2);
  assert.equal(opened.find([0, 1], [8, 1]).cost, 9);
  assert.notEqual(opened.id, grid.id);
  assert.equal(opened.editCosts([4, 1], Float64Array.of(2)).id, opened.id);
  // An agent of a size keeps the costs where it fits.
  assert.equal(opened.forSquare(1).find([0, 1], [8, 1]).cost, 9);
});

test("mistakes have a code and a cure", () => {
  const cells = new Uint8Array(4);
  for (const [costs, code, message] of [
    [[1, 1, 1], "cost", /3 costs for 4 cells/],
    [[1, 1, 1, 0], "cost", /cell \(1, 1\) is 0: it must be a positive number/],
    [[1, -1, 1, 1], "cost", /cell \(1, 0\)/],
    [[1, Number.NaN, 1, 1], "cost", /NaN/],
    [[1, Infinity, 1, 1], "cost", /blocked/],
    [[1, 1e-9, 1, 0.3], "cost", /65,536/],
  ]) {
    assert.throws(() => new Grid(2, 2, cells, { costs }), { code, message });
    assert.throws(() => new Grid(2, 2, cells).withCosts(Float64Array.from(costs)), { code, message });
  }
  for (const costs of ["1111", 3, {}, [1, 1, 1, "1"], [1, 1, 1, null], new DataView(new ArrayBuffer(4))]) {
    assert.throws(() => new Grid(2, 2, cells).withCosts(costs), TypeError);
  }
  assert.throws(() => new Grid(2, 2, cells).withCosts(new BigInt64Array(4)), TypeError);
  const costs = [1, 1, 1, 2];
  assert.throws(() => new Grid(2, 2, cells, { costs, cellSize: [0, 1] }), { code: "number" });
  assert.throws(() => new Grid(2, 2, cells, { costs, cellSize: 3 }), TypeError);
  assert.throws(() => new Grid(2, 2, cells, { cellSize: [1, 1] }), { code: "argument" });
  assert.throws(() => new Grid(2, 2, cells, { cost: costs }), {
    code: "argument",
    message: /costs, cellSize/,
  });
  const grid = new Grid(2, 2, cells, { costs });
  assert.throws(() => grid.path([0, 0], [1, 1], { costs }), { code: "argument", message: /withCosts/ });
  assert.throws(() => grid.space({ k: 9 }), { code: "motion", message: /from 2 to 8/ });
  assert.throws(() => grid.space({ k: "any" }), { code: "motion" });
  assert.throws(() => grid.find([0, 0], [1, 1], { engine: "jps" }), {
    code: "engine-without",
    message: /astar/,
  });
  assert.throws(() => grid.find([0, 0], [1, 1], { smooth: "taut" }), { code: "engine-without" });
  assert.throws(() => grid.editCosts([5, 5], 1), { code: "edit-outside" });
  assert.throws(() => grid.editCosts([0, 0], [1, 2]), { code: "argument" });
  assert.throws(() => new Grid(2, 2, cells).editCosts([0, 0], 1), { code: "cost", message: /withCosts/ });
  assert.throws(() => new Grid(2, 2, cells).space().editCosts([0, 0], 1), { code: "cost" });
  assert.throws(() => new Grid(2, 2, Uint8Array.of(0, 0, 0, 7)), { code: "argument", message: /withCosts/ });
});

test("a limit is a cost, and a clock that asks the same grid again stops nothing", () => {
  const grid = new Grid(20, 20, new Uint8Array(400), { costs: new Array(400).fill(3) });
  const stopped = grid.find([0, 0], [19, 0], { maxCost: 50 });
  assert.deepEqual([stopped.status, stopped.stoppedBy], ["stopped", "cost"]);
  assert.equal(grid.find([0, 0], [19, 0], { maxCost: 57 }).cost, 57);
  assert.equal(grid.find([0, 0], [19, 0], { timeout: 1000, k: 4 }).cost, 57);
});

test("costs around obstacles are those of nav2's formula", () => {
  for (let seed = 1; seed <= 20; seed += 1) {
    const random = randomFrom(seed);
    const [width, height] = [3 + random(9), 2 + random(8)];
    const walls = Uint8Array.from({ length: width * height }, () => Number(random(10) === 0));
    const inscribedRadius = [0, 1, 1.5][random(3)];
    const [inflationRadius, weight] = [2 + random(4), [2, 0.5][random(2)]];
    const factor = random(2) ? 0.75 : Math.log(252) / (inflationRadius - inscribedRadius);
    const costScalingFactor = factor === 0.75 ? factor : undefined;
    const meters = random(2) ? 0.5 : 1; // In a world lengths are meters, and factors per meter.
    let grid = new Grid(width, height, walls);
    if (meters !== 1) grid = grid.withWorld(new mediant.World(width, height, meters));
    const options = {
      inflationRadius: inflationRadius * meters,
      inscribedRadius: inscribedRadius * meters,
      costScalingFactor: costScalingFactor && costScalingFactor / meters,
      weight: weight === 2 ? undefined : weight,
    };
    const found = grid.inflated(options);
    assert.equal(found.world?.resolution, grid.world?.resolution);
    found.costs()?.forEach((cost, at) => {
      let distance = Infinity;
      walls.forEach((wall, other) => {
        const [dx, dy] = [(at % width) - (other % width), Math.floor(at / width) - Math.floor(other / width)];
        if (wall) distance = Math.min(distance, Math.hypot(dx, dy));
      });
      let byte = distance > inflationRadius ? 0 : 252 * Math.exp(-factor * (distance - inscribedRadius));
      byte = Math.floor(byte + 1e-9);
      const expected = distance <= inscribedRadius ? Infinity : 1 + (weight * byte) / 252;
      const what = `seed ${seed}, cell ${at}, ${JSON.stringify(options)}: ${cost}, not ${expected}`;
      assert.ok(cost === expected || Math.abs(cost - expected) < 1e-8, what);
    });
  }
});

test("a costmap is bytes that cost, and odd ones are refused", () => {
  const bytes = Uint8Array.of(0, 126, 252, 253, 254, 255);
  const costs = (/** @type {any} */ options) => [...(Grid.fromCostmap(6, 1, bytes, options).costs() ?? [])];
  assert.deepEqual(costs(undefined), [1, 2, 3, Infinity, Infinity, Infinity]);
  assert.deepEqual(costs({ weight: 4, unknown: 252 }), [1, 3, 5, Infinity, Infinity, 5]);
  assert.deepEqual(costs({ unknown: null }), costs({}));
  assert.equal(Grid.fromCostmap(3, 2, bytes).find([0, 0], [2, 0], { k: 2 }).cost, 4);
  const made = (/** @type {any} */ options) => () => Grid.fromCostmap(3, 2, bytes, options);
  assert.throws(made({ unknown: 253 }), { code: "argument", message: /unknown.*252/ });
  assert.throws(made({ weight: -1 }), { code: "argument", message: /^weight: / });
  assert.throws(made({ weight: 1e15 }), { code: "argument", message: /^weight: / });
  assert.throws(made({ world: 3 }), { message: /weight, unknown/ });
  assert.throws(() => Grid.fromCostmap(3, 3, bytes), { code: "argument", message: /9 bytes, found 6/ });
  assert.throws(() => Grid.fromCostmap(0, 3, bytes), { code: "map-size" });
  assert.throws(() => Grid.fromCostmap(1, 1, /** @type {any} */ ([7])), TypeError);
  const grid = Grid.fromRows(["#...."]);
  const inflated = (/** @type {any} */ options) => () => grid.inflated(options);
  assert.throws(inflated(undefined), { code: "argument", message: /inflationRadius/ });
  assert.throws(inflated({ inflationRadius: -1 }), { code: "argument", message: /^inflationRadius/ });
  assert.throws(inflated({ inflationRadius: 1, inscribedRadius: 2 }), { message: /^inflationRadius/ });
  assert.throws(inflated({ inflationRadius: 1, costScalingFactor: -1 }), { message: /^costScalingFactor/ });
  assert.throws(inflated({ radius: 1 }), { message: /inscribedRadius/ });
  assert.throws(() => Grid.fromCostmap(3, 2, bytes).inflated({ inflationRadius: 2 }), { code: "cost" });
});

test("a field tells how many cells have their cost", () => {
  const [width, height] = [300, 200];
  const walls = Uint8Array.from({ length: width * height }, (_, at) => Number(at % width === 250));
  const costs = Array.from(walls, (_, at) => 1 + (at % 7));
  const space = new Grid(width, height, walls, { costs }).space({ k: 3 });
  /** @type {[number, number][]} */
  const told = [];
  const field = space.field([0, 0], undefined, (done, total) => told.push([done, total]));
  assert.deepEqual(field.distances(), space.field([0, 0]).distances());
  assert.deepEqual(
    [told[0], told.at(-1)],
    [
      [0, 59800],
      [50000, 59800],
    ],
  );
  assert.ok(told.length > 8 && told.every(([done], i) => i === 0 || done >= told[i - 1][0]));
  const enough = () => {
    throw new RangeError("enough");
  };
  assert.throws(() => space.field([0, 0], Infinity, enough), { name: "RangeError", message: "enough" });
  const wrong = /** @type {any} */ (7);
  assert.throws(() => space.field([0, 0], 9, wrong), { name: "TypeError", message: /progress/ });
});

test("the light module says that it has none", async () => {
  const light = await load("light");
  const cells = new Uint8Array(4);
  const message = /light module has no costs of cells/;
  assert.throws(() => new light.Grid(2, 2, cells, { costs: [1, 1, 1, 1] }), { code: "argument", message });
  assert.throws(() => light.Grid.fromRows(["."], { costs: [1] }), { code: "argument", message });
  assert.equal(light.Grid.prototype.withCosts, undefined);
});
