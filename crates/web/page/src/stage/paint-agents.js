// Agents: small drops that look where they go, with the rest of their ways; a new plan flashes once.

/** @typedef {import("../../types.d.ts").Walkers} Walkers */
/** @typedef {Walkers["list"][number]} Agent */
/** @typedef {import("./view.js").Frame} Frame */
/** @typedef {import("./colors.js").Theme} Theme */

const FLASH = 600;
/** The least radius of an agent, and the largest one of a point, in pixels of the page. */
const [LEAST, MOST] = [6.5, 11];

export class Agents {
  /** The time at which each fresh agent became so. @type {WeakMap<Agent, number>} */
  #since = new WeakMap();
  #isStill = matchMedia("(prefers-reduced-motion: reduce)");

  /** Draws all agents. Returns whether a flash is still under way.
   *  @param {CanvasRenderingContext2D} context @param {Frame} frame @param {Walkers} walkers
   *  @param {{ shift: number, radius: number }} look @param {Theme} theme @param {number} now */
  draw(context, frame, walkers, look, theme, now) {
    const { list } = walkers;
    const { dpr, scale } = frame;
    if (list.length === 0) return false;
    const ways = list.map((agent) => nextWaypoint(agent, look.shift));
    context.save();
    drawWays(context, frame, list, ways, look.shift, theme);
    const own = look.radius > 0 ? look.radius : 0.32;
    const radius = Math.max(LEAST * dpr, Math.min(look.radius > 0 ? Infinity : MOST * dpr, own * scale));
    let isFlashing = false;
    list.forEach((agent, i) => {
      const x = frame.left + agent.x * scale;
      const y = frame.top + agent.y * scale;
      const dx = agent.path[ways[i]] + look.shift - agent.x;
      const dy = agent.path[ways[i] + 1] + look.shift - agent.y;
      drawAgent(context, [x, y], radius, agent.state, Math.atan2(dy, dx), theme, dpr);
      const age = (now - this.#flashOf(agent, now)) / FLASH;
      if (!(age >= 0 && age < 1)) return;
      isFlashing = true;
      context.beginPath();
      context.arc(x, y, radius + (this.#isStill.matches ? 6 : 4 + 14 * age) * dpr, 0, 7);
      context.globalAlpha = 1 - age;
      context.strokeStyle = theme.css.agent;
      context.lineWidth = 2.5 * dpr;
      context.stroke();
      context.globalAlpha = 1;
    });
    context.restore();
    return isFlashing;
  }

  /** The beginning of the agent's flash; -Infinity without one. @param {Agent} agent @param {number} now */
  #flashOf(agent, now) {
    if (!agent.fresh) {
      this.#since.delete(agent);
      return -Infinity;
    }
    const since = this.#since.get(agent) ?? now;
    this.#since.set(agent, since);
    return since;
  }
}

/** @param {CanvasRenderingContext2D} context @param {Frame} frame @param {Walkers["list"]} list
 *  @param {number[]} ways The waypoints that come next. @param {number} shift @param {Theme} theme */
function drawWays(context, frame, list, ways, shift, theme) {
  context.strokeStyle = theme.css.agent;
  context.globalAlpha = Math.max(0.2, Math.min(0.6, 20 / list.length));
  context.lineWidth = 1.75 * frame.dpr;
  context.lineJoin = "round";
  list.forEach(({ x, y, path, state }, n) => {
    if (state !== "walking" || path.length < 2) return;
    context.beginPath();
    context.moveTo(frame.left + x * frame.scale, frame.top + y * frame.scale);
    for (let i = ways[n]; i + 1 < path.length; i += 2) {
      const px = frame.left + (path[i] + shift) * frame.scale;
      context.lineTo(px, frame.top + (path[i + 1] + shift) * frame.scale);
    }
    context.stroke();
  });
  context.globalAlpha = 1;
}

/** @param {CanvasRenderingContext2D} context @param {[number, number]} at @param {number} radius
 *  @param {string} state @param {number} heading @param {Theme} theme @param {number} dpr */
function drawAgent(context, [x, y], radius, state, heading, theme, dpr) {
  context.beginPath();
  if (state === "walking" && !Number.isNaN(heading)) {
    // A drop, whose tip is before it.
    context.arc(x, y, radius, heading + 0.8, heading - 0.8);
    context.lineTo(x + 1.75 * radius * Math.cos(heading), y + 1.75 * radius * Math.sin(heading));
    context.closePath();
  } else {
    context.arc(x, y, radius, 0, 7);
  }
  context.globalAlpha = state === "arrived" ? 0.6 : 1;
  // Two rims, a dark and a light one: on any ground one of them stands out.
  context.lineJoin = "round";
  for (const [color, width] of /** @type {const} */ ([
    [theme.css.text, 5],
    [theme.css.page, 3],
  ])) {
    context.strokeStyle = color;
    context.lineWidth = width * dpr;
    context.stroke();
  }
  context.fillStyle = state === "stuck" ? theme.css.page : theme.css.agent;
  context.fill();
  context.strokeStyle = theme.css.danger;
  context.lineWidth = 2 * dpr;
  if (state === "stuck") context.stroke();
  if (state === "stuck") {
    const side = 0.45 * radius;
    context.beginPath();
    context.moveTo(x - side, y - side);
    context.lineTo(x + side, y + side);
    context.moveTo(x + side, y - side);
    context.lineTo(x - side, y + side);
    context.stroke();
  }
  context.globalAlpha = 1;
}

/** The index in the path of the agent's next waypoint: the end of the segment nearest to the agent.
 *  @param {Agent} agent @param {number} shift */
function nextWaypoint({ x: px, y: py, path }, shift) {
  const [x, y] = [px - shift, py - shift];
  let [best, least] = [0, Infinity];
  for (let i = 0; i + 3 < path.length; i += 2) {
    const [dx, dy] = [path[i + 2] - path[i], path[i + 3] - path[i + 1]];
    const along = ((x - path[i]) * dx + (y - path[i + 1]) * dy) / (dx * dx + dy * dy || 1);
    const t = Math.min(1, Math.max(0, along));
    const away = Math.hypot(x - path[i] - t * dx, y - path[i + 1] - t * dy);
    if (away < least - 1e-6) [best, least] = [i + 2, away];
  }
  return best;
}
