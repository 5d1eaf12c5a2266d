// Times the package in node beside the program, on the same queries: `node crates/web/check/compare.mjs`.
//
// It needs `cargo xtask web`, `cargo build --release -p mediant-cli`, and the sets dao, room and street of
// `cargo xtask download`. It writes the table of docs/measurements/web.md and its figure. Measure while the
// machine does nothing else. Options: `--queries 100`, `--repeat 5`, `--program PATH`, `--dry` to write
// nothing, `--light` to time the light module, by its engines, and write nothing.

import { execFileSync } from "node:child_process";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { cpus, loadavg } from "node:os";
import { join } from "node:path";
import { parseArgs } from "node:util";
import { figure, mean } from "./compare/figure.mjs";
import { table } from "./compare/table.mjs";
import { PACKAGE, ROOT } from "./places.mjs";
import { load } from "./truth.mjs";

/** Milliseconds of queries before the first that is timed. */
const WARM = 500;
/** A large map of a game, rooms, and a city. */
const MAPS = ["dao/orz900d", "room/16room_000", "street/Berlin_0_1024"];
/** @type {{ engine: string, k: number | "any" }[]} */
const SETUPS = [
  { engine: "astar", k: 3 },
  { engine: "jps-block", k: 3 },
  { engine: "subgoal", k: 3 },
  { engine: "canonical", k: 5 },
  { engine: "anya", k: "any" },
  { engine: "subgoal", k: "any" },
];

/**
 * One engine on one map. Times are nanoseconds of a query, the mean.
 * @typedef {object} Result
 * @property {string} map
 * @property {string} size
 * @property {string} engine
 * @property {number | "any"} k
 * @property {number} queries
 * @property {number} native
 * @property {number} wasm
 */

const { values } = parseArgs({
  options: {
    queries: { type: "string", default: "100" },
    repeat: { type: "string", default: "5" },
    program: { type: "string", default: join(ROOT, "target/release/mediant") },
    dry: { type: "boolean", default: false },
    light: { type: "boolean", default: false },
  },
});
const repeat = Number(values.repeat);

/** @param {string} path @param {string} how it is made */
function need(path, how) {
  if (existsSync(path)) return path;
  console.error(`error: ${path} is not there: ${how}`);
  return process.exit(2);
}

/** The program's answers with this setup to an even sample of the map's scenario. @param {string} file */
function native(file, /** @type {string} */ engine, /** @type {number | "any"} */ k) {
  const instances = readFileSync(`${file}.scen`, "utf8").trim().split("\n").length - 1;
  const every = Math.max(1, Math.floor(instances / Number(values.queries)));
  const words = [
    "run",
    file,
    "--scen",
    `${file}.scen`,
    "--every",
    `${every}`,
    "--engine",
    engine,
    "--k",
    `${k}`,
  ];
  const text = execFileSync(values.program, [...words, "--repeat", `${repeat}`, "--format", "jsonl"], {
    encoding: "utf8",
    maxBuffer: 1 << 28,
  });
  const lines = text
    .trim()
    .split("\n")
    .map((line) => JSON.parse(line));
  return lines.filter(({ type }) => type === "query");
}

/**
 * The mean of the same queries by the package, each the best of some runs.
 * @param {any} index @param {any[]} queries
 */
function wasm(index, queries) {
  const planner = index.planner();
  // V8 optimizes code that has run often. A page that answers queries has come there after a moment.
  const from = performance.now();
  do {
    for (const { start, goal } of queries) planner.find(start, goal);
  } while (performance.now() - from < WARM);
  let total = 0;
  for (const query of queries) {
    check(query, planner.find(query.start, query.goal), index.setup);
    let best = Infinity;
    for (let run = 0; run < repeat; run += 1) {
      const begin = performance.now();
      planner.find(query.start, query.goal);
      best = Math.min(best, performance.now() - begin);
    }
    total += best;
  }
  return (total / queries.length) * 1e6;
}

/** The package must give the very path that the program gives. */
function check(/** @type {any} */ query, /** @type {any} */ answer, /** @type {string} */ setup) {
  const same =
    answer.status === query.status && String(answer.path ?? "") === String(query.path?.flat() ?? "");
  // The program measures the path, the package tells the fixed-point length of the search.
  const near = Math.abs(answer.distance - query.cost) <= query.cost * 2 ** -31;
  if (same && (answer.status !== "found" || near)) return;
  const shown = `${setup} ${query.start} to ${query.goal}`;
  throw new Error(`${shown}: the program finds ${query.cost}, the package ${answer.distance}`);
}

/** The cells of a map. @param {any} grid */
const cellsOf = (grid) => ({ width: grid.width, height: grid.height, cells: grid.cells() });

/** @returns {Promise<Result[]>} */
async function measure() {
  const whole = await load();
  const mediant = values.light ? await load("light") : whole;
  const known = new Set(mediant.engines().map(({ name }) => name));
  const results = [];
  for (const map of MAPS) {
    const file = join(ROOT, "benchdata/cache", `${map}.map`);
    need(file, "cargo xtask download --set dao room street");
    // The light module reads no files.
    const { width, height, cells } = cellsOf(whole.Grid.read(file, readFileSync(file)));
    const grid = new mediant.Grid(width, height, cells);
    for (const { engine, k } of SETUPS.filter(({ engine }) => known.has(engine))) {
      const queries = native(file, engine, k);
      const index = grid.space({ k }).prepare(engine);
      const result = {
        map: map.split("/")[1],
        size: `${grid.width} × ${grid.height}`,
        engine,
        k,
        queries: queries.length,
        native: queries.reduce((sum, { nanos }) => sum + nanos, 0) / queries.length,
        wasm: wasm(index, queries),
      };
      results.push(result);
      const ratio = (result.wasm / result.native).toFixed(2);
      console.log(`${map} ${engine}:${k}: ${(result.native / 1e3).toFixed(2)} µs, in node × ${ratio}`);
    }
  }
  return results;
}

async function main() {
  need(values.program, "cargo build --release -p mediant-cli");
  need(PACKAGE, "cargo xtask web");
  if (loadavg()[0] > 0.7)
    console.log(`The machine is busy (load ${loadavg()[0].toFixed(2)}): times will be off`);
  const results = await measure();
  const day = new Date().toLocaleDateString("en-GB", { day: "numeric", month: "long", year: "numeric" });
  const { node, v8 } = process.versions;
  const machine = `${day}, ${cpus()[0]?.model.trim()}, node ${node}, V8 ${v8}.`;
  const text = table(results, machine);
  const greatest = Math.max(...results.map(({ wasm, native }) => wasm / native));
  const all = mean(results.map(({ wasm, native }) => wasm / native));
  console.log(`${text}\nRatio: geometric mean ${all.toFixed(2)}, greatest ${greatest.toFixed(2)}`);
  if (values.dry || values.light) return;
  const page = join(ROOT, "docs/measurements/web.md");
  const [before, rest] = readFileSync(page, "utf8").split("<!-- table of compare.mjs -->\n");
  const after = rest?.split("<!-- end of the table -->\n")[1] ?? "";
  const marked = `<!-- table of compare.mjs -->\n${text}<!-- end of the table -->\n`;
  writeFileSync(page, `${before}${marked}${after}`);
  writeFileSync(join(ROOT, "docs/measurements/figures/web-native.svg"), figure(results));
}

await main();
