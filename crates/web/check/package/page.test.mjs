// The folder of the page that `cargo xtask web` wrote: whole, and as its list says.

import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { readdirSync, readFileSync } from "node:fs";
import { join, posix } from "node:path";
import { test } from "node:test";
import { PACKAGE, PAGE, ROOT, SOURCES } from "../places.mjs";

const list = JSON.parse(readFileSync(join(PAGE, "files.json"), "utf8"));
/** The files of a folder, by their paths in it. @param {string} folder @returns {string[]} */
const filesOf = (folder, inside = "") =>
  readdirSync(join(folder, inside), { withFileTypes: true }).flatMap((entry) =>
    entry.isDirectory() ? filesOf(folder, posix.join(inside, entry.name)) : posix.join(inside, entry.name),
  );

test("the list has every file with its digest, and the service worker has the version", () => {
  const files = filesOf(PAGE).filter((path) => !["files.json", "offline.js"].includes(path));
  assert.deepEqual(Object.keys(list.files).sort(), files.sort());
  for (const path of files) {
    const digest = createHash("sha256").update(readFileSync(join(PAGE, path))).digest("base64");
    assert.equal(list.files[path], `sha256-${digest}`, path);
  }
  assert.match(list.version, /^[0-9a-f]{16}$/);
  assert.ok(readFileSync(join(PAGE, "offline.js"), "utf8").includes(`const VERSION = "${list.version}";`));
});

test("sources, maps and engines are there, and nothing that no browser needs", () => {
  const same = (/** @type {string} */ path, /** @type {string} */ from) =>
    assert.ok(readFileSync(join(PAGE, path)).equals(readFileSync(from)), `${path} differs from ${from}`);
  for (const path of filesOf(SOURCES).filter((path) => /^(src|style)\//.test(path)))
    same(path, join(SOURCES, path));
  const maps = join(ROOT, "crates/cli/maps");
  for (const path of filesOf(maps).filter((path) => path.endsWith(".map")))
    same(`maps/${path}`, join(maps, path));
  for (const path of ["mediant.js", "mediant_bg.wasm"]) same(`mediant/${path}`, join(PACKAGE, path));
  for (const path of Object.keys(list.files)) assert.doesNotMatch(path, /\.d\.ts$|node\.js$|package\.json$/);
});

test("the head announces every module that is started or imported, once, in order", () => {
  const head = readFileSync(join(PAGE, "index.html"), "utf8");
  const announced = [...head.matchAll(/rel="modulepreload" href="([^"]+)"/g)].map((match) => match[1]);
  const started = [...head.matchAll(/<script type="module"[^>]* src="([^"]+)"/g)].map((match) => match[1]);
  const found = new Set();
  const follow = (/** @type {string} */ path) => {
    if (found.has(path)) return;
    found.add(path);
    const text = readFileSync(join(PAGE, path), "utf8").replaceAll(/\/\*[^]*?\*\//g, "");
    for (const match of text.matchAll(/^(?:import|export|\}).*"(\.[^"]+)";$/gm))
      follow(posix.join(posix.dirname(path), match[1]));
  };
  started.forEach(follow);
  assert.deepEqual([...announced].sort(), [...found].sort());
  // A browser asks for them in this order; so the first worker starts before the rest is there.
  assert.equal(announced[0], "src/search/warm.js");
  assert.deepEqual(announced.filter((path) => started.includes(path)), started);
  // What makes maps is loaded after the first path.
  assert.ok(!announced.includes("src/model/generate.js"));
  assert.ok(announced.length > 50, `${announced.length}`);
  assert.ok(head.includes('rel="preload" href="mediant/mediant_bg.wasm" as="fetch" crossorigin'));
});
