// An entry of the any-angle track for the tests, on small maps: a right one, or one with the fault that
// GPPC_FAULT names. It is Dijkstra's algorithm over all corners of cells, whether paths turn there or not.
// It has nothing of the harness; what a segment may pass, it asks of one cell after the other.
#include "Entry.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace {

bool fault(const char *name) {
  const char *asked = std::getenv("GPPC_FAULT");
  return asked != nullptr && std::string(asked) == name;
}

// A corner, and at a double one the quadrant in which it is left and entered.
struct Node {
  int x, y, sx, sy;
};

struct State {
  std::vector<bool> bits;
  int width, height;
  std::vector<Node> nodes;
  std::vector<xyLoc> points;
  std::size_t asked;

  bool free(int x, int y) const {
    return x >= 0 && y >= 0 && x < width && y < height && bits[static_cast<std::size_t>(y * width + x)];
  }
  bool is_double(int x, int y) const {
    bool a = free(x, y), b = free(x - 1, y), c = free(x - 1, y - 1), d = free(x, y - 1);
    return a == c && b == d && a != b;
  }
};

// Whether the open square of a cell meets a segment: its corners lie strictly on both sides of the line, and
// the ends not both beyond one side.
bool meets(int x, int y, const Node &a, const Node &b) {
  if (std::max(a.x, b.x) <= x || std::min(a.x, b.x) >= x + 1 || std::max(a.y, b.y) <= y ||
      std::min(a.y, b.y) >= y + 1) {
    return false;
  }
  bool left = false, right = false;
  for (int corner = 0; corner < 4; ++corner) {
    int side = (b.x - a.x) * (y + corner / 2 - a.y) - (b.y - a.y) * (x + corner % 2 - a.x);
    left = left || side < 0;
    right = right || side > 0;
  }
  return left && right;
}

bool lies_between(int x, int y, const Node &a, const Node &b) {
  int cross = (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
  int along = (b.x - a.x) * (x - a.x) + (b.y - a.y) * (y - a.y);
  int length = (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y);
  return cross == 0 && along > 0 && along < length;
}

// Along a line between cells, each edge has a free cell at one side.
bool has_free_sides(const State &state, const Node &a, const Node &b) {
  for (int x = std::min(a.x, b.x); a.y == b.y && x < std::max(a.x, b.x); ++x) {
    if (!state.free(x, a.y) && !state.free(x, a.y - 1)) {
      return false;
    }
  }
  for (int y = std::min(a.y, b.y); a.x == b.x && y < std::max(a.y, b.y); ++y) {
    if (!state.free(a.x, y) && !state.free(a.x - 1, y)) {
      return false;
    }
  }
  return true;
}

bool sees(const State &state, const Node &a, const Node &b) {
  for (int y = std::min(a.y, b.y); y <= std::max(a.y, b.y); ++y) {
    for (int x = std::min(a.x, b.x); x <= std::max(a.x, b.x); ++x) {
      if ((!state.free(x, y) && meets(x, y, a, b)) ||
          (!fault("gaps") && state.is_double(x, y) && lies_between(x, y, a, b))) {
        return false;
      }
    }
  }
  return has_free_sides(state, a, b);
}

bool may_go(const Node &from, const Node &to) {
  return (to.x - from.x) * from.sx >= 0 && (to.y - from.y) * from.sy >= 0;
}

double distance(const Node &a, const Node &b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

bool joined(const State &state, const Node &a, const Node &b) {
  bool is_short = !fault("longer") || distance(a, b) < 1.1;
  return is_short && (a.x != b.x || a.y != b.y) && may_go(a, b) && may_go(b, a) && sees(state, a, b);
}

void make_nodes(State &state) {
  for (int y = 0; y <= state.height; ++y) {
    for (int x = 0; x <= state.width; ++x) {
      if (!state.is_double(x, y) || fault("gaps")) {
        state.nodes.push_back({x, y, 0, 0});
        continue;
      }
      int sy = state.free(x, y) ? 1 : -1;
      state.nodes.push_back({x, y, 1, sy});
      state.nodes.push_back({x, y, -1, -sy});
    }
  }
}

// The node of an end: of a double corner that of its own cell.
std::size_t node_of(const State &state, xyLoc at) {
  auto is = [&](const Node &node) {
    return node.x == at.x && node.y == at.y && (node.sx == 0 || (node.sx == 1 && node.sy == 1));
  };
  return static_cast<std::size_t>(std::find_if(state.nodes.begin(), state.nodes.end(), is) -
                                  state.nodes.begin());
}

void find(State &state, std::size_t start, std::size_t goal) {
  std::size_t count = state.nodes.size();
  std::vector<double> best(count, HUGE_VAL);
  std::vector<std::size_t> from(count, count);
  std::vector<bool> done(count, false);
  best[start] = 0;
  for (std::size_t next = start; next != goal;) {
    done[next] = true;
    for (std::size_t i = 0; i < count; ++i) {
      double length = best[next] + distance(state.nodes[next], state.nodes[i]);
      if (!done[i] && length < best[i] - 1e-12 && joined(state, state.nodes[next], state.nodes[i])) {
        best[i] = length;
        from[i] = next;
      }
    }
    next = count;
    for (std::size_t i = 0; i < count; ++i) {
      if (!done[i] && best[i] < HUGE_VAL && (next == count || best[i] < best[next])) {
        next = i;
      }
    }
    if (next == count) {
      return;
    }
  }
  for (std::size_t i = goal; i != count; i = from[i]) {
    state.points.insert(state.points.begin(),
                        {static_cast<double>(state.nodes[i].x), static_cast<double>(state.nodes[i].y)});
  }
}

xyLoc part(const xyLoc &a, const xyLoc &b, double share) {
  return {a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share};
}

// Points in the middle, which are no fault, and deliberate mistakes.
void spoil(State &state, xyLoc s, xyLoc g) {
  std::vector<xyLoc> &points = state.points;
  if (fault("missing") && ++state.asked % 10 == 0) {
    points.clear();
  }
  if (fault("through") && !points.empty()) {
    points = {s, g};
  }
  if (fault("invented") && points.empty()) {
    points = {s, g};
  }
  if (points.size() > 1 && (fault("middle") || fault("short"))) {
    double share = fault("short") ? 0.005 / std::hypot(points[1].x - s.x, points[1].y - s.y) : 1 / 3.0;
    points.insert(points.begin() + 1, part(points[0], points[1], share));
  }
  if (points.size() == 1) {
    points.clear();
  }
}

} // namespace

void PreprocessMap(const std::vector<bool> &, int, int, const std::string &) {}

void *PrepareForSearch(const std::vector<bool> &bits, int width, int height, const std::string &) {
  auto *state = new State{bits, width, height, {}, {}, 0};
  make_nodes(*state);
  return state;
}

bool GetPath(void *data, xyLoc s, xyLoc g, std::vector<xyLoc> &path) {
  State &state = *static_cast<State *>(data);
  if (path.empty()) {
    state.points.clear();
    find(state, node_of(state, s), node_of(state, g));
    spoil(state, s, g);
  }
  std::size_t more = fault("pieces") ? 2 : state.points.size();
  for (; more > 0 && path.size() < state.points.size(); --more) {
    path.push_back(state.points[path.size()]);
  }
  return path.size() == state.points.size();
}

std::string GetName() {
  return "plain";
}
