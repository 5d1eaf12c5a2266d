// The scene: the map, its ends, the lanes and what is shown. The only place that changes it; everything else
// follows its `change` events.

import { BitSet } from "./bits.js";
import { Box, joined } from "./change.js";
import { findEnds } from "./ends.js";
import { compact, History } from "./history.js";
import { landOf } from "./land.js";
import * as setups from "./setups.js";
import { Costs, Terrain } from "./terrain.js";

/** @typedef {import("../../types.d.ts").Point} Point */
/** @typedef {import("../../types.d.ts").LaneSetup} LaneSetup */
/** @typedef {import("../../types.d.ts").MapSource} MapSource */
/** @typedef {import("./history.js").Step} Step */

/** @typedef {import("./change.js").Change} Change */

/** A map to load. `edited`: its cells are not those of its source any more.
 * @typedef {{ width: number, height: number, cells: Uint8Array, costs?: Uint8Array | null, source: MapSource,
 *   start?: Point, goal?: Point, edited?: boolean }} NewMap */

/** @typedef {import("../../types.d.ts").Model} Contract */
/** @typedef {Pick<Contract, "active" | "overlay" | "nearest" | "radius" | "agents">} Settings */

/** @implements {Contract} */
export class Model extends EventTarget {
  #terrain = new Terrain(0, 0, new Uint8Array(0), { kind: "empty", width: 0, height: 0 }, false);
  #version = 0;
  /** @type {Point} */ #start = [0, 0];
  /** @type {Point} */ #goal = [0, 0];

  /** @type {readonly Readonly<LaneSetup>[]} */ #lanes = [setups.FIRST_LANE];
  /** @type {Settings} */
  #settings = { active: 0, overlay: "none", nearest: false, radius: 0, agents: 0 };

  #history = new History();
  /** The cells that were flipped since the last step of undo. */
  #stroke = new BitSet(0);
  /** The costs before, of cells whose cost changed since the last step. @type {Map<number, number>} */
  #landStroke = new Map();
  /** The ends at the last step of undo. @type {[Point, Point]} */ #ends = [this.#start, this.#goal];
  #depth = 0;
  /** @type {"" | "end" | "cells"} */ #gesture = "";
  #isFirst = true;

  #batches = 0;
  /** @type {Change | null} */ #held = null;

  constructor() {
    super();
    const [width, height] = [32, 20];
    const source = /** @type {const} */ ({ kind: "empty", width, height });
    const cells = new Uint8Array(width * height);
    this.load({ width, height, cells, source, start: [5, 10], goal: [26, 10] });
    this.paint(
      Array.from({ length: 12 }, (_, i) => (i + 3) * width + 16),
      true,
    );
    this.#history.clear();
    this.#isFirst = true;
  }

  get width() {
    return this.#terrain.width;
  }
  get height() {
    return this.#terrain.height;
  }
  get cells() {
    return this.#terrain.cells;
  }
  get costs() {
    const { land } = this.#terrain;
    return land.dear > 0 ? land.now : null;
  }
  /** The costs as the map was loaded. */
  get firstCosts() {
    return this.#terrain.land.first;
  }
  get version() {
    return this.#version;
  }
  get source() {
    return this.#terrain.source;
  }
  get edited() {
    return this.#terrain.edited;
  }
  get start() {
    return this.#start;
  }
  get goal() {
    return this.#goal;
  }
  get lanes() {
    return this.#lanes;
  }
  get active() {
    return this.#settings.active;
  }
  get overlay() {
    return this.#settings.overlay;
  }
  get nearest() {
    return this.#settings.nearest;
  }
  get radius() {
    return this.#settings.radius;
  }
  get agents() {
    return this.#settings.agents;
  }
  get gesture() {
    return this.#gesture;
  }
  get canUndo() {
    return this.#isPending || this.#history.canUndo;
  }
  get canRedo() {
    return this.#history.canRedo && !this.#isPending;
  }

  /** The cells that differ from the map as it was loaded, in order. */
  edits() {
    return this.#terrain.edits.toList();
  }

  /** Another map: one step of undo, but for the first one, which replaces a scene that nobody made.
   * @param {NewMap} map */
  load({ width, height, cells, costs = null, source, start, goal, edited = false }) {
    const why = [cells, costs ?? cells].map((array) => setups.whyNoMap(width, height, array)).join("");
    if (why !== "") throw new RangeError(why);
    this.#commit();
    if (this.#isFirst && !this.#history.canUndo) this.#history.clear();
    else this.#history.push({ cells: null, ends: this.#ends, map: this.#terrain.pack() });
    this.#isFirst = false;
    const copy = cells.map((cell) => (cell === 0 ? 0 : 1));
    const land = new Costs(copy.length, costs?.slice() ?? null);
    this.#setTerrain(new Terrain(width, height, copy, source, edited, land));
    const ends = findEnds(width, height, copy, { start, goal });
    this.#start = this.#clamped(ends.start);
    this.#goal = this.#clamped(ends.goal);
    this.#ends = [this.#start, this.#goal];
    this.#tell({ map: true });
  }

  /** @param {"end" | "cells"} kind */
  beginGesture(kind) {
    this.#depth++;
    if (this.#depth > 1) return;
    this.#gesture = kind;
    this.#tell({ gesture: true });
  }

  endGesture() {
    if (this.#depth === 0 || --this.#depth > 0) return;
    this.#commit();
    this.#gesture = "";
    this.#tell({ gesture: true });
  }

  /** @param {Iterable<number>} cells @param {boolean} blocked */
  paint(cells, blocked) {
    const other = blocked ? 0 : 1;
    const terrain = this.#terrain;
    const box = new Box(terrain.width);
    for (const cell of cells) {
      // This also passes over what is no cell: outside of the array there is nothing.
      if (terrain.cells[cell] !== other) continue;
      terrain.flip(cell);
      this.#stroke.flip(cell);
      box.add(cell);
    }
    this.#afterChange(box.rect === null ? null : { cells: box.rect });
  }

  /** Makes land of these cells: steps on it cost so much. Walls on it go.
   * @param {Iterable<number>} cells @param {number} cost */
  paintLand(cells, cost) {
    const list = [...cells];
    this.batch(() => {
      this.paint(list, false);
      this.setCosts(list, cost);
    });
  }

  /** Sets what steps on these cells cost, walls or not.
   * @param {Iterable<number>} cells @param {number} cost */
  setCosts(cells, cost) {
    if (landOf(cost) === undefined) return;
    const { land, width } = this.#terrain;
    const box = new Box(width);
    for (const cell of cells) {
      if (!(cell in this.#terrain.cells)) continue;
      const before = land.at(cell);
      if (before === cost) continue;
      land.set(cell, cost);
      if (!this.#landStroke.has(cell)) this.#landStroke.set(cell, before);
      box.add(cell);
    }
    this.#afterChange(box.rect === null ? null : { cells: box.rect });
  }

  /** @param {"start" | "goal"} end @param {Point} to */
  moveEnd(end, to) {
    const place = this.#clamped(to);
    const old = end === "start" ? this.#start : this.#goal;
    if (isSame(old, place)) return;
    if (end === "start") this.#start = place;
    else this.#goal = place;
    this.#afterChange({ ends: true });
  }

  undo() {
    this.#commit();
    this.#history.undo((step) => this.#exchange(step));
  }

  redo() {
    this.#commit();
    this.#history.redo((step) => this.#exchange(step));
  }

  /** @param {number} index @param {Partial<LaneSetup>} change */
  setLane(index, change) {
    if (!(index in this.#lanes)) return;
    this.setLanes(this.#lanes.map((lane, i) => (i === index ? { ...lane, ...change } : { ...lane })));
  }

  /** @param {LaneSetup[]} lanes */
  setLanes(lanes) {
    const why = setups.whyNoLanes(lanes);
    if (why !== "") throw new RangeError(why);
    if (setups.areSameLanes(lanes, this.#lanes)) return;
    this.#lanes = Object.freeze(lanes.map((lane) => Object.freeze({ ...lane })));
    this.batch(() => {
      this.#tell({ lanes: true });
      this.set({ active: this.active });
    });
  }

  /** Adds a lane like the active one, at the end, and makes it the active one. */
  addLane() {
    if (this.#lanes.length >= setups.MOST_LANES) return;
    this.batch(() => {
      this.setLanes([...this.#lanes, this.#lanes[this.active]].map((lane) => ({ ...lane })));
      this.set({ active: this.#lanes.length - 1 });
    });
  }

  /** @param {number} index */
  removeLane(index) {
    if (this.#lanes.length < 2 || !(index in this.#lanes)) return;
    const active = this.active > index ? this.active - 1 : this.active;
    this.batch(() => {
      this.setLanes(this.#lanes.filter((_, i) => i !== index).map((lane) => ({ ...lane })));
      this.set({ active });
    });
  }

  /** Numbers are brought into their bounds; what is no legal value changes nothing.
   * @param {Partial<Settings>} change */
  set(change) {
    const old = this.#settings;
    const next = {
      active: setups.whole(change.active, 0, this.#lanes.length - 1) ?? old.active,
      overlay: setups.OVERLAYS.find((overlay) => overlay === change.overlay) ?? old.overlay,
      nearest: typeof change.nearest === "boolean" ? change.nearest : old.nearest,
      radius: setups.radius(change.radius) ?? old.radius,
      agents: setups.whole(change.agents, 0, setups.MOST_AGENTS) ?? old.agents,
    };
    this.#settings = next;
    const told = /** @type {Change} */ ({});
    if (next.active !== old.active) told.active = true;
    if (next.overlay !== old.overlay) told.overlay = true;
    if (next.nearest !== old.nearest || next.radius !== old.radius) told.wishes = true;
    if (next.agents !== old.agents) told.agents = true;
    if (Object.keys(told).length > 0) this.#tell(told);
  }

  /** Joins all changes that the work makes into one event.
   * @param {() => void} work */
  batch(work) {
    this.#batches++;
    try {
      work();
    } finally {
      this.#batches--;
      const held = this.#held;
      if (this.#batches === 0 && held !== null) {
        this.#held = null;
        this.#tell(held);
      }
    }
  }

  /** @param {Change} change */
  #tell(change) {
    if (this.#batches === 0) this.dispatchEvent(new CustomEvent("change", { detail: change }));
    else this.#held = joined(this.#held ?? {}, change);
  }

  /** @param {Change | null} change */
  #afterChange(change) {
    if (this.#depth === 0) this.#commit();
    if (change === null) return;
    if (change.cells) this.#version++;
    this.#tell(change);
  }

  /** Whether there are changes that are no step of undo yet. */
  get #isPending() {
    const [start, goal] = this.#ends;
    const isPainted = this.#stroke.count > 0 || this.#landStroke.size > 0;
    return isPainted || !isSame(start, this.#start) || !isSame(goal, this.#goal);
  }

  /** Makes what is pending a step of undo. */
  #commit() {
    if (!this.#isPending) return;
    const cells = this.#stroke.count > 0 ? compact(this.#stroke) : null;
    const costs = this.#landStroke.size > 0 ? this.#landStroke : null;
    this.#history.push({ cells, costs, ends: this.#ends, map: null });
    this.#stroke.clear();
    this.#landStroke = new Map();
    this.#ends = [this.#start, this.#goal];
  }

  /** Undoes or redoes a step: exchanges what it holds with what the scene has.
   * @param {Step} step */
  #exchange(step) {
    /** @type {Change} */ const told = {};
    if (step.map !== null) {
      const other = step.map;
      step.map = this.#terrain.pack();
      this.#setTerrain(Terrain.unpack(other));
      told.map = true;
    }
    if (step.cells !== null || step.costs) {
      const terrain = this.#terrain;
      const box = new Box(terrain.width);
      step.cells?.forEach((/** @type {number} */ cell) => {
        terrain.flip(cell);
        box.add(cell);
      });
      for (const [cell, cost] of step.costs ?? []) {
        step.costs?.set(cell, terrain.land.at(cell));
        terrain.land.set(cell, cost);
        box.add(cell);
      }
      this.#version++;
      if (box.rect !== null) told.cells = box.rect;
    }
    const ends = /** @type {[Point, Point]} */ ([this.#start, this.#goal]);
    if (step.ends !== null) {
      [this.#start, this.#goal] = step.ends;
      if (!isSame(ends[0], this.#start) || !isSame(ends[1], this.#goal)) told.ends = true;
      step.ends = ends;
    }
    this.#ends = [this.#start, this.#goal];
    this.#tell(told);
  }

  /** @param {Terrain} terrain */
  #setTerrain(terrain) {
    this.#terrain = terrain;
    this.#stroke = new BitSet(terrain.cells.length);
    this.#landStroke = new Map();
    this.#version++;
  }

  /** The nearest cell of the map.
   * @param {Point} point @returns {Point} */
  #clamped([x, y]) {
    const { whole } = setups;
    return [whole(x, 0, this.width - 1) ?? 0, whole(y, 0, this.height - 1) ?? 0];
  }
}

/** @param {Point} a @param {Point} b */
function isSame(a, b) {
  return a[0] === b[0] && a[1] === b[1];
}
