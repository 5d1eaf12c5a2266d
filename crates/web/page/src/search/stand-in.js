// What the light package answers in place of the whole one.

/** @import { LaneSetup, Model } from "../../types.js" */
import { standsIn } from "../workers.js";

/** The engines of the light package. */
const ENGINES = ["astar", "dijkstra", "canonical", "jps", "jps-block", "anya"];

/**
 * The package for an engine on the model's map: the light one only until the whole one is there. It has no
 * costs of cells, and no agents of a size.
 * @param {string} engine
 * @param {Pick<Model, "costs" | "radius">} model
 */
export function kindFor(engine, { costs, radius }) {
  const isEasy = ENGINES.includes(engine) && costs === null && radius === 0;
  return isEasy && standsIn() ? "light" : "whole";
}
