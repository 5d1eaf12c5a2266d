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
    "| map | engine | k | queries | native, µs | node, µs | ratio |",
    "|---|---|--:|--:|--:|--:|--:|",
  ];
  for (const { map, size, engine, k, queries, native, wasm } of results) {
    const times = [native / 1e3, wasm / 1e3].map(digits);
    const cells = [
      `${map}, ${size}`,
      engine,
      k === "any" ? "∞" : k,
      queries,
      ...times,
      (wasm / native).toFixed(2),
    ];
    rows.push(`| ${cells.join(" | ")} |`);
  }
  return `${rows.join("\n")}\n`;
}
