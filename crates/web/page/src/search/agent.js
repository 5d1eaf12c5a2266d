// One agent: what it is, what it needs, and what it does with the answer.

/** @import { Waypoints } from "../../mediant/mediant.js" */
/** @import { Errand, ErrandDone } from "./protocol.js" */
import { placesAround, rest } from "./walk.js";

/**
 * An agent. Its place is that of its center, in cells of the drawn map.
 * @typedef {object} Agent
 * @property {number} id
 * @property {number} x
 * @property {number} y
 * @property {Waypoints} path - Waypoints x, y, …, in vertices.
 * @property {number} next - The waypoint it walks to.
 * @property {"walking" | "arrived" | "stuck"} state
 * @property {boolean} fresh - Whether it has just got another way.
 * @property {number} since - The time at which it got it, or arrived, in ms.
 * @property {"" | "place" | "way" | "check"} needs - A place, a way, a check of its way, or nothing.
 * @property {number} wish - Grows with each new need.
 */

/**
 * An agent that is not on the map yet.
 * @param {number} id
 * @returns {Agent}
 */
export function newAgent(id) {
  return {
    id,
    x: 0,
    y: 0,
    path: new Int32Array(0),
    next: 0,
    state: "walking",
    fresh: false,
    since: 0,
    needs: "place",
    wish: 0,
  };
}

/**
 * The agent needs another place, another way, or to know whether its way holds.
 * @param {Agent} agent
 * @param {Agent["needs"]} what
 */
export function need(agent, what) {
  // An agent that is to start elsewhere does so, whatever else has changed.
  agent.needs = agent.needs === "place" ? "place" : what;
  agent.wish++;
}

/**
 * The errand that meets an agent's need.
 * @param {Agent} agent
 * @param {number} offset
 * @returns {Errand}
 */
export function errandOf(agent, offset) {
  return {
    agent: agent.id,
    path: agent.needs === "check" ? rest(agent, offset) : null,
    places: agent.needs === "place" ? [] : placesAround(agent, offset),
  };
}

/**
 * Takes an answer. Returns whether the agent has a way.
 * @param {Agent} agent
 * @param {ErrandDone} done
 * @param {boolean} isLast - Whether nothing has changed for the agent since it asked.
 * @param {number} offset
 */
export function take(agent, { kept, path }, isLast, offset) {
  const { needs } = agent;
  agent.needs = isLast ? "" : needs;
  agent.since = kept ? agent.since : performance.now();
  if (kept || !path) {
    agent.state = kept || needs === "place" ? agent.state : "stuck";
    return kept;
  }
  [agent.path, agent.next, agent.state, agent.fresh] = [path, 0, "walking", needs === "check"];
  if (needs === "place") {
    [agent.x, agent.y] = [path[0] + offset, path[1] + offset];
  }
  return true;
}

/**
 * Whether an agent may walk on. It stops before a wall that was drawn in its way, until it has another one.
 * @param {Agent} agent
 * @param {{ width: number, height: number, cells: Uint8Array }} map
 */
export function mayWalk({ path, next, x, y, needs }, { width, height, cells }) {
  if (!path.length || 2 * next >= path.length || needs !== "check") {
    return path.length > 0;
  }
  const [dx, dy] = [path[2 * next] - x, path[2 * next + 1] - y];
  const far = Math.hypot(dx, dy) || 1;
  const [ahead, below] = [Math.floor(x + dx / far), Math.floor(y + dy / far)];
  const isInside = ahead >= 0 && below >= 0 && ahead < width && below < height;
  return !isInside || !cells[below * width + ahead];
}
