// The state of a lane's worker: the map, the map for the agent, the space with its motion, the engine's
// index and its planners. It is brought up to date before each query. Objects of the package that are
// replaced are freed.

/** @import { LaneSetup } from "../../types.js" */
/** @import { Grid, Index, Planner, Space } from "../../mediant/mediant.js" */
/** @import { Ask, MapNews } from "./protocol.js" */
import { mediant } from "./package.js";
import { motionKey, motionOf, optionsOf, setupKey } from "./protocol.js";

/** @typedef {(stage: string, done: number, total: number) => void} Progress */

/** Expansions in a millisecond of a slow engine: how we begin. */
const SLOW = 30;

export class Session {
  /** @type {MapNews[]} */
  #news = [];
  /** The map. @type {Grid | null} */
  #grid = null;
  /** The motion and radius of the space. */
  #spaceKey = "";
  /** The setup of the index. */
  #indexKey = "";
  /** Whether the engine tells its progress: it prepares long, and repairs nothing. */
  #tells = false;
  /** @type {Space | null} */
  space = null;
  /** @type {Index | null} */
  index = null;
  /** @type {Planner | null} */
  planner = null;
  /** A planner for the agents, who walk while a search is under way. @type {Planner | null} */
  #walker = null;
  /** The planner for the optimum. @type {Planner | null} */
  #judge = null;
  /** Whether the last index came from the one of the map before. */
  wasEdit = false;
  /** Grows with each change of the space or the index. */
  serial = 0;
  /** Expansions in a millisecond, by the last search. */
  pace = SLOW;
  /** The same of the search for the optimum, and what the last one took, in ms. */
  judged = { pace: SLOW, making: Infinity, ms: Infinity };

  /** @param {MapNews} news */
  note(news) {
    if (news.map) {
      this.#news = [];
    }
    if (news.map || news.patch) {
      this.#news.push(news);
    }
  }

  /**
   * Whether `sync` has anything to do.
   * @param {Ask} ask
   */
  isBehind(ask) {
    return (
      this.#news.length > 0 ||
      !this.index ||
      setupKey(ask.setup) !== this.#indexKey ||
      spaceKey(ask) !== this.#spaceKey
    );
  }

  /**
   * Brings all up to date. Returns the milliseconds that the index took, or null if it was there.
   * @param {Ask} ask
   * @param {Progress} progress
   * @returns {number | null}
   */
  sync(ask, progress) {
    if (!this.isBehind(ask)) {
      return null;
    }
    this.serial++;
    this.#dropPlanners();
    const hasMap = this.#news.some((news) => news.map);
    if (hasMap || setupKey(ask.setup) !== this.#indexKey || spaceKey(ask) !== this.#spaceKey) {
      this.#dropIndex();
    }
    if (hasMap || spaceKey(ask) !== this.#spaceKey) {
      this.#dropSpace();
    }
    this.wasEdit = this.index !== null;
    try {
      return this.#prepare(ask, progress);
    } catch (error) {
      // An index that does not belong to the space must not answer.
      this.#dropIndex();
      throw error;
    }
  }

  /**
   * @param {Ask} ask
   * @param {Progress} progress
   */
  #prepare(ask, progress) {
    const space = this.#changedSpace(ask);
    if (space !== this.space) {
      this.space?.free();
      this.space = space;
    }
    this.#spaceKey = spaceKey(ask);
    const began = performance.now();
    const index = this.#changedIndex(ask.setup, space, progress);
    const ms = performance.now() - began;
    this.index?.free();
    this.index = index;
    this.#indexKey = setupKey(ask.setup);
    this.planner = index.planner();
    return ms;
  }

  /**
   * The space with all news.
   * @param {Ask} ask
   * @returns {Space}
   */
  #changedSpace(ask) {
    const [news, space] = [this.#news, this.space];
    this.#news = [];
    if (space && !ask.radius) {
      return news.reduce((space, news) => this.#editedSpace(space, news), space);
    }
    this.#grid = news.reduce(edited, this.#grid);
    return space && !news.length ? space : spaceOf(/** @type {Grid} */ (this.#grid), ask);
  }

  /**
   * @param {Space} space
   * @param {MapNews} news
   */
  #editedSpace(space, { patch }) {
    if (!patch) {
      return space;
    }
    const changed = patched(space, patch);
    if (space !== this.space) {
      space.free();
    }
    this.#grid?.free();
    this.#grid = changed.grid;
    return changed;
  }

  /**
   * @param {LaneSetup} setup
   * @param {Space} space
   * @param {Progress} progress
   * @returns {Index}
   */
  #changedIndex(setup, space, progress) {
    if (this.index && (!this.#tells || isOf(this.index, space))) {
      return this.index.repair(space);
    }
    this.#tells = false;
    return space.prepare(setup.engine, optionsOf(setup), (stage, done, total) => {
      this.#tells = true;
      progress(stage, done, total);
    });
  }

  /** The map of the space. */
  get grid() {
    return this.#grid;
  }

  /** A planner for the agents. */
  get walker() {
    this.#walker ??= this.index?.planner() ?? null;
    return this.#walker;
  }

  /** The milliseconds that the true optimum would take, as far as it is known. */
  get judgment() {
    return this.judged.ms + (this.#judge ? 0 : this.judged.making);
  }

  /**
   * The planner for the optimum: at any angle, where steps cost differently over N(k).
   * @param {Ask} ask
   * @returns {Planner}
   */
  judge({ setup }) {
    if (this.#judge) {
      return this.#judge;
    }
    const began = performance.now();
    const space = /** @type {Space} */ (this.space);
    const grid = space.grid;
    const free = grid.space(motionOf({ ...setup, k: "any" }));
    this.#judge = planned(free, "anya");
    grid.free();
    free.free();
    this.judged.making = performance.now() - began;
    return this.#judge;
  }

  #dropSpace() {
    this.space?.free();
    this.space = null;
  }

  #dropPlanners() {
    for (const planner of [this.planner, this.#walker, this.#judge]) {
      planner?.free();
    }
    this.planner = this.#walker = this.#judge = null;
  }

  #dropIndex() {
    this.index?.free();
    this.index = null;
    this.#tells = false;
    this.pace = SLOW;
    this.judged = { pace: SLOW, making: Infinity, ms: Infinity };
  }
}

/** @param {Ask} ask */
const spaceKey = (ask) => `${motionKey(ask.setup)} ${ask.radius}`;

/**
 * Whether an index is of the map of a space.
 * @param {Index} index
 * @param {Space} space
 */
function isOf(index, space) {
  const own = index.space;
  const grids = [own.grid, space.grid];
  const same = grids[0].id === grids[1].id;
  for (const object of [own, ...grids]) {
    object.free();
  }
  return same;
}

/**
 * The map after a change. It is another object; the one before is freed.
 * @param {Grid | null} grid
 * @param {MapNews} news
 * @returns {Grid | null}
 */
export function edited(grid, { map, patch }) {
  if (map) {
    grid?.free();
    return new mediant.Grid(map.width, map.height, map.cells, map.costs ? { costs: map.costs } : undefined);
  }
  if (!patch || !grid) {
    return grid;
  }
  const after = patched(grid, patch);
  grid.free();
  return after;
}

/**
 * A map or a space with other cells in a rectangle; with what each costs, if they cost differently.
 * @template {Grid | Space} T
 * @param {T} of
 * @param {NonNullable<MapNews["patch"]>} patch
 * @returns {T}
 */
function patched(of, { x, y, width, height, cells, costs }) {
  if (!costs) {
    return /** @type {T} */ (of.edit(x, y, width, height, cells));
  }
  const places = new Int32Array(2 * cells.length);
  for (let i = 0; i < cells.length; i++) {
    places[2 * i] = x + (i % width);
    places[2 * i + 1] = y + Math.floor(i / width);
  }
  const each = Array.from(cells, (cell, i) => (cell ? null : costs[i]));
  return /** @type {T} */ (of.editCosts(places, each));
}

/**
 * The space of a map for an agent.
 * @param {Grid} grid
 * @param {{ setup: LaneSetup, radius: number }} scene
 */
export function spaceOf(grid, { setup, radius }) {
  const motion = motionOf(setup);
  if (!radius) {
    return grid.space(motion);
  }
  const fitted = grid.forDisc(radius, motion);
  const space = fitted.space(motion);
  fitted.free();
  return space;
}

/**
 * @param {Space} space
 * @param {string} engine
 * @returns {Planner}
 */
function planned(space, engine) {
  const index = space.prepare(engine);
  const planner = index.planner();
  index.free();
  return planner;
}
