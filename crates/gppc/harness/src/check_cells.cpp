#include "check_cells.h"

#include <cstdlib>

namespace harness {

namespace {

std::string text(Cell at) {
  return "(" + std::to_string(at.x) + ", " + std::to_string(at.y) + ")";
}

int sign(int number) {
  return (number > 0) - (number < 0);
}

// Walks a run cell by cell. The first cell is free.
std::string walk(const Map &map, Cell from, Cell to, Octile &length) {
  int dx = to.x - from.x, dy = to.y - from.y;
  if (dx != 0 && dy != 0 && std::abs(dx) != std::abs(dy)) {
    return "from " + text(from) + " to " + text(to) + " is neither straight nor diagonal";
  }
  int sx = sign(dx), sy = sign(dy);
  for (Cell at = from; !(at == to);) {
    Cell next{at.x + sx, at.y + sy};
    if (!map.free(next)) {
      return "the path enters the blocked cell " + text(next);
    }
    if (sx != 0 && sy != 0) {
      if (!map.free(at.x, next.y) || !map.free(next.x, at.y)) {
        return "the path cuts the corner between " + text(at) + " and " + text(next);
      }
      ++length.diagonal;
    } else {
      ++length.straight;
    }
    at = next;
  }
  return "";
}

} // namespace

CheckedCells check_cells(const Map &map, Cell start, Cell goal, const std::vector<Cell> &path) {
  CheckedCells checked;
  if (path.size() < 2) {
    checked.wrong = path.empty() ? "no point is no path" : "one point alone is no path";
  } else if (!(path.front() == start)) {
    checked.wrong = "the path starts at " + text(path.front()) + ", not at " + text(start);
  } else if (!(path.back() == goal)) {
    checked.wrong = "the path ends at " + text(path.back()) + ", not at " + text(goal);
  } else if (!map.free(start)) {
    checked.wrong = "the start is blocked";
  }
  for (std::size_t i = 1; checked.wrong.empty() && i < path.size(); ++i) {
    checked.wrong = walk(map, path[i - 1], path[i], checked.length);
  }
  return checked;
}

} // namespace harness
