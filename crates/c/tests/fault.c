// A fault in the library, a panic of Rust, is an error of the call in which it is; the program goes on.
//
// The library has no fault that a test could count on. So the clock fails here, which Rust takes for a fault:
// this program has a clock of its own, and the library takes it, since a program's functions come first.
#define _GNU_SOURCE
#include "check.h"

#include <errno.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

static int is_broken = 0;

int clock_gettime(clockid_t clock, struct timespec *time) {
  if (is_broken) {
    errno = EINVAL;
    return -1;
  }
  return (int)syscall(SYS_clock_gettime, clock, time);
}

int main(void) {
  struct made made = make(RING, NULL, NULL);
  mediant_point start = at(0, 0), goal = at(5, 4);
  mediant_answer answer;
  for (int times = 0; times < 3; times++) {
    is_broken = 0;
    OK(mediant_planner_find(made.planner, &start, 1, &goal, 1, "timeout=60000", NULL, &answer));
    NEAR(answer.distance, 9);
    is_broken = 1;
    FAILS(mediant_planner_find(made.planner, &start, 1, &goal, 1, "timeout=60000", NULL, &answer),
          MEDIANT_CODE_OTHER, "a fault in the library");
  }
  // What was made before is whole.
  drop(made);
  IS(mediant_objects() == 0);
  puts("fault.c: all is as it should be");
  return 0;
}
