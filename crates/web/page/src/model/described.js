// The engines, and the words of a motion, as the library describes them.

// described: page
/** @type {Record<string, { name: string, how: string }>} */
export const ENGINES = {
  astar: {
    name: "A*",
    how: "Expands the vertex with the least cost so far plus distance over N(k) to the goal.",
  },
  dijkstra: {
    name: "Dijkstra",
    how: "Expands the vertices in the order of their cost, in all directions alike.",
  },
  wavefront: {
    name: "Wavefront",
    how: "Spreads ring by ring, and counts moves rather than length.",
  },
  canonical: {
    name: "Canonical A*",
    how: "A* that follows one of the paths that differ only in the order of their moves.",
  },
  jps: {
    name: "JPS",
    how: "Jumps over the vertices at which no shortest path turns.",
  },
  "jps-block": {
    name: "Block-based JPS",
    how: "JPS that looks at 64 vertices at once, by operations on a word.",
  },
  "jps-plus": {
    name: "JPS+",
    how: "JPS with the jump points of every vertex prepared in lists.",
  },
  theta: {
    name: "Theta*",
    how: "A* in which the parent may be any vertex that is seen: paths at any angle.",
  },
  "lazy-theta": {
    name: "Lazy Theta*",
    how: "Theta* that tests whether a vertex is seen only when it expands it.",
  },
  anya: {
    name: "Anya",
    how: "Searches intervals of grid lines that a root sees: exact over N(k) and at every angle.",
  },
  subgoal: {
    name: "Subgoal graph",
    how:
      "Joins two prepared labels, lists of corners at which shortest paths turn, without a search. " +
      "Where labels would take too much memory, it searches a prepared graph.",
  },
  "subgoal-theta": {
    name: "Sub-Theta*",
    how: "Theta* over a prepared subgoal graph.",
  },
  hpa: {
    name: "HPA*",
    how: "Plans over prepared clusters of the map, then refines the plan down to cells.",
  },
  chpa: {
    name: "CHPA*",
    how: "Plans checkpoints over prepared segments of the map, then searches from one to the next.",
  },
  landmarks: {
    name: "Landmarks (ALT)",
    how:
      "A* guided by the prepared distances of all vertices from a few landmarks; made for costs of " +
      "cells.",
  },
};

/** The largest k that an engine takes. Beyond it there is only "any". */
export const LARGEST_K = 12;

/** The words that each field of a lane may be. */
export const CHOICES = Object.freeze({
  placement: ["center", "corner"],
  corners: ["never", "one", "always"],
  gap: ["open", "closed"],
  smooth: ["", "linear", "taut"],
});
// described: end
