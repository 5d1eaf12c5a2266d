// An entry of the classic track for the tests: a right one, or one with the fault that GPPC_FAULT names.
#include "Entry.h"
#include "plain.h"

#include <fstream>

namespace {

using plain::fault;

struct State {
  std::vector<bool> bits;
  plain::Ground ground;
  std::vector<xyLoc> points;
  std::size_t asked = 0;
};

void find(State &state, xyLoc s, xyLoc g) {
  int width = state.ground.width;
  std::vector<int> cells = plain::shortest(state.ground, s.y * width + s.x, g.y * width + g.x);
  state.points.clear();
  for (int cell : cells) {
    state.points.push_back(
        {static_cast<std::int16_t>(cell % width), static_cast<std::int16_t>(cell / width)});
  }
  if (state.points.size() == 1 && !fault("single")) {
    state.points.clear();
  }
  if (fault("missing") && ++state.asked % 10 == 0) {
    state.points.clear();
  }
  if (fault("invented") && state.points.empty()) {
    state.points = {s, g};
  }
}

} // namespace

void PreprocessMap(const std::vector<bool> &, int, int, const std::string &filename) {
  std::ofstream(filename) << "index";
}

void *PrepareForSearch(const std::vector<bool> &bits, int width, int height, const std::string &filename) {
  auto *state = new State{bits, {width, height, {}}, {}, 0};
  std::string word;
  std::ifstream(filename) >> word;
  // Without its index it knows no cell.
  state->ground.is_free = [state, word](int cell) {
    return word == "index" && state->bits[static_cast<std::size_t>(cell)];
  };
  return state;
}

bool GetPath(void *data, xyLoc s, xyLoc g, std::vector<xyLoc> &path) {
  State &state = *static_cast<State *>(data);
  if (path.empty()) {
    find(state, s, g);
  }
  std::size_t more = fault("pieces") ? 3 : state.points.size();
  for (; more > 0 && path.size() < state.points.size(); --more) {
    path.push_back(state.points[path.size()]);
  }
  return path.size() == state.points.size();
}

std::string GetName() {
  return "plain";
}
