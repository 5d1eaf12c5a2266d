// The light module: it answers as the whole one does, and says which engines it lacks.

import assert from "node:assert/strict";
import { readFileSync, statSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { PACKAGE } from "../places.mjs";
import { load } from "../truth.mjs";

const table = JSON.parse(readFileSync(new URL("../../../mediant/tests/calls.json", import.meta.url), "utf8"));
const [whole, light] = [await load(), await load("light")];
const ENGINES = ["astar", "dijkstra", "canonical", "jps", "jps-block", "anya"];

/** `max-cost` as `maxCost`. @param {string} name */
const camel = (name) => name.replace(/-(.)/g, (_, letter) => letter.toUpperCase());

/** The answer of a module, or its error's code. @param {any} module @param {any} call */
function answered(module, { map, call, start, goal }) {
  const how = Object.fromEntries(Object.entries(call).map(([name, value]) => [camel(name), value]));
  try {
    const grid = module.Grid.fromRows(table.maps[map]);
    return { setup: grid.setup(how), ...grid.find(start, goal, how) };
  } catch (error) {
    return { code: error.code ?? error.name };
  }
}

test("its engines are those that prepare little", () => {
  const names = light.engines().map(({ name }) => name);
  assert.deepEqual(names, ENGINES);
  assert.ok(statSync(join(PACKAGE, "light", "mediant_bg.wasm")).size < 1_000_000);
});

test("it answers the calls of the table as the whole module does", () => {
  let [same, lacking] = [0, 0];
  for (const request of table.cases) {
    const [expected, found] = [answered(whole, request), answered(light, request)];
    const isThere = ENGINES.includes(expected.setup?.split(":")[0]);
    if (found.code?.startsWith("engine-") && !isThere) lacking += 1;
    else {
      assert.deepEqual(found, expected, JSON.stringify(request.call));
      same += 1;
    }
  }
  assert.ok(same >= 110 && lacking >= 10, `${same} the same, ${lacking} without the engine`);
});

test("many paths, at every k, in every rule", () => {
  let seed = 7;
  const random = (below) => {
    seed = (seed * 1_103_515_245 + 12_345) % 2_147_483_648;
    return Math.floor((seed / 2_147_483_648) * below);
  };
  for (let round = 0; round < 40; round += 1) {
    const cells = Uint8Array.from({ length: 24 * 18 }, () => Number(random(10) < 3));
    const motion = [
      { k: 2, placement: "center" },
      { k: 3, corners: "one" },
      { k: 5, placement: "corner" },
      { k: "any" },
    ][round % 4];
    const spaces = [whole, light].map((module) => new module.Grid(24, 18, cells).space(motion));
    const engines = ENGINES.filter((engine) => light.checkSetup(engine, motion) === undefined);
    for (const engine of engines) {
      const [expected, found] = spaces.map((space) => space.prepare(engine).planner());
      for (let query = 0; query < 20; query += 1) {
        const ends = [
          [random(24), random(18)],
          [random(24), random(18)],
        ];
        if (!ends.every((end) => spaces[0].isFree(end))) continue;
        assert.deepEqual(
          found.find(...ends),
          expected.find(...ends),
          `${engine}, ${JSON.stringify(motion)}, ${ends}`,
        );
      }
    }
  }
});

test("an engine that it lacks is an error that names those it has", () => {
  const grid = light.Grid.fromRows(["..", ".."]);
  assert.throws(() => grid.path([0, 0], [1, 1], { engine: "subgoal" }), {
    code: "engine-without",
    message: `subgoal is not in this build of the library: choose ${ENGINES.join(", ")}`,
  });
});
