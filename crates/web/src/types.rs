//! The types of plain objects, for TypeScript. The reference in the first line is for the `[Symbol.dispose]`
//! that wasm-bindgen declares, which older settings of TypeScript do not know.

use js_sys::Int32Array;
use wasm_bindgen::prelude::*;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &str = r#"/// <reference lib="esnext.disposable" />

/** A vertex: x to the right, y down, whole numbers from 0. */
export type Point = readonly [x: number, y: number];

/** One vertex or several: a point, an array of points, or an `Int32Array` of x, y, …. */
export type Points = Point | readonly Point[] | Int32Array;

/** How an agent moves. */
export interface Motion {
  /**
   * The neighborhood: 2^k directions, `k` from 2 to 12, so that k = 3 has 8 moves and k = 8 has 256; or
   * `"any"` for every direction. 3 by default.
   */
  readonly k?: number | "any";
  /** The neighborhood by its number of moves, in place of `k`: 4, 8, 16, … 4096. */
  readonly neighbors?: number;
  /** Where the vertices are: at centers or corners of cells. Centers by default, corners for k "any". */
  readonly placement?: "center" | "corner";
  /**
   * At centers: whether a path may cut the corner of a blocked cell. Never by default. Without `placement` it
   * means centers.
   */
  readonly corners?: "never" | "one" | "always";
  /**
   * At corners: whether a path may pass where two blocked cells touch diagonally. Open by default. Without
   * `placement` it means corners.
   */
  readonly gap?: "open" | "closed";
}

/** How an agent moves, with all that it has: `corners` at centers, `gap` at corners. */
export interface WholeMotion extends Motion {
  readonly k: number | "any";
  readonly placement: "center" | "corner";
}

/** What a query asks beyond a path. */
export interface Wishes {
  /** Where no path leads, one to the reachable vertex that is nearest to the goal. */
  readonly nearest?: boolean;
  /** Moves a start or goal that is blocked to the nearest free vertex. */
  readonly snap?: boolean;
  /** The path may end within this distance of the goal, in cells, exactly so far included. */
  readonly tolerance?: number;
  /** The greatest length of a path, in cells; one that is exactly as long is within it. */
  readonly maxCost?: number;
  /** Stops the search after this many expansions. */
  readonly maxExpansions?: number;
  /** Stops the search after this many milliseconds. */
  readonly timeout?: number;
}

/** The options of engines; `engines()` says which engine takes which. */
export interface Options {
  /** The heuristic of the search. */
  readonly heuristic?: "hk" | "euclidean" | "zero" | "squared";
  /** The repaired engine, or the published one. */
  readonly variant?: "exact" | "complete" | "paper";
  /** Jumps take at most this many steps. */
  readonly jumpLimit?: number;
  /** Keeps intermediate jump points. */
  readonly keepIntermediate?: boolean;
  /**
   * The levels of subgoal graphs and of clusters; for `"subgoal"` also a contraction hierarchy or hub labels.
   * By default it has hub labels if they fit in `memory`, else a contraction hierarchy.
   */
  readonly levels?: number | "all" | "contracted" | "labels";
  /**
   * The memory that hub labels may take: bytes, or a text as `"8MB"`. By default 48 bytes a cell, but at least
   * 32 MB and at most 1 GB.
   */
  readonly memory?: number | string;
  /** The side of a cluster or segment, in cells. */
  readonly side?: number;
  /** Leaves out the straightening of HPA*. */
  readonly unstraightened?: boolean;
  /** The heuristic of the second phase of CHPA*. */
  readonly second?: "hk" | "euclidean" | "zero" | "squared";
  /** A checkpoint every this many segments. */
  readonly step?: number;
  /** How many times longer than on an empty grid the way to a checkpoint may be. */
  readonly detour?: number;
  /** Shortens paths after the search; they are at any angle then. */
  readonly smooth?: "linear" | "taut";
}

/** What `Grid.path` takes. */
export interface How extends Motion, Wishes, Options {
  /** The engine; by default ("auto") one that prepares little. */
  readonly engine?: string;
}

/** Which characters of a map are free cells, and which are blocked. */
export interface TileOptions {
  /** The characters of free cells, `".GS"` by default. Without `blocked` all others are blocked. */
  readonly free?: string;
  /** The characters of blocked cells, `"@OTW#"` by default. Without `free` all others are free. */
  readonly blocked?: string;
}

/** How a file becomes a map. The characters are those of a MovingAI map. */
export interface MapOptions extends TileOptions {
  /** A pixel that is darker than this part of white is blocked, 0 to 1. One half by default. */
  readonly threshold?: number;
  /** Light pixels are blocked. */
  readonly invert?: boolean;
  /** What becomes of transparent pixels, and of the unknown cells of a ROS map. Blocked by default. */
  readonly unknown?: "blocked" | "free";
  /**
   * Whose `map_server` says how the picture of a ROS map is read: that of ROS 2 (nav2 since 2025) or that of
   * ROS 1. ROS 2 by default.
   */
  readonly ros?: 1 | 2;
}

/** The answer to a query. */
export interface Answer {
  /**
   * `"found"`; `"unreachable"`: there is no path; `"nearest"`: there is none, and the path leads to the
   * reachable vertex that is nearest to the goal; `"stopped"`: a limit stopped the search.
   */
  readonly status: "found" | "unreachable" | "nearest" | "stopped";
  /** The waypoints x, y, … of a found or nearest answer. */
  readonly path?: Int32Array;
  /** Its length in cells, as `Planner.distance` measures it; `Infinity` if unreachable, `NaN` if stopped. */
  readonly distance: number;
  /**
   * No path of the engine's kind to the goal that was asked for is shorter, in cells: no path over N(k), or at
   * k "any" and by an engine of any-angle paths no path at all. Of a found path its own length where the
   * engine guarantees that it is shortest, else 0; of a stopped answer what the search has ruled out;
   * `Infinity` where there is no path, also of a nearest answer.
   */
  readonly lowerBound: number;
  /** The limit that stopped the search. */
  readonly stoppedBy?: "cost" | "expansions" | "timeout";
  /** Of a stopped answer the best so far: a path to a goal, or to the vertex nearest to one. */
  readonly best?: Int32Array;
}

/** What `Space.widestPath` finds. */
export interface WidestPath {
  /** The waypoints x, y, …. */
  readonly path: Int32Array;
  /** Its length in cells. */
  readonly distance: number;
  /** The radius in cells of the disc that keeps its distance to all obstacles along it. */
  readonly radius: number;
}

/** What `Planner.nearest` finds. */
export interface NearestGoal {
  /** The number of the goal. */
  readonly goal: number;
  /** The length of the path to it, in cells. */
  readonly distance: number;
}

/** What an engine can do. */
export interface EngineInfo {
  readonly name: string;
  readonly placements: ("center" | "corner")[];
  /** The largest finite k; the smallest is 2. */
  readonly maxK: number;
  /** Whether it takes k "any". */
  readonly any: boolean;
  /** What is guaranteed of its paths: `"optimal(k)"`, `"suboptimal"`, …. */
  readonly guarantee: string;
  /** Its paper: first author and year. */
  readonly paper: string;
  /** Whether its index can be saved as bytes. */
  readonly index: boolean;
  /** The keys of `Options` that it takes. */
  readonly options: string[];
}

/** What is thrown, but for arguments of a wrong type, which are a `TypeError`. */
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
    pub(crate) fn set_path(this: &JsAnswer, path: Int32Array);
    #[wasm_bindgen(method, setter)]
    pub(crate) fn set_distance(this: &JsAnswer, distance: f64);
    #[wasm_bindgen(method, setter, js_name = lowerBound)]
    pub(crate) fn set_lower_bound(this: &JsAnswer, lower_bound: f64);
    #[wasm_bindgen(method, setter, js_name = stoppedBy)]
    pub(crate) fn set_stopped_by(this: &JsAnswer, limit: &str);
    #[wasm_bindgen(method, setter)]
    pub(crate) fn set_best(this: &JsAnswer, best: Int32Array);

    /// Motion with all that it has.
    #[wasm_bindgen(typescript_type = "WholeMotion")]
    pub type JsMotion;
    /// What engines can do.
    #[wasm_bindgen(typescript_type = "EngineInfo[]")]
    pub type JsEngines;
    /// An engine, and why.
    #[wasm_bindgen(typescript_type = "{ engine: string; why: string }")]
    pub type JsChoice;
}
