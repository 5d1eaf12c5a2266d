// Lengths of shortest paths, by searches that are slow and plain. They share nothing with the engines.
#ifndef GPPC_HARNESS_REFERENCE_H
#define GPPC_HARNESS_REFERENCE_H

#include "map.h"
#include "octile.h"

#include <optional>

namespace harness {

// Over eight directions without cutting corners, by A* with exact lengths. Nothing if no path leads there,
// or an end is blocked.
std::optional<Octile> shortest_by_cells(const Map &map, Cell start, Cell goal);

// Of the any-angle track, by Dijkstra's algorithm over all corners that see each other. For small maps.
std::optional<long double> shortest_by_points(const Map &map, Cell start, Cell goal);

// Whether a path of the any-angle track leads there: from cell to cell across sides, since it passes no gap.
bool joined_by_points(const Map &map, Cell start, Cell goal);

} // namespace harness

#endif
