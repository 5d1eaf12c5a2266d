// Checks of the tests in C: each one that fails names its line, and ends the program.
#ifndef MEDIANT_CHECK_H
#define MEDIANT_CHECK_H

#include "../include/mediant.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// A condition holds.
#define IS(condition) \
  do { \
    if (!(condition)) { \
      fprintf(stderr, "%s:%d: %s\n  last message: %s\n", __FILE__, __LINE__, #condition, mediant_message()); \
      exit(1); \
    } \
  } while (0)

// A call does what it should.
#define OK(call) IS((call) == MEDIANT_CODE_OK)

// A number is another one, but for rounding.
#define NEAR(number, expected) \
  do { \
    double found_ = (number); \
    double wanted_ = (expected); \
    if (!(fabs(found_ - wanted_) < 1e-9)) { \
      fprintf(stderr, "%s:%d: %s is %.17g, not %.17g\n", __FILE__, __LINE__, #number, found_, wanted_); \
      exit(1); \
    } \
  } while (0)

// A call fails with a code and with a sentence that has a text in it.
#define FAILS(call, expected, text) \
  do { \
    mediant_code code_ = (call); \
    if (code_ != (expected) || strstr(mediant_message(), (text)) == NULL) { \
      fprintf(stderr, "%s:%d: %s is %d (%s), not %d (%s)\n", __FILE__, __LINE__, #call, (int)code_, \
              mediant_message(), (int)(expected), (text)); \
      exit(1); \
    } \
  } while (0)

// A text is another one.
#define SAME(text, expected) IS(strcmp((text), (expected)) == 0)

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

// Six cells by five, with a ring of walls around two free cells. Between centers, from (0, 0) to (5, 4), it
// is 9 along the outside; at any angle between corners, from (0, 0) to (6, 4), the path bends at (5, 1).
#define RING "......\n.@@@@.\n.@..@.\n.@@@@.\n......\n"

static inline mediant_point at(double x, double y) {
  mediant_point point = {x, y};
  return point;
}

static inline int same(mediant_point a, mediant_point b) {
  return a.x == b.x && a.y == b.y;
}

// A map, a space, an index and a planner on it.
struct made {
  mediant_map map;
  mediant_space space;
  mediant_index index;
  mediant_planner planner;
};

static inline struct made make(const char *rows, const char *motion, const char *engine) {
  struct made made;
  OK(mediant_map_parse(rows, &made.map));
  OK(mediant_space_new(made.map, motion, &made.space));
  OK(mediant_index_prepare(made.space, engine, NULL, &made.index));
  OK(mediant_planner_new(made.index, &made.planner));
  return made;
}

static inline void drop(struct made made) {
  OK(mediant_planner_free(made.planner));
  OK(mediant_index_free(made.index));
  OK(mediant_space_free(made.space));
  OK(mediant_map_free(made.map));
}

// Of queries.c.
void test_planner(void);
void test_wishes(void);
void test_exceptions(void);
void test_search(void);
void test_costs(void);
void test_points(void);
void test_points_anywhere(void);
void test_goals(void);
void test_batch(void);
void test_watcher(void);

// Of indexes.c.
void test_index(const char *folder);
void test_bytes(void);
void test_repair(void);

// Of misuse.c.
void test_handles(void);
void test_pointers(void);
void test_rooms(void);
void test_words(void);

#endif
