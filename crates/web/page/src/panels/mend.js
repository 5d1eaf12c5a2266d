// Makes engine and motion go together: when one is chosen, the other follows.

import { engineName, kText } from "./words.js";

/** @typedef {import("../../types").LaneSetup} LaneSetup */
/** @typedef {import("../../types").EngineInfo} EngineInfo */

/** The substitutes, other than A*, for engines that do not take the motion.
 *  @type {Record<string, string>} */
const INSTEAD = { "jps-block": "jps", "jps-plus": "jps", "subgoal-theta": "theta" };

/** Engines that at centers take k = 2, and k = 3 with corners never. */
const NARROW_AT_CENTERS = ["subgoal", "hpa", "chpa"];

/**
 * Whether the engine takes this motion.
 * @param {EngineInfo} engine
 * @param {LaneSetup} setup
 */
export function takes(engine, setup) {
  const { k, placement, corners } = setup;
  // At any angle paths lead between corners and between centers.
  if (k === "any") return engine.any;
  if (!engine.placements.includes(placement)) return false;
  if (k > engine.maxK) return false;
  if (placement === "corner" || !NARROW_AT_CENTERS.includes(engine.name)) return true;
  return k === 2 || (k === 3 && corners === "never");
}

/**
 * The setup with the change, mended: a chosen engine changes the motion, a chosen motion changes the engine.
 * `said` tells what was mended, as a sentence.
 * @param {LaneSetup} wanted
 * @param {Partial<LaneSetup>} change
 * @param {readonly EngineInfo[]} engines
 * @param {boolean} [onLand] whether steps cost differently
 * @returns {{ setup: LaneSetup, said: string }}
 */
export function mended(wanted, change, engines, onLand = false) {
  const setup = { ...wanted, ...change };
  const engine = engines.find(({ name }) => name === setup.engine);
  if (onLand) {
    // An engine that was chosen, and a k that there is not on land, are for the lane to refuse.
    if (!engine || engine.costs || change.engine !== undefined) return { setup, said: "" };
    const said = `${engineName(engine.name)} knows no costs. A* searches the land instead.`;
    return { setup: { ...setup, engine: "astar" }, said };
  }
  if (!engine || takes(engine, setup)) return { setup, said: "" };
  return change.engine === undefined ? withEngine(setup, engines) : withMotion(setup, engine);
}

/** @param {LaneSetup} setup @param {EngineInfo} engine */
function withMotion(setup, engine) {
  const [only] = engine.placements;
  const mended = { ...setup };
  const name = engineName(engine.name);
  const said = [];
  if (only && !engine.placements.includes(setup.placement)) {
    mended.placement = only === "center" ? "center" : "corner";
    said.push(`${name} has its vertices at ${mended.placement}s.`);
  }
  if (setup.k === "any" && !engine.any) mended.k = 3;
  else if (setup.k !== "any" && setup.k > engine.maxK) mended.k = engine.maxK;
  if (mended.placement === "center" && NARROW_AT_CENTERS.includes(engine.name)) {
    if (mended.k !== 2) Object.assign(mended, { k: 3, corners: "never" });
    if (mended.corners !== setup.corners) said.push(`At centers ${name} takes corner rule never at k = 3.`);
  }
  if (mended.k !== setup.k) {
    said.push(`${name} takes ${kRange(engine, mended)}: k is ${kText(mended.k)} now.`);
  }
  return { setup: mended, said: said.join(" ") };
}

/** @param {EngineInfo} engine @param {LaneSetup} setup */
function kRange(engine, setup) {
  const most = setup.placement === "center" && NARROW_AT_CENTERS.includes(engine.name) ? 3 : engine.maxK;
  return `k from 2 to ${most}${setup.placement === "center" && engine.any ? " at centers" : ""}`;
}

/** @param {LaneSetup} setup @param {readonly EngineInfo[]} engines */
function withEngine(setup, engines) {
  const mended = { ...setup };
  const name = engineName(setup.engine);
  if (setup.k === "any") {
    mended.engine = "anya";
    const back = `${name} is back when k is finite again.`;
    const said = `${name} takes a finite k. Anya searches every angle. ${back}`;
    return { setup: mended, said };
  }
  const { setup: other } = mendedEngine(mended, engines);
  const instead = engineName(other.engine);
  return { setup: other, said: `${name} does not take this motion. ${instead} searches it instead.` };
}

/** @param {LaneSetup} setup @param {readonly EngineInfo[]} engines */
function mendedEngine(setup, engines) {
  for (const name of [setup.engine, INSTEAD[setup.engine] ?? "astar", "astar"]) {
    const engine = engines.find((engine) => engine.name === name);
    if (engine && takes(engine, setup)) return { setup: { ...setup, engine: name } };
  }
  return { setup };
}
