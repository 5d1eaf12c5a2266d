#include "judge.h"
#include "check_cells.h"
#include "reference.h"

#include <cmath>

namespace harness {

namespace {

// A shortest length: an exact one if it is of a search over cells.
struct Shortest {
  bool known = false;
  bool none = false;
  // There is a path.
  bool some = false;
  bool exact = false;
  Octile cells;
  long double length = 0;
  long double tolerance = 0;
};

Shortest stated(const Stated &stated) {
  Shortest shortest;
  shortest.known = stated.known;
  shortest.none = stated.known && stated.none;
  shortest.some = stated.some || (stated.known && !stated.none);
  shortest.length = stated.length;
  shortest.tolerance = stated.tolerance;
  return shortest;
}

Shortest searched(Track track, const Map &map, const Query &query) {
  Shortest shortest;
  shortest.known = true;
  if (track == Track::any_angle) {
    auto length = shortest_by_points(map, query.start, query.goal);
    shortest.none = !length;
    shortest.length = length.value_or(-1);
    shortest.tolerance = 1e-12L * (1 + std::fabs(shortest.length));
  } else {
    auto length = shortest_by_cells(map, query.start, query.goal);
    shortest.none = !length;
    shortest.exact = true;
    shortest.cells = length.value_or(Octile());
    shortest.length = length ? length->length() : -1;
  }
  shortest.some = !shortest.none;
  return shortest;
}

bool differs(const Stated &stated, const Shortest &shortest) {
  return stated.known && (stated.none != shortest.none ||
                          (!stated.none && std::fabs(stated.length - shortest.length) > stated.tolerance));
}

// The cells of an answer. Points that are none become one outside all maps.
std::vector<Cell> cells_of(const std::vector<Point> &points) {
  std::vector<Cell> cells;
  for (Point point : points) {
    bool is_cell = point.x == std::floor(point.x) && point.y == std::floor(point.y) &&
                   std::fabs(point.x) <= 1e6 && std::fabs(point.y) <= 1e6;
    cells.push_back(is_cell ? Cell{static_cast<int>(point.x), static_cast<int>(point.y)} : Cell{-1, -1});
  }
  return cells;
}

void compare(const Shortest &shortest, bool equal, Verdict &verdict) {
  verdict.unknown = !shortest.known;
  if (!shortest.known) {
    return;
  }
  verdict.optimal = equal && !shortest.none;
  if (shortest.none) {
    verdict.why = "a path is given, but there is none";
  } else if (!equal) {
    verdict.why = verdict.length > shortest.length ? "the path is not the shortest"
                                                   : "the path is shorter than the shortest length known";
  }
}

void judge_path(Track track, const Map &map, const Query &query, const Answer &answer,
                const Shortest &shortest, Verdict &verdict) {
  Octile cells;
  if (track == Track::any_angle) {
    CheckedPoints checked = check_points(map, query.start, query.goal, answer.points);
    verdict.why = checked.wrong;
    verdict.length = checked.length;
  } else {
    CheckedCells checked = check_cells(map, query.start, query.goal, cells_of(answer.points));
    verdict.why = checked.wrong;
    cells = checked.length;
    verdict.length = cells.length();
  }
  verdict.valid = verdict.why.empty();
  if (verdict.valid) {
    bool near = std::fabs(verdict.length - shortest.length) <= shortest.tolerance;
    compare(shortest, shortest.exact ? cells == shortest.cells : near, verdict);
  }
}

Verdict judge_by(Track track, const Map &map, const Query &query, const Answer &answer,
                 const Shortest &shortest) {
  Verdict verdict;
  verdict.shortest = !shortest.known || shortest.none ? -1 : shortest.length;
  verdict.misstated = differs(query.stated, shortest);
  if (!answer.complaint.empty()) {
    verdict.why = answer.complaint;
  } else if (!answer.points.empty()) {
    judge_path(track, map, query, answer, shortest, verdict);
  } else if (track != Track::dynamic && query.start == query.goal && map.free(query.start)) {
    // On the tracks whose map does not change, a path from an end to itself is empty.
    verdict.length = 0;
    verdict.valid = verdict.optimal = true;
  } else {
    // Without a length it can be told at any angle whether there is a path, whatever the file says of cells.
    bool is_asked = track == Track::any_angle && !shortest.known;
    bool some = is_asked ? joined_by_points(map, query.start, query.goal) : shortest.some;
    verdict.none = true;
    verdict.unknown = !is_asked && !shortest.known && !shortest.some;
    verdict.valid = verdict.optimal = is_asked ? !some : shortest.none;
    verdict.why = some ? "no path is given, but there is one" : "";
  }
  return verdict;
}

Verdict judge_one(Track track, bool search, const Map &map, const Query &query, const Answer &answer) {
  if (!search) {
    Verdict verdict = judge_by(track, map, query, answer, stated(query.stated));
    // Lengths of some files are of other maps, or of other rules.
    if (verdict.why.empty() || track == Track::any_angle) {
      return verdict;
    }
  }
  return judge_by(track, map, query, answer, searched(track, map, query));
}

} // namespace

std::vector<Verdict> judge(Track track, bool search_all, const Timeline &timeline, const Answers &answers) {
  std::vector<Verdict> verdicts;
  Replay replay(timeline);
  for (std::size_t i = 0; i < timeline.queries.size() && i < answers.answers.size(); ++i) {
    if (i > 0) {
      replay.apply(timeline.queries[i]);
    }
    verdicts.push_back(judge_one(track, search_all, replay.map(), timeline.queries[i], answers.answers[i]));
  }
  return verdicts;
}

void state_lengths(Track track, Timeline &timeline) {
  Replay replay(timeline);
  bool first = true;
  for (Query &query : timeline.queries) {
    if (!first) {
      replay.apply(query);
    }
    first = false;
    if (!query.stated.known) {
      Shortest shortest = searched(track, replay.map(), query);
      query.stated = {true, shortest.none, shortest.some, shortest.length,
                      1e-10L * (1 + std::fabs(shortest.length))};
    }
  }
}

} // namespace harness
