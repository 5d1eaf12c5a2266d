// As fault.c, in a program that throws exceptions of its own: before, between, while one is being handled, and
// out of a function that the library calls. The library's unwinder and that of C++ leave each other alone.

#include "../include/mediant.hpp"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <sys/syscall.h>
#include <thread>
#include <time.h>
#include <unistd.h>

#define IS(condition)                                                                                        \
  do {                                                                                                       \
    if (!(condition)) {                                                                                      \
      std::fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition);                                   \
      std::exit(1);                                                                                          \
    }                                                                                                        \
  } while (0)

namespace {

thread_local bool is_broken = false;

int find(mediant::Planner &planner) {
  try {
    auto answer = planner.find({{0, 0}}, {{5, 4}}, "timeout=60000");
    IS(answer.distance == 9);
    return 0;
  } catch (const mediant::error &error) {
    return error.code();
  }
}

// Throws, and finds while what it threw is handled.
void throw_and_find(mediant::Planner &planner, int depth) {
  try {
    if (depth == 0) {
      throw std::runtime_error("of the program");
    }
    throw_and_find(planner, depth - 1);
  } catch (const std::exception &) {
    is_broken = true;
    IS(find(planner) == MEDIANT_CODE_OTHER);
    is_broken = false;
    IS(find(planner) == 0);
    throw;
  }
}

void test(const mediant::Index &index, const mediant::Space &space) {
  mediant::Planner planner(index);
  for (int times = 0; times < 20; times++) {
    bool is_thrown = false;
    try {
      throw_and_find(planner, 4);
    } catch (const std::runtime_error &error) {
      is_thrown = std::string(error.what()) == "of the program";
    }
    IS(is_thrown);
    is_thrown = false;
    mediant::watcher watcher;
    watcher.stop = []() -> bool { throw std::logic_error("of a watcher"); };
    try {
      mediant::Index::prepare(space, "engine=subgoal", watcher);
    } catch (const std::logic_error &) {
      is_thrown = true;
    }
    IS(is_thrown);
  }
}

} // namespace

extern "C" int clock_gettime(clockid_t clock, struct timespec *time) noexcept {
  if (is_broken) {
    errno = EINVAL;
    return -1;
  }
  return static_cast<int>(syscall(SYS_clock_gettime, clock, time));
}

int main() {
  {
    auto map = mediant::Map::parse("......\n.@@@@.\n.@..@.\n.@@@@.\n......\n");
    mediant::Space space(map);
    auto index = mediant::Index::prepare(space);
    std::thread other([&] { test(index, space); });
    test(index, space);
    other.join();
  }
  IS(mediant::objects() == 0);
  std::puts("fault.cpp: all is as it should be");
}
