// Indexes: their setup, saved and loaded, as bytes, repaired after edits.

#include "check.h"

// The length of a path on an index.
static double length_on(mediant_index index, mediant_point start, mediant_point goal) {
  mediant_planner planner;
  double length = NAN;
  OK(mediant_planner_new(index, &planner));
  OK(mediant_planner_distance(planner, start, goal, &length));
  OK(mediant_planner_free(planner));
  return length;
}

void test_index(const char *folder) {
  struct made made = make(RING, "k=any gap=closed", "engine=subgoal levels=contracted");
  double bound = 0, expected = sqrt(26) + sqrt(10);
  OK(mediant_index_bound(made.index, &bound));
  NEAR(bound, 1);
  uint64_t memory = 0;
  OK(mediant_index_memory(made.index, &memory));
  IS(memory > 0 && memory < 1000000);
  char setup[200];
  size_t length = 0;
  OK(mediant_index_setup(made.index, setup, sizeof setup, &length));
  IS(strlen(setup) == length && strstr(setup, "subgoal") != NULL && strstr(setup, "closed") != NULL);
  int32_t finished = -1;
  OK(mediant_index_is_finished(made.index, &finished));
  IS(finished == 1);
  FAILS(mediant_planner_nearest(made.planner, at(0, 0), (mediant_goals){0}, &length, &bound),
        MEDIANT_CODE_HANDLE, "the goals are null");

  char path[4096];
  snprintf(path, sizeof path, "%s/ring.index", folder);
  OK(mediant_index_save(made.index, path));
  mediant_index loaded;
  OK(mediant_index_load(made.map, path, NULL, &loaded));
  NEAR(length_on(loaded, at(0, 0), at(6, 4)), expected);
  char again[200];
  OK(mediant_index_setup(loaded, again, sizeof again, &length));
  SAME(again, setup);
  // The space of an index that was loaded has its motion.
  mediant_space space;
  int32_t is = -1;
  OK(mediant_index_space(loaded, &space));
  OK(mediant_space_sees(space, at(0, 0), at(5, 1), &is));
  IS(is == 1);
  OK(mediant_space_free(space));
  OK(mediant_index_free(loaded));
  OK(mediant_index_load(made.map, path, "smooth=taut", &loaded));
  NEAR(length_on(loaded, at(0, 0), at(6, 4)), expected);
  OK(mediant_index_free(loaded));

  mediant_map other;
  OK(mediant_map_new(6, 5, NULL, &other));
  FAILS(mediant_index_load(other, path, NULL, &loaded), MEDIANT_CODE_MISMATCH, "map");
  OK(mediant_map_free(other));
  FAILS(mediant_index_save(made.index, "/none/at/all.index"), MEDIANT_CODE_FILE_UNWRITABLE, "all.index");
  snprintf(path, sizeof path, "%s/none.index", folder);
  FAILS(mediant_index_load(made.map, path, NULL, &loaded), MEDIANT_CODE_FILE_MISSING, "none.index");

  mediant_index none;
  FAILS(mediant_index_prepare(made.space, "engine=nothing", NULL, &none), MEDIANT_CODE_UNKNOWN_NAME,
        "nothing");
  FAILS(mediant_index_prepare(made.space, "engine=jps", NULL, &none), MEDIANT_CODE_ENGINE_K, "jps");
  drop(made);
}

void test_bytes(void) {
  struct made made = make(RING, "k=any gap=closed", "engine=subgoal levels=contracted");
  double expected = sqrt(26) + sqrt(10);
  mediant_index loaded;
  mediant_bytes bytes;
  const uint8_t *data = NULL;
  size_t size = 0;
  OK(mediant_index_to_bytes(made.index, &bytes));
  OK(mediant_bytes_data(bytes, &data, &size));
  IS(data != NULL && size > 100);
  OK(mediant_index_from_bytes(made.map, data, size, NULL, &loaded));
  NEAR(length_on(loaded, at(0, 0), at(6, 4)), expected);
  OK(mediant_index_free(loaded));
  // Cut short, and with another byte: an error, or the same index.
  for (size_t cut = 0; cut < size; cut += 1 + size / 50) {
    FAILS(mediant_index_from_bytes(made.map, data, cut, NULL, &loaded), MEDIANT_CODE_INDEX_DAMAGED, "");
    uint8_t *copy = malloc(size);
    IS(copy != NULL);
    memcpy(copy, data, size);
    copy[cut] ^= 0x40;
    if (mediant_index_from_bytes(made.map, copy, size, NULL, &loaded) == MEDIANT_CODE_OK) {
      NEAR(length_on(loaded, at(0, 0), at(6, 4)), expected);
      OK(mediant_index_free(loaded));
    }
    free(copy);
  }
  OK(mediant_bytes_free(bytes));
  drop(made);
}

void test_repair(void) {
  struct made made = make(RING, NULL, "engine=subgoal");
  mediant_cell door = {1, 2};
  uint8_t open = 0;
  mediant_map opened;
  mediant_space changed, other;
  mediant_index repaired, finished;
  OK(mediant_map_edit_cells(made.map, &door, &open, 1, &opened));
  OK(mediant_space_new(opened, NULL, &changed));
  OK(mediant_index_repair(made.index, changed, &repaired));
  mediant_point points[8], start = {0, 0}, enclosed = {2, 2};
  size_t count = 0;
  double length = 0;
  OK(mediant_planner_path(made.planner, start, enclosed, points, COUNT(points), &count, &length));
  IS(count == 0);
  OK(mediant_planner_follow(made.planner, repaired));
  OK(mediant_planner_path(made.planner, start, enclosed, points, COUNT(points), &count, &length));
  NEAR(length, 4);
  OK(mediant_planner_distance(made.planner, start, at(3, 2), &length));
  NEAR(length, 5);
  // The index that was repaired stays as it is.
  IS(isinf(length_on(made.index, start, enclosed)));

  OK(mediant_index_finish(repaired, NULL, &finished));
  int32_t is = -1;
  OK(mediant_index_is_finished(finished, &is));
  IS(is == 1);
  NEAR(length_on(finished, start, enclosed), 4);
  OK(mediant_planner_follow(made.planner, finished));
  OK(mediant_planner_distance(made.planner, start, enclosed, &length));
  NEAR(length, 4);

  // Another motion.
  OK(mediant_space_new(opened, "k=any gap=closed", &other));
  FAILS(mediant_index_repair(made.index, other, &repaired), MEDIANT_CODE_MISMATCH, "");
  mediant_index another;
  OK(mediant_index_prepare(other, NULL, NULL, &another));
  FAILS(mediant_planner_follow(made.planner, another), MEDIANT_CODE_MISMATCH, "");
  // The planner still answers.
  OK(mediant_planner_distance(made.planner, start, enclosed, &length));
  NEAR(length, 4);
  OK(mediant_index_free(another));
  OK(mediant_index_free(finished));
  OK(mediant_index_free(repaired));
  OK(mediant_space_free(other));
  OK(mediant_space_free(changed));
  OK(mediant_map_free(opened));
  drop(made);
}
