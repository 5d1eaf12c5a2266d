// Tests the package and the page: `node crates/web/check/check.mjs`, after `cargo xtask web`.
//
//   check.mjs [WORD…]   runs the test files whose names hold one of the words; all without words
//   --gallery           also draws the pictures of docs/web.md anew
//   --all               counts what cannot be run on this machine as a failure
//
// Dependencies are installed into node_modules beside this file. Tests that lack some are named at the end.

import { execFileSync, spawnSync } from "node:child_process";
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";
import { chromium, HERE, PACKAGE, PAGE } from "./places.mjs";

/** @type {string[]} */
const failures = [];
/** @type {string[]} */
const notRun = [];

/** @param {string} title @param {string} program @param {string[]} words */
function run(title, program, words) {
  console.log(`\n== ${title}`);
  const begin = performance.now();
  const { status } = spawnSync(program, words, { cwd: HERE, stdio: "inherit", shell: false });
  console.log(`== ${((performance.now() - begin) / 1000).toFixed(1)} s`);
  if (status !== 0) failures.push(title);
}

/** Whether the dev dependencies are there, in exactly the versions of package.json. */
function isInstalled() {
  const wanted = JSON.parse(readFileSync(join(HERE, "package.json"), "utf8")).devDependencies;
  return Object.entries(wanted).every(([name, version]) => {
    const about = join(HERE, "node_modules", name, "package.json");
    return existsSync(about) && JSON.parse(readFileSync(about, "utf8")).version === version;
  });
}

/** Installs the dev dependencies, unless they are there. No program of theirs runs meanwhile. */
function install() {
  if (isInstalled()) return true;
  console.log("== npm install: biome, playwright-core, typescript");
  const options = ["--ignore-scripts", "--no-audit", "--no-fund", "--no-package-lock", "--loglevel=error"];
  try {
    execFileSync("npm", ["install", ...options], { cwd: HERE, stdio: "inherit", timeout: 300_000 });
  } catch {
    return false;
  }
  return isInstalled();
}

/** The test files of a folder, as paths from here. @param {string} folder */
function tests(folder) {
  const names = readdirSync(join(HERE, folder)).filter((name) => name.endsWith(".test.mjs"));
  return names.sort().map((name) => `${folder}/${name}`);
}

function main() {
  const { values, positionals: words } = parseArgs({
    allowPositionals: true,
    options: { gallery: { type: "boolean" }, all: { type: "boolean" } },
  });
  if (!existsSync(join(PAGE, "files.json")) || !existsSync(join(PACKAGE, "package.json"))) {
    console.error("error: there is no package or no page in target/web: `cargo xtask web` makes them");
    process.exit(2);
  }
  const files = [...tests("."), ...tests("package")];
  if (!install()) {
    notRun.push("style, types and the page: npm cannot install biome, playwright-core and typescript here");
  } else {
    files.push(...tests("style"), ...tests("types"));
    if (chromium()) files.push(...tests("page"));
    else notRun.push("the page: there is no Chromium (chromium of the system, or its path in CHROMIUM)");
  }
  const chosen = files.filter((file) => words.length === 0 || words.some((word) => file.includes(word)));
  for (const file of chosen) {
    run(file, process.execPath, ["--test", "--test-reporter=spec", file]);
  }
  if (values.gallery && chromium() && failures.length === 0) {
    run("The gallery", process.execPath, ["gallery.mjs"]);
  }
  for (const what of notRun) console.log(`Not run: ${what}`);
  for (const what of failures) console.log(`Failed: ${what}`);
  if (failures.length > 0 || (values.all && notRun.length > 0)) process.exit(1);
  console.log(notRun.length > 0 ? "== What was run is well" : "== All is well");
}

if (Number(process.versions.node.split(".")[0]) < 20) {
  console.error(`error: Node.js ${process.versions.node} is too old: the tests need 20 or newer`);
  process.exit(2);
}
if (process.argv[1] === fileURLToPath(import.meta.url)) main();
