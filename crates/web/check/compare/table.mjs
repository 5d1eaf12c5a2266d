// The table of compare.mjs, as Markdown.

/** @typedef {import("../compare.mjs").Result} Result */

/** A number with two or three digits that count. @param {number} value */
function digits(value) {
  if (value >= 1000) return Math.round(value).toLocaleString("en");
  return value >= 100 ? value.toFixed(0) : value.toPrecision(value >= 10 ? 3 : 2);
}

/** @param {Result[]} results @param {string} machine */
export function table(results, machine) {
  const rows = [
    machine,
    "",
    "| map | engine | k | queries | native, µs | node, µs | ratio | prepare, native, ms | node, ms | ratio |",
    "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|",
  ];
  for (const result of results) {
    const { map, size, engine, k, queries, native, wasm, nativePrepare, wasmPrepare } = result;
    // Times below a tenth of a millisecond say nothing of a preparation that happens once.
    const isPrepared = nativePrepare >= 0.1;
    const cells = [
      `${map}, ${size}`,
      engine,
      k === "any" ? "∞" : k,
      queries,
      digits(native / 1e3),
      digits(wasm / 1e3),
      (wasm / native).toFixed(2),
      isPrepared ? digits(nativePrepare) : "–",
      isPrepared ? digits(wasmPrepare) : "–",
      isPrepared ? (wasmPrepare / nativePrepare).toFixed(2) : "–",
    ];
    rows.push(`| ${cells.join(" | ")} |`);
  }
  return `${rows.join("\n")}\n`;
}
