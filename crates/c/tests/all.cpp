// Every class and function of mediant.hpp. It takes the name of an empty folder, in which it writes.

#include "../include/mediant.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <thread>
#if __cplusplus >= 202002L
#include <span>
#endif

using mediant::cell;
using mediant::point;

#define IS(condition)                                                                                        \
  do {                                                                                                       \
    if (!(condition)) {                                                                                      \
      std::cerr << __FILE__ << ":" << __LINE__ << ": " << #condition << "\n";                                \
      std::exit(1);                                                                                          \
    }                                                                                                        \
  } while (0)

#define NEAR(number, expected) IS(std::fabs((number) - (expected)) < 1e-9)

// An expression throws an error with a code.
#define THROWS(expression, expected)                                                                         \
  do {                                                                                                       \
    mediant_code code_ = MEDIANT_CODE_OK;                                                                    \
    try {                                                                                                    \
      static_cast<void>(expression);                                                                         \
    } catch (const mediant::error &error) {                                                                  \
      code_ = error.code();                                                                                  \
      IS(error.what()[0] != '\0' && std::string(error.name()) == mediant_code_name(code_));                  \
    }                                                                                                        \
    IS(code_ == (expected));                                                                                 \
  } while (0)

namespace {

const char *const RING = "......\n.@@@@.\n.@..@.\n.@@@@.\n......\n";
const double DIRECT = std::sqrt(26) + std::sqrt(10);

bool same(point a, point b) {
  return a.x == b.x && a.y == b.y;
}

void test_library() {
  IS(!mediant::version().empty());
  auto moves = mediant::moves(8);
  IS(moves.size() == 256 && moves[0].x == 0 && moves[0].y == 1);
  THROWS(mediant::moves(1), MEDIANT_CODE_K);
  NEAR(*mediant::bound("k=any gap=closed"), 1);
  NEAR(*mediant::bound("k=3 placement=corner"), std::sqrt(4 - 2 * std::sqrt(2)));
}

void test_views() {
  std::vector<point> vector{{0, 0}, {1, 2}};
  std::array<point, 2> array{point{0, 0}, point{1, 2}};
  const point raw[] = {{0, 0}, {1, 2}};
  auto second = [](mediant::view<point> points) { return points.size() == 2 && points[1].y == 2; };
  IS(second(vector) && second(array) && second(raw) && second({vector.data(), 2}) &&
     second({{0, 0}, {1, 2}}));
  mediant::view<point> view = vector;
  double sum = 0;
  for (const point &at : view) {
    sum += at.x + at.y;
  }
  IS(sum == 3 && !view.empty() && view.data() == vector.data() && view.copy().size() == 2);
  IS(mediant::view<point>().empty());
#if __cplusplus >= 202002L
  std::span<const point> span = view;
  IS(span.size() == 2 && second(span) && second(std::span<point>(vector)));
#endif
}

void test_maps(const std::string &folder) {
  auto map = mediant::Map::parse(RING);
  IS(map.size().width == 6 && map.size().height == 5);
  auto cells = map.cells();
  IS(cells.size() == 30 && cells[7] == 1 && cells[14] == 0 && map.is_blocked({1, 1}) &&
     !map.is_blocked({2, 2}));
  IS(mediant::Map(6, 5, cells).cells() == cells);
  IS(mediant::Map(6, 5).cells() == std::vector<std::uint8_t>(30));
  std::vector<std::uint8_t> bits(4);
  for (std::size_t at = 0; at < cells.size(); at++) {
    bits[at / 8] |= static_cast<std::uint8_t>((cells[at] == 0) << at % 8);
  }
  IS(mediant::Map::from_bits(6, 5, bits).cells() == cells);
  IS(!map.edit({1, 1, 1, 2}, {0, 0}).is_blocked({1, 2}));
  IS(map.edit_cells({{0, 0}}, {1}).is_blocked({0, 0}) && !map.is_blocked({0, 0}));
  IS(mediant::Map(3, 3).for_square(2).is_blocked({2, 2}));
  IS(!mediant::Map(3, 3).for_disc(1.5).is_blocked({1, 1}) &&
     mediant::Map(3, 3).for_disc(1.5).is_blocked({0, 1}));
  NEAR(mediant::Map(3, 3).clearance()[4], 1.5);

  std::string path = folder + "/ring.map";
  std::ofstream(path) << "type octile\nheight 5\nwidth 6\nmap\n" << RING;
  IS(mediant::Map::open(path).cells() == cells);
  THROWS(mediant::Map::open(folder + "/none.map"), MEDIANT_CODE_FILE_MISSING);
  THROWS(mediant::Map::open(std::string("a\0b", 3)), MEDIANT_CODE_ARGUMENT);
  // Too few values would be read beyond their end.
  THROWS(mediant::Map(6, 6, cells), MEDIANT_CODE_ARGUMENT);
  THROWS(mediant::Map::from_bits(6, 6, bits), MEDIANT_CODE_ARGUMENT);
  THROWS(map.edit({0, 0, 2, 2}, {0, 0}), MEDIANT_CODE_ARGUMENT);
  THROWS(map.edit_cells({{0, 0}}, {}), MEDIANT_CODE_ARGUMENT);
  THROWS(map.costs({1, 2}), MEDIANT_CODE_COST);
  auto priced = mediant::Map(3, 3).costs(std::vector<double>(9, 2));
  IS(priced.edit_costs({{1, 1}}, {NAN}).is_blocked({1, 1}) && !priced.is_blocked({1, 1}));

  // Moved, released, taken over.
  mediant::Map moved = std::move(map);
  IS(moved && !map);
  THROWS(map.cells(), MEDIANT_CODE_HANDLE);
  map = std::move(moved);
  mediant::Map over(map.release());
  IS(!map && over.handle().id != 0 && over.cells() == cells);
}

void test_find() {
  auto map = mediant::Map::parse(RING);
  auto found = map.find({0, 0}, {6, 4}, "k=any gap=closed");
  IS(found.found() && found.points.size() == 3 && same(found.points[1], {5, 1}));
  NEAR(found.distance, DIRECT);
  std::vector<mediant::point> starts{{0, 0}, {0, 4}}, goals{{5, 4}};
  IS(map.find(starts, goals).distance == 5);
  IS(map.find({0, 0}, {2, 2}).points.empty() && !map.find({0, 0}, {2, 2}, "nearest").points.empty());
  THROWS(map.find({1, 1}, {5, 4}), MEDIANT_CODE_START_BLOCKED);
}

void test_spaces() {
  auto map = mediant::Map::parse(RING);
  mediant::Space space(map), corners(map, "k=any gap=closed");
  IS(space.is_free({0, 0}) && !space.is_free({1, 1}));
  IS(space.connected({0, 0}, {5, 4}) && !space.connected({0, 0}, {2, 2}));
  IS(corners.sees({0, 0}, {5, 1}) && !corners.sees({0, 0}, {6, 4}));
  auto path = corners.path({0, 0}, {6, 4});
  IS(path && path->points.size() == 3 && same(path->points[1], {5, 1}));
  NEAR(path->length, DIRECT);
  IS(corners.holds(path->points) && !corners.holds({{0, 0}, {6, 4}}));
  corners.check(path->points);
  THROWS(corners.check({{0, 0}, {6, 4}}), MEDIANT_CODE_BROKEN_PATH);
  IS(!space.path({0, 0}, {2, 2}));
  NEAR(space.widest_path({0, 0}, {5, 4}, 0.2)->radius, 0.5);
  IS(!space.widest_path({0, 0}, {2, 2}, 0.2));
  auto choice = corners.engine(UINT64_MAX);
  IS(choice.engine == "subgoal" && choice.why.size() > 10);
  IS(space.path_touched_cells({{0, 0}, {3, 0}}).size() == 4);
  IS(mediant::path_vertices({{0, 0}, {100, 0}}).size() == 101);
  IS(mediant::path_spaced({{0, 0}, {3, 0}}, 2).size() == 3);
  THROWS(mediant::Space(map, "k=99"), MEDIANT_CODE_MOTION);
}

void test_fields() {
  auto map = mediant::Map::parse(RING);
  mediant::Space space(map);
  mediant::Field field(space, {{0, 0}});
  IS(field.size().width == 6 && field.size().height == 5);
  NEAR(field.distances()[29], 9);
  NEAR(field.get({5, 4}), 9);
  IS(field.flow().size() == 60 && field.flow()[6] == -1);
  IS(same(field.direction({0, 3}), {0, -1}));
  IS(same(*field.next({3, 0}), {2, 0}) && !field.next({2, 2}));
  IS(same(*field.nearest_source({5, 4}), {0, 0}) && !field.nearest_source({2, 2}));
  IS(same(field.path_from({5, 0}).front(), {5, 0}) && field.path_from({2, 2}).empty());
  mediant::Space opened(map.edit_cells({{1, 2}}, {0}));
  NEAR(field.repair(opened).get({2, 2}), 4);
  IS(std::isinf(mediant::Field(space, {{0, 0}}, 3).get({4, 0})));
}

void test_indexes(const std::string &folder) {
  auto map = mediant::Map::parse(RING);
  mediant::Space space(map);
  auto index = mediant::Index::prepare(space, "engine=subgoal levels=contracted");
  IS(index.memory() > 0 && index.setup().find("subgoal") != std::string::npos && index.is_finished());
  static_cast<void>(index.bound());
  IS(index.space().connected({0, 0}, {5, 4}));
  index.save(folder + "/ring.index");
  NEAR(mediant::Planner(mediant::Index::load(map, folder + "/ring.index")).distance({0, 0}, {5, 4}), 9);
  auto bytes = index.to_bytes();
  NEAR(mediant::Planner(mediant::Index::from_bytes(map, bytes.data())).distance({0, 0}, {5, 4}), 9);
  THROWS(mediant::Index::from_bytes(map, {1, 2, 3}), MEDIANT_CODE_INDEX_DAMAGED);
  THROWS(mediant::Index::prepare(space, "engine=none"), MEDIANT_CODE_UNKNOWN_NAME);

  auto repaired = index.repair(mediant::Space(map.edit_cells({{1, 2}}, {0})));
  mediant::Planner planner(index);
  IS(!planner.path({0, 0}, {2, 2}));
  planner.follow(repaired);
  NEAR(planner.path({0, 0}, {2, 2})->length, 4);
  IS(repaired.finish().is_finished());

  auto table = index.table({{0, 0}, {5, 0}}, {{0, 4}, {5, 4}});
  IS(table.size() == 4);
  NEAR(table[1], 9);
  mediant::Goals goals(index, {{0, 4}, {5, 4}, {2, 2}});
  planner.follow(index);
  auto distances = planner.distances({0, 0}, goals);
  IS(distances.size() == goals.size() && std::isinf(distances[2]));
  NEAR(distances[1], 9);
  auto nearest = planner.nearest({5, 0}, goals);
  IS(nearest && nearest->goal == 1);
  NEAR(nearest->length, 4);
  IS(!planner.nearest({0, 0}, mediant::Goals(index, {})));
}

// Ends anywhere, at any angle between corners and between centers.
void test_points() {
  auto map = mediant::Map::parse(RING);
  const double expected = std::hypot(4.5, 0.75) + std::sqrt(10);
  for (const char *motion : {"k=any gap=closed", "placement=center k=any"}) {
    double by = motion[0] == 'k' ? 0 : -0.5;
    point start{by + 0.5, by + 0.25}, goal{by + 6, by + 4}, corner{by + 5, by + 1};
    mediant::Space space(map, motion);
    NEAR(space.path(start, goal)->length, expected);
    IS(space.is_free(start) && space.sees(start, corner) && !space.sees(start, goal));
    for (const char *engine : {"engine=anya", "engine=subgoal", "engine=subgoal levels=all"}) {
      auto index = mediant::Index::prepare(space, engine);
      mediant::Planner planner(index);
      auto path = planner.path(start, goal);
      IS(path && path->points.size() == 3 && same(path->points[1], corner));
      NEAR(path->length, expected);
      NEAR(planner.find(start, goal).distance, expected);
      mediant::Goals goals(index, {goal, corner});
      NEAR(planner.distances(start, goals)[0], expected);
      IS(planner.nearest(start, goals)->goal == 1);
      NEAR(index.table({start}, {goal})[0], expected);
      NEAR(index.paths({{start, goal}}).length(0), expected);
    }
    mediant::Field field(space, {start});
    NEAR(field.get(goal), expected);
    IS(same(*field.nearest_source(goal), start) && same(field.path_from(goal).back(), start));
  }
}

void test_batches() {
  auto map = mediant::Map::parse(RING);
  auto index = mediant::Index::prepare(mediant::Space(map, "k=any gap=closed"));
  std::vector<mediant::ends> ends(1000, {{0, 0}, {6, 4}});
  ends[7] = {{1.5, 1.5}, {0, 0}};
  ends[8] = {{0, 0}, {3, 3}};
  auto batch = index.paths(ends, 2);
  mediant::Batch moved = std::move(batch);
  IS(batch.size() == 0 && moved.size() == 1000);
  batch = std::move(moved);
  IS(batch.size() == 1000 && batch.lengths().size() == 1000);
  NEAR(batch.length(999), DIRECT);
  IS(batch.points(999).size() == 3 && same(batch.points(999)[1], {5, 1}));
  IS(batch.code(7) == MEDIANT_CODE_START_BLOCKED && std::isnan(batch.length(7)) && batch.points(7).empty());
  IS(batch.code(8) == MEDIANT_CODE_OK && std::isinf(batch.length(8)));
  bool is_out = false;
  try {
    batch.points(1000);
  } catch (const std::out_of_range &) {
    is_out = true;
  }
  IS(is_out);
}

void test_planners() {
  auto map = mediant::Map::parse(RING);
  mediant::Planner planner(mediant::Index::prepare(mediant::Space(map), "engine=astar"));
  auto path = planner.path({0, 0}, {5, 4});
  IS(path && path->points.size() == 3);
  NEAR(path->length, 9);
  IS(!planner.path({0, 0}, {2, 2}) && std::isinf(planner.distance({0, 0}, {2, 2})));
  THROWS(planner.path({1, 1}, {5, 4}), MEDIANT_CODE_START_BLOCKED);
  mediant::path again;
  IS(planner.path({0, 0}, {0, 4}, again) && again.points.size() == 2 && again.length == 4);
  IS(!planner.path({0, 0}, {2, 2}, again) && again.points.empty());

  auto answer = planner.find({0, 0}, {5, 4});
  IS(answer.found() && answer.points.size() == 3 && planner.points().size() == 3);
  NEAR(answer.distance, 9);
  NEAR(answer.lower_bound, 9);
  answer = planner.find({{5, 4}, {0, 0}}, {{2, 2}, {0, 4}});
  NEAR(answer.length, 4);
  answer = planner.find({0, 0}, {5, 4}, "max_expansions=2");
  IS(answer.status == MEDIANT_STATUS_STOPPED && answer.stopped_by == MEDIANT_LIMIT_EXPANSIONS);
  const std::vector<cell> shut{{0, 2}};
  mediant::exceptions except;
  except.blocked = shut;
  NEAR(planner.find_except({{0, 0}}, {{0, 4}}, except).distance, 14);
  IS(!planner.searched_by().empty());

  planner.begin({{0, 0}}, {{5, 4}});
  IS(!planner.step(3) && planner.progress().expansions == 3 && planner.progress().lower_bound > 0);
  IS(!planner.best().empty() && planner.path_to({0, 1}).size() == 2);
  auto done = planner.step(1000);
  IS(done && done->found());
  NEAR(done->distance, 9);

  // A path with more points than there is room for at first: up and down between teeth.
  std::string teeth;
  for (int row = 0; row < 3; row++) {
    for (int column = 0; column < 200; column++) {
      bool is_open = column % 2 == 0 || row == (column % 4 == 1 ? 0 : 2);
      teeth += is_open ? '.' : '@';
    }
    teeth += '\n';
  }
  mediant::Space comb(mediant::Map::parse(teeth));
  auto crooked = mediant::Planner(mediant::Index::prepare(comb)).path({0, 0}, {198, 0});
  IS(crooked && crooked->points.size() > 100 && same(crooked->points.back(), {198, 0}));
  IS(comb.holds(crooked->points) && comb.path({0, 0}, {198, 0})->points.size() == crooked->points.size());
}

struct thrown {};

// What a function of a watcher throws comes out of the call, wherever it was called.
template <class Work> void throws_own(const Work &work) {
  mediant::watcher from_stop{[]() -> bool { throw thrown(); }, nullptr};
  bool is_thrown = false;
  try {
    work(from_stop);
  } catch (const thrown &) {
    is_thrown = true;
  }
  IS(is_thrown);
}

void test_watchers() {
  std::vector<std::uint8_t> cells(100 * 100);
  for (std::size_t at = 0; at < cells.size(); at++) {
    cells[at] = at % 5 == 2 && at / 100 % 5 == 2;
  }
  mediant::Map map(100, 100, cells);
  mediant::Space space(map);
  std::atomic<int> told{0};
  mediant::watcher counts{nullptr, [&](std::uint64_t done, std::uint64_t total) { told += done <= total; }};
  auto index = mediant::Index::prepare(space, "engine=subgoal", counts);
  IS(told > 0);
  mediant::watcher stops{[] { return true; }, nullptr};
  THROWS(mediant::Index::prepare(space, "engine=subgoal", stops), MEDIANT_CODE_CANCELLED);

  auto search = mediant::Index::prepare(space, "engine=dijkstra");
  mediant::Planner planner(search);
  auto stopped = planner.find({0, 0}, {99, 99}, {}, stops);
  IS(stopped.status == MEDIANT_STATUS_STOPPED && stopped.stopped_by == MEDIANT_LIMIT_CANCELLED);
  std::size_t objects = mediant::objects();
  throws_own([&](const mediant::watcher &watch) { mediant::Index::prepare(space, "engine=subgoal", watch); });
  throws_own([&](const mediant::watcher &watch) { planner.find({0, 0}, {99, 99}, {}, watch); });
  throws_own([&](const mediant::watcher &watch) {
    planner.find_except({{0, 0}}, {{99, 99}}, {}, {}, watch);
  });
  throws_own([&](const mediant::watcher &watch) { space.path({0, 0}, {99, 99}, watch); });
  throws_own([&](const mediant::watcher &watch) { space.widest_path({0, 0}, {99, 99}, 0.1, watch); });
  throws_own([&](const mediant::watcher &watch) { mediant::Field(space, {{0, 0}}, INFINITY, watch); });
  throws_own([&](const mediant::watcher &watch) { index.table({{0, 0}}, {{9, 9}}, watch); });
  std::vector<mediant::ends> ends(2000, {{0, 0}, {9, 9}});
  throws_own([&](const mediant::watcher &watch) { index.paths(ends, 2, watch); });
  throws_own([&](const mediant::watcher &watch) {
    planner.begin({{0, 0}}, {{99, 99}}, {}, watch);
    planner.step(UINT64_MAX);
  });
  // One that throws when all is done: nothing is left behind.
  mediant::watcher late{nullptr, [](std::uint64_t done, std::uint64_t total) {
                          if (done == total) {
                            throw std::runtime_error("late");
                          }
                        }};
  bool is_late = false;
  try {
    index.paths(ends, 2, late);
  } catch (const std::runtime_error &error) {
    is_late = std::string(error.what()) == "late";
  }
  IS(is_late && mediant::objects() == objects);

  // A planner takes its watcher along when it is moved.
  std::atomic<int> asked{0};
  planner.begin({{0, 0}}, {{99, 99}}, {}, {[&] { return ++asked < 0; }, nullptr});
  THROWS(planner.begin({{2, 2}}, {{99, 99}}), MEDIANT_CODE_START_BLOCKED);
  planner.begin({{0, 0}}, {{99, 99}}, {}, {[&] { return ++asked < 0; }, nullptr});
  mediant::Planner moved = std::move(planner);
  IS(moved.step(UINT64_MAX)->found() && asked > 0);
}

void test_threads() {
  mediant::Space space(mediant::Map::parse(RING), "k=any gap=closed");
  auto index = mediant::Index::prepare(space);
  std::vector<std::thread> threads;
  for (int number = 0; number < 4; number++) {
    threads.emplace_back([&] {
      mediant::Planner planner(index);
      for (int round = 0; round < 100; round++) {
        NEAR(planner.path({0, 0}, {6, 4})->length, DIRECT);
      }
    });
  }
  for (auto &thread : threads) {
    thread.join();
  }
}

} // namespace

int main(int arguments, char **argument) {
  if (arguments != 2) {
    std::cerr << "usage: " << argument[0] << " FOLDER\n";
    return 2;
  }
  std::string folder = argument[1];
  test_library();
  test_views();
  test_maps(folder);
  test_find();
  test_spaces();
  test_fields();
  test_indexes(folder);
  test_points();
  test_batches();
  test_planners();
  test_watchers();
  test_threads();
  IS(mediant::objects() == 0);
  std::cout << "all.cpp: all is as it should be\n";
}
