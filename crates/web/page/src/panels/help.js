// The help: what to do here, the keys, and what each word means.

import { h, part } from "./dom.js";
import { iconButton } from "./icons.js";
import { NOTES } from "./notes.js";

const TODO = [
  "Drag the start and the goal. The path follows.",
  "Drag k. Each k adds the mediants: a new move between every two neighbors, their sum. Paths get shorter, " +
    "and the bars say how much at most is left.",
  "Draw walls, or open a map of your own: drop a file on the page. With a scenario of the MovingAI " +
    "benchmarks you go through its queries.",
  "Take the brush of grass, forest or swamp: steps cost more there, and the path follows the cost. The map " +
    "Landscape is made of them.",
  "Add lanes to race engines, and play their searches side by side.",
];

const KEYS = [
  ["M D E F R", "move, draw, erase, fill, rectangle"],
  ["L", "another brush: wall, road, grass, forest, swamp"],
  ["[ ]", "k down, k up, to the next one that changes the path"],
  ["Shift ← →", "at the knob: each k"],
  ["B N", "in a scenario: the query before, the next one"],
  ["P", "play or pause"],
  [", .", "one expansion back, on"],
  ["0 + −", "fit the map, zoom in, zoom out"],
  ["Ctrl+Z", "undo; with Shift redo"],
  ["↑ ↓ ← →", "in the map: move the cell cursor; Space draws, S and G put the start and the goal there"],
  ["?", "this help"],
];

const WORDS = [
  [
    "k, N(k)",
    "N(k) is the neighborhood of 2ᵏ moves: N(2) is 4-connected, N(3) 8-connected, N(∞) has every " +
      "direction.",
  ],
  ["mediant", "The sum of two neighboring moves. N(k + 1) has one between every two moves of N(k)."],
  ...["excess", "certificate", "expansions", "vertices", "corners", "gaps", "smoothing"].map((key) => [
    NOTES[key].word,
    NOTES[key].text,
  ]),
  ["open", "Vertices that were reached but not expanded."],
  [
    "cost",
    "What a step of length 1 costs on a cell. A path costs its length in each cell times the cell's cost.",
  ],
  ["clearance", "The distance to the nearest obstacle, in a straight line."],
  ["index", "Data that an engine prepares from a map once, so that queries are fast."],
  ["optimal(k)", "No path over N(k) is shorter. At k = ∞: no legal path at all."],
];

/** @returns {() => void} what opens the help */
export function startHelp() {
  const dialog = part("help", HTMLDialogElement);
  const close = iconButton("close", "Close", () => dialog.close());
  dialog.append(
    h(
      "div",
      { class: "help-head" },
      h("h2", { id: "help-title", tabindex: -1, autofocus: true }, "What to do here"),
      close,
    ),
    h(
      "div",
      { class: "help-body" },
      h("ul", {}, ...TODO.map((text) => h("li", {}, text))),
      h("h3", {}, "Keys"),
      list("keys", KEYS, (keys) => keys.split(" ").map((key) => h("kbd", {}, key))),
      h("h3", {}, "Words"),
      list("words", WORDS, (word) => [word]),
      h("p", { class: "muted small" }, "Everything runs in this browser. No map leaves it."),
    ),
  );
  // A click beside the dialog closes it.
  dialog.addEventListener("click", (event) => event.target === dialog && dialog.close());
  const open = () => {
    if (!dialog.open) dialog.showModal();
  };
  part("help-open", HTMLElement).addEventListener("click", open);
  return open;
}

/**
 * A list of terms and their meanings. `draw` gives the left side of an entry.
 * @param {string} kind
 * @param {string[][]} entries
 * @param {(term: string) => (Node | string)[]} draw
 */
function list(kind, entries, draw) {
  return h(
    "dl",
    { class: kind },
    ...entries.flatMap(([term = "", text = ""]) => [h("dt", {}, ...draw(term)), h("dd", {}, text)]),
  );
}
