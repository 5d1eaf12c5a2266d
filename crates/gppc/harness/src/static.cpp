// gppc-classic and gppc-any-angle: run an entry of C++ that is linked into the program. Which track it is
// says the folder in which Entry.h is found, and GPPC_ANY_ANGLE.
#include "Entry.h"
#include "generate.h"
#include "judge.h"
#include "options.h"
#include "report.h"
#include "scenario.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

using namespace harness;

namespace {

#ifdef GPPC_ANY_ANGLE
constexpr Track TRACK = Track::any_angle;
constexpr const char *PROGRAM = "gppc-any-angle";
// Larger ones take a plain search too long.
constexpr int SIDE = 28;
#else
constexpr Track TRACK = Track::classic;
constexpr const char *PROGRAM = "gppc-classic";
constexpr int SIDE = 120;
#endif

// A call that goes on for ever is one that says so often that it is not done.
constexpr int MOST_CALLS = 1000000;

xyLoc location(Cell at) {
  xyLoc location{};
  location.x = static_cast<decltype(location.x)>(at.x);
  location.y = static_cast<decltype(location.y)>(at.y);
  return location;
}

double length_of(const std::vector<xyLoc> &path) {
  double length = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    length += std::hypot(static_cast<double>(path[i].x - path[i - 1].x),
                         static_cast<double>(path[i].y - path[i - 1].y));
  }
  return length;
}

std::vector<bool> bits_of(const Timeline &timeline) {
  Replay replay(timeline);
  std::vector<bool> bits(replay.map().cells());
  for (std::size_t i = 0; i < bits.size(); ++i) {
    bits[i] = replay.map().bit(i);
  }
  return bits;
}

Answer ask(void *data, const Query &query, std::vector<xyLoc> &path) {
  Answer answer;
  Charge charge;
  path.clear();
  bool done = false;
  for (int calls = 0; !done; ++calls) {
    std::int64_t time =
        timed([&] { done = GetPath(data, location(query.start), location(query.goal), path); });
    charge.call(time, length_of(path));
    if (calls == MOST_CALLS) {
      answer.complaint = "it is never done";
      break;
    }
  }
  for (const xyLoc &at : path) {
    answer.points.push_back({static_cast<double>(at.x), static_cast<double>(at.y)});
  }
  answer.times = charge.finish(!path.empty());
  return answer;
}

void run(const Options &options, const Timeline &timeline, Report &report) {
  const std::vector<bool> bits = bits_of(timeline);
  Task task;
  task.prepare = [&](const std::string &index) {
    PreprocessMap(bits, timeline.width, timeline.height, index);
  };
  task.answer = [&](const std::string &index, Answers &answers) {
    std::int64_t before = memory_now();
    void *data = nullptr;
    answers.name = GetName();
    answers.init = timed([&] { data = PrepareForSearch(bits, timeline.width, timeline.height, index); });
    std::vector<xyLoc> path;
    for (const Query &query : timeline.queries) {
      answers.answers.push_back(ask(data, query, path));
    }
    answers.kilobytes = memory_at_most() - before;
  };
  Answers answers = run_task(task, options.seconds);
  report.add(timeline, answers, judge(TRACK, options.reference, timeline, answers));
}

// Lengths of any-angle paths are in tables of their own; those of scenario files are over eight directions.
void state(const Options &options, Timeline &timeline) {
  if (TRACK == Track::any_angle) {
    forget_stated(timeline);
  }
  if (options.costs.empty()) {
    return;
  }
  std::string table = options.costs;
  if (std::filesystem::is_directory(table)) {
    table += "/any-closed-" + timeline.name + ".csv";
    if (!std::filesystem::exists(table)) {
      return;
    }
  }
  state_from(table, timeline);
}

int run_all(const Options &options) {
  if (options.files.empty() && options.generated == 0) {
    std::fprintf(
        stderr,
        "usage: %s [SCENARIO...] [--every N] [--costs TABLES] [--generated N] [--seed S] [--side N]\n"
        "       [--reference] [--processor] [--csv FILE] [--seconds N]\n",
        PROGRAM);
    return 2;
  }
  timing_clock = options.processor ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC;
  Report report(options.csv);
  for (const std::string &file : options.files) {
    Timeline timeline = read_static(file);
    state(options, timeline);
    keep_every(options.every, timeline);
    run(options, timeline, report);
  }
  int side = options.side > 0 ? static_cast<int>(options.side) : SIDE;
  for (std::size_t i = 0; i < options.generated; ++i) {
    Timeline timeline = generate_static(options.seed, i, side, TRACK == Track::any_angle);
    state_lengths(TRACK, timeline);
    run(options, timeline, report);
  }
  return report.print();
}

} // namespace

int main(int count, char **words) {
  try {
    return run_all(read_options(count, words));
  } catch (const std::exception &error) {
    std::fprintf(stderr, "%s: %s\n", PROGRAM, error.what());
    return 2;
  }
}
