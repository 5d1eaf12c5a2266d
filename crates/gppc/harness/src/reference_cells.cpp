#include "reference.h"

#include <algorithm>
#include <cstdlib>
#include <queue>
#include <vector>

namespace harness {

namespace {

struct Reached {
  Octile estimate;
  Octile length;
  Cell at;
};

struct Later {
  bool operator()(const Reached &a, const Reached &b) const { return b.estimate < a.estimate; }
};

// The length on a map where all is free, which is never too long.
Octile at_least(Cell from, Cell to) {
  int dx = std::abs(to.x - from.x), dy = std::abs(to.y - from.y);
  return {std::abs(dx - dy), std::min(dx, dy)};
}

bool may_step(const Map &map, Cell at, int dx, int dy) {
  return map.free(at.x + dx, at.y + dy) && map.free(at.x + dx, at.y) && map.free(at.x, at.y + dy);
}

} // namespace

std::optional<Octile> shortest_by_cells(const Map &map, Cell start, Cell goal) {
  if (!map.free(start) || !map.free(goal)) {
    return std::nullopt;
  }
  std::vector<std::optional<Octile>> best(map.cells());
  std::priority_queue<Reached, std::vector<Reached>, Later> open;
  best[map.index(start.x, start.y)] = Octile();
  open.push({at_least(start, goal), Octile(), start});
  while (!open.empty()) {
    Reached reached = open.top();
    open.pop();
    if (*best[map.index(reached.at.x, reached.at.y)] < reached.length) {
      continue;
    }
    if (reached.at == goal) {
      return reached.length;
    }
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if ((dx == 0 && dy == 0) || !may_step(map, reached.at, dx, dy)) {
          continue;
        }
        Cell next{reached.at.x + dx, reached.at.y + dy};
        Octile length = reached.length + (dx != 0 && dy != 0 ? Octile{0, 1} : Octile{1, 0});
        std::optional<Octile> &known = best[map.index(next.x, next.y)];
        if (!known || length < *known) {
          known = length;
          open.push({length + at_least(next, goal), length, next});
        }
      }
    }
  }
  return std::nullopt;
}

} // namespace harness
