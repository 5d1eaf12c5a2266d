// Tests of the checkers, the searches, the readers and the account of time, against cases made by hand.
#include "charge.h"
#include "check_cells.h"
#include "check_points.h"
#include "generate.h"
#include "judge.h"
#include "random.h"
#include "reference.h"
#include "scenario.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

using namespace harness;

namespace {

int failures = 0;

#define IS(condition)                                                                                        \
  do {                                                                                                       \
    if (!(condition)) {                                                                                      \
      std::fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition);                                   \
      ++failures;                                                                                            \
    }                                                                                                        \
  } while (0)

Map map_of(const std::string &rows) {
  std::istringstream in(rows);
  std::vector<std::string> lines;
  for (std::string row; in >> row;) {
    lines.push_back(row);
  }
  Map map(static_cast<int>(lines[0].size()), static_cast<int>(lines.size()), false);
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      map.set(x, y, lines[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] == '.');
    }
  }
  return map;
}

// Expects a verdict about a path from its first point to its last: a part of the reason, or "" if it is
// valid.
void cells(int line, const Map &map, const std::vector<Cell> &path, const std::string &reason,
           Octile length = {}) {
  CheckedCells checked = check_cells(map, path.front(), path.back(), path);
  bool right = reason.empty() ? checked.wrong.empty() && checked.length == length
                              : checked.wrong.find(reason) != std::string::npos;
  if (!right) {
    std::fprintf(stderr, "line %d: '%s' is expected, not '%s', length %Lg\n", line, reason.c_str(),
                 checked.wrong.c_str(), checked.length.length());
    ++failures;
  }
}

void points(int line, const Map &map, const std::vector<Point> &path, const std::string &reason) {
  Cell start{static_cast<int>(path.front().x), static_cast<int>(path.front().y)};
  Cell goal{static_cast<int>(path.back().x), static_cast<int>(path.back().y)};
  CheckedPoints checked = check_points(map, start, goal, path);
  bool right = reason.empty() ? checked.wrong.empty() : checked.wrong.find(reason) != std::string::npos;
  if (!right) {
    std::fprintf(stderr, "line %d: '%s' is expected, not '%s'\n", line, reason.c_str(),
                 checked.wrong.c_str());
    ++failures;
  }
}

#define CELLS(...) cells(__LINE__, __VA_ARGS__)
#define POINTS(...) points(__LINE__, __VA_ARGS__)

void test_cells() {
  Map map = map_of("......\n.@....\n...@..\n......\n");
  CELLS(map, {{0, 0}, {5, 0}}, "", {5, 0});
  CELLS(map, {{3, 0}, {3, 3}}, "blocked cell (3, 2)");
  CELLS(map, {{2, 0}, {3, 1}}, "", {0, 1});
  CELLS(map, {{2, 0}, {3, 1}, {3, 1}, {4, 1}, {5, 2}, {5, 3}}, "", {2, 2});
  CELLS(map, {{2, 0}, {5, 3}}, "cuts the corner between (3, 1) and (4, 2)");
  CELLS(map, {{0, 0}, {2, 2}}, "blocked cell (1, 1)");
  CELLS(map, {{2, 1}, {2, 2}, {3, 3}}, "cuts the corner");
  CELLS(map, {{0, 1}, {1, 0}}, "cuts the corner");
  CELLS(map, {{3, 1}, {4, 2}}, "cuts the corner");
  CELLS(map, {{3, 0}, {5, 1}}, "neither straight nor diagonal");
  CELLS(map, {{0, 3}, {3, 0}}, "cuts the corner");
  CELLS(map, {{2, 2}, {2, 0}}, "", {2, 0});
  CELLS(map, {{0, 0}}, "one point alone");
  CELLS(map, {{0, 0}, {0, 0}}, "", {0, 0});
  CELLS(map, {{1, 1}, {1, 1}}, "start is blocked");
  CELLS(map, {{1, 1}, {1, 0}}, "start is blocked");
  CELLS(map, {{5, 3}, {6, 3}}, "blocked cell (6, 3)");
  CELLS(map, {{0, 0}, {0, -1}}, "blocked cell (0, -1)");
  IS(check_cells(map, {0, 0}, {1, 0}, {{0, 0}, {2, 0}}).wrong.find("ends at") != std::string::npos);
  IS(check_cells(map, {1, 0}, {2, 0}, {{0, 0}, {2, 0}}).wrong.find("starts at") != std::string::npos);
  IS(!check_cells(map, {1, 0}, {2, 0}, {}).wrong.empty());
}

// Along edges and through cells, with corners alone.
void test_segments() {
  Map map = map_of(".....\n.@@..\n.....\n...@.\n..@..\n");
  POINTS(map, {{0, 0}, {1, 1}, {0, 1}}, "");
  POINTS(map, {{0, 0}, {4, 4}}, "blocked cell (1, 1)");
  POINTS(map, {{0, 1}, {4, 1}}, "");
  POINTS(map, {{0, 2}, {4, 2}}, "");
  POINTS(map, {{2, 0}, {2, 2}}, "between two blocked cells");
  POINTS(map, {{1, 0}, {1, 4}}, "");
  POINTS(map, {{0, 2}, {1, 1}, {3, 0}}, "");
  POINTS(map, {{0, 2}, {3, 0}}, "blocked cell (1, 1)");
  // Along the border, which is free at one side, and along one that is not.
  POINTS(map, {{0, 0}, {4, 0}}, "");
  POINTS(map_of("...\n"), {{0, 0}, {2, 0}}, "");
  POINTS(map_of(".@.\n"), {{0, 0}, {2, 0}}, "between two blocked cells");
  // (3, 4) is a double corner: cells (3, 3) and (2, 4) are blocked.
  POINTS(map, {{2, 3}, {4, 5}, {4, 4}}, "double corner (3, 4)");
  POINTS(map, {{2, 3}, {3, 4}, {4, 4}}, "double corner (3, 4)");
  POINTS(map, {{2, 3}, {3, 4}, {2, 2}}, "");
  POINTS(map, {{1, 3}, {3, 4}, {2, 2}}, "");
  POINTS(map, {{4, 3}, {4, 4}, {3, 4}}, "");
  POINTS(map, {{0, 0}, {5, 0}, {4, 0}}, "");
  POINTS(map, {{0, 0}, {6, 0}, {4, 0}}, "outside the map");
  POINTS(map, {{0, 0}}, "one point alone");
  POINTS(map, {{0, 0}, {0, 0}}, "shorter than 0.01");
  POINTS(map, {{1, 1}, {0, 0}}, "cell of an end is blocked");
  IS(!check_points(map, {0, 0}, {1, 0}, {{0, 0}, {2, 0}}).wrong.empty());
  IS(!check_points(map, {0, 0}, {1, 0}, {{0, 0}, {NAN, 0}, {1, 0}}).wrong.empty());
}

// Double corners of both kinds, as ends: an end has its own cell to the south-east.
void test_ends_on_double_corners() {
  Map map = map_of("....\n.@..\n..@.\n....\n");
  IS(is_double_corner(map, 2, 2) && !is_double_corner(map, 1, 1) && !is_double_corner(map, 3, 3));
  // Cells (2, 1) and (1, 2) are blocked: (2, 2) has its own cell free.
  Map gap = map_of("....\n..@.\n.@..\n....\n");
  IS(is_double_corner(gap, 2, 2));
  POINTS(gap, {{2, 2}, {3, 3}}, "");
  POINTS(gap, {{2, 2}, {3, 2}}, "");
  POINTS(gap, {{2, 2}, {2, 3}}, "");
  POINTS(gap, {{2, 2}, {1, 1}}, "through its own cell");
  POINTS(gap, {{2, 2}, {2, 1}, {2, 0}}, "through its own cell");
  POINTS(gap, {{2, 2}, {1, 2}, {0, 2}}, "through its own cell");
  POINTS(gap, {{3, 3}, {2, 2}}, "");
  POINTS(gap, {{1, 1}, {2, 2}}, "through its own cell");
  POINTS(gap, {{1, 0}, {2, 2}}, "through its own cell");
  POINTS(gap, {{1, 1}, {3, 3}}, "double corner (2, 2)");
  // At a corner in the middle a path keeps its quadrant, edges included, whichever way the gap lies.
  POINTS(gap, {{1, 1}, {2, 2}, {2, 1}, {2, 0}}, "");
  POINTS(gap, {{1, 1}, {2, 2}, {3, 2}}, "double corner");
  POINTS(map, {{3, 0}, {2, 2}, {3, 1}}, "");
  POINTS(map, {{3, 1}, {2, 2}, {1, 3}}, "double corner");
  POINTS(map, {{3, 1}, {1, 3}}, "double corner");
}

// Points that are no corners.
void test_other_points() {
  Map map = map_of(".....\n.@@..\n.....\n...@.\n..@..\n");
  POINTS(map, {{0, 0}, {0.5, 1.5}, {0, 2}}, "");
  POINTS(map, {{0, 0}, {1.5, 1.5}, {3, 0}}, "no free cell");
  POINTS(map, {{0, 0}, {1.5, 1}, {3, 0}}, "");
  POINTS(map, {{0, 0}, {1.5, 1.001}, {3, 0}}, "no free cell");
  POINTS(map, {{0, 0}, {1.5, 1.00000001}, {3, 0}}, "");
  POINTS(map, {{2, 0}, {2, 0.5}, {2, 2}}, "no free cell");
  POINTS(map, {{0, 0}, {0.004, 0}, {3, 0}}, "shorter than 0.01");
  POINTS(map, {{0, 0}, {0.02, 0}, {3, 0}}, "");
  POINTS(map, {{2, 3}, {2.5, 3.5}, {3.5, 4.5}, {4, 4}}, "double corner (3, 4)");
  POINTS(map, {{2, 3}, {2.5, 3.5}, {3, 4}, {3.5, 4.5}, {4, 4}}, "double corner (3, 4)");
  POINTS(map, {{2, 3}, {2.5, 3.5}, {3, 4}, {3, 3.5}, {2, 3}}, "");
  POINTS(map, {{0, 0}, {-0.5, 1}, {0, 2}}, "outside the map");
  POINTS(map, {{0.5, 0}, {2, 0}}, "the path leads from");
}

Map scaled(const Map &map, int by) {
  Map large(map.width() * by, map.height() * by, false);
  for (int y = 0; y < large.height(); ++y) {
    for (int x = 0; x < large.width(); ++x) {
      large.set(x, y, map.free(x / by, y / by));
    }
  }
  return large;
}

// A path over fractions of cells is as valid as over the corners of a map that is so much larger, where all
// is exact.
void test_scaled(std::uint64_t seed) {
  Random random(seed);
  int valid = 0;
  for (int i = 0; i < 20000; ++i) {
    int width = random.between(1, 6), height = random.between(1, 6), by = random.between(2, 7);
    Map map(width, height, true);
    for (int block = random.between(0, width * height / 2); block > 0; --block) {
      map.set(random.between(0, width - 1), random.between(0, height - 1), false);
    }
    Cell start{random.between(0, width - 1), random.between(0, height - 1)};
    Cell goal{random.between(0, width - 1), random.between(0, height - 1)};
    Point middle{static_cast<double>(random.between(0, width * by)),
                 static_cast<double>(random.between(0, height * by))};
    auto at = [](Cell cell, int by) {
      return Point{static_cast<double>(cell.x * by), static_cast<double>(cell.y * by)};
    };
    CheckedPoints small =
        check_points(map, start, goal, {at(start, 1), {middle.x / by, middle.y / by}, at(goal, 1)});
    CheckedPoints large = check_points(scaled(map, by), {start.x * by, start.y * by},
                                       {goal.x * by, goal.y * by}, {at(start, by), middle, at(goal, by)});
    valid += small.wrong.empty();
    if (small.wrong.empty() != large.wrong.empty()) {
      std::fprintf(stderr, "seed %llu, number %d: '%s' and '%s'\n", static_cast<unsigned long long>(seed), i,
                   small.wrong.c_str(), large.wrong.c_str());
      ++failures;
    }
  }
  IS(valid > 1000);
}

void test_lengths() {
  IS((Octile{1, 0} < Octile{0, 1}) && !(Octile{0, 1} < Octile{1, 0}) && (Octile{0, 2} < Octile{3, 0}));
  IS((Octile{0, 408} < Octile{577, 0}) && !(Octile{577, 0} < Octile{0, 408}));
  IS((Octile{1393, 0} < Octile{0, 985}) && !(Octile{3, 4} < Octile{3, 4}));
  Map map = map_of(".....\n.@@@.\n.@.@.\n.@@@.\n.....\n");
  IS((*shortest_by_cells(map, {0, 0}, {4, 4}) == Octile{8, 0}));
  IS(!shortest_by_cells(map, {0, 0}, {2, 2}) && !shortest_by_cells(map, {1, 1}, {0, 0}));
  IS((*shortest_by_cells(map, {2, 2}, {2, 2}) == Octile{0, 0}));
  IS(std::fabs(*shortest_by_points(map, {0, 0}, {4, 4}) - (std::sqrt(17.0L) + 3)) < 1e-15L);
  IS(std::fabs(*shortest_by_points(map, {0, 1}, {1, 4}) - std::sqrt(10.0L)) < 1e-15L);
  IS(*shortest_by_points(map, {0, 1}, {0, 1}) == 0);
  IS(!shortest_by_points(map, {0, 0}, {2, 2}));
  Map gap = map_of("....\n..@.\n.@..\n....\n");
  // From (2, 2) only to the south-east: around the blocked cell (2, 1) to its other side, and back.
  IS(*shortest_by_points(gap, {2, 2}, {1, 1}) == 4 && *shortest_by_points(gap, {1, 1}, {2, 2}) == 4);
}

// Whether there is a path is told by cells as by a search.
void test_joined(std::uint64_t seed) {
  int joined = 0, apart = 0;
  for (std::size_t number = 0; number < 200; ++number) {
    Random random(seed + number);
    Map map(random.between(2, 9), random.between(2, 9), true);
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x) {
        map.set(x, y, !random.chance(45));
      }
    }
    for (int i = 0; i < 20; ++i) {
      Cell start{random.between(0, map.width() - 1), random.between(0, map.height() - 1)};
      Cell goal{random.between(0, map.width() - 1), random.between(0, map.height() - 1)};
      bool is_joined = joined_by_points(map, start, goal);
      if (is_joined != shortest_by_points(map, start, goal).has_value()) {
        auto at = static_cast<int>(seed + number);
        std::fprintf(stderr, "seed %d: (%d, %d) to (%d, %d)\n", at, start.x, start.y, goal.x, goal.y);
        IS(false);
      }
      ++(is_joined ? joined : apart);
    }
  }
  IS(joined > 500 && apart > 500);
}

void test_charge() {
  Charge charge;
  charge.change(100);
  charge.call(10, 5);
  charge.call(60, 20);
  charge.call(200, 40);
  Times times = charge.finish(true);
  IS(times.total == 370 && times.change == 100 && times.first == 170 && times.longest == 200);
  Charge none;
  none.call(10, 30);
  none.call(10, 0);
  times = none.finish(false);
  IS(times.first == 20 && times.total == 20 && times.longest == 10);
}

bool same(const Map &a, const Map &b) {
  bool same = a.width() == b.width() && a.height() == b.height();
  for (int y = 0; same && y < a.height(); ++y) {
    for (int x = 0; same && x < a.width(); ++x) {
      same = a.free(x, y) == b.free(x, y);
    }
  }
  return same;
}

// Kinds of changes and queries that generated timelines have to have.
struct Seen {
  int cells = 0, wholes = 0, overlaps = 0, idle = 0, blocked = 0, selves = 0, none = 0;
};

bool overlap(const Timeline &timeline, const Placed &a, const Placed &b) {
  const Map &of_a = timeline.patches[a.patch], &of_b = timeline.patches[b.patch];
  return a.at.x < b.at.x + of_b.width() && b.at.x < a.at.x + of_a.width() &&
         a.at.y < b.at.y + of_b.height() && b.at.y < a.at.y + of_a.height();
}

void see(const Timeline &timeline, const Query &query, const Map &before, const Map &after, Seen &seen) {
  for (const Placed &placed : query.changes) {
    const Map &patch = timeline.patches[placed.patch];
    seen.cells += patch.cells() == 1;
    seen.wholes += patch.cells() == after.cells();
    seen.overlaps += &placed != &query.changes[0] && overlap(timeline, placed, query.changes[0]);
  }
  seen.idle += !query.changes.empty() && same(before, after);
  seen.blocked += !after.free(query.start) || !after.free(query.goal);
  seen.selves += query.start == query.goal;
  seen.none += query.stated.none && after.free(query.start) && after.free(query.goal);
}

void test_generated(std::uint64_t seed) {
  Seen seen;
  for (std::size_t number = 0; number < 14; ++number) {
    Timeline timeline = generate_timeline(seed, number, 40);
    state_lengths(Track::dynamic, timeline);
    IS(timeline.queries.size() == 100);
    Replay replay(timeline);
    for (std::size_t i = 1; i < timeline.queries.size(); ++i) {
      Map before = replay.map();
      replay.apply(timeline.queries[i]);
      see(timeline, timeline.queries[i], before, replay.map(), seen);
    }
  }
  IS(seen.cells > 50 && seen.wholes > 10 && seen.overlaps > 50 && seen.idle > 10);
  IS(seen.blocked > 50 && seen.selves > 20 && seen.none > 50);
}

// What is written is read again as it was.
void test_files(const std::string &folder) {
  for (std::size_t number = 0; number < 14; ++number) {
    Timeline timeline = generate_timeline(7, number, 40);
    state_lengths(Track::dynamic, timeline);
    write_dynamic(folder + "/timeline", timeline);
    Timeline again = read_dynamic(folder + "/timeline.scen");
    IS(again.queries.size() == timeline.queries.size() && again.patches.size() == timeline.patches.size());
    Replay before(timeline), after(again);
    for (std::size_t i = 0; i < timeline.queries.size(); ++i) {
      const Query &a = timeline.queries[i], &b = again.queries[i];
      if (i > 0) {
        before.apply(a);
        after.apply(b);
      }
      IS(same(before.map(), after.map()) && a.start == b.start && a.goal == b.goal);
      IS(a.stated.none == b.stated.none && b.stated.known);
      IS(a.stated.none || std::fabs(a.stated.length - b.stated.length) <= b.stated.tolerance);
      IS(b.stated.none || b.stated.tolerance < 1e-6L);
    }
  }
}

bool refuses(const std::string &folder, const std::string &scenario, const std::string &map) {
  std::ofstream(folder + "/bad.map.scen") << scenario;
  std::ofstream(folder + "/bad.map") << map;
  std::ofstream(folder + "/bad.patch") << "type patch\npatches 1\npatch 0\nheight 1\nwidth 2\nmap\n@.\n";
  try {
    scenario.rfind("version 2", 0) == 0 ? read_dynamic(folder + "/bad.map.scen")
                                        : read_static(folder + "/bad.map.scen");
  } catch (const std::runtime_error &) {
    return true;
  }
  return false;
}

void test_bad_files(const std::string &folder) {
  const std::string map = "type octile\nheight 2\nwidth 2\nmap\n.@\n..\n", head = "version 1\n";
  const std::string ends = "0 m.map 2 2 0 0 0 1 1\n";
  IS(!refuses(folder, head + ends, map));
  IS(refuses(folder, head, map));
  IS(refuses(folder, "version 3\n" + ends, map));
  IS(refuses(folder, head + "0 m.map 2 2 0 0 0 2 1\n", map));
  IS(refuses(folder, head + "0 m.map 2 2 0 0 0 1 x\n", map));
  IS(refuses(folder, head + ends, "type octile\nheight 2\nwidth 2\nmap\n.@\n.\n"));
  IS(refuses(folder, head + ends, "type tile\nheight 2\nwidth 2\nmap\n.@\n..\n"));
  const std::string second = "version 2\nheight 2\nwidth 2\ncost 2 other octile\npatch bad.patch\ncommands\n";
  IS(!refuses(folder, second + "P 0 0 0 1\nQ 0 0 0 1 1 9 -1\n", map));
  IS(refuses(folder, second + "P 0 0 1 1\n", map));
  IS(refuses(folder, second + "P 0 1 0 0\n", map));
  IS(refuses(folder, second + "Q 0 0 0 2 0 9 1\n", map));
  IS(refuses(folder, second + "R 0 0 0 1 0 9 1\n", map));
  IS(refuses(folder, "version 2\nheight 2\nwidth 2\ncost 1 other\npatch bad.patch\ncommands\n", map));
}

void test_tolerance(const std::string &folder) {
  std::ofstream(folder + "/t.map") << "type octile\nheight 1\nwidth 2\nmap\n..\n";
  std::ofstream(folder + "/t.map.scen") << "version 1.0\n0 t 2 1 0 0 1 0 2.82843\n0 t 2 1 0 0 1 0 70\n"
                                           "0 t 2 1 0 0 1 0 1203.24\n";
  Timeline timeline = read_static(folder + "/t.map.scen");
  IS(timeline.queries.size() == 3 && timeline.queries[0].stated.tolerance < 1.1e-5L);
  IS(timeline.queries[1].stated.tolerance > 0.9e-4L && timeline.queries[1].stated.tolerance < 1.1e-4L);
  IS(timeline.queries[2].stated.tolerance > 0.9e-2L && timeline.queries[2].stated.tolerance < 1.1e-2L);
}

} // namespace

// It takes the name of an empty folder, in which it writes.
int main(int count, char **words) {
  if (count != 2) {
    std::fputs("usage: check-test FOLDER\n", stderr);
    return 2;
  }
  test_cells();
  test_segments();
  test_ends_on_double_corners();
  test_other_points();
  test_scaled(1);
  test_lengths();
  test_joined(1);
  test_charge();
  test_generated(1);
  test_files(words[1]);
  test_bad_files(words[1]);
  test_tolerance(words[1]);
  if (failures == 0) {
    std::puts("check-test: all is as it should be");
  }
  return failures == 0 ? 0 : 1;
}
