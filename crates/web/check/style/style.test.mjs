// All JavaScript, TypeScript, CSS and JSON of the package, the page and their tests has one style: that of
// biome, by `biome.json`. `node_modules/.bin/biome check --write ../` in the folder `check` mends most of it.

import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { HERE, ROOT } from "../places.mjs";

test("biome finds nothing to format and nothing to mend", () => {
  const biome = join(HERE, "node_modules/.bin/biome");
  const words = ["check", "--error-on-warnings", "."];
  const { status, stdout, stderr } = spawnSync(biome, words, { cwd: join(HERE, ".."), encoding: "utf8" });
  assert.equal(status, 0, `${stdout}${stderr}` || "biome did not run");
});

test("files are at most 500 lines of 110 columns", () => {
  const list = execFileSync("git", ["ls-files", "-co", "--exclude-standard", "crates/web"], {
    cwd: ROOT,
    encoding: "utf8",
  });
  const files = list.split("\n").filter((name) => /\.(m?js|css|ts)$/.test(name));
  const long = [];
  for (const name of files) {
    const lines = readFileSync(join(ROOT, name), "utf8").split("\n");
    if (lines.length > 501) long.push(`${name}: ${lines.length} lines`);
    lines.forEach((line, at) => {
      if ([...line].length > 110) long.push(`${name}:${at + 1}: ${[...line].length} columns`);
      if (/\s$/.test(line)) long.push(`${name}:${at + 1}: white space at the end`);
    });
  }
  assert.deepEqual(long, []);
});
