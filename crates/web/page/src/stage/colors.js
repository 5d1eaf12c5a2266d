// The colors of the stage, read from the style sheet; canvas code needs them as text and as numbers.

/** @typedef {[number, number, number]} Rgb */
/**
 * @typedef {object} Theme
 * @property {Record<string, string>} css Every color by its name, as canvas takes it.
 * @property {string[]} lanes
 * @property {Uint32Array} expanded From first to last, as pixels.
 * @property {Uint32Array} marks The same for single vertices, which need more color.
 * @property {number} open As a pixel.
 * @property {number} ink As a pixel.
 * @property {number} danger As a pixel.
 * @property {number} wall As a pixel.
 * @property {number} wallInField Walls between colors, as a pixel.
 * @property {Uint32Array} land From the cheapest to the dearest, as pixels; 0 for that of free cells.
 * @property {number[]} parts What the start reaches, what the goal reaches, and its stripes, as pixels.
 * @property {Uint32Array} field From least to greatest, as pixels.
 */

const NAMES = [
  "page",
  "panel",
  "text",
  "muted",
  "line",
  "axis",
  "accent",
  "wall",
  "free",
  "grid-line",
  "expanded-first",
  "expanded-last",
  "open",
  "start",
  "goal",
  "agent",
  "danger",
  "reference",
  "focus",
  "outside",
  "stage-wall-in-field",
  "land-grass",
  "land-forest",
  "land-swamp",
  "part-start",
  "part-goal",
  "part-stripe",
];

/** The figures' scale of a field: its lightness falls evenly, so that the order is seen without hues. */
const SCALE = [
  "#faf1c7",
  "#e6e9b6",
  "#cfe2aa",
  "#b5dba2",
  "#98d4a0",
  "#78cca1",
  "#54c3a6",
  "#29b9ac",
  "#08acb0",
  "#059eb1",
  "#078fb2",
  "#0981b4",
  "#1971b6",
  "#3360ae",
  "#4250a3",
  "#4b4094",
  "#503182",
];

/** The dashes of the lanes' paths, for a line one pixel wide at 3.5: lanes differ without color. */
export const DASHES = [[], [10, 5], [3.5, 4.5], [13, 4.5, 3.5, 4.5]];

const probe = document.createElement("canvas").getContext("2d");

/** A color of a style sheet as numbers; black if it is none. @param {string} css @returns {Rgb} */
function parse(css) {
  if (!probe) return [0, 0, 0];
  probe.fillStyle = "#000";
  probe.fillStyle = css;
  const text = String(probe.fillStyle);
  if (text.startsWith("#")) {
    const value = parseInt(text.slice(1, 7), 16);
    return [value >> 16, (value >> 8) & 255, value & 255];
  }
  const [r = 0, g = 0, b = 0] = (text.match(/[\d.]+/g) ?? []).map(Number);
  return [r, g, b];
}

/** The color as one pixel of an ImageData, seen through a Uint32Array. @param {Rgb} color */
function pixel([r, g, b]) {
  const bytes = new Uint8Array([r, g, b, 255]);
  return new Uint32Array(bytes.buffer)[0];
}

/** 256 pixels through these colors. @param {Rgb[]} stops */
function ramp(stops) {
  const pixels = new Uint32Array(256);
  for (let i = 0; i < 256; i++) {
    const at = (i / 255) * (stops.length - 1);
    const index = Math.min(Math.floor(at), stops.length - 2);
    const [a, b] = [stops[index], stops[index + 1]];
    const mix = (/** @type {0 | 1 | 2} */ c) => Math.round(a[c] + (at - index) * (b[c] - a[c]));
    pixels[i] = pixel([mix(0), mix(1), mix(2)]);
  }
  return pixels;
}

/** A pixel as a color for canvas. @param {number} value */
export function cssOf(value) {
  const [r, g, b] = new Uint8Array(new Uint32Array([value]).buffer);
  return `rgb(${r},${g},${b})`;
}

/** The theme that holds for this element now. @param {Element} element @returns {Theme} */
export function readTheme(element) {
  const style = getComputedStyle(element);
  const read = (/** @type {string} */ name) => style.getPropertyValue(`--${name}`).trim() || "#808080";
  const css = Object.fromEntries(NAMES.map((name) => [name, read(name)]));
  css.outside = style.getPropertyValue("--outside").trim() || css.panel;
  const pixelOf = (/** @type {string} */ name) => pixel(parse(css[name]));
  return {
    css,
    lanes: [0, 1, 2, 3].map((index) => read(`lane-${index}`)),
    expanded: ramp([parse(css["expanded-first"]), parse(css["expanded-last"])]),
    marks: ramp([parse(css["expanded-last"]), parse(css.accent)]),
    open: pixelOf("open"),
    ink: pixelOf("text"),
    danger: pixelOf("danger"),
    wall: pixelOf("wall"),
    wallInField: pixelOf("stage-wall-in-field"),
    land: Uint32Array.from([0, ...["land-grass", "land-forest", "land-swamp"].map(pixelOf)]),
    parts: ["part-start", "part-goal", "part-stripe"].map(pixelOf),
    field: ramp(SCALE.map(parse)),
  };
}

/** Calls back when the theme changes, by the page or by the system. @param {() => void} changed */
export function watchTheme(changed) {
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", changed);
  const observer = new MutationObserver(changed);
  observer.observe(document.documentElement, { attributes: true, attributeFilter: ["data-theme"] });
}
