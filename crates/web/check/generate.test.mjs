// Generated maps: the same on every platform, well connected, with ends far apart, and fast.

import assert from "node:assert/strict";
import { test } from "node:test";

import { findEnds } from "../page/src/model/ends.js";
import { Random, root } from "../page/src/model/generate/random.js";
import { generate } from "../page/src/model/generate.js";
import { generators, whyNotGenerated } from "../page/src/model/generators.js";
import { digestOf } from "../page/src/model/scene.js";

const SEED = Number(process.env.SEED ?? 1);

/** The digests of the maps of side 64 and of side 333, both of seed 1. Links hold only name, side and seed of
 * a map: when a generator changes, its maps in old links are lost. */
const DIGESTS = {
  obstacles: ["NraQUA", "wWjNbw"],
  city: ["EeL-1Q", "8wYpAQ"],
  rooms: ["fYZWsQ", "hK1SsQ"],
  cave: ["eosIhw", "n3R-9w"],
  islands: ["MsxWHg", "ugxPdQ"],
  landscape: ["Wnj1Vw", "8-n84g"],
  warehouse: ["RJ14xg", "gI8tCQ"],
  maze: ["qPYaDA", "eI5gWw"],
  "narrow-maze": ["hixqUw", "iGGW9Q"],
  "noise-10": ["3Leu1Q", "WAs8nA"],
  "noise-20": ["3pWynQ", "QXOv7w"],
  "noise-30": ["Gvc3WA", "G_qSgw"],
  "noise-40": ["gSWAUg", "GCCvzg"],
};

/** The free cells that are connected with a cell, and whether another one is among them. */
function connected({ width, height, cells, start, goal }) {
  const seen = cells.slice();
  const stack = [start[1] * width + start[0]];
  seen[stack[0]] = 2;
  for (let cell = stack.pop(); cell !== undefined; cell = stack.pop()) {
    const x = cell % width;
    const near = [x > 0 ? cell - 1 : -1, x + 1 < width ? cell + 1 : -1, cell - width, cell + width];
    for (const next of near.filter((n) => n >= 0 && n < width * height && seen[n] === 0)) {
      seen[next] = 2;
      stack.push(next);
    }
  }
  const count = seen.filter((value) => value === 2).length;
  return { count, hasGoal: seen[goal[1] * width + goal[0]] === 2 };
}

test("a seed gives the same map everywhere", () => {
  const found = {};
  for (const { name } of generators) {
    found[name] = [64, 333].map((side) => digestOf(generate(name, side, 1).cells));
  }
  assert.deepEqual(found, DIGESTS);
  const land = [64, 333].map((side) => digestOf(generate("landscape", side, 1).costs));
  assert.deepEqual(land, ["TuSBxQ", "Z98guQ"]);
});

test(`maps of any side and seed are well connected and have ends far apart (SEED=${SEED})`, () => {
  const random = new Random(SEED);
  for (const { name } of generators) {
    for (const side of [32, 33, 64, 127, 256, random.between(32, 300), random.between(32, 300)]) {
      const seed = random.next();
      const map = generate(name, side, seed);
      const what = `${name}, side ${side}, seed ${seed}`;
      assert.equal(map.cells.length, side * side, what);
      assert.ok(
        map.cells.every((cell) => cell === 0 || cell === 1),
        what,
      );
      const costs = map.costs && [...new Set(map.costs)].sort();
      assert.deepEqual(costs, name === "landscape" ? [1, 2, 4, 8] : null, what);
      const free = map.cells.filter((cell) => cell === 0).length;
      assert.ok(free > side * side * 0.25, `${what}: ${free} free cells`);
      for (const [x, y] of [map.start, map.goal]) assert.equal(map.cells[y * side + x], 0, what);
      const { count, hasGoal } = connected(map);
      assert.ok(hasGoal, what);
      const share = name.startsWith("noise") ? 0.45 : 0.8;
      assert.ok(count > free * share, `${what}: ${count} of ${free} cells are connected`);
      const apart = Math.hypot(map.goal[0] - map.start[0], map.goal[1] - map.start[1]);
      assert.ok(apart > side * 0.4, `${what}: the ends are ${apart} apart`);
    }
    assert.notDeepEqual(generate(name, 64, 1).cells, generate(name, 64, 2).cells, name);
  }
});

test("there is no map of a wrong name, side or seed", () => {
  for (const [name, side, seed] of [
    ["x", 64, 1],
    ["city", 31, 1],
    ["city", 4097, 1],
    ["city", 64.5, 1],
    ["city", 64, -1],
    ["city", 64, 2 ** 32],
    ["city", 64, NaN],
  ]) {
    assert.match(whyNotGenerated(name, side, seed), /\.$/);
    assert.throws(() => generate(name, side, seed), RangeError);
  }
});

test("a map of a million cells takes a moment", () => {
  for (const { name } of generators) {
    const begin = performance.now();
    generate(name, 1024, 3);
    const ms = performance.now() - begin;
    // About 100 ms on a machine that does nothing else.
    assert.ok(ms < 5000, `${name}: ${ms} ms`);
  }
});

test("ends are found in a moment, in a map of 16 million cells too", () => {
  const cells = new Uint8Array(4096 * 4096).map((_, i) => ((i * 7) % 97 === 0 ? 1 : 0));
  const begin = performance.now();
  const { start, goal } = findEnds(4096, 4096, cells);
  const ms = performance.now() - begin;
  assert.ok(ms < 8000, `${ms} ms`);
  assert.ok(Math.hypot(goal[0] - start[0], goal[1] - start[1]) > 4096);
});

test("random numbers keep within their bounds, and roots are exact", () => {
  const random = new Random(5);
  const counts = new Uint32Array(7);
  for (let i = 0; i < 70_000; i++) counts[random.below(7)]++;
  for (const count of counts) assert.ok(count > 9500 && count < 10_500, `${counts}`);
  for (let n = 0; n < 2000; n++) {
    for (const more of [0, n, 2 * n]) assert.equal(root(n * n + more), n);
  }
});
