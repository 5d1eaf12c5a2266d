// The package that a worker runs: the whole one, or the light one, which gives the same answers, lacks much,
// and is there sooner. Their objects do not mix: a worker begins with one of them and keeps it.

/** @import { EngineInfo } from "../../mediant/mediant.js" */
/** @import { Kind } from "../workers.js" */
import * as light from "../../mediant/light/mediant.js";
import * as whole from "../../mediant/mediant.js";

/** The engines that search land with the whole package. */
const ON_LAND = ["astar", "dijkstra"];

/** What this worker makes of its package; both have it. */
export let mediant = { Grid: whole.Grid, Trace: whole.Trace };

/**
 * Makes an instance of a package. Returns its memory, and its engines as the whole package describes them.
 * @param {Kind} kind
 * @param {WebAssembly.Module} module
 */
export function begin(kind, module) {
  if (kind === "whole") return { memory: whole.initSync({ module }).memory, engines: whole.engines() };
  // It lacks some calls; those that it has are the same.
  const { Grid, Trace } = /** @type {typeof whole} */ (/** @type {unknown} */ (light));
  mediant = { Grid, Trace };
  return { memory: light.initSync({ module }).memory, engines: light.engines().map(described) };
}

/** @param {EngineInfo} engine */
const described = (engine) => ({ ...engine, costs: ON_LAND.includes(engine.name) });
