// The modules of the page have the types that they say, by its contract and by the package; programs of
// TypeScript can use the package.

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { cpSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { HERE, PACKAGE, SOURCES, WEB } from "../places.mjs";

const TSC = join(HERE, "node_modules/.bin/tsc");
const FOLDER = join(WEB, "types");

/** The compiler's findings in these files, empty if none. @param {string} folder @param {object} config */
function check(folder, config) {
  const file = join(folder, "tsconfig.json");
  writeFileSync(file, JSON.stringify(config));
  const { status, stdout, stderr } = spawnSync(TSC, ["--project", file], { cwd: folder, encoding: "utf8" });
  return status === 0 ? "" : `${stdout}${stderr}` || "the compiler did not run";
}

/** The package's objects can be disposed of by `using`. */
const LIBRARY = ["es2023", "esnext.disposable"];
const strict = {
  noEmit: true,
  strict: true,
  checkJs: true,
  allowJs: true,
  target: "es2023",
  module: "esnext",
  moduleResolution: "bundler",
  types: [],
  skipLibCheck: false,
};

test("the page", () => {
  rmSync(FOLDER, { recursive: true, force: true });
  cpSync(SOURCES, FOLDER, { recursive: true, filter: (path) => !/page.(mediant|maps)$/.test(path) });
  mkdirSync(join(FOLDER, "mediant"), { recursive: true });
  cpSync(PACKAGE, join(FOLDER, "mediant"), { recursive: true });
  const page = { ...strict, lib: [...LIBRARY, "dom", "dom.iterable", "dom.asynciterable"] };
  assert.equal(check(FOLDER, { compilerOptions: page, include: ["src/**/*.js", "types.d.ts"] }), "");
  const worker = { ...strict, lib: [...LIBRARY, "webworker"] };
  assert.equal(check(FOLDER, { compilerOptions: worker, include: ["offline.js"] }), "");
});

test("a program that uses all of the package", () => {
  const folder = join(WEB, "uses");
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(join(folder, "node_modules/mediant"), { recursive: true });
  cpSync(PACKAGE, join(folder, "node_modules/mediant"), { recursive: true });
  cpSync(join(HERE, "types/uses.ts"), join(folder, "uses.ts"));
  writeFileSync(join(folder, "package.json"), '{ "type": "module" }');
  const options = { ...strict, lib: [...LIBRARY, "dom"], noUncheckedIndexedAccess: true };
  for (const moduleResolution of ["bundler", "nodenext"]) {
    const module = moduleResolution === "bundler" ? "esnext" : "nodenext";
    const found = check(folder, {
      compilerOptions: { ...options, module, moduleResolution },
      include: ["uses.ts"],
    });
    assert.equal(found, "", moduleResolution);
  }
  // Each mistake must be found: otherwise the types would allow anything.
  const lines = readFileSync(join(HERE, "types/mistakes.ts"), "utf8").split("\n");
  writeFileSync(join(folder, "mistakes.ts"), lines.join("\n"));
  const found = check(folder, { compilerOptions: options, include: ["mistakes.ts"] });
  lines.forEach((line, at) => {
    if (line.endsWith("// wrong"))
      assert.match(found, new RegExp(`mistakes\\.ts\\(${at + 1},`), `${line}\n${found}`);
  });
});

test("every export of the package is used there", () => {
  const types = readFileSync(join(PACKAGE, "mediant.d.ts"), "utf8");
  const uses = readFileSync(join(HERE, "types/uses.ts"), "utf8");
  const members = [...types.matchAll(/^ {4}(?:static |readonly )?(\w+)[(:?]/gm)].map((match) => match[1]);
  const functions = [...types.matchAll(/^export (?:class|function) (\w+)/gm)].map((match) => match[1]);
  const wasm = /^(?:__|init|initSync|free|memory|constructor|name|private)/;
  const unused = [...new Set([...members, ...functions])].filter(
    (name) => !wasm.test(name) && !uses.includes(name),
  );
  assert.deepEqual(
    unused.filter((name) => !/^[a-z]+_/.test(name)),
    [],
  );
});
