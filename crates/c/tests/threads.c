// Eight threads that share objects: every call is right, or says why not. Meant for ThreadSanitizer too.

#define _POSIX_C_SOURCE 200809L
#include "check.h"

#include <pthread.h>

enum { THREADS = 8, ROUNDS = 200 };

// What all threads use.
struct shared {
  mediant_map map;
  mediant_space space;
  mediant_index index;
  mediant_goals goals;
  // One that all of them try to use, from (0, 0) to (5, 4).
  mediant_planner planner;
  // By round, one that all of them try to free.
  mediant_map maps[ROUNDS];
  mediant_planner planners[ROUNDS];
  pthread_barrier_t barrier;
};

// A thread, and what it saw.
struct worker {
  struct shared *shared;
  int is_held;
  size_t number, answered, busy, freed_maps, freed_planners;
};

// The thread's own planner answers as if it were alone.
static void ask(const struct shared *shared, mediant_planner planner, size_t number) {
  mediant_point points[8];
  size_t count = 0, goal = 9;
  double length = 0, lengths[2];
  int32_t is = -1;
  OK(mediant_planner_path(planner, at(0, 0), at(6, 4), points, COUNT(points), &count, &length));
  IS(count == 3 && same(points[1], at(5, 1)));
  NEAR(length, sqrt(26) + sqrt(10));
  OK(mediant_planner_path(planner, at((double)number / 16, 0), at(0, 1), points, COUNT(points), &count, &length));
  NEAR(length, hypot((double)number / 16, 1));
  OK(mediant_planner_distances(planner, at(0, 0), shared->goals, lengths, 2, &count));
  NEAR(lengths[0], 5);
  OK(mediant_planner_nearest(planner, at(6, 4), shared->goals, &goal, &length));
  IS(goal == 1);
  NEAR(length, 1);
  OK(mediant_space_sees(shared->space, at(0, 0), at(5, 1), &is));
  IS(is == 1);
  // The message is the thread's own.
  double x = 1.25 + (double)number / 16;
  char text[40];
  snprintf(text, sizeof text, "(%g, 1.5)", x);
  FAILS(mediant_planner_distance(planner, at(x, 1.5), at(0, 0), &length), MEDIANT_CODE_START_BLOCKED, text);
}

// Objects of its own, made and freed among those of others.
static void make_and_free(const struct shared *shared, size_t number) {
  mediant_map map;
  mediant_bytes bytes;
  mediant_batch batch;
  mediant_paths paths;
  mediant_field field;
  uint32_t width = 0, height = 0;
  OK(mediant_map_new((uint32_t)number + 1, 2, NULL, &map));
  OK(mediant_index_to_bytes(shared->index, &bytes));
  OK(mediant_map_size(map, &width, &height));
  IS(width == number + 1 && height == 2);
  mediant_ends ends[] = {{{0, 0}, {6, 4}}, {{0, 0}, {0, (double)number / 2}}};
  OK(mediant_index_paths(shared->index, ends, COUNT(ends), 2, NULL, &batch));
  OK(mediant_batch_paths(batch, &paths));
  IS(paths.count == 2 && paths.lengths[1] == (double)number / 2);
  mediant_point source = {0, 0};
  double distance = 0;
  OK(mediant_field_new(shared->space, &source, 1, INFINITY, NULL, &field));
  OK(mediant_field_get(field, at(0, 3), &distance));
  NEAR(distance, 3);
  OK(mediant_field_free(field));
  OK(mediant_batch_free(batch));
  OK(mediant_bytes_free(bytes));
  OK(mediant_map_free(map));
  IS(mediant_map_free(map) == MEDIANT_CODE_HANDLE);
}

// The planner of all: one call at a time.
static void compete(struct worker *worker) {
  double length = 0;
  mediant_code code = mediant_planner_distance(worker->shared->planner, at(0, 0), at(5, 4), &length);
  if (code == MEDIANT_CODE_OK) {
    NEAR(length, 9);
    worker->answered++;
  } else {
    IS(code == MEDIANT_CODE_BUSY);
    worker->busy++;
  }
}

// Called in a search of the first thread: holds it until the others have tried to use its planner.
static int32_t hold(void *data) {
  struct worker *worker = data;
  if (!worker->is_held) {
    worker->is_held = 1;
    pthread_barrier_wait(&worker->shared->barrier);
    pthread_barrier_wait(&worker->shared->barrier);
  }
  return 0;
}

static void held(struct worker *worker) {
  mediant_planner planner = worker->shared->planner;
  if (worker->number == 0) {
    mediant_watcher watcher = {hold, NULL, worker};
    mediant_point start = {0, 0}, goal = {5, 4};
    mediant_answer answer;
    OK(mediant_planner_find(planner, &start, 1, &goal, 1, NULL, &watcher, &answer));
    IS(worker->is_held);
    NEAR(answer.distance, 9);
  } else {
    double length = 0;
    pthread_barrier_wait(&worker->shared->barrier);
    FAILS(mediant_planner_distance(planner, at(0, 0), at(5, 4), &length), MEDIANT_CODE_BUSY, "another call");
    FAILS(mediant_planner_free(planner), MEDIANT_CODE_BUSY, "another call");
    pthread_barrier_wait(&worker->shared->barrier);
  }
  pthread_barrier_wait(&worker->shared->barrier);
}

// All use and free the same map and planner at the same time; each is freed once.
static void free_same(struct worker *worker, size_t round) {
  mediant_map map = worker->shared->maps[round];
  mediant_planner planner = worker->shared->planners[round];
  uint32_t width = 0, height = 0;
  mediant_code code = mediant_map_size(map, &width, &height);
  IS(code == MEDIANT_CODE_OK ? width == 7 : code == MEDIANT_CODE_HANDLE);
  code = mediant_map_free(map);
  IS(code == MEDIANT_CODE_OK || code == MEDIANT_CODE_HANDLE);
  worker->freed_maps += code == MEDIANT_CODE_OK;
  double length = 0;
  code = mediant_planner_distance(planner, at(0, 0), at(0, 1), &length);
  IS(code == MEDIANT_CODE_OK || code == MEDIANT_CODE_HANDLE || code == MEDIANT_CODE_BUSY);
  do {
    code = mediant_planner_free(planner);
  } while (code == MEDIANT_CODE_BUSY);
  IS(code == MEDIANT_CODE_OK || code == MEDIANT_CODE_HANDLE);
  worker->freed_planners += code == MEDIANT_CODE_OK;
}

static void *work(void *data) {
  struct worker *worker = data;
  mediant_planner planner;
  OK(mediant_planner_new(worker->shared->index, &planner));
  held(worker);
  for (size_t round = 0; round < ROUNDS; round++) {
    ask(worker->shared, planner, worker->number);
    make_and_free(worker->shared, worker->number);
    compete(worker);
    pthread_barrier_wait(&worker->shared->barrier);
    free_same(worker, round);
  }
  OK(mediant_planner_free(planner));
  return NULL;
}

int main(void) {
  static struct shared shared;
  static struct worker workers[THREADS];
  struct made made = make(RING, "k=any gap=closed", "engine=subgoal");
  shared.map = made.map;
  shared.space = made.space;
  shared.index = made.index;
  struct made other = make(RING, NULL, "engine=dijkstra");
  shared.planner = other.planner;
  mediant_point goals[] = {{0, 5}, {6, 5}};
  OK(mediant_goals_new(made.index, goals, COUNT(goals), &shared.goals));
  for (size_t round = 0; round < ROUNDS; round++) {
    OK(mediant_map_new(7, 7, NULL, &shared.maps[round]));
    OK(mediant_planner_new(made.index, &shared.planners[round]));
  }
  IS(pthread_barrier_init(&shared.barrier, NULL, THREADS) == 0);
  pthread_t threads[THREADS];
  for (size_t number = 0; number < THREADS; number++) {
    workers[number] = (struct worker){.shared = &shared, .number = number};
    IS(pthread_create(&threads[number], NULL, work, &workers[number]) == 0);
  }
  size_t answered = 0, busy = 0, freed_maps = 0, freed_planners = 0;
  for (size_t number = 0; number < THREADS; number++) {
    IS(pthread_join(threads[number], NULL) == 0);
    answered += workers[number].answered;
    busy += workers[number].busy;
    freed_maps += workers[number].freed_maps;
    freed_planners += workers[number].freed_planners;
  }
  IS(answered > 0 && answered + busy == THREADS * ROUNDS);
  IS(freed_maps == ROUNDS && freed_planners == ROUNDS);
  IS(pthread_barrier_destroy(&shared.barrier) == 0);
  OK(mediant_goals_free(shared.goals));
  drop(made);
  drop(other);
  IS(mediant_objects() == 0);
  printf("threads.c: all is as it should be; the planner of all answered %zu times, and was busy %zu times\n",
         answered, busy);
  return 0;
}
