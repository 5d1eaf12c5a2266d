// Checks paths over eight directions that never cut corners. Nothing here is shared with the engines.
#ifndef GPPC_HARNESS_CHECK_CELLS_H
#define GPPC_HARNESS_CHECK_CELLS_H

#include "map.h"
#include "octile.h"

#include <string>
#include <vector>

namespace harness {

struct CheckedCells {
  // Empty if the path is valid, else the first thing that is wrong.
  std::string wrong;
  Octile length;
};

// Whether points are joined by straight or exactly diagonal runs of free cells, from the start to the goal,
// and how long it is. One point alone is no path: that from a cell to itself is the cell, twice.
CheckedCells check_cells(const Map &map, Cell start, Cell goal, const std::vector<Cell> &path);

} // namespace harness

#endif
