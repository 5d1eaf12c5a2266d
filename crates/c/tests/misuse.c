// Mistakes of programs: handles, pointers, rooms, texts. All are told, none does harm.

#include "check.h"

// A pointer that no value of T can be at.
#define ODD(T, memory) ((T *)(void *)((char *)(memory) + 1))

static void fails_handle(mediant_code code, const char *text) {
  IS(code == MEDIANT_CODE_HANDLE);
  IS(strcmp(mediant_message(), text) == 0);
}

// Each kind that is null, of another kind, and made up.
static void test_wrong_handles(struct made made) {
  mediant_map map;
  mediant_space space;
  mediant_index index;
  mediant_planner planner;
  mediant_field field;
  mediant_bytes bytes;
  mediant_paths paths;
  const uint8_t *data;
  size_t size = 0;
  uint32_t width = 0;
  uint64_t of_map = made.map.id, of_index = made.index.id;
  uint64_t handles[] = {0, of_map, 1, UINT64_MAX, of_map ^ 1,
                        of_map ^ (UINT64_C(1) << 40), of_index ^ 0xfffffff};
  for (size_t which = 0; which < COUNT(handles); which++) {
    uint64_t id = handles[which];
    if (id != of_map) {
      IS(mediant_map_size((mediant_map){id}, &width, &width) == MEDIANT_CODE_HANDLE);
      IS(mediant_map_free((mediant_map){id}) == MEDIANT_CODE_HANDLE);
      IS(mediant_space_new((mediant_map){id}, NULL, &space) == MEDIANT_CODE_HANDLE);
    }
    IS(mediant_index_prepare((mediant_space){id}, NULL, NULL, &index) == MEDIANT_CODE_HANDLE);
    IS(mediant_planner_new((mediant_index){id}, &planner) == MEDIANT_CODE_HANDLE);
    IS(mediant_planner_follow((mediant_planner){id}, made.index) == MEDIANT_CODE_HANDLE);
    IS(mediant_planner_follow(made.planner, (mediant_index){id}) == MEDIANT_CODE_HANDLE);
    IS(mediant_field_size((mediant_field){id}, &width, &width) == MEDIANT_CODE_HANDLE);
    IS(mediant_field_repair((mediant_field){id}, made.space, &field) == MEDIANT_CODE_HANDLE);
    IS(mediant_batch_paths((mediant_batch){id}, &paths) == MEDIANT_CODE_HANDLE);
    IS(mediant_bytes_data((mediant_bytes){id}, &data, &size) == MEDIANT_CODE_HANDLE);
    IS(mediant_index_to_bytes((mediant_index){id}, &bytes) == MEDIANT_CODE_HANDLE);
    IS(mediant_space_free((mediant_space){id}) == MEDIANT_CODE_HANDLE);
    IS(mediant_index_free((mediant_index){id}) == MEDIANT_CODE_HANDLE);
    IS(mediant_planner_free((mediant_planner){id}) == MEDIANT_CODE_HANDLE);
    IS(mediant_goals_free((mediant_goals){id}) == MEDIANT_CODE_HANDLE);
    IS(mediant_field_free((mediant_field){id}) == MEDIANT_CODE_HANDLE);
    IS(mediant_batch_free((mediant_batch){id}) == MEDIANT_CODE_HANDLE);
    IS(mediant_bytes_free((mediant_bytes){id}) == MEDIANT_CODE_HANDLE);
  }
  fails_handle(mediant_map_for_square((mediant_map){0}, 2, &map), "the map is null");
  fails_handle(mediant_map_for_square((mediant_map){of_index}, 2, &map),
               "the map is of another type, or made up");
  fails_handle(mediant_map_for_square((mediant_map){of_map | 0xffffff}, 2, &map), "the map was never made");
}

void test_handles(void) {
  size_t before = mediant_objects();
  struct made made = make(RING, NULL, NULL);
  IS(mediant_objects() == before + 4);
  test_wrong_handles(made);
  IS(mediant_objects() == before + 4);

  mediant_map map, next;
  uint32_t width = 0;
  OK(mediant_map_new(4, 3, NULL, &map));
  OK(mediant_map_free(map));
  fails_handle(mediant_map_free(map), "the map was freed");
  fails_handle(mediant_map_size(map, &width, &width), "the map was freed");
  // Its place is taken again, by another handle.
  OK(mediant_map_new(5, 3, NULL, &next));
  IS(map.id != next.id);
  fails_handle(mediant_map_free(map), "the map was freed");
  OK(mediant_map_size(next, &width, &width));
  OK(mediant_map_free(next));

  // A planner stays when all that it was made of is freed.
  double length = 0;
  OK(mediant_index_free(made.index));
  OK(mediant_space_free(made.space));
  OK(mediant_map_free(made.map));
  OK(mediant_planner_distance(made.planner, at(0, 0), at(5, 4), &length));
  NEAR(length, 9);
  OK(mediant_planner_free(made.planner));
  fails_handle(mediant_planner_free(made.planner), "the planner was freed");
  fails_handle(mediant_planner_distance(made.planner, at(0, 0), at(5, 4), &length), "the planner was freed");

  // More than the first places of a table.
  static mediant_map many[1000];
  for (size_t number = 0; number < COUNT(many); number++) {
    OK(mediant_map_new(1 + (uint32_t)number, 1, NULL, &many[number]));
  }
  IS(mediant_objects() == before + COUNT(many));
  for (size_t number = 0; number < COUNT(many); number++) {
    uint32_t height = 0;
    OK(mediant_map_size(many[number], &width, &height));
    IS(width == number + 1 && height == 1);
    OK(mediant_map_free(many[number]));
  }
  IS(mediant_objects() == before);
}

// A planner that is used in a call of its own watcher.
struct used {
  mediant_planner planner;
  int calls;
};

static int32_t use(void *data) {
  struct used *used = data;
  double length = 0;
  used->calls++;
  FAILS(mediant_planner_distance(used->planner, at(0, 0), at(1, 0), &length), MEDIANT_CODE_BUSY,
        "the planner is used by another call");
  FAILS(mediant_planner_free(used->planner), MEDIANT_CODE_BUSY, "the planner is used by another call");
  return 0;
}

static void test_busy(struct made made) {
  struct used used = {made.planner, 0};
  mediant_watcher watcher = {use, NULL, &used};
  mediant_point start = {0, 0}, goal = {5, 4};
  mediant_answer answer;
  OK(mediant_planner_find(made.planner, &start, 1, &goal, 1, NULL, &watcher, &answer));
  IS(used.calls > 0 && answer.status == MEDIANT_STATUS_FOUND);
  NEAR(answer.distance, 9);
}

void test_pointers(void) {
  struct made made = make(RING, NULL, "engine=dijkstra");
  test_busy(made);
  mediant_planner planner = made.planner;
  mediant_point start = {0, 0}, goal = {5, 4};
  mediant_answer answer;
  double memory[32] = {0};
  size_t count = 77;
  double length = 77;
  const mediant_code wrong = MEDIANT_CODE_ARGUMENT;

  FAILS(mediant_map_open(NULL, &made.map), wrong, "path: it is null");
  FAILS(mediant_map_new(1, 1, NULL, NULL), wrong, "map: it is null");
  FAILS(mediant_map_new(1, 1, NULL, ODD(mediant_map, memory)), wrong, "map: it is not aligned");
  FAILS(mediant_map_from_bits(1, 1, NULL, (mediant_map *)memory), wrong, "free: it is null");
  FAILS(mediant_map_cells(made.map, NULL, 4), wrong, "blocked: it is null");
  FAILS(mediant_map_size(made.map, (uint32_t *)memory, NULL), wrong, "height: it is null");
  FAILS(mediant_map_costs(made.map, ODD(double, memory), 30, (mediant_map *)memory), wrong,
        "costs: it is not aligned");
  FAILS(mediant_map_clearance(made.map, memory, SIZE_MAX / 2), wrong, "distances: it has more elements");
  FAILS(mediant_space_new(made.map, NULL, NULL), wrong, "space: it is null");
  FAILS(mediant_space_check(made.space, NULL, 2), wrong, "points: it is null");
  FAILS(mediant_space_is_free(made.space, start, NULL), wrong, "free: it is null");
  FAILS(mediant_index_prepare(made.space, NULL, NULL, NULL), wrong, "index: it is null");
  FAILS(mediant_index_prepare(made.space, NULL, ODD(mediant_watcher, memory), &made.index), wrong,
        "watcher: it is not");
  FAILS(mediant_index_save(made.index, NULL), wrong, "path: it is null");
  FAILS(mediant_index_from_bytes(made.map, NULL, 5, NULL, &made.index), wrong, "bytes: it is null");
  FAILS(mediant_index_from_bytes(made.map, NULL, 0, NULL, &made.index), MEDIANT_CODE_INDEX_DAMAGED, "");
  FAILS(mediant_index_table(made.index, &start, 1, &goal, 1, NULL, NULL), wrong, "lengths: it is null");
  FAILS(mediant_index_paths(made.index, NULL, 3, 1, NULL, (mediant_batch *)memory), wrong, "ends: it is null");

  // A call without a place for its result does no work, and writes nothing.
  FAILS(mediant_planner_path(planner, start, goal, NULL, 4, &count, &length), wrong, "points: it is null");
  FAILS(mediant_planner_path(planner, start, goal, NULL, 0, NULL, &length), wrong, "count: it is null");
  FAILS(mediant_planner_path(planner, start, goal, NULL, 0, &count, NULL), wrong, "length: it is null");
  FAILS(mediant_planner_path(planner, start, goal, ODD(mediant_point, memory), 1, &count, &length), wrong,
        "points: it is not aligned");
  IS(count == 77 && length == 77);
  FAILS(mediant_planner_find(planner, &start, 1, &goal, 1, NULL, NULL, NULL), wrong, "answer: it is null");
  FAILS(mediant_planner_find(planner, &start, SIZE_MAX, &goal, 1, NULL, NULL, &answer), wrong,
        "starts: it has more elements");
  FAILS(mediant_planner_find_except(planner, &start, 1, &goal, 1, NULL, NULL, NULL, &answer), wrong,
        "exceptions: it is null");
  mediant_exceptions except = {NULL, 1, NULL, 0, 0};
  FAILS(mediant_planner_find_except(planner, &start, 1, &goal, 1, &except, NULL, NULL, &answer), wrong,
        "blocked: it is null");
  FAILS(mediant_planner_step(planner, 1, NULL, &answer), wrong, "done: it is null");
  FAILS(mediant_planner_searched_by(planner, NULL), wrong, "engine: it is null");
  FAILS(mediant_moves(3, NULL, 4, &count), wrong, "moves: it is null");
  FAILS(mediant_bound(NULL, NULL), wrong, "bound: it is null");
  drop(made);
}

// Arrays that are too small have as much as there is room for; nothing beyond is written.
void test_rooms(void) {
  struct made made = make(RING, NULL, NULL);
  mediant_point points[3] = {{0, 0}, {77, 77}, {88, 88}};
  size_t count = 0;
  double length = 0;
  OK(mediant_planner_path(made.planner, at(0, 0), at(5, 4), points, 1, &count, &length));
  IS(count == 3 && same(points[0], at(0, 0)) && same(points[1], at(77, 77)));
  NEAR(length, 9);
  OK(mediant_planner_points(made.planner, points, 2, &count));
  IS(count == 3 && points[1].x != 77 && same(points[2], at(88, 88)));
  OK(mediant_planner_points(made.planner, points, 3, &count));
  IS(same(points[2], at(5, 4)));
  OK(mediant_planner_path(made.planner, at(0, 0), at(5, 4), NULL, 0, &count, &length));
  IS(count == 3);

  char text[8];
  memset(text, 'x', sizeof text);
  OK(mediant_index_setup(made.index, text, 4, &count));
  IS(count > 4 && strlen(text) == 3 && text[4] == 'x');
  OK(mediant_index_setup(made.index, text, 1, &count));
  IS(text[0] == '\0' && text[4] == 'x');
  OK(mediant_index_setup(made.index, NULL, 0, &count));
  IS(count > 4);

  uint8_t cells[4] = {9, 9, 9, 9};
  OK(mediant_map_cells(made.map, cells, 3));
  IS(cells[2] == 0 && cells[3] == 9);
  OK(mediant_map_cells(made.map, NULL, 0));
  // More room than values: the rest stays.
  double distances[40];
  distances[30] = 77;
  OK(mediant_map_clearance(made.map, distances, 40));
  IS(distances[30] == 77 && distances[29] == 0.5);
  drop(made);
}

void test_words(void) {
  mediant_map map;
  mediant_space space;
  OK(mediant_map_parse(RING, &map));
  OK(mediant_space_new(map, "", &space));
  OK(mediant_space_free(space));
  FAILS(mediant_space_new(map, "k=99", &space), MEDIANT_CODE_MOTION, "99");
  FAILS(mediant_space_new(map, "k=many", &space), MEDIANT_CODE_ARGUMENT, "many");
  FAILS(mediant_space_new(map, "k", &space), MEDIANT_CODE_ARGUMENT, "k");
  FAILS(mediant_space_new(map, "kk=3", &space), MEDIANT_CODE_ARGUMENT,
        "motion: no parameter 'kk' is known; the parameters are k, neighbors, placement, corners, gap");
  FAILS(mediant_space_new(map, "nearest", &space), MEDIANT_CODE_ARGUMENT, "nearest");
  FAILS(mediant_space_new(map, "gap=wide", &space), MEDIANT_CODE_UNKNOWN_NAME, "wide");
  FAILS(mediant_space_new(map, "\xff\xfe", &space), MEDIANT_CODE_ARGUMENT, "motion: it is not UTF-8");
  FAILS(mediant_map_open("\xff", &map), MEDIANT_CODE_ARGUMENT, "path: it is not UTF-8");
  // A sentence that is longer than there is room for ends between letters.
  static char word[8001];
  for (size_t at = 0; at + 2 < sizeof word; at += 2) {
    memcpy(word + at, "\xc3\xa4", 2);
  }
  FAILS(mediant_space_new(map, word, &space), MEDIANT_CODE_ARGUMENT, "motion: ");
  size_t length = strlen(mediant_message());
  IS(length > 1000 && length < 1024);
  OK(mediant_map_free(map));
}
