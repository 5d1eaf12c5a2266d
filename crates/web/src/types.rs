//! The types of plain objects, for TypeScript. The reference in the first line is for the `[Symbol.dispose]`
//! that wasm-bindgen declares, which older settings of TypeScript do not know.

use wasm_bindgen::prelude::*;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &str = r#"/// <reference lib="esnext.disposable" />

/**
 * A vertex: x to the right, y down, whole numbers from 0. For a path at any angle also any point between
 * vertices, rounded to multiples of 1/1024.
 */
export type Point = readonly [x: number, y: number];

/** One point or several: a point, an array of points, or an array of x, y, …. */
export type Points = Point | readonly Point[] | Waypoints;

/** The waypoints x, y, … of a path: in a `Float64Array` if one of them lies between vertices. */
export type Waypoints = Int32Array | Float64Array;

// described: calls
/** The motion of an agent. */
export interface Motion {
  /**
   * The neighborhood, of 2^k moves: k = 3 has 8, k = 8 has 256. From 2 to 12, or any, which is every
   * direction. 3 by default.
   */
  readonly k?: number | "any";
  /** The neighborhood by its number of moves, instead of k: 4, 8, 16, … 4096. */
  readonly neighbors?: number;
  /**
   * Where the vertices of paths are: at centers or at corners of cells. Corner (x, y) is the top left one of
   * cell (x, y). Corners by default for k = any, and for engines that search only there. center by default.
   */
  readonly placement?: "center" | "corner";
  /**
   * At centers, where a move touches a corner of cells: never cuts it (both cells beside it must be free),
   * one of them must be free, or it always may. Without a placement it means centers. never by default.
   */
  readonly corners?: "never" | "one" | "always";
  /**
   * At corners, whether a path may pass where two blocked cells touch diagonally: open or closed. Without a
   * placement it means corners. At centers it is for any angle, and closed by default. open by default.
   */
  readonly gap?: "open" | "closed";
}

/** Wishes beyond the ends of a path. */
export interface Wishes {
  /** If there is no path, the path to the reachable vertex that is nearest to the goal. */
  readonly nearest?: boolean;
  /** Moves a start or goal that is blocked, or outside the map, to the nearest free vertex. */
  readonly snap?: boolean;
  /** The path may end within this many cells of the goal, in a straight line, exactly so many included. */
  readonly tolerance?: number;
  /**
   * The greatest length of a path, in cells, or its cost where cells have costs; a path that is exactly as
   * long is within it. An engine that guarantees nothing may miss a path that is nearly as long.
   */
  readonly maxCost?: number;
  /** The greatest number of expansions of the search. */
  readonly maxExpansions?: number;
  /** The most time that the answer may take, in milliseconds. */
  readonly timeout?: number;
}

/** The options of engines; `engines()` says which engine takes which. */
export interface Options {
  /**
   * The heuristic of the search: hk, the cost on an empty grid (the default), euclidean, the straight-line
   * distance, or zero.
   */
  readonly heuristic?: "hk" | "euclidean" | "zero";
  /**
   * The number of levels of the subgoal graph (1 is the graph without a hierarchy) or of the clusters, or
   * all; for subgoal also labels (hub labels) or contracted (a contraction hierarchy). By default hub labels
   * for subgoal if they fit in --memory, else a contraction hierarchy; 2 levels for subgoal-theta, 3 for
   * hpa; with --index, those of the index.
   */
  readonly levels?: number | "all" | "contracted" | "labels";
  /**
   * The memory that the hub labels of subgoal may take, as 8MB: what they leave of it goes to labels of
   * vertices, with which queries are faster on most maps. By default they may take 64 bytes a cell, but at
   * least 48MB and at most 1GB, and vertices have none. A map whose labels take more has a contraction
   * hierarchy, and the same paths.
   */
  readonly memory?: number | string;
  /**
   * Cut the map into clusters (on the lowest level) or segments of N × N cells. 10 by default for hpa, 3 for
   * chpa; with --index, those of the index.
   */
  readonly side?: number;
  /**
   * The number of landmarks from which landmarks has all distances: 4, 8 or 16, the first of these that is
   * not less than N. 8 by default; 16 take twice the memory and the time to prepare, for queries 1.1 to 1.4
   * times as fast; with --index, those of the index.
   */
  readonly landmarks?: number;
  /**
   * Shortens paths after the search, by straight segments at any angle: linear looks for the next vertex in
   * sight along the path, taut pulls the path tight around the corners.
   */
  readonly smooth?: "linear" | "taut";
}

/** All that `Grid.path` takes. */
export interface How extends Motion, Wishes, Options {
  /** The engine. auto is the one that is best for what is asked. auto by default. */
  readonly engine?: string;
}

/** The kinds of answers. */
export type Status = "found" | "unreachable" | "nearest" | "stopped";

/** The limits that stop a search. */
export type Limit = "cost" | "expansions" | "timeout" | "cancelled";

/** The stages of a preparation that reports progress. */
export type Stage = "edges" | "hierarchy" | "sight" | "labels" | "vertices";

/** The ways in which an index came about. */
export type Origin = "prepared" | "loaded" | "repaired" | "unchanged";
// described: end

/** The motion of an agent with all its parts: `corners` at centers, `gap` at corners. */
export interface WholeMotion extends Motion {
  readonly k: number | "any";
  readonly placement: "center" | "corner";
}

/** The characters of a map's free and blocked cells. */
export interface TileOptions {
  /** The characters of free cells, `".GS"` by default. Without `blocked` all others are blocked. */
  readonly free?: string;
  /** The characters of blocked cells, `"@OTW#"` by default. Without `free` all others are free. */
  readonly blocked?: string;
}

/** Costs of cells, row by row: an array of numbers, or a typed one. */
export type Costs = ArrayLike<number>;

/** Costs of a new grid; the light module has none. */
export interface CostOptions {
  /** The cost of a unit of length in each cell, row by row: see `Grid.withCosts`. */
  readonly costs?: Costs;
  /** The width and the height of a cell; 1 and 1 by default. Only costs depend on it. */
  readonly cellSize?: readonly [x: number, y: number];
}

/** The options of `Grid.inflated`: lengths are in meters where the grid has a world, else in cells. */
export interface InflationOptions {
  /** The distance from obstacles up to which cells cost more: at least the inscribed radius. */
  readonly inflationRadius: number;
  /** The radius of the robot: cells so near to the center of a blocked one are blocked, too. 0 by default. */
  readonly inscribedRadius?: number;
  /**
   * The rate at which costs fall, per unit of length; by default they fall to those of byte 1 at the
   * inflation radius.
   */
  readonly costScalingFactor?: number;
  /** How much the bytes count, 0 or more: the dearest cells cost 1 + weight. 2 by default. */
  readonly weight?: number;
}

/** The options of `Grid.fromCostmap`. */
export interface CostmapOptions {
  /** How much the bytes count, 0 or more: the dearest cells cost 1 + weight. 2 by default. */
  readonly weight?: number;
  /** The byte for which unknown cells are taken, 0 to 252; by default, and for null, they are blocked. */
  readonly unknown?: number | null;
}

/** The options of `Grid.fromRows`. */
export interface RowOptions extends TileOptions, CostOptions {}

/** The options of reading a map from a file. The characters are those of a MovingAI map. */
export interface MapOptions extends TileOptions {
  /** A pixel that is darker than this part of white is blocked, 0 to 1. One half by default. */
  readonly threshold?: number;
  /** Light pixels are blocked. */
  readonly invert?: boolean;
  /** The state of transparent pixels, and of the unknown cells of a ROS map. Blocked by default. */
  readonly unknown?: "blocked" | "free";
  /**
   * The version of ROS by whose `map_server` the picture of a ROS map is read: ROS 2 (nav2 since 2025) or
   * ROS 1. ROS 2 by default.
   */
  readonly ros?: 1 | 2;
}

/** The radius of a disc: in cells, or in meters for a grid with a world. */
export type Radius = number | { readonly meters: number };

/** Cells that count otherwise than on the map, for one query. */
export interface Exceptions {
  /** Cells that count as blocked: other agents in the way. */
  readonly blocked?: Points;
  /** Cells that count as free. One that is among `blocked`, too, is free. */
  readonly free?: Points;
  /**
   * Whether starts and goals count as free, whatever else is said of their cells: the map has the cell of an
   * agent as blocked. Between corners this is the cell (x, y) of a vertex none of whose cells is free, on the
   * right and lower edge of the map the cell before it.
   */
  readonly freeEnds?: boolean;
}

/** The answer to a query. */
export interface Answer {
  /**
   * `"found"`; `"unreachable"`: there is no path; `"nearest"`: there is none, and the path leads to the
   * reachable vertex that is nearest to the goal; `"stopped"`: a limit stopped the search.
   */
  readonly status: Status;
  /** The waypoints x, y, … of a found or nearest answer. */
  readonly path?: Waypoints;
  /**
   * Its length in cells, as `Planner.distance` measures it; where cells have costs its cost. `Infinity` if
   * unreachable, `NaN` if stopped.
   */
  readonly distance: number;
  /** The cost of `path`, if cells have costs. */
  readonly cost?: number;
  /** The length of `path` in cells, whatever their size, if cells have costs. */
  readonly length?: number;
  /**
   * No path of the engine's kind to the goal that was asked for is shorter, in cells: no path over N(k), or at
   * k "any" and by an engine of any-angle paths no path at all. Of a found path its own length where the
   * engine guarantees that it is shortest, else 0; of a stopped answer what the search has ruled out;
   * `Infinity` where there is no path, also of a nearest answer.
   */
  readonly lowerBound: number;
  /**
   * The certificate of `path`, in cells: no path at any angle between its two ends is shorter, though it
   * bends at corners of obstacles. At corners it is the length of the path divided by `Index.bound`, or the
   * straight line if that is longer; between centers the shortest path at any angle, if that was asked for,
   * or the straight line.
   */
  readonly anyAngleLowerBound?: number;
  /** The limit that stopped the search. */
  readonly stoppedBy?: Limit;
  /** Of a stopped answer the best so far: a path to a goal, or to the vertex nearest to one. */
  readonly best?: Waypoints;
}

/** The result of `Space.widestPath`. */
export interface WidestPath {
  /** The waypoints x, y, …. */
  readonly path: Waypoints;
  /** Its length in cells. */
  readonly distance: number;
  /** The radius in cells of the disc that keeps its distance to all obstacles along it. */
  readonly radius: number;
}

/** The result of `Planner.nearest`. */
export interface NearestGoal {
  /** The number of the goal. */
  readonly goal: number;
  /** The length of the path to it, in cells. */
  readonly distance: number;
}

/** The name, limits and guarantee of an engine. */
export interface EngineInfo {
  readonly name: string;
  /** Its name in print: `"Block-based JPS"`. */
  readonly title: string;
  /** Its method, in a sentence. */
  readonly how: string;
  readonly placements: ("center" | "corner")[];
  /** The largest finite k; the smallest is 2. */
  readonly maxK: number;
  /** Whether it takes k "any". */
  readonly any: boolean;
  /** Whether it takes costs of cells: then k is 8 at most. */
  readonly costs: boolean;
  /** The guarantee of its paths: `"optimal(k)"`, `"suboptimal"`, …. */
  readonly guarantee: string;
  /** Its paper: first author and year. */
  readonly paper: string;
  /** Whether its index can be saved as bytes. */
  readonly index: boolean;
  /** The keys of `Options` that it takes. */
  readonly options: string[];
}

/** The error that is thrown, except for arguments of a wrong type: they are a `TypeError`. */
export interface MediantError extends Error {
  readonly name: "MediantError";
  /** Stable from version to version: `"start-blocked"`, `"map-format"`, …. */
  readonly code: string;
}
"#;

#[wasm_bindgen]
extern "C" {
    /// An answer.
    #[wasm_bindgen(typescript_type = "Answer")]
    pub type JsAnswer;

    #[wasm_bindgen(method, setter)]
    pub(crate) fn set_status(this: &JsAnswer, status: &JsValue);
    #[wasm_bindgen(method, setter)]
    pub(crate) fn set_path(this: &JsAnswer, path: &JsValue);
    #[wasm_bindgen(method, setter)]
    pub(crate) fn set_distance(this: &JsAnswer, distance: f64);
    #[wasm_bindgen(method, setter)]
    pub(crate) fn set_cost(this: &JsAnswer, cost: f64);
    #[wasm_bindgen(method, setter)]
    pub(crate) fn set_length(this: &JsAnswer, length: f64);
    #[wasm_bindgen(method, setter, js_name = lowerBound)]
    pub(crate) fn set_lower_bound(this: &JsAnswer, lower_bound: f64);
    #[wasm_bindgen(method, setter, js_name = anyAngleLowerBound)]
    pub(crate) fn set_any_angle_lower_bound(this: &JsAnswer, lower_bound: f64);
    #[wasm_bindgen(method, setter, js_name = stoppedBy)]
    pub(crate) fn set_stopped_by(this: &JsAnswer, limit: &str);
    #[wasm_bindgen(method, setter)]
    pub(crate) fn set_best(this: &JsAnswer, best: &JsValue);

    /// The waypoints of a path.
    #[wasm_bindgen(typescript_type = "Waypoints")]
    pub type JsWaypoints;
    /// Motion with all that it has.
    #[wasm_bindgen(typescript_type = "WholeMotion")]
    pub type JsMotion;
    /// The capabilities of engines.
    #[wasm_bindgen(typescript_type = "EngineInfo[]")]
    pub type JsEngines;
    /// A recommended engine, with the reason.
    #[wasm_bindgen(typescript_type = "{ engine: string; why: string }")]
    pub type JsChoice;
}
