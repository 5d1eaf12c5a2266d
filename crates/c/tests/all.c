// Every function of mediant.h, with right answers. It takes the name of an empty folder, in which it writes.
//
// Here: the library, maps, spaces, paths, fields.

#include "check.h"

static void test_library(void) {
  IS(mediant_interface() == MEDIANT_INTERFACE);
  IS(strchr(mediant_version(), '.') != NULL);
  SAME(mediant_message(), "");
  SAME(mediant_code_name(MEDIANT_CODE_OK), "ok");
  SAME(mediant_code_name(MEDIANT_CODE_START_BLOCKED), "start-blocked");
  SAME(mediant_code_name(MEDIANT_CODE_OTHER), "other");
  IS(mediant_code_name(-1) == NULL && mediant_code_name(100) == NULL);

  mediant_cell moves[8];
  size_t count = 0;
  OK(mediant_moves(3, moves, COUNT(moves), &count));
  IS(count == 8 && moves[0].x == 0 && moves[0].y == 1);
  // Clockwise, as seen with y upwards.
  IS(moves[1].x == 1 && moves[1].y == 1 && moves[2].x == 1 && moves[2].y == 0);
  OK(mediant_moves(8, moves, COUNT(moves), &count));
  IS(count == 256);
  FAILS(mediant_moves(1, moves, COUNT(moves), &count), MEDIANT_CODE_K, "k");

  double bound = 0;
  OK(mediant_bound("k=3 placement=corner", &bound));
  // √(4 − 2√2): the ratio of octile distance to the straight line, where it is greatest.
  NEAR(bound, sqrt(4 - 2 * sqrt(2)));
  OK(mediant_bound("k=any gap=closed", &bound));
  NEAR(bound, 1);
  OK(mediant_bound("k=2 corners=always", &bound));
  IS(isnan(bound) || bound > 1);
}

static void test_maps(void) {
  mediant_map map, other;
  OK(mediant_map_parse(RING, &map));
  uint32_t width = 0, height = 0;
  OK(mediant_map_size(map, &width, &height));
  IS(width == 6 && height == 5);

  uint8_t cells[30];
  OK(mediant_map_cells(map, cells, sizeof cells));
  IS(memcmp(cells + 6, "\0\1\1\1\1\0\0\1\0\0\1\0", 12) == 0);

  // The same map of bytes, and of bits.
  OK(mediant_map_new(6, 5, cells, &other));
  uint8_t again[30];
  OK(mediant_map_cells(other, again, sizeof again));
  IS(memcmp(cells, again, sizeof cells) == 0);
  OK(mediant_map_free(other));
  uint8_t bits[4] = {0};
  for (size_t cell = 0; cell < 30; cell++) {
    bits[cell / 8] |= (uint8_t)((cells[cell] == 0) << cell % 8);
  }
  OK(mediant_map_from_bits(6, 5, bits, &other));
  OK(mediant_map_cells(other, again, sizeof again));
  IS(memcmp(cells, again, sizeof cells) == 0);
  OK(mediant_map_free(other));

  int32_t blocked = -1;
  mediant_cell wall = {1, 1}, inside = {2, 2}, outside = {-1, 0};
  OK(mediant_map_is_blocked(map, wall, &blocked));
  IS(blocked == 1);
  OK(mediant_map_is_blocked(map, inside, &blocked));
  IS(blocked == 0);
  OK(mediant_map_is_blocked(map, outside, &blocked));
  IS(blocked == 1);
  OK(mediant_map_free(map));

  FAILS(mediant_map_new(0, 5, NULL, &map), MEDIANT_CODE_MAP_SIZE, "0");
  // Before bytes are read that no map has.
  FAILS(mediant_map_new(32769, 1, cells, &map), MEDIANT_CODE_MAP_SIZE, "32769 columns");
  FAILS(mediant_map_new(UINT32_MAX, UINT32_MAX, cells, &map), MEDIANT_CODE_MAP_SIZE, "4294967295");
  FAILS(mediant_map_from_bits(1, UINT32_MAX, bits, &map), MEDIANT_CODE_MAP_SIZE, "rows");
  FAILS(mediant_map_from_bits(0, 1, bits, &map), MEDIANT_CODE_MAP_SIZE, "0 columns");
  FAILS(mediant_map_parse("..\n...\n", &map), MEDIANT_CODE_MAP_RAGGED, "row");
  FAILS(mediant_map_parse("..\n.x\n", &map), MEDIANT_CODE_MAP_TILE, "x");
  FAILS(mediant_map_parse(NULL, &map), MEDIANT_CODE_MAP_SIZE, "");
}

static void test_files(const char *folder) {
  char path[4096];
  snprintf(path, sizeof path, "%s/ring.map", folder);
  FILE *file = fopen(path, "w");
  IS(file != NULL);
  fputs("type octile\nheight 5\nwidth 6\nmap\n" RING, file);
  IS(fclose(file) == 0);
  mediant_map map;
  uint8_t cells[30];
  OK(mediant_map_open(path, &map));
  OK(mediant_map_cells(map, cells, sizeof cells));
  IS(memcmp(cells + 6, "\0\1\1\1\1\0", 6) == 0);
  OK(mediant_map_free(map));

  snprintf(path, sizeof path, "%s/none.map", folder);
  FAILS(mediant_map_open(path, &map), MEDIANT_CODE_FILE_MISSING, "none.map");
  file = fopen(path, "w");
  IS(file != NULL);
  fputs("type octile\nheight 5\n", file);
  IS(fclose(file) == 0);
  FAILS(mediant_map_open(path, &map), MEDIANT_CODE_MAP_FORMAT, "none.map");
  IS(remove(path) == 0);
}

static void test_made_maps(void) {
  mediant_map empty, map;
  OK(mediant_map_new(4, 3, NULL, &empty));
  uint8_t cells[12], walls[] = {1, 0, 1, 1};
  mediant_area area = {1, 1, 2, 2};
  OK(mediant_map_edit(empty, area, walls, &map));
  OK(mediant_map_cells(map, cells, sizeof cells));
  IS(memcmp(cells, "\0\0\0\0\0\1\0\0\0\1\1\0", 12) == 0);
  OK(mediant_map_free(map));
  // What is beyond the map is left out.
  mediant_area beyond = {3, 2, 2, 2}, far = {UINT32_MAX, UINT32_MAX, 2, 2};
  OK(mediant_map_edit(empty, beyond, walls, &map));
  OK(mediant_map_cells(map, cells, sizeof cells));
  IS(memcmp(cells, "\0\0\0\0\0\0\0\0\0\0\0\1", 12) == 0);
  OK(mediant_map_free(map));
  FAILS(mediant_map_edit(empty, far, walls, &map), MEDIANT_CODE_EDIT_OUTSIDE, "outside");
  mediant_area huge = {0, 0, 2, 32769};
  FAILS(mediant_map_edit(empty, huge, walls, &map), MEDIANT_CODE_ARGUMENT, "area: 2 × 32769 cells");

  mediant_cell where[] = {{0, 0}, {3, 2}, {0, 0}};
  uint8_t what[] = {1, 9, 0};
  OK(mediant_map_edit_cells(empty, where, what, 3, &map));
  OK(mediant_map_cells(map, cells, sizeof cells));
  IS(cells[0] == 0 && cells[11] == 1);
  OK(mediant_map_free(map));
  mediant_cell none[] = {{4, 0}};
  FAILS(mediant_map_edit_cells(empty, none, what, 1, &map), MEDIANT_CODE_EDIT_OUTSIDE, "outside");

  // A square of 2 × 2 cells has no place in the last column and row.
  OK(mediant_map_for_square(empty, 2, &map));
  OK(mediant_map_cells(map, cells, sizeof cells));
  IS(memcmp(cells, "\0\0\0\1\0\0\0\1\1\1\1\1", 12) == 0);
  OK(mediant_map_free(map));
  // A disc that is as high as the map fits in its middle row.
  OK(mediant_map_for_disc(empty, 1.5, NULL, &map));
  OK(mediant_map_cells(map, cells, sizeof cells));
  IS(memcmp(cells, "\1\1\1\1\1\0\0\1\1\1\1\1", 12) == 0);
  OK(mediant_map_free(map));
  FAILS(mediant_map_for_disc(empty, -1, NULL, &map), MEDIANT_CODE_NUMBER, "radius");

  double clearance[12];
  OK(mediant_map_clearance(empty, clearance, 12));
  NEAR(clearance[0], 0.5);
  NEAR(clearance[5], 1.5);
  OK(mediant_map_free(empty));
}

static void test_spaces(void) {
  mediant_map map;
  mediant_space space, corners;
  OK(mediant_map_parse(RING, &map));
  OK(mediant_space_new(map, NULL, &space));
  OK(mediant_space_new(map, "k=any gap=closed", &corners));
  // What is made of a map stays when that is freed.
  OK(mediant_map_free(map));

  int32_t is = -1;
  OK(mediant_space_is_free(space, at(1, 1), &is));
  IS(is == 0);
  OK(mediant_space_is_free(corners, at(1, 1), &is));
  IS(is == 1);
  OK(mediant_space_is_free(corners, at(1.5, 1.5), &is));
  IS(is == 0);
  OK(mediant_space_connected(space, at(0, 0), at(5, 4), &is));
  IS(is == 1);
  OK(mediant_space_connected(space, at(0, 0), at(2, 2), &is));
  IS(is == 0);
  OK(mediant_space_sees(corners, at(0, 0), at(5, 1), &is));
  IS(is == 1);
  OK(mediant_space_sees(corners, at(0, 0), at(6, 4), &is));
  IS(is == 0);

  mediant_point good[] = {{0, 0}, {5, 1}, {6, 4}}, bad[] = {{0, 0}, {6, 4}};
  OK(mediant_space_check(corners, good, 3));
  FAILS(mediant_space_check(corners, bad, 2), MEDIANT_CODE_BROKEN_PATH, "(");

  size_t count = 0;
  double radius = 0;
  mediant_batch path;
  mediant_paths paths;
  OK(mediant_space_path(corners, at(0, 0), at(6, 4), NULL, &path));
  OK(mediant_batch_paths(path, &paths));
  IS(paths.count == 1 && paths.firsts[1] == 3 && paths.codes[0] == MEDIANT_CODE_OK);
  IS(same(paths.points[1], at(5, 1)) && same(paths.points[2], at(6, 4)));
  NEAR(paths.lengths[0], sqrt(26) + sqrt(10));
  OK(mediant_batch_free(path));
  OK(mediant_space_path(space, at(0, 0), at(2, 2), NULL, &path));
  OK(mediant_batch_paths(path, &paths));
  IS(paths.count == 1 && paths.firsts[1] == 0 && isinf(paths.lengths[0]));
  OK(mediant_batch_free(path));
  FAILS(mediant_space_path(space, at(1, 1), at(0, 0), NULL, &path), MEDIANT_CODE_START_BLOCKED, "(1, 1)");

  mediant_cell start = {0, 0}, goal = {5, 4}, cut = {2, 2};
  OK(mediant_space_widest_path(space, start, goal, 0.2, NULL, &path, &radius));
  OK(mediant_batch_paths(path, &paths));
  IS(paths.firsts[1] >= 3 && same(paths.points[0], at(0, 0)));
  IS(same(paths.points[paths.firsts[1] - 1], at(5, 4)));
  NEAR(radius, 0.5);
  OK(mediant_batch_free(path));
  OK(mediant_space_widest_path(space, start, cut, 0.2, NULL, &path, &radius));
  OK(mediant_batch_paths(path, &paths));
  IS(paths.firsts[1] == 0 && isinf(paths.lengths[0]) && isnan(radius));
  OK(mediant_batch_free(path));

  const char *engine = NULL;
  char why[400];
  OK(mediant_space_engine(corners, UINT64_MAX, &engine, why, sizeof why, &count));
  SAME(engine, "subgoal");
  IS(count > 10 && strlen(why) == count);
  OK(mediant_space_engine(corners, 1, &engine, NULL, 0, &count));
  IS(strcmp(engine, "subgoal") != 0 && count > 10);
  OK(mediant_space_free(space));
  OK(mediant_space_free(corners));
}

static void test_paths(void) {
  mediant_point path[] = {{0, 0}, {3, 0}, {3, 2}}, between[] = {{0, 0}, {2.5, 0}};
  mediant_cell cells[12];
  size_t total = 0;
  OK(mediant_path_vertices(path, 3, cells, COUNT(cells), &total));
  IS(total == 6 && cells[1].x == 1 && cells[5].x == 3 && cells[5].y == 2);
  OK(mediant_path_vertices(between, 2, cells, COUNT(cells), &total));
  IS(total == 0);
  OK(mediant_path_vertices(NULL, 0, cells, COUNT(cells), &total));
  IS(total == 0);

  mediant_point spaced[12];
  OK(mediant_path_spaced(path, 3, 2, spaced, COUNT(spaced), &total));
  // At 0, 2, 4, and its end at 5.
  IS(total == 4 && same(spaced[1], at(2, 0)) && same(spaced[2], at(3, 1)) && same(spaced[3], at(3, 2)));
  FAILS(mediant_path_spaced(path, 3, 0, spaced, COUNT(spaced), &total), MEDIANT_CODE_NUMBER, "cells apart");
  FAILS(mediant_path_spaced(path, 3, 1e-300, spaced, COUNT(spaced), &total), MEDIANT_CODE_NUMBER,
        "more than");

  mediant_map map;
  mediant_space space;
  OK(mediant_map_new(4, 3, NULL, &map));
  OK(mediant_space_new(map, NULL, &space));
  OK(mediant_path_touched_cells(space, path, 3, cells, COUNT(cells), &total));
  IS(total == 6 && cells[0].x == 0 && cells[5].x == 3 && cells[5].y == 2);
  OK(mediant_space_free(space));
  OK(mediant_map_free(map));
}

static void test_fields(void) {
  mediant_map map, opened;
  mediant_space space, changed;
  mediant_field field, repaired;
  OK(mediant_map_parse(RING, &map));
  OK(mediant_space_new(map, NULL, &space));
  mediant_point source = {0, 0};
  OK(mediant_field_new(space, &source, 1, INFINITY, NULL, &field));
  uint32_t width = 0, height = 0;
  OK(mediant_field_size(field, &width, &height));
  IS(width == 6 && height == 5);
  double distances[30], distance = 0;
  OK(mediant_field_distances(field, distances, 30));
  NEAR(distances[29], 9);
  IS(distances[0] == 0 && isinf(distances[14]) && isinf(distances[7]));
  OK(mediant_field_get(field, at(5, 4), &distance));
  NEAR(distance, 9);
  OK(mediant_field_get(field, at(-5, 4), &distance));
  IS(isinf(distance));

  float flow[60];
  OK(mediant_field_flow(field, flow, 60));
  IS(flow[6] == -1 && flow[7] == 0 && flow[0] == 0 && flow[28] == 0);
  mediant_point point = {7, 7};
  OK(mediant_field_direction(field, at(0, 3), &point));
  IS(same(point, at(0, -1)));
  OK(mediant_field_direction(field, at(0, 0), &point));
  IS(same(point, at(0, 0)));
  int32_t there = -1;
  OK(mediant_field_next(field, at(3, 0), &point, &there));
  IS(there == 1 && same(point, at(2, 0)));
  OK(mediant_field_next(field, at(2, 2), &point, &there));
  IS(there == 0);
  OK(mediant_field_nearest_source(field, at(5, 4), &point, &there));
  IS(there == 1 && same(point, at(0, 0)));
  OK(mediant_field_nearest_source(field, at(2, 2), &point, &there));
  IS(there == 0);
  mediant_point points[4];
  size_t count = 9;
  OK(mediant_field_path_from(field, at(5, 0), points, COUNT(points), &count));
  IS(count >= 2 && same(points[0], at(5, 0)));
  OK(mediant_field_path_from(field, at(2, 2), points, COUNT(points), &count));
  IS(count == 0);

  // A door in the ring.
  mediant_cell door = {1, 2};
  uint8_t open = 0;
  OK(mediant_map_edit_cells(map, &door, &open, 1, &opened));
  OK(mediant_space_new(opened, NULL, &changed));
  OK(mediant_field_repair(field, changed, &repaired));
  OK(mediant_field_get(repaired, at(2, 2), &distance));
  NEAR(distance, 4);
  OK(mediant_field_free(repaired));
  OK(mediant_field_free(field));

  OK(mediant_field_new(space, &source, 1, 3, NULL, &field));
  OK(mediant_field_get(field, at(3, 0), &distance));
  NEAR(distance, 3);
  OK(mediant_field_get(field, at(4, 0), &distance));
  IS(isinf(distance));
  OK(mediant_field_free(field));
  mediant_point wall = {1, 1};
  FAILS(mediant_field_new(space, &wall, 1, 3, NULL, &field), MEDIANT_CODE_START_BLOCKED, "the source (1, 1)");
  FAILS(mediant_field_new(space, &source, 1, NAN, NULL, &field), MEDIANT_CODE_NUMBER, "limit");
  OK(mediant_space_free(changed));
  OK(mediant_space_free(space));
  OK(mediant_map_free(opened));
  OK(mediant_map_free(map));
}

/* One call from a map to a path. */
static void test_find(void) {
  mediant_map map;
  mediant_batch path;
  mediant_paths paths;
  mediant_answer answer;
  mediant_point starts[] = {{0, 0}, {0, 4}}, goal = {6, 4}, inside = {2, 2};
  OK(mediant_map_parse(RING, &map));
  OK(mediant_map_find(map, starts, 1, &goal, 1, "k=any gap=closed", NULL, &path, &answer));
  IS(answer.status == MEDIANT_STATUS_FOUND && answer.point_count == 3);
  NEAR(answer.distance, sqrt(26) + sqrt(10));
  OK(mediant_batch_paths(path, &paths));
  IS(paths.count == 1 && paths.firsts[1] == 3 && same(paths.points[1], at(5, 1)));
  OK(mediant_batch_free(path));

  /* From the nearer of two starts; none where none leads, but a path to the nearest place. */
  mediant_point end = {5, 4};
  OK(mediant_map_find(map, starts, 2, &end, 1, NULL, NULL, &path, &answer));
  IS(answer.status == MEDIANT_STATUS_FOUND && answer.distance == 5);
  OK(mediant_batch_free(path));
  OK(mediant_map_find(map, starts, 1, &inside, 1, "neighbors=4", NULL, &path, &answer));
  IS(answer.status == MEDIANT_STATUS_UNREACHABLE && answer.point_count == 0 && isinf(answer.distance));
  OK(mediant_batch_paths(path, &paths));
  IS(paths.count == 1 && paths.firsts[1] == 0);
  OK(mediant_batch_free(path));
  OK(mediant_map_find(map, starts, 1, &inside, 1, "nearest engine=astar", NULL, &path, &answer));
  IS(answer.status == MEDIANT_STATUS_NEAREST && answer.point_count > 0);
  OK(mediant_batch_free(path));
  /* Out of time before anything is prepared. */
  OK(mediant_map_find(map, starts, 1, &end, 1, "engine=jps-plus timeout=0", NULL, &path, &answer));
  IS(answer.status == MEDIANT_STATUS_STOPPED && answer.stopped_by == MEDIANT_LIMIT_TIMEOUT);
  OK(mediant_batch_free(path));

  FAILS(mediant_map_find(map, starts, 1, &end, 1, "k=13", NULL, &path, &answer), MEDIANT_CODE_MOTION, "13");
  FAILS(mediant_map_find(map, starts, 1, &end, 1, "side=4 engine=jps", NULL, &path, &answer),
        MEDIANT_CODE_ENGINE_OPTION, "side");
  FAILS(mediant_map_find(map, starts, 0, &end, 1, NULL, NULL, &path, &answer), MEDIANT_CODE_NO_END, "start");
  FAILS(mediant_map_find(map, starts, 1, &end, 1, NULL, NULL, NULL, &answer), MEDIANT_CODE_ARGUMENT, "path");
  FAILS(mediant_map_find(map, starts, 1, &end, 1, NULL, NULL, &path, NULL), MEDIANT_CODE_ARGUMENT, "answer");
  OK(mediant_map_free(map));
  FAILS(mediant_map_find(map, starts, 1, &end, 1, NULL, NULL, &path, &answer), MEDIANT_CODE_HANDLE, "map");
}

int main(int arguments, char **argument) {
  if (arguments != 2) {
    fprintf(stderr, "usage: %s FOLDER\n", argument[0]);
    return 2;
  }
  test_library();
  test_maps();
  test_files(argument[1]);
  test_made_maps();
  test_spaces();
  test_find();
  test_paths();
  test_fields();
  test_planner();
  test_wishes();
  test_exceptions();
  test_search();
  test_costs();
  test_points();
  test_points_anywhere();
  test_goals();
  test_batch();
  test_watcher();
  test_index(argument[1]);
  test_bytes();
  test_repair();
  test_handles();
  test_pointers();
  test_rooms();
  test_words();
  IS(mediant_objects() == 0);
  puts("all.c: all is as it should be");
  return 0;
}
