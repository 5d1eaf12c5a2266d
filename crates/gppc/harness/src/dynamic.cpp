// gppc-dynamic: runs an entry of the dynamic track.
#include "generate.h"
#include "judge.h"
#include "load.h"
#include "options.h"
#include "report.h"
#include "scenario.h"

#include <cmath>
#include <cstdio>
#include <stdexcept>

using namespace harness;

namespace {

// The longest side of generated maps.
constexpr int SIDE = 160;

gppc_point point_of(Cell at) {
  return {static_cast<std::uint16_t>(at.x), static_cast<std::uint16_t>(at.y)};
}

gppc_patch patch_of(const Map &map, Cell at) {
  return {map.bytes(), static_cast<std::uint16_t>(map.width()), static_cast<std::uint16_t>(map.height()),
          point_of(at)};
}

// An answer from the pieces in which an entry tells it.
class Pieces {
public:
  explicit Pieces(const Map &map) : most_(4 * map.cells() + 16) {}

  // Returns whether the harness asks again.
  bool add(const gppc_path &piece, std::int64_t time) {
    if (piece.length > 0 && piece.path == nullptr) {
      answer_.complaint = "points without an address";
    } else if (piece.length == 0 && piece.incomplete != 0) {
      answer_.complaint = "an incomplete path without points";
    } else if (piece.length == 0) {
      // There is no path after all, whatever was told.
      answer_.points.clear();
      length_ = 0;
    }
    if (answer_.complaint.empty()) {
      for (std::uint32_t i = 0; i < piece.length; ++i) {
        add_point({static_cast<double>(piece.path[i].x), static_cast<double>(piece.path[i].y)});
      }
    }
    charge.call(time, length_);
    return answer_.complaint.empty() && piece.incomplete != 0 && has_room();
  }
  Answer finish() {
    answer_.times = charge.finish(!answer_.points.empty());
    return answer_;
  }

  Charge charge;

private:
  void add_point(Point at) {
    if (!answer_.points.empty()) {
      length_ += std::hypot(at.x - answer_.points.back().x, at.y - answer_.points.back().y);
    }
    answer_.points.push_back(at);
  }
  // A path that never ends has more points than a longest path through all cells.
  bool has_room() {
    if (answer_.points.size() > most_) {
      answer_.complaint = "a path that does not end";
    }
    return answer_.complaint.empty();
  }

  Answer answer_;
  double length_ = 0;
  std::size_t most_;
};

void tell_changes(const Library &library, void *data, const Timeline &timeline, const Query &query,
                  Charge &charge) {
  std::vector<gppc_patch> patches;
  for (const Placed &placed : query.changes) {
    patches.push_back(patch_of(timeline.patches[placed.patch], placed.at));
  }
  auto count = static_cast<std::uint32_t>(patches.size());
  charge.change(timed([&] { library.change(data, patches.data(), count); }));
}

// One cold pass over all queries. The map has changes before the entry is told of them.
void answer(const Library &library, const Timeline &timeline, const std::string &index, Answers &answers) {
  Replay replay(timeline);
  std::int64_t before = memory_now();
  void *data = nullptr;
  answers.name = library.name();
  answers.init = timed([&] { data = library.init(patch_of(replay.map(), {0, 0}), index.c_str()); });
  for (std::size_t i = 0; i < timeline.queries.size(); ++i) {
    const Query &query = timeline.queries[i];
    Pieces pieces(replay.map());
    if (i > 0 && !query.changes.empty()) {
      replay.apply(query);
      tell_changes(library, data, timeline, query, pieces.charge);
    }
    gppc_path piece{};
    std::int64_t time = 0;
    do {
      time = timed([&] { piece = library.path(data, point_of(query.start), point_of(query.goal)); });
    } while (pieces.add(piece, time));
    answers.answers.push_back(pieces.finish());
  }
  answers.kilobytes = memory_at_most() - before;
  library.free(data);
}

// The library is loaded anew in each process, as the competition does.
void run(const std::string &file, const Options &options, const Timeline &timeline, Report &report) {
  Task task;
  task.prepare = [&](const std::string &index) {
    Replay replay(timeline);
    Library(file).preprocess(patch_of(replay.map(), {0, 0}), index.c_str());
  };
  task.answer = [&](const std::string &index, Answers &answers) {
    answer(Library(file), timeline, index, answers);
  };
  Answers answers = run_task(task, options.seconds);
  report.add(timeline, answers, judge(Track::dynamic, options.reference, timeline, answers));
}

int run_all(const Options &options) {
  if (options.files.empty()) {
    std::fputs(
        "usage: gppc-dynamic LIBRARY [SCENARIO...] [--timelines N] [--seed S] [--side N] [--write FOLDER]\n"
        "                    [--reference] [--processor] [--csv FILE] [--tags KINDS] [--seconds N]\n",
        stderr);
    return 2;
  }
  const std::string &library = options.files[0];
  Library loaded(library);
  if (loaded.tags != nullptr && loaded.tags(options.tags) == 0) {
    std::printf("%s takes no part in scenarios of the kinds %d\n", loaded.name(), options.tags);
    return 0;
  }
  timing_clock = options.processor ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC;
  Report report(options.csv);
  for (std::size_t i = 1; i < options.files.size(); ++i) {
    run(library, options, read_dynamic(options.files[i]), report);
  }
  for (std::size_t i = 0; i < options.generated; ++i) {
    Timeline timeline =
        generate_timeline(options.seed, i, options.side > 0 ? static_cast<int>(options.side) : SIDE);
    state_lengths(Track::dynamic, timeline);
    if (!options.write.empty()) {
      write_dynamic(options.write + "/" + timeline.name + "-" + std::to_string(i), timeline);
    }
    run(library, options, timeline, report);
  }
  return report.print();
}

} // namespace

int main(int count, char **words) {
  try {
    return run_all(read_options(count, words));
  } catch (const std::exception &error) {
    std::fprintf(stderr, "gppc-dynamic: %s\n", error.what());
    return 2;
  }
}
