// The walk of an agent along its path: its place after a step, the part of the path still before it, and the
// vertices from which it could go another way. Pure: no worker, no clock.

/** @import { Rect } from "../../types.js" */
/** @import { Waypoints } from "../../mediant/mediant.js" */
/** @import { Agent } from "./agent.js" */

/** The vertices of centers are half a cell further than their numbers. @param {string} placement */
export const offsetOf = (placement) => (placement === "center" ? 0.5 : 0);

/**
 * Walks on. Returns whether the agent has arrived.
 * @param {Agent} agent
 * @param {number} cells - The distance.
 * @param {number} offset
 */
export function advance(agent, cells, offset) {
  const { path } = agent;
  while (2 * agent.next < path.length) {
    const dx = path[2 * agent.next] + offset - agent.x;
    const dy = path[2 * agent.next + 1] + offset - agent.y;
    const far = Math.hypot(dx, dy);
    if (far > cells) {
      agent.x += (dx / far) * cells;
      agent.y += (dy / far) * cells;
      return false;
    }
    agent.x += dx;
    agent.y += dy;
    cells -= far;
    agent.next++;
  }
  return true;
}

/**
 * The part of the path that is still before the agent: from the last vertex on the line to the next waypoint
 * that the agent has passed.
 * @param {Agent} agent
 * @param {number} offset
 * @returns {Waypoints}
 */
export function rest({ path, next, x, y }, offset) {
  if (2 * next >= path.length) {
    return path.slice(-2);
  }
  if (next === 0) {
    return path.slice();
  }
  const [ax, ay, bx, by] = path.subarray(2 * next - 2, 2 * next + 2);
  const steps = divisor(bx - ax, by - ay);
  const along = Math.hypot(bx - ax, by - ay);
  const done = Math.hypot(x - offset - ax, y - offset - ay);
  const passed = along ? Math.min(steps, Math.floor((done / along) * steps + 1e-6)) : 0;
  const left = path.slice(2 * next - 2);
  if (steps) {
    left[0] = ax + ((bx - ax) / steps) * passed;
    left[1] = ay + ((by - ay) / steps) * passed;
  }
  return left;
}

/**
 * The vertices around the agent, the nearest first: x, y, ….
 * @param {{ x: number, y: number }} agent
 * @param {number} offset
 * @returns {number[]}
 */
export function placesAround({ x, y }, offset) {
  const [ax, ay] = [x - offset, y - offset];
  const [left, top] = [Math.floor(ax), Math.floor(ay)];
  const places = [
    [left, top],
    [left + 1, top],
    [left, top + 1],
    [left + 1, top + 1],
  ];
  const far = (/** @type {number[]} */ [px, py]) => (px - ax) ** 2 + (py - ay) ** 2;
  return places.sort((a, b) => far(a) - far(b)).flat();
}

/**
 * Whether the way before an agent comes near a rectangle of cells.
 * @param {Agent} agent
 * @param {Rect} rectangle
 * @param {number} margin - In cells.
 */
export function meets({ path, next, x, y }, rectangle, margin) {
  let [left, right, top, bottom] = [x, x, y, y];
  for (let i = 2 * Math.max(0, next - 1); i < path.length; i += 2) {
    [left, right] = [Math.min(left, path[i]), Math.max(right, path[i] + 1)];
    [top, bottom] = [Math.min(top, path[i + 1]), Math.max(bottom, path[i + 1] + 1)];
  }
  return (
    left - margin <= rectangle.x + rectangle.width &&
    right + margin >= rectangle.x &&
    top - margin <= rectangle.y + rectangle.height &&
    bottom + margin >= rectangle.y
  );
}

/**
 * The greatest common divisor.
 * @param {number} a
 * @param {number} b
 * @returns {number}
 */
function divisor(a, b) {
  return b === 0 ? Math.abs(a) : divisor(b, a % b);
}
