// The interfaces between the modules of the page. The modules are JavaScript with types in comments, which
// the tests check against this file.

import type { EngineInfo, Motion, Waypoints } from "./mediant/mediant.js";

/** A cell, or a vertex: x to the right, y down, from 0. At centers a vertex is its cell; at corners it is
 *  the top left corner of its cell. */
export type Point = [number, number];

export interface Rect {
  x: number;
  y: number;
  width: number;
  height: number;
}

/** An engine with its motion: what a lane of a race runs. Of `corners` and `gap` the placement takes one. */
export interface LaneSetup {
  engine: string;
  k: number | "any";
  placement: "center" | "corner";
  corners: "never" | "one" | "always";
  gap: "open" | "closed";
  smooth: "" | "linear" | "taut";
}

/** The picture over the map: the search as it spread, or one of the others. */
export type Overlay = "search" | "clearance" | "distances" | "flow" | "rules" | "none";

/** The origin of a map. A map that was edited says so beside it. */
export type MapSource =
  | { kind: "bundled"; name: string }
  | { kind: "generated"; name: string; side: number; seed: number }
  | { kind: "file"; name: string }
  | { kind: "empty"; width: number; height: number };

/** The parts of the scene that a change of the model touched. */
export interface Change {
  /** Another map: size, cells, ends. */
  map?: boolean;
  /** Cells in this rectangle. */
  cells?: Rect;
  ends?: boolean;
  lanes?: boolean;
  active?: boolean;
  overlay?: boolean;
  /** `nearest`, `radius`. */
  wishes?: boolean;
  agents?: boolean;
  /** A gesture began or ended. */
  gesture?: boolean;
}

/** model/model.js: the scene, and the only place that changes it. Dispatches `change` with a `Change` as
 *  `detail`. */
export interface Model extends EventTarget {
  readonly width: number;
  readonly height: number;
  /** Row by row, 1 = blocked. Changed in place. */
  readonly cells: Uint8Array;
  /** The cost of a unit of length on each cell: 1, 2, 4 or 8; null where all cost 1. Changed in place. */
  readonly costs: Uint8Array | null;
  /** The costs of the map as it was loaded. */
  readonly firstCosts: Uint8Array | null;
  /** Grows with every change of a cell, and with every map. */
  readonly version: number;
  readonly source: MapSource;
  readonly edited: boolean;
  readonly start: Point;
  readonly goal: Point;
  readonly lanes: readonly Readonly<LaneSetup>[];
  /** The lane that the panels show and change. */
  readonly active: number;
  readonly overlay: Overlay;
  /** If there is no way: lead to the reachable vertex nearest to the goal. */
  readonly nearest: boolean;
  /** The radius of the agent in cells; 0 for a point. */
  readonly radius: number;
  readonly agents: number;
  /** Between `beginGesture` and `endGesture`: an end is dragged, or cells are drawn. */
  readonly gesture: "" | "end" | "cells";

  load(map: {
    width: number;
    height: number;
    cells: Uint8Array;
    costs?: Uint8Array | null;
    source: MapSource;
    start?: Point;
    goal?: Point;
    edited?: boolean;
  }): void;
  /** All changes of cells until `endGesture` are one step of undo. */
  beginGesture(kind: "end" | "cells"): void;
  endGesture(): void;
  /** Sets these cells (numbers y · width + x). */
  paint(cells: Iterable<number>, blocked: boolean): void;
  /** Makes these cells free land on which a unit of length costs so much. */
  paintLand(cells: Iterable<number>, cost: number): void;
  /** Sets what a unit of length costs on these cells, walls or not. */
  setCosts(cells: Iterable<number>, cost: number): void;
  moveEnd(end: "start" | "goal", to: Point): void;
  undo(): void;
  redo(): void;
  readonly canUndo: boolean;
  readonly canRedo: boolean;
  setLane(index: number, change: Partial<LaneSetup>): void;
  setLanes(lanes: LaneSetup[]): void;
  addLane(): void;
  removeLane(index: number): void;
  /** Joins all changes that the work makes into one event. */
  batch(work: () => void): void;
  set(change: Partial<Pick<Model, "active" | "overlay" | "nearest" | "radius" | "agents">>): void;
}

/** The queries of a scenario. */
export interface Queries {
  name: string;
  /** The name of the map that they are for. */
  map: string;
  /** Whether the map of the page is as large as theirs. */
  fits: boolean;
  /** x, y, … */
  starts: Int32Array;
  goals: Int32Array;
  /** Lengths of shortest paths for k = 3 between centers that cut no corners; NaN where none is published. */
  lengths: Float64Array;
}

/** The answer of a lane's engine. */
export interface LaneAnswer {
  start: Point;
  goal: Point;
  status: "found" | "unreachable" | "nearest" | "invalid";
  /** Waypoints x, y, x, y, … in vertices of the lane's placement; empty if there is none. */
  path: Waypoints;
  /** In cells. */
  length: number;
  /** The cost of the path where steps cost differently; null where they do not. */
  cost: number | null;
  expanded: number;
  generated: number;
  /** Milliseconds of one query on a warm planner, once it has settled: the first runs include the browser's
   *  compiler. */
  ms: number;
  settled: boolean;
  /** `optimal(3)`, `suboptimal`, … */
  guarantee: string;
  optimal: boolean;
  /** The certificate: no path at any angle is shorter than length / bound. At centers it is the optimum
   *  itself, or the straight line. */
  bound: number | null;
  /** The steps of the search (`Trace.steps` of the package), if they were recorded; there are
   *  `verticesPerRow` in a row. */
  steps: Uint32Array | null;
  verticesPerRow: number;
  /** A shortest path at any angle. Comes a little later. Where steps cost differently it is over the lane's
   *  N(k), and its length is its cost. */
  reference: { length: number; path: Waypoints; what: "any" | "k" } | null;
  /** The error of an invalid query, as a sentence, with its code. */
  error: { code: string; message: string } | null;
}

/** The best path of a k. Without land its cost is its length. */
export interface Rung {
  cost: number;
  length: number;
}

export interface LaneState {
  phase: "starting" | "preparing" | "searching" | "done" | "cancelled" | "failed";
  progress: { stage: string; done: number; total: number } | null;
  /** Of a search under way: expansions so far. */
  expanded: number;
  /** The reason of a failure or a cancellation, as a sentence. */
  message: string;
  answer: LaneAnswer | null;
  /** Whether the scene has changed since the answer. */
  stale: boolean;
  /** The index, once it is there. `ms`: how long it took. */
  index: {
    ms: number;
    bytes: number;
    origin: string;
    /** `"labels"`: hub labels answer, and no search is shown. */
    levels: number | string | undefined;
    /** The engine that searches, if the lane's kept nothing. */
    searchedBy: string;
  } | null;
}

/** search/lanes.js: follows the model; each lane has a worker of its own. Dispatches `change` with
 *  `{ lane: number }`, `{ overlay: true }` or `{ ladder: true }` as `detail`. */
export interface Lanes extends EventTarget {
  /** Fulfilled when all engines can be asked. */
  readonly ready: Promise<void>;
  /** One for each lane of the model. */
  readonly list: readonly LaneState[];
  /** All engines; before `ready` none, or those of the light package. */
  readonly engines: readonly EngineInfo[];
  /** The moves of N(k), x, y, … in angular order. */
  moves(k: number): Promise<Int32Array>;
  /** The conflict between engine and motion, as a sentence; empty if there is none. */
  check(setup: LaneSetup): Promise<string>;
  /** The bounds of paths over N(k) with this motion, as ratios to the shortest at any angle; null where none
   *  is known. One for each k. */
  bounds(setup: LaneSetup, ks: number[]): Promise<(number | null)[]>;
  /** Stops a search or a preparation. */
  cancel(index: number): void;
  retry(index: number): void;
  /** The map in these files (a ROS map is two files). Rejects with an `Error` whose message is a sentence. */
  readMap(files: File[]): Promise<{ name: string; width: number; height: number; cells: Uint8Array }>;
  /** The queries of a scenario. Rejects as `readMap`. */
  readScenario(file: File): Promise<Queries>;
  /** The lane's search for the Posthoc visualizer. */
  trace(index: number): Promise<Blob>;
  picture(index: number, format: "png" | "svg"): Promise<Blob>;
  /** The values of the overlay, for the active lane: one for each vertex (or cell, for clearance). */
  readonly field: {
    kind: "clearance" | "distances" | "flow";
    width: number;
    height: number;
    placement: "center" | "corner";
    values: Float32Array;
    /** dx, dy for each vertex, of kind flow. */
    flow: Float32Array | null;
    greatest: number;
  } | null;
  /** The best path between the ends for each k, with the active lane's rules, as far as they are known. Where
   *  steps cost differently there is none beyond k = 8. */
  readonly ladder: ReadonlyMap<number | "any", Rung>;
  /** Whether no more of them will come for the scene of now. */
  readonly isLadderWhole: boolean;
  /** Where the active lane has no path: the vertices that its start reaches, 1, and those that its goal
   *  reaches, 2. */
  readonly parts: {
    width: number;
    height: number;
    placement: "center" | "corner";
    values: Uint8Array;
  } | null;
  /** The cells where the agent does not fit: 1 = too narrow, walls included; null for a point. */
  readonly tooNarrow: Uint8Array | null;
}

/** stage/player.js: how much of each search is shown. Dispatches `change`, and `use` when somebody plays. */
export interface Player extends EventTarget {
  /** Same pace: so many expansions of each lane. Real time: what each lane had done after so many ms,
   *  slowed down. */
  mode: "pace" | "time";
  /** Expansions (or thousandths of the longest search's time) a second. */
  speed: number;
  readonly playing: boolean;
  /** From 0 to `length`: expansions, or milliseconds. */
  readonly position: number;
  readonly length: number;
  /** Plays from the beginning, when all lanes have ended. */
  start(): void;
  play(): void;
  pause(): void;
  toggle(): void;
  /** One expansion on, or back. */
  step(by: number): void;
  seek(position: number): void;
  /** The number of the lane's steps that are shown. */
  shown(lane: number): number;
  /** Whether the lane has arrived, so that its path is shown. */
  arrived(lane: number): boolean;
}

export type Tool = "move" | "draw" | "erase" | "fill" | "rectangle";

/** stage/stage.js: the panes, one for each lane; pointer and keyboard on them. Dispatches `tool` when
 *  another tool or brush is taken, and `say` with a sentence as `detail` about the keyboard's cell. */
export interface Stage extends EventTarget {
  tool: Tool;
  /** The matter that the tools draw: 0 for walls, else land by what a step on it costs. */
  brush: number;
  /** The CSS pixels in the window of a point of the map, which is in cells. */
  place(lane: number, x: number, y: number): { x: number; y: number };
  /** Whether a path turns slowly into another one, while the page moves by itself. */
  glides: boolean;
  /** Whether the ends are called to be dragged. */
  calls: boolean;
  fit(): void;
  zoom(factor: number): void;
  /** Milliseconds of the page's work in each frame of the last drag. */
  readonly frames: readonly number[];
  /** Milliseconds from the pointer's move to the painted path, of the last drag. */
  readonly latencies: readonly number[];
}

export interface Walker {
  x: number;
  y: number;
  /** The rest of its path, in vertices. */
  path: Waypoints;
  state: "walking" | "arrived" | "stuck";
  /** Whether it has just planned anew. */
  fresh: boolean;
}

/** search/walkers.js: agents that walk to the goal with the active lane's motion and engine. Dispatches
 *  `change`. */
export interface Walkers extends EventTarget {
  readonly walking: boolean;
  /** Places in cells (fractions) of the drawn map, at the center of the agent. */
  readonly list: readonly Walker[];
  /** `kept` and `replanned` since the last edit; `checks` in all. */
  readonly counts: {
    walking: number;
    arrived: number;
    stuck: number;
    kept: number;
    replanned: number;
    ms: number;
  };
  start(count: number): void;
  stop(): void;
}

export type { EngineInfo, Motion };
