// A plain search over eight directions for the entries of the tests. It has nothing of the harness.
#ifndef GPPC_HARNESS_TESTS_PLAIN_H
#define GPPC_HARNESS_TESTS_PLAIN_H

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <queue>
#include <string>
#include <utility>
#include <vector>

namespace plain {

// The fault that the tests ask for.
inline bool fault(const char *name) {
  const char *asked = std::getenv("GPPC_FAULT");
  return asked != nullptr && std::string(asked) == name;
}

// A rectangle of cells; a cell's number is y * width + x.
struct Ground {
  int width = 0;
  int height = 0;
  std::function<bool(int)> is_free;

  bool free(int x, int y) const {
    return x >= 0 && y >= 0 && x < width && y < height && is_free(y * width + x);
  }
};

// All cells of a shortest path, or none. Dijkstra's algorithm, with lengths that are rounded.
inline std::vector<int> shortest(const Ground &ground, int start, int goal) {
  if (!ground.is_free(start) || !ground.is_free(goal)) {
    return {};
  }
  using Entry = std::pair<double, int>;
  std::vector<double> best(static_cast<std::size_t>(ground.width * ground.height), HUGE_VAL);
  std::vector<int> from(best.size(), -1);
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> open;
  best[static_cast<std::size_t>(start)] = 0;
  open.push({0, start});
  while (!open.empty()) {
    auto [length, cell] = open.top();
    open.pop();
    if (cell == goal) {
      break;
    }
    int x = cell % ground.width, y = cell / ground.width;
    for (int move = 0; move < 9; ++move) {
      int dx = move % 3 - 1, dy = move / 3 - 1;
      bool diagonal = dx != 0 && dy != 0;
      bool beside = ground.free(x + dx, y) && ground.free(x, y + dy);
      if (!ground.free(x + dx, y + dy) || (!beside && !fault("cuts")) || (diagonal && fault("longer"))) {
        continue;
      }
      int next = cell + dy * ground.width + dx;
      double through = length + (diagonal ? std::sqrt(2.0) : 1.0);
      if (through < best[static_cast<std::size_t>(next)] - 1e-9) {
        best[static_cast<std::size_t>(next)] = through;
        from[static_cast<std::size_t>(next)] = cell;
        open.push({through, next});
      }
    }
  }
  if (best[static_cast<std::size_t>(goal)] == HUGE_VAL) {
    return {};
  }
  std::vector<int> path;
  for (int cell = goal; cell != -1; cell = from[static_cast<std::size_t>(cell)]) {
    path.push_back(cell);
  }
  std::reverse(path.begin(), path.end());
  return path;
}

} // namespace plain

#endif
