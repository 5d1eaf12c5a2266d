// Planners: paths, wishes, searches in steps, costs, points between vertices, goals, batches, watchers.

#include "check.h"

void test_planner(void) {
  struct made made = make(RING, NULL, NULL);
  mediant_point points[8], start = {0, 0}, goal = {5, 4}, enclosed = {2, 2}, wall = {1, 1};
  size_t count = 9;
  double length = 0;
  OK(mediant_planner_points(made.planner, points, COUNT(points), &count));
  IS(count == 0);
  OK(mediant_planner_path(made.planner, start, goal, points, COUNT(points), &count, &length));
  IS(count == 3 && same(points[0], start) && same(points[2], goal));
  NEAR(length, 9);
  OK(mediant_planner_path(made.planner, start, enclosed, points, COUNT(points), &count, &length));
  IS(count == 0 && isinf(length));
  OK(mediant_planner_distance(made.planner, start, goal, &length));
  NEAR(length, 9);
  OK(mediant_planner_distance(made.planner, start, enclosed, &length));
  IS(isinf(length));
  mediant_planner planner = made.planner;
  FAILS(mediant_planner_path(planner, wall, goal, points, COUNT(points), &count, &length),
        MEDIANT_CODE_START_BLOCKED, "(1, 1)");
  FAILS(mediant_planner_path(planner, start, at(6, 4), points, COUNT(points), &count, &length),
        MEDIANT_CODE_GOAL_OUTSIDE, "(6, 4)");
  FAILS(mediant_planner_path(planner, at(0.5, 0), goal, points, COUNT(points), &count, &length),
        MEDIANT_CODE_BETWEEN, "0.5");
  FAILS(mediant_planner_path(planner, at(NAN, 0), goal, points, COUNT(points), &count, &length),
        MEDIANT_CODE_START_OUTSIDE, "start");

  // Several ends: the pair with the shortest path.
  mediant_answer answer;
  mediant_point starts[] = {{5, 4}, {0, 0}}, goals[] = {{2, 2}, {0, 4}};
  OK(mediant_planner_find(planner, starts, 2, goals, 2, NULL, NULL, &answer));
  IS(answer.status == MEDIANT_STATUS_FOUND && answer.stopped_by == MEDIANT_LIMIT_NONE && answer.point_count == 2);
  NEAR(answer.distance, 4);
  NEAR(answer.length, 4);
  NEAR(answer.lower_bound, 4);
  IS(answer.any_angle_lower_bound <= 4 || isnan(answer.any_angle_lower_bound));
  OK(mediant_planner_points(planner, points, COUNT(points), &count));
  IS(count == 2 && same(points[0], start) && same(points[1], goals[1]));
  FAILS(mediant_planner_find(planner, NULL, 0, goals, 2, NULL, NULL, &answer), MEDIANT_CODE_NO_END, "start");

  drop(made);
}

void test_wishes(void) {
  struct made made = make(RING, NULL, NULL);
  mediant_planner planner = made.planner;
  mediant_point points[8], start = {0, 0}, goal = {5, 4}, enclosed = {2, 2}, wall = {1, 1};
  mediant_answer answer;
  size_t count = 0;
  OK(mediant_planner_find(planner, &start, 1, &enclosed, 1, NULL, NULL, &answer));
  IS(answer.status == MEDIANT_STATUS_UNREACHABLE && isinf(answer.distance) && answer.point_count == 0);
  OK(mediant_planner_find(planner, &start, 1, &enclosed, 1, "nearest", NULL, &answer));
  IS(answer.status == MEDIANT_STATUS_NEAREST && answer.point_count >= 2);
  OK(mediant_planner_points(planner, points, COUNT(points), &count));
  NEAR(hypot(points[count - 1].x - 2, points[count - 1].y - 2), 2);
  OK(mediant_planner_find(planner, &wall, 1, &goal, 1, "snap", NULL, &answer));
  IS(answer.status == MEDIANT_STATUS_FOUND && answer.point_count >= 2);
  OK(mediant_planner_find(planner, &start, 1, &goal, 1, "tolerance=2", NULL, &answer));
  NEAR(answer.distance, 7);
  OK(mediant_planner_find(planner, &start, 1, &goal, 1, "max_cost=9", NULL, &answer));
  IS(answer.status == MEDIANT_STATUS_FOUND);
  OK(mediant_planner_find(planner, &start, 1, &goal, 1, " max_cost=8\tnearest=false ", NULL, &answer));
  IS(answer.status == MEDIANT_STATUS_STOPPED && answer.stopped_by == MEDIANT_LIMIT_COST);
  IS(isnan(answer.distance));
  OK(mediant_planner_find(planner, &start, 1, &goal, 1, "timeout=0", NULL, &answer));
  IS(answer.status == MEDIANT_STATUS_STOPPED && answer.stopped_by == MEDIANT_LIMIT_TIMEOUT);

  const char *engine = NULL;
  OK(mediant_planner_searched_by(planner, &engine));
  IS(engine != NULL && strlen(engine) > 0);
  drop(made);
}

// Cells that count otherwise.
void test_exceptions(void) {
  struct made made = make(RING, NULL, NULL);
  mediant_planner planner = made.planner;
  mediant_point points[8], start = {0, 0}, enclosed = {2, 2}, wall = {1, 1};
  mediant_answer answer;
  const char *engine = NULL;
  size_t count = 0;
  mediant_cell shut = {0, 2}, door = {2, 1};
  mediant_exceptions except = {&shut, 1, NULL, 0, 0};
  mediant_point below = {0, 4};
  OK(mediant_planner_find_except(planner, &start, 1, &below, 1, &except, NULL, NULL, &answer));
  NEAR(answer.distance, 14);
  mediant_exceptions opened = {NULL, 0, &door, 1, 0};
  OK(mediant_planner_find_except(planner, &start, 1, &enclosed, 1, &opened, NULL, NULL, &answer));
  NEAR(answer.distance, 4);
  mediant_exceptions ends = {NULL, 0, NULL, 0, 1};
  mediant_point beside = {0, 1};
  OK(mediant_planner_find_except(planner, &wall, 1, &beside, 1, &ends, NULL, NULL, &answer));
  NEAR(answer.distance, 1);
  OK(mediant_planner_points(planner, points, COUNT(points), &count));
  IS(count == 2 && same(points[0], wall));
  OK(mediant_planner_searched_by(planner, &engine));
  IS(strlen(engine) > 0);
  // No limit stops it before it is seen that it has no end.
  FAILS(mediant_planner_find_except(planner, NULL, 0, &beside, 1, &opened, "timeout=0", NULL, &answer),
        MEDIANT_CODE_NO_END, "start");
  drop(made);
}

void test_search(void) {
  struct made made = make(RING, NULL, "engine=astar");
  mediant_planner planner = made.planner;
  mediant_point start = {0, 0}, goal = {5, 4}, points[40];
  mediant_answer answer;
  int32_t done = -1;
  FAILS(mediant_planner_step(planner, 1, &done, &answer), MEDIANT_CODE_NOT_BEGUN, "begin");
  size_t count = 9;
  OK(mediant_planner_best(planner, points, COUNT(points), &count));
  IS(count == 0);
  uint64_t expansions = 9;
  double bound = 9;
  OK(mediant_planner_progress(planner, &expansions, &bound));
  IS(expansions == 0 && bound == 0);

  OK(mediant_planner_begin(planner, &start, 1, &goal, 1, NULL, NULL));
  OK(mediant_planner_step(planner, 4, &done, &answer));
  IS(done == 0);
  OK(mediant_planner_progress(planner, &expansions, &bound));
  IS(expansions == 4 && bound > 6 && bound <= 9);
  OK(mediant_planner_best(planner, points, COUNT(points), &count));
  IS(count >= 1 && same(points[0], start));
  OK(mediant_planner_path_to(planner, at(0, 1), points, COUNT(points), &count));
  IS(count == 2 && same(points[1], at(0, 1)));
  OK(mediant_planner_path_to(planner, goal, points, COUNT(points), &count));
  IS(count == 0);
  int steps = 1;
  while (!done) {
    OK(mediant_planner_step(planner, 1, &done, &answer));
    steps++;
    IS(steps < 100);
  }
  IS(steps > 2 && answer.status == MEDIANT_STATUS_FOUND);
  NEAR(answer.distance, 9);
  OK(mediant_planner_points(planner, points, COUNT(points), &count));
  IS(count == answer.point_count && same(points[count - 1], goal));

  // Any other query forgets a search, one with wishes too, and is none itself.
  OK(mediant_planner_begin(planner, &start, 1, &goal, 1, NULL, NULL));
  OK(mediant_planner_find(planner, &start, 1, &goal, 1, "max_cost=20", NULL, &answer));
  FAILS(mediant_planner_step(planner, 1, &done, &answer), MEDIANT_CODE_NOT_BEGUN, "begin");
  OK(mediant_planner_best(planner, points, COUNT(points), &count));
  IS(count == 0);
  OK(mediant_planner_path_to(planner, start, points, COUNT(points), &count));
  IS(count == 0);
  OK(mediant_planner_progress(planner, &expansions, &bound));
  IS(expansions == 0 && bound == 0);

  // A search that is begun anew, with a limit.
  OK(mediant_planner_begin(planner, &start, 1, &goal, 1, "max_expansions=3", NULL));
  OK(mediant_planner_points(planner, points, COUNT(points), &count));
  IS(count == 0);
  OK(mediant_planner_step(planner, 100, &done, &answer));
  IS(done == 1 && answer.status == MEDIANT_STATUS_STOPPED);
  IS(answer.stopped_by == MEDIANT_LIMIT_EXPANSIONS && isnan(answer.distance));
  mediant_point wall = {1, 1};
  FAILS(mediant_planner_begin(planner, &wall, 1, &goal, 1, NULL, NULL), MEDIANT_CODE_START_BLOCKED, "(1, 1)");
  drop(made);
}

void test_costs(void) {
  mediant_map map, priced;
  mediant_space space;
  mediant_index index;
  mediant_planner planner;
  OK(mediant_map_new(3, 3, NULL, &map));
  double costs[] = {2, 2, 2, 2, 50, 2, 2, 2, 2};
  FAILS(mediant_map_costs(map, costs, 8, &priced), MEDIANT_CODE_COST, "8");
  costs[0] = -1;
  FAILS(mediant_map_costs(map, costs, 9, &priced), MEDIANT_CODE_COST, "-1");
  costs[0] = 2;
  OK(mediant_map_costs(map, costs, 9, &priced));
  OK(mediant_space_new(priced, "corners=always", &space));
  OK(mediant_index_prepare(space, NULL, NULL, &index));
  OK(mediant_planner_new(index, &planner));
  // Costs of cells that are edited: NaN blocks one, a number frees it.
  mediant_map edited, freed;
  mediant_cell corner = {0, 0};
  double none = NAN, seven = 7;
  uint8_t cells[9], open = 0;
  OK(mediant_map_edit_costs(priced, &corner, &none, 1, &edited));
  OK(mediant_map_cells(edited, cells, sizeof cells));
  IS(cells[0] == 1 && cells[1] == 0);
  FAILS(mediant_map_edit_cells(edited, &corner, &open, 1, &freed), MEDIANT_CODE_COST,
        "cell (0, 0) is freed, and has no cost: free it by mediant_map_edit_costs");
  OK(mediant_map_edit_costs(edited, &corner, &seven, 1, &freed));
  OK(mediant_map_cells(freed, cells, sizeof cells));
  IS(cells[0] == 0);
  OK(mediant_map_free(freed));
  OK(mediant_map_free(edited));
  FAILS(mediant_map_edit_costs(map, &corner, &seven, 1, &edited), MEDIANT_CODE_COST,
        "mediant_map_costs");
  // Around the middle, by its corners: 2√2 cells, at 2 each.
  mediant_point start = {0, 1}, goal = {2, 1}, points[4];
  size_t count = 0;
  double cost = 0;
  OK(mediant_planner_path(planner, start, goal, points, COUNT(points), &count, &cost));
  NEAR(cost, 4 * sqrt(2));
  IS(count == 3);
  mediant_answer answer;
  OK(mediant_planner_find(planner, &start, 1, &goal, 1, NULL, NULL, &answer));
  NEAR(answer.distance, 4 * sqrt(2));
  NEAR(answer.length, 2 * sqrt(2));
  double bound = 0;
  OK(mediant_index_bound(index, &bound));
  IS(isnan(bound) || bound >= 1);
  struct made made = {map, space, index, planner};
  drop(made);
  OK(mediant_map_free(priced));
}

void test_points(void) {
  struct made made = make(RING, "k=any gap=closed", "engine=subgoal");
  mediant_point points[8];
  size_t count = 0;
  double length = 0;
  OK(mediant_planner_path(made.planner, at(0.5, 0.25), at(6, 4), points, COUNT(points), &count, &length));
  IS(count == 3 && same(points[0], at(0.5, 0.25)) && same(points[1], at(5, 1)) && same(points[2], at(6, 4)));
  NEAR(length, hypot(4.5, 0.75) + sqrt(10));
  // Numbers are rounded to 1/1024.
  OK(mediant_planner_path(made.planner, at(0.3, 0), at(0.3, 1), points, COUNT(points), &count, &length));
  IS(count == 2 && points[0].x == 307.0 / 1024 && length == 1);
  FAILS(mediant_planner_path(made.planner, at(1.5, 1.5), at(6, 4), points, COUNT(points), &count, &length),
        MEDIANT_CODE_START_BLOCKED, "(1.5, 1.5)");
  FAILS(mediant_planner_path(made.planner, at(1e300, 1.5), at(6, 4), points, COUNT(points), &count, &length),
        MEDIANT_CODE_START_OUTSIDE, "start");
  FAILS(mediant_planner_path(made.planner, at(0, 0), at(0, -INFINITY), points, COUNT(points), &count, &length),
        MEDIANT_CODE_GOAL_OUTSIDE, "goal");
  drop(made);
}

// Ends anywhere at any angle, by an engine: whatever takes a point takes them. `by` is where the corner of the
// map is, in the coordinates of the placement.
static void ends_anywhere(const char *motion, const char *engine, double by) {
  struct made made = make(RING, motion, engine);
  mediant_planner planner = made.planner;
  mediant_point start = at(by + 0.5, by + 0.25), goal = at(by + 6, by + 4), corner = at(by + 5, by + 1);
  mediant_point beside = at(by + 0.5, by + 3.25), enclosed = at(by + 2.5, by + 2.5), points[8];
  double length = 0, expected = hypot(4.5, 0.75) + sqrt(10), table[3];
  size_t count = 0, nearest = 9;
  OK(mediant_planner_path(planner, start, goal, points, COUNT(points), &count, &length));
  IS(count == 3 && same(points[0], start) && same(points[1], corner) && same(points[2], goal));
  NEAR(length, expected);
  OK(mediant_space_check(made.space, points, 3));
  OK(mediant_planner_distance(planner, goal, start, &length));
  NEAR(length, expected);
  OK(mediant_planner_distance(planner, start, enclosed, &length));
  IS(isinf(length));

  mediant_answer answer;
  mediant_point goals[] = {goal, beside, enclosed};
  OK(mediant_planner_find(planner, &start, 1, goals, 3, NULL, NULL, &answer));
  NEAR(answer.distance, 3);
  // An opening of the ring.
  mediant_cell door = {1, 2};
  mediant_exceptions opened = {NULL, 0, &door, 1, 0};
  OK(mediant_planner_find_except(planner, &beside, 1, &enclosed, 1, &opened, NULL, NULL, &answer));
  IS(answer.status == MEDIANT_STATUS_FOUND && answer.distance < 2.5);
  int32_t done = 0;
  OK(mediant_planner_begin(planner, &start, 1, &goal, 1, NULL, NULL));
  OK(mediant_planner_step(planner, UINT64_MAX, &done, &answer));
  IS(done == 1);
  NEAR(answer.distance, expected);

  mediant_goals prepared;
  OK(mediant_goals_new(made.index, goals, 3, &prepared));
  OK(mediant_planner_distances(planner, start, prepared, table, 3, &count));
  IS(count == 3 && isinf(table[2]));
  NEAR(table[0], expected);
  NEAR(table[1], 3);
  OK(mediant_planner_nearest(planner, start, prepared, &nearest, &length));
  IS(nearest == 1);
  OK(mediant_goals_free(prepared));
  OK(mediant_index_table(made.index, &start, 1, goals, 3, NULL, table));
  NEAR(table[0], expected);
  IS(isinf(table[2]));
  mediant_ends ends = {start, goal};
  mediant_batch batch;
  mediant_paths paths;
  OK(mediant_index_paths(made.index, &ends, 1, 1, NULL, &batch));
  OK(mediant_batch_paths(batch, &paths));
  NEAR(paths.lengths[0], expected);
  IS(paths.firsts[1] == 3 && same(paths.points[1], corner));
  OK(mediant_batch_free(batch));
  drop(made);
}

// The same without an engine: questions of the space, and fields.
static void points_of_space(const char *motion, double by) {
  struct made made = make(RING, motion, NULL);
  mediant_point start = at(by + 0.5, by + 0.25), goal = at(by + 6, by + 4), corner = at(by + 5, by + 1);
  mediant_point beside = at(by + 0.5, by + 3.25), points[4], next;
  int32_t is = -1;
  OK(mediant_space_is_free(made.space, start, &is));
  IS(is == 1);
  OK(mediant_space_connected(made.space, start, at(by + 2.5, by + 2.5), &is));
  IS(is == 0);
  OK(mediant_space_sees(made.space, start, corner, &is));
  IS(is == 1);
  OK(mediant_space_sees(made.space, start, goal, &is));
  IS(is == 0);
  mediant_batch path;
  mediant_paths paths;
  OK(mediant_space_path(made.space, start, goal, NULL, &path));
  OK(mediant_batch_paths(path, &paths));
  NEAR(paths.lengths[0], hypot(4.5, 0.75) + sqrt(10));
  OK(mediant_batch_free(path));

  mediant_field field;
  double length = 0;
  size_t count = 0;
  mediant_point sources[] = {start, beside};
  OK(mediant_field_new(made.space, sources, 2, INFINITY, NULL, &field));
  OK(mediant_field_get(field, at(by + 0.75, by + 0.25), &length));
  NEAR(length, 0.25);
  OK(mediant_field_get(field, beside, &length));
  IS(length == 0);
  OK(mediant_field_nearest_source(field, at(by + 0.5, by + 3), &next, &is));
  IS(is == 1 && same(next, beside));
  OK(mediant_field_path_from(field, at(by + 5.5, by + 0.5), points, COUNT(points), &count));
  IS(count == 2 && same(points[1], start));
  OK(mediant_field_direction(field, at(by + 4.5, by + 0.25), &next));
  NEAR(next.x, -1);
  OK(mediant_field_free(field));
  mediant_point wall = at(by + 1.5, by + 1.5);
  FAILS(mediant_field_new(made.space, &wall, 1, INFINITY, NULL, &field), MEDIANT_CODE_START_BLOCKED,
        "the source");
  drop(made);
}

void test_points_anywhere(void) {
  const char *engines[] = {NULL, "engine=anya", "engine=subgoal", "engine=subgoal levels=labels",
                           "engine=subgoal levels=contracted", "engine=subgoal levels=all",
                           "engine=subgoal levels=1"};
  for (size_t engine = 0; engine < COUNT(engines); engine++) {
    ends_anywhere("k=any gap=closed", engines[engine], 0);
    ends_anywhere("k=any gap=open", engines[engine], 0);
    ends_anywhere("placement=center k=any", engines[engine], -0.5);
    ends_anywhere("placement=center k=any gap=open", engines[engine], -0.5);
  }
  points_of_space("k=any gap=closed", 0);
  points_of_space("k=any gap=open", 0);
  points_of_space("placement=center k=any", -0.5);
}

void test_goals(void) {
  struct made made = make(RING, NULL, NULL);
  mediant_point where[] = {{0, 4}, {5, 4}, {2, 2}};
  mediant_goals goals, none;
  OK(mediant_goals_new(made.index, where, 3, &goals));
  double lengths[3], length = 0;
  size_t count = 0;
  OK(mediant_planner_distances(made.planner, at(0, 0), goals, NULL, 0, &count));
  IS(count == 3);
  OK(mediant_planner_distances(made.planner, at(0, 0), goals, lengths, 3, &count));
  IS(count == 3);
  NEAR(lengths[0], 4);
  NEAR(lengths[1], 9);
  IS(isinf(lengths[2]));
  size_t goal = 9;
  OK(mediant_planner_nearest(made.planner, at(5, 0), goals, &goal, &length));
  IS(goal == 1);
  NEAR(length, 4);
  OK(mediant_goals_new(made.index, where, 0, &none));
  OK(mediant_planner_nearest(made.planner, at(5, 0), none, &goal, &length));
  IS(isinf(length));
  OK(mediant_goals_free(none));
  mediant_point wall = {1, 1};
  FAILS(mediant_goals_new(made.index, &wall, 1, &none), MEDIANT_CODE_GOAL_BLOCKED, "(1, 1)");
  OK(mediant_goals_free(goals));

  double table[6];
  mediant_point starts[] = {{0, 0}, {5, 0}};
  OK(mediant_index_table(made.index, starts, 2, where, 3, NULL, table));
  NEAR(table[0], 4);
  NEAR(table[1], 9);
  NEAR(table[3], 9);
  NEAR(table[4], 4);
  IS(isinf(table[2]) && isinf(table[5]));
  OK(mediant_index_table(made.index, starts, 2, NULL, 0, NULL, NULL));
  drop(made);
}

// How often it was called, and from which call on it stops.
struct watched {
  uint64_t asked, stop_at, told, done, total;
};

static int32_t stop(void *data) {
  struct watched *watched = data;
  watched->asked++;
  return watched->asked >= watched->stop_at;
}

static void progress(void *data, uint64_t done, uint64_t total) {
  struct watched *watched = data;
  watched->told++;
  watched->done = done;
  watched->total = total;
}

static int32_t stops_once(void *data) {
  struct watched *watched = data;
  watched->asked++;
  return watched->asked <= 2;
}

void test_batch(void) {
  struct made made = make(RING, "k=any gap=closed", NULL);
  static mediant_ends ends[1000];
  double direct = sqrt(26) + sqrt(10);
  for (size_t query = 0; query < COUNT(ends); query++) {
    mediant_ends kinds[] = {
        {{0, 0}, {6, 4}}, {{0, 0}, {0, 0}}, {{0, 0}, {3, 3}}, {{1.5, 1.5}, {0, 0}}, {{0, 0}, {INFINITY, 0}},
    };
    ends[query] = kinds[query % COUNT(kinds)];
  }
  // One thread calls at a time.
  struct watched seen = {0, UINT64_MAX, 0, 0, 0};
  mediant_watcher watcher = {stop, progress, &seen};
  mediant_batch batch;
  OK(mediant_index_paths(made.index, ends, COUNT(ends), 1, &watcher, &batch));
  IS(seen.asked > 0 && seen.told > 0 && seen.done == 1000 && seen.total == 1000);
  OK(mediant_batch_free(batch));

  OK(mediant_index_paths(made.index, ends, COUNT(ends), 2, NULL, &batch));
  mediant_paths paths;
  OK(mediant_batch_paths(batch, &paths));
  IS(paths.count == 1000 && paths.firsts[0] == 0);
  for (size_t query = 0; query < paths.count; query++) {
    size_t first = paths.firsts[query], after = paths.firsts[query + 1];
    const int32_t codes[] = {0, 0, 0, MEDIANT_CODE_START_BLOCKED, MEDIANT_CODE_GOAL_OUTSIDE};
    IS(paths.codes[query] == codes[query % 5]);
    switch (query % 5) {
      case 0:
        NEAR(paths.lengths[query], direct);
        IS(after - first == 3 && same(paths.points[first + 1], at(5, 1)));
        break;
      case 1:
        IS(paths.lengths[query] == 0 && after - first >= 1 && same(paths.points[first], at(0, 0)));
        break;
      case 2:
        IS(isinf(paths.lengths[query]) && after == first);
        break;
      default:
        IS(isnan(paths.lengths[query]) && after == first);
    }
  }
  OK(mediant_batch_free(batch));
  OK(mediant_index_paths(made.index, NULL, 0, 0, NULL, &batch));
  OK(mediant_batch_paths(batch, &paths));
  IS(paths.count == 0 && paths.firsts[0] == 0);
  OK(mediant_batch_free(batch));
  // More threads than any machine gives.
  OK(mediant_index_paths(made.index, ends, COUNT(ends), SIZE_MAX, NULL, &batch));
  OK(mediant_batch_free(batch));
  drop(made);
}

void test_watcher(void) {
  enum { SIDE = 100 };
  mediant_map map;
  mediant_space space;
  mediant_index index;
  mediant_planner planner;
  // A block of one cell in each square of five by five.
  static uint8_t cells[SIDE * SIDE];
  for (size_t cell = 0; cell < COUNT(cells); cell++) {
    cells[cell] = cell % 5 == 2 && cell / SIDE % 5 == 2;
  }
  OK(mediant_map_new(SIDE, SIDE, cells, &map));
  OK(mediant_space_new(map, NULL, &space));
  struct watched seen = {0, UINT64_MAX, 0, 0, 0};
  mediant_watcher watcher = {stop, progress, &seen}, teller = {NULL, progress, &seen};
  OK(mediant_index_prepare(space, "engine=subgoal", &watcher, &index));
  IS(seen.told > 0);
  OK(mediant_index_free(index));
  OK(mediant_index_prepare(space, "engine=landmarks", &teller, &index));
  OK(mediant_index_free(index));
  seen.stop_at = 0;
  FAILS(mediant_index_prepare(space, "engine=landmarks", &watcher, &index), MEDIANT_CODE_CANCELLED, "stopped by its watcher while");

  OK(mediant_index_prepare(space, "engine=dijkstra", NULL, &index));
  OK(mediant_planner_new(index, &planner));
  mediant_point start = {0, 0}, goal = {SIDE - 1, SIDE - 1};
  mediant_answer answer;
  OK(mediant_planner_find(planner, &start, 1, &goal, 1, NULL, &watcher, &answer));
  IS(answer.status == MEDIANT_STATUS_STOPPED && answer.stopped_by == MEDIANT_LIMIT_CANCELLED);
  OK(mediant_planner_find(planner, &start, 1, &goal, 1, "timeout=0", &watcher, &answer));
  IS(answer.status == MEDIANT_STATUS_STOPPED && answer.stopped_by == MEDIANT_LIMIT_TIMEOUT);
  mediant_exceptions none = {NULL, 0, NULL, 0, 0};
  OK(mediant_planner_find_except(planner, &start, 1, &goal, 1, &none, NULL, &watcher, &answer));
  IS(answer.status == MEDIANT_STATUS_STOPPED && answer.stopped_by == MEDIANT_LIMIT_CANCELLED);
  OK(mediant_planner_begin(planner, &start, 1, &goal, 1, NULL, &watcher));
  int32_t done = 0;
  OK(mediant_planner_step(planner, UINT64_MAX, &done, &answer));
  IS(done == 1 && answer.status == MEDIANT_STATUS_STOPPED && answer.stopped_by == MEDIANT_LIMIT_CANCELLED);
  mediant_batch found;
  double radius = 0;
  mediant_cell from = {0, 0}, to = {SIDE - 1, SIDE - 1};
  FAILS(mediant_space_path(space, start, goal, &watcher, &found), MEDIANT_CODE_CANCELLED,
        "stopped by its watcher while");
  FAILS(mediant_space_widest_path(space, from, to, 0.1, &watcher, &found, &radius), MEDIANT_CODE_CANCELLED,
        "stopped by its watcher while");
  mediant_field field;
  FAILS(mediant_field_new(space, &start, 1, INFINITY, &watcher, &field), MEDIANT_CODE_CANCELLED, "stopped by its watcher while");
  // Fewer queries than a thread takes at a time: each is long enough to ask.
  static mediant_ends ends[100];
  for (size_t query = 0; query < COUNT(ends); query++) {
    ends[query].goal = goal;
  }
  mediant_batch batch;
  // One that has said 'stop' is not asked again, whatever it would say.
  mediant_watcher once = {stops_once, NULL, &seen};
  seen.asked = 0;
  FAILS(mediant_index_paths(index, ends, 1, 1, &once, &batch), MEDIANT_CODE_CANCELLED, "watcher");
  FAILS(mediant_index_prepare(space, "engine=subgoal", &once, &index), MEDIANT_CODE_CANCELLED, "watcher");
  IS(seen.asked == 2);
  FAILS(mediant_index_paths(index, ends, 1, 0, &watcher, &batch), MEDIANT_CODE_CANCELLED, "stopped by its watcher while");
  struct watched late = {0, 50, 0, 0, 0};
  mediant_watcher stops_late = {stop, NULL, &late};
  FAILS(mediant_index_paths(index, ends, COUNT(ends), 1, &stops_late, &batch), MEDIANT_CODE_CANCELLED, "stopped by its watcher while");
  IS(late.asked == 50);
  double table[1];
  FAILS(mediant_index_table(index, &start, 1, &goal, 1, &watcher, table), MEDIANT_CODE_CANCELLED, "stopped by its watcher while");
  struct made made = {map, space, index, planner};
  drop(made);
}
