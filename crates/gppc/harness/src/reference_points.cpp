#include "check_points.h"
#include "reference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace harness {

namespace {

constexpr long double FAR = std::numeric_limits<long double>::infinity();

// A shortest path turns only at corners of one blocked cell alone. At a double corner no path needs to turn:
// it comes and goes within a quadrant, across which it can go straight.
std::vector<Cell> turning_corners(const Map &map) {
  std::vector<Cell> corners;
  for (int y = 1; y < map.height(); ++y) {
    for (int x = 1; x < map.width(); ++x) {
      int free = map.free(x, y) + map.free(x - 1, y) + map.free(x, y - 1) + map.free(x - 1, y - 1);
      if (free == 3) {
        corners.push_back({x, y});
      }
    }
  }
  return corners;
}

// Whether an end may be left or entered towards a corner.
bool may_leave(const Map &map, Cell end, Cell towards) {
  return !is_double_corner(map, end.x, end.y) || (towards.x >= end.x && towards.y >= end.y);
}

long double distance(Cell a, Cell b) {
  return std::hypot(static_cast<long double>(a.x - b.x), static_cast<long double>(a.y - b.y));
}

// The free cells at an end through which a path may leave it.
std::vector<Cell> cells_at(const Map &map, Cell end) {
  if (is_double_corner(map, end.x, end.y)) {
    return {end};
  }
  std::vector<Cell> cells;
  for (Cell at : {end, Cell{end.x - 1, end.y}, Cell{end.x, end.y - 1}, Cell{end.x - 1, end.y - 1}}) {
    if (map.free(at)) {
      cells.push_back(at);
    }
  }
  return cells;
}

} // namespace

bool joined_by_points(const Map &map, Cell start, Cell goal) {
  if (!map.free(start) || !map.free(goal)) {
    return false;
  }
  std::vector<bool> reached(map.cells(), false);
  std::vector<Cell> open = cells_at(map, start);
  while (!open.empty()) {
    Cell at = open.back();
    open.pop_back();
    if (map.free(at) && !reached[map.index(at.x, at.y)]) {
      reached[map.index(at.x, at.y)] = true;
      open.insert(open.end(), {{at.x + 1, at.y}, {at.x - 1, at.y}, {at.x, at.y + 1}, {at.x, at.y - 1}});
    }
  }
  std::vector<Cell> ends = cells_at(map, goal);
  return start == goal || std::any_of(ends.begin(), ends.end(), [&](Cell at) {
           return reached[map.index(at.x, at.y)];
         });
}

std::optional<long double> shortest_by_points(const Map &map, Cell start, Cell goal) {
  if (!map.free(start) || !map.free(goal)) {
    return std::nullopt;
  }
  if (start == goal) {
    return 0;
  }
  // The start is first, the goal last.
  std::vector<Cell> corners = turning_corners(map);
  corners.insert(corners.begin(), start);
  corners.push_back(goal);
  std::vector<long double> best(corners.size(), FAR);
  std::vector<bool> done(corners.size(), false);
  best[0] = 0;
  for (;;) {
    std::size_t next = corners.size();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (!done[i] && best[i] < FAR && (next == corners.size() || best[i] < best[next])) {
        next = i;
      }
    }
    if (next == corners.size()) {
      return std::nullopt;
    }
    if (next + 1 == corners.size()) {
      return best[next];
    }
    done[next] = true;
    Cell from = corners[next];
    for (std::size_t i = 0; i < corners.size(); ++i) {
      Cell to = corners[i];
      bool wrong = done[i] || from == to || !may_leave(map, from, to) || !may_leave(map, to, from);
      if (!wrong && best[next] + distance(from, to) < best[i] &&
          check_segment(map, {static_cast<double>(from.x), static_cast<double>(from.y)},
                        {static_cast<double>(to.x), static_cast<double>(to.y)})
              .empty()) {
        best[i] = best[next] + distance(from, to);
      }
    }
  }
}

} // namespace harness
