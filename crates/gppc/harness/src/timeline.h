// Queries, with the changes of the map that come before each. A map that never changes is one patch before
// the first query.
#ifndef GPPC_HARNESS_TIMELINE_H
#define GPPC_HARNESS_TIMELINE_H

#include "map.h"

#include <cstddef>
#include <string>
#include <vector>

namespace harness {

// A patch, and where its first cell goes.
struct Placed {
  std::size_t patch = 0;
  Cell at;
};

// The length of a shortest path as a file states it.
struct Stated {
  bool known = false;
  // No path leads there.
  bool none = false;
  // A path leads there, even if its length is not known.
  bool some = false;
  long double length = 0;
  // How far off it may be, since it is rounded.
  long double tolerance = 0;
};

struct Query {
  // Its number in the file.
  std::size_t number = 0;
  std::vector<Placed> changes;
  Cell start;
  Cell goal;
  Stated stated;
};

struct Timeline {
  // The file, or the kind of a generated timeline: one row of the table.
  std::string name;
  // Which one of that name, for messages.
  std::string which;
  int width = 0;
  int height = 0;
  std::vector<Map> patches;
  std::vector<Query> queries;
};

// The map of a timeline as it is at a query.
class Replay {
public:
  // The map is all free, but for the changes before the first query.
  explicit Replay(const Timeline &timeline)
      : timeline_(timeline), map_(timeline.width, timeline.height, true) {
    if (!timeline.queries.empty()) {
      apply(timeline.queries.front());
    }
  }
  void apply(const Query &query) {
    for (const Placed &placed : query.changes) {
      map_.put(timeline_.patches[placed.patch], placed.at);
    }
  }
  const Map &map() const { return map_; }

private:
  const Timeline &timeline_;
  Map map_;
};

} // namespace harness

#endif
