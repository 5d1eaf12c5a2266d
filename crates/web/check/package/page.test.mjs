// The folder of the page that `cargo xtask web` wrote: whole, and as its list says.

import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { readdirSync, readFileSync } from "node:fs";
import { join, posix } from "node:path";
import { test } from "node:test";
import { gunzipSync } from "node:zlib";
import { PACKAGE, PAGE, ROOT, SOURCES } from "../places.mjs";

const list = JSON.parse(readFileSync(join(PAGE, "files.json"), "utf8"));
/** The files of a folder, by their paths in it. @param {string} folder @returns {string[]} */
const filesOf = (folder, inside = "") =>
  readdirSync(join(folder, inside), { withFileTypes: true }).flatMap((entry) =>
    entry.isDirectory() ? filesOf(folder, posix.join(inside, entry.name)) : posix.join(inside, entry.name),
  );

const read = (/** @type {string} */ path) => readFileSync(join(PAGE, path), "utf8");
const digest = (/** @type {string | Buffer} */ bytes) =>
  `sha256-${createHash("sha256").update(bytes).digest("base64")}`;

test("the list has all that a browser needs, with digests; head and service worker know the version", () => {
  const isNeeded = (/** @type {string} */ path) =>
    !["files.json", "offline.js"].includes(path) && !path.endsWith(".js.map");
  const files = filesOf(PAGE).filter(isNeeded);
  assert.deepEqual(Object.keys(list.files).sort(), files.sort());
  for (const path of files) assert.equal(list.files[path], digest(readFileSync(join(PAGE, path))), path);
  assert.match(list.version, /^[0-9a-f]{16}$/);
  assert.ok(read("offline.js").includes(`const VERSION = "${list.version}";`));
  assert.ok(read("index.html").includes(`data-version="${list.version}"`));
});

test("maps and engines are there as they are, and nothing that no browser needs", () => {
  const maps = join(ROOT, "crates/cli/maps");
  const names = filesOf(maps).filter((path) => path.endsWith(".map"));
  for (const name of names) assert.equal(read(`maps/${name}`), readFileSync(join(maps, name), "utf8"), name);
  for (const [packed, module] of [
    ["light_bg.wasm.gz", "light/mediant_bg.wasm"],
    ["mediant_bg.wasm.gz", "mediant_bg.wasm"],
  ]) {
    const engines = gunzipSync(readFileSync(join(PAGE, packed)));
    assert.ok(engines.equals(readFileSync(join(PACKAGE, module))), packed);
  }
  const own = ["index.html", "offline.js", "files.json", "icon.svg", "manifest.webmanifest", "LICENSE"];
  const packed = ["page.js.gz", "worker.js.gz", "light_bg.wasm.gz", "mediant_bg.wasm.gz"];
  const sources = ["page.js.map", "worker.js.map"];
  assert.deepEqual(
    filesOf(PAGE).sort(),
    [...own, ...packed, ...sources, ...names.map((name) => `maps/${name}`)].sort(),
  );
});

test("every module of the sources is in a script, and debuggers find it", () => {
  const named = ["page.js.map", "worker.js.map"].flatMap((path) => JSON.parse(read(path)).sources);
  assert.ok(
    named.every((path) => path.startsWith("../sources/")),
    named.join(" "),
  );
  const modules = filesOf(SOURCES).filter((path) => /^src\/.*\.js$/.test(path));
  const first = ["src/start.js", "src/panels/theme-first.js"];
  const isIn = (/** @type {string} */ path) => first.includes(path) || named.includes(`../sources/${path}`);
  assert.deepEqual(
    modules.filter((path) => !isIn(path)),
    [],
  );
});

test("the head holds its script and its styles, and its policy allows no others", () => {
  const head = read("index.html");
  const [, policy] = /http-equiv="Content-Security-Policy"\s+content="([^"]+)"/.exec(head) ?? [];
  for (const [element, rule] of [
    ["script", "script-src"],
    ["style", "style-src"],
  ]) {
    const parts = [...head.matchAll(new RegExp(`<${element}[^>]*>([^]*?)</${element}>`, "g"))];
    assert.equal(parts.length, 1, element);
    const allowed = policy.split("; ").find((part) => part.startsWith(`${rule} `)) ?? "";
    assert.ok(allowed.split(" ").includes(`'${digest(parts[0][1])}'`), allowed);
    assert.doesNotMatch(allowed, /unsafe-inline|unsafe-eval'? |https?:/);
  }
  assert.doesNotMatch(head, /<script[^>]* src=|rel="stylesheet"/);
});
