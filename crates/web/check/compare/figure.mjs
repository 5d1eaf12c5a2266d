// The figure of compare.mjs: how many times as long the package takes as the program.

/** @typedef {import("../compare.mjs").Result} Result */

const WIDTH = 760;
const LEFT = 170;
const RIGHT = 700;
const TOP = 84;
const ROW = 44;
const LIMIT = 2.5;
const COLORS = ["s0", "s1", "s2"];

// The colors and sizes of the other figures.
const STYLE = `
.page{fill:#fff}
text{fill:#1f2328;font:12px system-ui,-apple-system,"Segoe UI",Roboto,Helvetica,Arial,sans-serif}
.title{font-size:16px;font-weight:600}
.muted{fill:#59636e}
.grid{stroke:#e4e8ec;stroke-width:1}
.axis{stroke:#818b98;stroke-width:1}
.limit{stroke:#59636e;stroke-width:1.25;stroke-dasharray:7 3}
.span{stroke:#818b98;stroke-width:1.25}
.mark{fill:currentColor;stroke:#fff;stroke-width:.75}
.s0{color:#0072b2}.s1{color:#d55e00}.s2{color:#009e73}
@media (prefers-color-scheme:dark){
.page{fill:#0d1117}
text{fill:#e6edf3}
.muted{fill:#9198a1}
.grid{stroke:#242a32}
.axis,.span{stroke:#6e7681}
.limit{stroke:#9198a1}
.mark{stroke:#0d1117}
.s0{color:#4a9fe0}
}
`;

/** The geometric mean. @param {number[]} values */
export const mean = (values) =>
  Math.exp(values.reduce((sum, value) => sum + Math.log(value), 0) / values.length);

/** A mark that tells a map from the others without its color: a disc, a square, a triangle. */
function mark(/** @type {number} */ series, /** @type {number} */ x, /** @type {number} */ y) {
  const of = `class="mark ${COLORS[series]}"`;
  if (series === 0) return `<circle ${of} cx="${x}" cy="${y}" r="5"/>`;
  if (series === 1) return `<rect ${of} x="${x - 4.5}" y="${y - 4.5}" width="9" height="9"/>`;
  return `<path ${of} d="M${x} ${y - 6}l5.5 10h-11z"/>`;
}

/** @param {string} name @param {string} text @param {number} x @param {number} y @param {string} [more] */
const words = (name, text, x, y, more = "") =>
  `<text class="${name}" x="${x}" y="${y}"${more}>${text}</text>`;

/** @param {Result[]} results */
export function figure(results) {
  const maps = [...new Set(results.map(({ map }) => map))];
  const rows = [...new Set(results.map(({ engine, k }) => `${engine} ${k}`))];
  const ratio = (/** @type {Result} */ { wasm, native }) => wasm / native;
  const most = Math.max(3, Math.ceil(Math.max(...results.map(ratio)) * 2) / 2);
  const place = (/** @type {number} */ value) => Number((LEFT + ((RIGHT - LEFT) * value) / most).toFixed(2));
  const bottom = TOP + rows.length * ROW;
  const height = bottom + 52;
  const title = "The package in node beside the program";
  const parts = [
    `<svg xmlns="http://www.w3.org/2000/svg" role="img" width="${WIDTH}" height="${height}"` +
      ` viewBox="0 0 ${WIDTH} ${height}">`,
    `<title>${title}</title>`,
    `<desc>Chart of the time of a query in WebAssembly over the native one, for ${rows.length} engines on ` +
      `${maps.join(", ")}; geometric mean ${mean(results.map(ratio)).toFixed(2)}</desc>`,
    `<style>${STYLE}</style>`,
    `<rect class="page" x="0" y="0" width="${WIDTH}" height="${height}"/>`,
    words("title", title, 16, 24),
    words(
      "muted",
      "time of a query in WebAssembly over that of the native program; the bar is the mean",
      16,
      42,
    ),
  ];
  for (let value = 0; value <= most; value += 0.5) {
    const x = place(value);
    parts.push(`<line class="grid" x1="${x}" y1="${TOP - 8}" x2="${x}" y2="${bottom}"/>`);
    parts.push(words("muted", String(value), x, bottom + 18, ' text-anchor="middle"'));
  }
  const limit = place(LIMIT);
  parts.push(
    `<line class="axis" x1="${LEFT}" y1="${bottom}" x2="${RIGHT}" y2="${bottom}"/>`,
    `<line class="limit" x1="${limit}" y1="${TOP - 8}" x2="${limit}" y2="${bottom}"/>`,
    words("muted", "times as long as native", RIGHT, bottom + 38, ' text-anchor="end"'),
    words("muted", `our limit, ${LIMIT}`, limit + 6, TOP + 4),
  );
  maps.forEach((map, series) => {
    const x = LEFT + series * 170;
    parts.push(mark(series, x, 62), words("", map, x + 12, 66));
  });
  rows.forEach((row, at) => {
    const y = TOP + at * ROW + ROW / 2;
    const found = results.filter(({ engine, k }) => `${engine} ${k}` === row);
    const [engine, k] = row.split(" ");
    parts.push(words("", `${engine}, k = ${k === "any" ? "∞" : k}`, LEFT - 14, y + 4, ' text-anchor="end"'));
    const places = found.map((result) => place(ratio(result)));
    const middle = place(mean(found.map(ratio)));
    parts.push(
      `<line class="span" x1="${Math.min(...places)}" y1="${y}" x2="${Math.max(...places)}" y2="${y}"/>`,
      `<line class="axis" x1="${middle}" y1="${y - 11}" x2="${middle}" y2="${y + 11}"/>`,
      ...found.map((result) => mark(maps.indexOf(result.map), place(ratio(result)), y)),
    );
  });
  return `${parts.join("\n")}\n</svg>\n`;
}
