// The package in node, from the folder that `cargo xtask web` wrote.

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import {
  existsSync,
  mkdirSync,
  mkdtempSync,
  readdirSync,
  readFileSync,
  rmSync,
  statSync,
  symlinkSync,
  writeFileSync,
} from "node:fs";
import { homedir, tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { PACKAGE, ROOT } from "../places.mjs";
import { load } from "../truth.mjs";

const about = JSON.parse(readFileSync(join(PACKAGE, "package.json"), "utf8"));

test("package.json names files that are there", () => {
  assert.equal(about.name, "mediant");
  const version = /^version = "(.*)"$/m.exec(readFileSync(join(ROOT, "Cargo.toml"), "utf8"))?.[1];
  assert.equal(about.version, version);
  const named = [about.main, about.types, ...about.files, ...Object.values(about.exports["."])];
  for (const name of named) assert.ok(existsSync(join(PACKAGE, name)), `${name} is not there`);
  for (const name of ["LICENSE", "README.md", "mediant_bg.wasm"]) assert.ok(about.files.includes(name), name);
});

test("the module is small, and has no path of the machine that built it", () => {
  const bytes = readFileSync(join(PACKAGE, "mediant_bg.wasm"));
  assert.ok(statSync(join(PACKAGE, "mediant_bg.wasm")).size < 3_340_000);
  const text = bytes.toString("latin1");
  for (const path of [homedir(), ".cargo/registry", ".rustup/", "registry/src/"]) {
    const at = text.indexOf(path);
    assert.equal(at, -1, `the module holds ${text.slice(at - 40, at + 60)}`);
  }
});

test("paths in node", async () => {
  const mediant = await load();
  const grid = mediant.Grid.fromRows(["...#....", ".#.#.##.", ".#...#.."]);
  assert.deepEqual([...grid.path([0, 0], [7, 0])], [0, 0, 2, 0, 2, 2, 4, 2, 4, 0, 7, 0]);
  assert.equal(mediant.version(), about.version);
});

test("mistakes are errors with a sentence, never a panic", async () => {
  const mediant = await load();
  const grid = mediant.Grid.fromRows(["..", ".#"]);
  const mistakes = [
    () => grid.path([0, 0], [1, 1]),
    () => grid.path([0, 0], [5, 5]),
    () => grid.path([0, 0], [1]),
    () => grid.path([0, 0], "there"),
    () => grid.path([0.5, 0], [1, 0]),
    () => grid.path([-1, 0], [1, 0]),
    () => grid.path([0, 0], [1, 0], { kk: 3 }),
    () => grid.path([0, 0], [1, 0], { k: 99 }),
    () => grid.path([0, 0], [1, 0], { engine: "none" }),
    () => grid.space({ k: "any", placement: "center", corners: "one" }),
    () => new mediant.Grid(2, 2, new Uint8Array(3)),
    () => new mediant.Grid(0, 0, new Uint8Array(0)),
    () => mediant.Grid.fromRows([]),
    () => mediant.Grid.fromRows(["..", "."]),
    () => mediant.Grid.read("a.map", new Uint8Array(3)),
    () => mediant.Grid.read("a.png", new Uint8Array(3)),
    () => mediant.moves(99),
  ];
  for (const mistake of mistakes) {
    assert.throws(mistake, (error) => {
      assert.ok(
        error instanceof Error && !(error instanceof WebAssembly.RuntimeError),
        `${mistake}: ${error}`,
      );
      assert.ok(error.message.length > 10, `${mistake}: ${error.message}`);
      return true;
    });
  }
  assert.ok(grid.path([0, 0], [1, 0]), "the package works after mistakes");
});

/** A folder in which the package is installed. */
function project() {
  const folder = mkdtempSync(join(tmpdir(), "mediant-"));
  mkdirSync(join(folder, "node_modules"));
  symlinkSync(PACKAGE, join(folder, "node_modules/mediant"), "junction");
  writeFileSync(join(folder, "package.json"), '{ "type": "module" }');
  return folder;
}

test("the examples run as they stand", () => {
  const folder = project();
  const example = join(ROOT, "crates/web/example.mjs");
  const guide = join(ROOT, "docs/guide/src");
  const pages = readdirSync(guide, { recursive: true }).filter((name) => name.endsWith(".md"));
  const programs = [join(ROOT, "crates/web/README.md"), ...pages.sort().map((name) => join(guide, name))]
    .flatMap((page) => [...readFileSync(page, "utf8").matchAll(/^```(?:js|javascript|mjs)\n(.*?)^```/gms)])
    .map((match) => match[1]);
  // The others are parts of programs.
  const whole = programs.filter((text) => /^import .* from "mediant";/m.test(text));
  try {
    if (existsSync(example)) whole.push(readFileSync(example, "utf8"));
    assert.ok(whole.length > 3, "the README, the guide and example.mjs have few programs");
    whole.forEach((text, number) => {
      const file = join(folder, `example-${number}.mjs`);
      writeFileSync(file, text);
      const { status, stderr } = spawnSync(process.execPath, [file], { cwd: folder, encoding: "utf8" });
      assert.equal(status, 0, `${text}\n${stderr}`);
    });
  } finally {
    rmSync(folder, { recursive: true });
  }
});
