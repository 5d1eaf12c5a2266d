// Notes on words: a button beside a word opens what it means, with a small picture.

import { h, s } from "./dom.js";
import { CORNER_RULES, GAP_RULES, PLACEMENTS } from "./figures.js";
import { icon } from "./icons.js";

/** A picture of lines. @param {...[kind: string, d: string]} lines */
const drawn = (...lines) =>
  s(
    "svg",
    { class: "note-drawn", viewBox: "0 0 120 48", "aria-hidden": "true" },
    ...lines.map(([kind, d]) => s("path", { class: `f-${kind}`, d })),
  );

/** Cells of a grid of side 12, as one figure. @param {string} cells Columns and rows: "12 34" */
const squares = (cells) =>
  cells
    .split(" ")
    .map(([x, y]) => `M${12 * Number(x)} ${12 * Number(y)}h12v12h-12z`)
    .join("");

/** @param {Record<string, () => SVGElement>} figures */
const captioned = (figures) =>
  Object.entries(figures).map(([name, figure]) => h("span", { class: "note-figure" }, figure(), name));

/** The words, what they mean, and their pictures.
 *  @type {Record<string, { word: string, text: string, pictures: () => Element[] }>} */
export const NOTES = {
  excess: {
    word: "excess",
    text:
      "How much longer a path is than the shortest one at any angle, in percent. Where that is not known, " +
      "than the shortest over N(k).",
    pictures: () => [
      drawn(
        ["apart", "M8 40 40 8H112z"],
        ["way", "M8 40 40 8H112"],
        ["best", "M8 40 112 8"],
        ["dot", "M8 36a4 4 0 1 1-.1 0zM112 4a4 4 0 1 1-.1 0z"],
      ),
    ],
  },
  certificate: {
    word: "certificate",
    text:
      "A proof for this one path, without a second search. The search knows a length that no path at any " +
      "angle can beat (below). This path (above) is at most so much longer than the shortest.",
    pictures: () => [
      drawn(
        ["way", "M8 14H112"],
        ["best", "M8 34H92"],
        ["stop", "M92 8V40M112 8V40"],
        ["apart", "M92 8h20v32h-20z"],
      ),
    ],
  },
  expansions: {
    word: "expansion",
    text: "The search takes a vertex from its list and looks around it. Fewer expansions are less work.",
    pictures: () => [
      drawn(
        ["seen", squares("12 22 32 42 23 33 21 31 41 51 50")],
        ["open", squares("02 11 13 43 52 60 61 40 30 53")],
        ["way", "M18 30H42L66 6"],
      ),
    ],
  },
  vertices: {
    word: "vertices",
    text: "The places at which a path turns and ends: the corners of cells, or their centers.",
    pictures: () => captioned({ corners: PLACEMENTS.corner, centers: PLACEMENTS.center }),
  },
  corners: {
    word: "corner cutting",
    text: "Of the two cells beside a diagonal move, so many may be blocked: none, one, or both.",
    pictures: () => captioned(CORNER_RULES),
  },
  gaps: {
    word: "gap",
    text: "A point at which two walls touch diagonally. A path may slip through it, or it may not.",
    pictures: () => captioned(GAP_RULES),
  },
  smoothing: {
    word: "smoothing",
    text: "Bends are cut off after the search. The path leaves N(k) and gets shorter.",
    pictures: () => [drawn(["way faint", "M8 40 40 8H112"], ["way", "M8 40 112 8"])],
  },
};

/** The distance of a note from its button and from the edges of the window, in pixels. */
const AWAY = 8;

/**
 * The button of a note, and the note, which lies over the page while it is open.
 * @param {string} key
 * @returns {[HTMLButtonElement, HTMLElement]}
 */
export function noteOf(key) {
  const { word, text, pictures } = NOTES[key];
  const id = `note-${key}`;
  const note = h("div", { id, class: "note", popover: "auto", role: "note" });
  const label = `What is meant by ${word}?`;
  const button = h(
    "button",
    { type: "button", class: "quiet ask", popovertarget: id, "aria-label": label, title: label },
    icon("help"),
  );
  note.addEventListener("beforetoggle", () => {
    if (note.childElementCount) return;
    note.append(
      h("div", { class: "note-pictures" }, ...pictures()),
      h("p", {}, h("b", {}, word), `: ${text}`),
    );
  });
  note.addEventListener("toggle", () => place(note, button.getBoundingClientRect()));
  return [button, note];
}

/** Below the button, or above it where there is no room. @param {HTMLElement} note @param {DOMRect} at */
function place(note, at) {
  const { offsetWidth: width, offsetHeight: height } = note;
  const left = Math.min(innerWidth - width - AWAY, Math.max(AWAY, at.left + at.width / 2 - width / 2));
  const isBelow = at.bottom + AWAY + height < innerHeight;
  note.style.left = `${left}px`;
  note.style.top = `${isBelow ? at.bottom + AWAY : Math.max(AWAY, at.top - AWAY - height)}px`;
}
