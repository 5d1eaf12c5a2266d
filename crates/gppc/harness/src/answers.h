// The answers of an entry, and the process of its own in which it gives them: it can neither stop nor spoil
// the harness, and what one run leaves behind is not there in the next.
#ifndef GPPC_HARNESS_ANSWERS_H
#define GPPC_HARNESS_ANSWERS_H

#include "charge.h"
#include "check_points.h"

#include <functional>
#include <string>
#include <vector>

namespace harness {

struct Answer {
  Times times;
  // Against the rules of the interface; empty if it kept them.
  std::string complaint;
  std::vector<Point> points;
};

struct Answers {
  std::string name;
  // Of the init function.
  std::int64_t init = 0;
  // Of the preparing process.
  std::int64_t prepare = 0;
  // How much more memory than before its init the answering process held, at most.
  std::int64_t kilobytes = 0;
  // In all files that preparing left.
  std::int64_t index_bytes = 0;
  // Why there are no answers; empty if there are.
  std::string failure;
  std::vector<Answer> answers;
};

// An entry of any track on one map: to prepare, and to answer everything in order.
struct Task {
  std::function<void(const std::string &index)> prepare;
  std::function<void(const std::string &index, Answers &answers)> answer;
};

// Runs both parts of a task, each in a process of its own that is stopped after some seconds.
Answers run_task(const Task &task, unsigned seconds);

// How much memory this process holds, and held at most, in kilobytes.
std::int64_t memory_now();
std::int64_t memory_at_most();

} // namespace harness

#endif
