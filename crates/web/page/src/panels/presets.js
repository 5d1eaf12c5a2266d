// Races that are worth a look.

/** @typedef {import("../../types").LaneSetup} LaneSetup */

/** @type {LaneSetup} */
const CORNERS = { engine: "astar", k: 3, placement: "corner", corners: "never", gap: "open", smooth: "" };
/** @type {LaneSetup} */
const CENTERS = { ...CORNERS, placement: "center" };

/** @param {LaneSetup} base @param {string[]} engines */
const engines = (base, engines) => engines.map((engine) => ({ ...base, engine }));

/** @type {readonly { name: string, lanes: LaneSetup[] }[]} */
export const PRESETS = [
  {
    name: "k = 2, 3, 4, ∞",
    lanes: [{ ...CORNERS, k: 2 }, CORNERS, { ...CORNERS, k: 4 }, { ...CORNERS, engine: "anya", k: "any" }],
  },
  {
    name: "A*, canonical, JPS, block JPS",
    lanes: engines(CORNERS, ["astar", "canonical", "jps", "jps-block"]),
  },
  {
    name: "Prepared: subgoal, JPS+, HPA*; and A*",
    lanes: engines(CENTERS, ["subgoal", "jps-plus", "hpa", "astar"]),
  },
  {
    name: "Any angle: Theta*, Lazy Theta*, Anya, subgoals",
    lanes: [
      ...engines(CORNERS, ["theta", "lazy-theta"]),
      ...engines({ ...CORNERS, k: "any" }, ["anya", "subgoal"]),
    ],
  },
  {
    name: "Corner rules: never, one, always",
    lanes: [CENTERS, { ...CENTERS, corners: "one" }, { ...CENTERS, corners: "always" }],
  },
  {
    name: "Gaps: open, closed",
    lanes: [
      { ...CORNERS, engine: "anya", k: "any" },
      { ...CORNERS, engine: "anya", k: "any", gap: "closed" },
    ],
  },
  { name: "Centers and corners", lanes: [CENTERS, CORNERS] },
];

/** The lane of the first sight. */
export const FIRST_SIGHT = CORNERS;
