// Shared by the entries of the classic and of the any-angle track: a map of the harness's bits, its index in
// the harness's file, and a planner on it.
#ifndef MEDIANT_GPPC_ENTRY_HPP
#define MEDIANT_GPPC_ENTRY_HPP

#include "pages.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <mediant.hpp>
#include <random>
#include <string>
#include <vector>

namespace entry {

// The name of both entries. The harness names their files after it: were the version a part of it, an index
// of another version would not be found, and so not be refused.
constexpr const char *NAME = "Mediant";

// The questions of a track.
struct track {
  // The rules of motion.
  const char *motion;
  // The same as the setup of an index has them.
  const char *in_setup;
  // The engine for a map that was not preprocessed: it prepares next to nothing.
  const char *unprepared;
};

// Ends the program, after a sentence on stderr. A harness takes no answer for a wrong one, and time of
// another engine for the entry's.
[[noreturn]] inline void refuse(const mediant::error &error, const std::string &what) {
  std::fprintf(stderr, "%s %s: %s\n%s\n", NAME, mediant_version(), error.what(), what.c_str());
  std::exit(EXIT_FAILURE);
}

inline mediant::Map map_of(const std::vector<bool> &free, int width, int height) {
  std::vector<std::uint8_t> blocked(free.size());
  for (std::size_t cell = 0; cell < free.size(); ++cell) {
    blocked[cell] = !free[cell];
  }
  return mediant::Map(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), blocked);
}

// The engine, with the memory that it may take for a map. By itself it keeps hub labels where they fit in 64
// bytes a cell, and at least 48 MB: so of every map of games, streets and rooms. Where the map is so dense or
// so noisy that they do not, it keeps a contraction hierarchy, or nothing if a search is faster. Maps of up
// to 1024 × 1024 cells have labels of vertices besides, within 100 to 400 MB: with them queries take 0.6
// to 1.0 of the time here.
inline std::string engine_for(int width, int height) {
  constexpr std::int64_t CELLS = 1 << 20, BYTES_A_CELL = 384, LEAST = 100000000;
  std::int64_t cells = std::int64_t{width} * height;
  std::int64_t bytes = std::max(LEAST, BYTES_A_CELL * cells);
  return cells <= CELLS ? "engine=subgoal memory=" + std::to_string(bytes) : "engine=subgoal";
}

// Prepares the index of a map, and writes it to the harness's file.
inline void preprocess(const track &track, const std::vector<bool> &free, int width, int height,
                       const std::string &file) {
  try {
    mediant::Space space(map_of(free, width, height), track.motion);
    mediant::Index::prepare(space, engine_for(width, height)).save(file);
  } catch (const mediant::error &error) {
    refuse(error, "The map is not preprocessed.");
  }
}

// Answers the queries on a map.
class search {
public:
  // With the index in the harness's file. Without the file it searches by an engine that needs none.
  static search *prepare(const track &track, const std::vector<bool> &free, int width, int height,
                         const std::string &file) {
    try {
      auto made = new search(index_of(track, map_of(free, width, height), file));
      use_large_pages();
      made->warm_up(free, width);
      return made;
    } catch (const mediant::error &error) {
      refuse(error, "To build the index of " + file + ": ./run -pre MAP");
    }
  }

  // The points of the shortest path, up to the next call: none where none leads, where an end is blocked, and
  // from a point to itself.
  mediant::view<mediant::point> path(mediant::point start, mediant::point goal) {
    if (start.x == goal.x && start.y == goal.y) {
      return {};
    }
    std::size_t count = 0;
    double length = 0;
    mediant_code code =
        mediant_planner_path(planner_.handle(), start, goal, points_.data(), points_.size(), &count, &length);
    if (code == MEDIANT_CODE_OK && count > points_.size()) {
      points_.resize(count);
      code = mediant_planner_points(planner_.handle(), points_.data(), points_.size(), &count);
    }
    switch (code) {
    case MEDIANT_CODE_OK:
      return {points_.data(), count};
    case MEDIANT_CODE_START_BLOCKED:
    case MEDIANT_CODE_GOAL_BLOCKED:
    case MEDIANT_CODE_START_OUTSIDE:
    case MEDIANT_CODE_GOAL_OUTSIDE:
      return {};
    default:
      refuse(mediant::error(code, mediant_message()), "The query has no answer.");
    }
  }

private:
  // Answers queries between cells of the whole map, for some milliseconds, so that the code and what was
  // prepared are in memory when the first query of the harness comes: that one would else take as long as
  // fifty others.
  void warm_up(const std::vector<bool> &free, int width) {
    constexpr int QUERIES = 1000;
    constexpr std::chrono::milliseconds MOST{20};
    std::vector<mediant::point> cells;
    for (std::size_t cell = 0; cell < free.size(); ++cell) {
      if (free[cell]) {
        auto at = static_cast<int>(cell);
        cells.push_back({static_cast<double>(at % width), static_cast<double>(at / width)});
      }
    }
    std::minstd_rand random;
    auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < QUERIES && !cells.empty() && std::chrono::steady_clock::now() - begin < MOST; ++i) {
      path(cells[random() % cells.size()], cells[random() % cells.size()]);
    }
  }

  explicit search(const mediant::Index &index) : planner_(index), points_(1024) {}

  static mediant::Index index_of(const track &track, const mediant::Map &map, const std::string &file) {
    try {
      auto index = mediant::Index::load(map, file);
      std::string setup = index.setup();
      if (setup.find(track.in_setup) == std::string::npos) {
        throw mediant::error(MEDIANT_CODE_MISMATCH,
                             file + ": expected an index for " + track.motion + ", found " + setup);
      }
      return index;
    } catch (const mediant::error &error) {
      if (error.code() != MEDIANT_CODE_FILE_MISSING) {
        throw;
      }
    }
    std::fprintf(stderr, "%s: %s is not there: searching without an index\n", NAME, file.c_str());
    return mediant::Index::prepare(mediant::Space(map, track.motion), track.unprepared);
  }

  mediant::Planner planner_;
  std::vector<mediant::point> points_;
};

} // namespace entry

#endif
