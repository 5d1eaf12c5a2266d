// The table of calls that every language answers alike: see `crates/mediant/tests/calls.json`.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { load } from "../truth.mjs";

const table = JSON.parse(readFileSync(new URL("../../../mediant/tests/calls.json", import.meta.url), "utf8"));
const mediant = await load();

/** `max-cost` as `maxCost`. @param {string} name */
const camel = (name) => name.replace(/-(.)/g, (_, letter) => letter.toUpperCase());

test("the table is whole", () => assert.ok(table.cases.length >= 140));

for (const { map, call, start, goal, expected, published } of table.cases) {
  test(`the call ${JSON.stringify(call)}`, () => {
    const grid = mediant.Grid.fromRows(table.maps[map]);
    const how = Object.fromEntries(Object.entries(call).map(([name, value]) => [camel(name), value]));
    if (published) {
      // Options that only reproduce publications are in the program, not in the package.
      assert.throws(() => grid.find(start, goal, how));
      return;
    }
    if (expected.code) {
      assert.throws(
        () => grid.find(start, goal, how),
        // Of another type: JavaScript has an error of its own for that.
        (error) => (error instanceof TypeError ? "argument" : error.code) === expected.code,
      );
      return;
    }
    const answer = grid.find(start, goal, how);
    assert.deepEqual([grid.setup(how), answer.status], [expected.setup, expected.status]);
    assert.equal(answer.stoppedBy, expected.stopped_by);
    assert.deepEqual(answer.path && [...answer.path], expected.path?.flat());
    if (expected.path) assert.equal(answer.distance, expected.distance);
  });
}
