// An entry of the dynamic track for the tests: a right one, or one with the fault that GPPC_FAULT names.
#include "load.h"
#include "plain.h"

#include <csignal>
#include <unistd.h>

namespace {

using plain::fault;

struct State {
  gppc_patch map;
  // The map as it was at first, for an entry that forgets its changes.
  std::vector<std::uint8_t> before;
  std::vector<gppc_point> points;
  std::size_t told = 0;
  std::size_t asked = 0;
};

bool is_free(const State &state, int cell) {
  const std::uint8_t *bytes = fault("forgets") ? state.before.data() : state.map.bitarray;
  return (bytes[cell / 8] >> (cell % 8) & 1) != 0;
}

void find(State &state, gppc_point start, gppc_point goal) {
  auto free = [&](int cell) { return is_free(state, cell); };
  plain::Ground ground{state.map.width, state.map.height, free};
  int width = state.map.width;
  std::vector<int> cells = plain::shortest(ground, start.y * width + start.x, goal.y * width + goal.x);
  for (int cell : cells) {
    state.points.push_back(
        {static_cast<std::uint16_t>(cell % width), static_cast<std::uint16_t>(cell / width)});
  }
  if (state.points.size() == 1 && !fault("single")) {
    state.points.push_back(state.points[0]);
  }
}

// Deliberate mistakes about what was found.
void spoil(State &state, gppc_point start, gppc_point goal) {
  if (fault("missing") && state.asked % 10 == 0) {
    state.points.clear();
  }
  if (fault("invented") && state.points.empty()) {
    state.points = {start, goal};
  }
  if (fault("ends") && state.points.size() > 2) {
    state.points.pop_back();
  }
}

// What an entry does that gives no answer.
void misbehave(const char *where) {
  if (fault("dies") || (fault("dies-early") && *where == 'p')) {
    std::raise(SIGKILL);
  }
  if (fault("leaves")) {
    _exit(0);
  }
  while (fault("hangs")) {
    usleep(1000);
  }
}

} // namespace

extern "C" {

void gppc_preprocess_init_map(gppc_patch, const char *) {
  if (fault("dies-early")) {
    misbehave("prepare");
  }
}

void *gppc_search_init(gppc_patch map, const char *) {
  auto *state = new State{map, {}, {}, 0, 0};
  state->before.assign(map.bitarray, map.bitarray + (map.width * map.height + 7) / 8);
  return state;
}

void gppc_map_change(void *, const gppc_patch *, std::uint32_t) {}

gppc_path gppc_get_path(void *data, gppc_point start, gppc_point goal) {
  State &state = *static_cast<State *>(data);
  if (fault("endless")) {
    state.points.assign(1000, start);
    return {state.points.data(), 1000, 1};
  }
  if (state.told == 0) {
    state.points.clear();
    ++state.asked;
    misbehave("answer");
    find(state, start, goal);
    spoil(state, start, goal);
  }
  // In pieces of three points, which is no fault.
  if (fault("pieces") && state.points.size() - state.told > 3) {
    state.told += 3;
    return {state.points.data() + state.told - 3, 3, 1};
  }
  std::size_t told = state.told;
  state.told = 0;
  return {state.points.data() + told, static_cast<std::uint32_t>(state.points.size() - told), 0};
}

void gppc_free_data(void *data) {
  delete static_cast<State *>(data);
}

const char *gppc_get_name() {
  return "plain";
}

int gppc_scenario_tags(int kinds) {
  return kinds < 64;
}
}
