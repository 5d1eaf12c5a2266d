// The entry of the classic track, or with ANY_ANGLE that of the any-angle track, as a harness calls it:
//   entries FOLDER [MAPS [SEED]]    a folder for its files
// On so many small random maps it has the shortest path between any two cells, with its index and without
// one, by a search that shares nothing with it. It refuses indexes that are not the map's.
#include "Entry.h"

#include <sys/wait.h>
#include <unistd.h>

#include <mediant.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <sstream>

namespace {

constexpr double NONE = std::numeric_limits<double>::infinity();
unsigned seed = 41;

struct grid {
  int width, height;
  std::vector<bool> free;

  bool is_free(int x, int y) const {
    return x >= 0 && y >= 0 && x < width && y < height && free[static_cast<std::size_t>(y * width + x)];
  }
};

std::string text(const grid &map) {
  std::string rows;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      rows += map.is_free(x, y) ? '.' : '@';
    }
    rows += '\n';
  }
  return rows;
}

// Ends the test.
[[noreturn]] void fail(const std::string &what) {
  std::fprintf(stderr, "seed %u: %s\n", seed, what.c_str());
  std::exit(1);
}

struct place {
  int x, y;
};

#ifdef ANY_ANGLE

// Whether two blocked cells meet at a vertex, and nothing else is blocked there.
bool is_gap(const grid &map, int x, int y) {
  bool a = map.is_free(x - 1, y - 1), b = map.is_free(x, y - 1), c = map.is_free(x - 1, y),
       d = map.is_free(x, y);
  return a == d && b == c && a != b;
}

// Which side of the line from a to b a vertex is on.
int side(place a, place b, int x, int y) {
  int turn = (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
  return (turn > 0) - (turn < 0);
}

// Whether the straight segment between two vertices is legal, by all cells and vertices of the map.
bool is_legal(const grid &map, place a, place b) {
  for (int y = -1; y <= map.height; ++y) {
    for (int x = -1; x <= map.width; ++x) {
      int sides[4] = {side(a, b, x, y), side(a, b, x + 1, y), side(a, b, x, y + 1), side(a, b, x + 1, y + 1)};
      auto [least, most] = std::minmax_element(std::begin(sides), std::end(sides));
      bool in_columns = x >= std::min(a.x, b.x) && x < std::max(a.x, b.x);
      bool in_rows = y >= std::min(a.y, b.y) && y < std::max(a.y, b.y);
      // Through a cell.
      if (*least < 0 && *most > 0 && in_columns && in_rows && !map.is_free(x, y)) {
        return false;
      }
      // Along the edge above a cell, or to its left, with both sides blocked.
      bool above = a.y == b.y && a.y == y && in_columns && !map.is_free(x, y) && !map.is_free(x, y - 1);
      bool left = a.x == b.x && a.x == x && in_rows && !map.is_free(x, y) && !map.is_free(x - 1, y);
      // Through a gap.
      bool between = side(a, b, x, y) == 0 && x >= std::min(a.x, b.x) && x <= std::max(a.x, b.x) &&
                     y >= std::min(a.y, b.y) && y <= std::max(a.y, b.y) && !(x == a.x && y == a.y) &&
                     !(x == b.x && y == b.y);
      if (above || left || (between && is_gap(map, x, y))) {
        return false;
      }
    }
  }
  return true;
}

// Whether a path may start or end at a vertex with its next point there.
bool is_legal_end(const grid &map, place end, place next) {
  return !is_gap(map, end.x, end.y) || (next.x >= end.x && next.y >= end.y);
}

// The vertices: those of a map with a row and a column more than it has cells.
int columns(const grid &map) { return map.width + 1; }
int rows(const grid &map) { return map.height + 1; }

// The length of a step between two places of a path from start to goal; none if it is not legal. Within a
// free quadrant of a gap no shortest path bends.
double step(const grid &map, place a, place b, place start, place goal) {
  auto is = [](place one, place other) { return one.x == other.x && one.y == other.y; };
  bool legal = is_legal(map, a, b);
  legal = legal && (is(a, start) ? is_legal_end(map, a, b) : !is_gap(map, a.x, a.y));
  legal = legal && (is(b, goal) ? is_legal_end(map, b, a) : !is_gap(map, b.x, b.y));
  return legal ? std::hypot(a.x - b.x, a.y - b.y) : NONE;
}

#else

int columns(const grid &map) { return map.width; }
int rows(const grid &map) { return map.height; }

// The length of a straight or diagonal run of cells; none for others, and for a run that is not legal.
double step(const grid &map, place a, place b, place, place) {
  int dx = (b.x > a.x) - (b.x < a.x), dy = (b.y > a.y) - (b.y < a.y);
  int length = std::max(std::abs(b.x - a.x), std::abs(b.y - a.y));
  if (b.x - a.x != dx * length || b.y - a.y != dy * length || !map.is_free(b.x, b.y)) {
    return NONE;
  }
  for (int i = 0; i < length; ++i) {
    int x = a.x + i * dx, y = a.y + i * dy;
    if (!map.is_free(x, y) || !map.is_free(x + dx, y) || !map.is_free(x, y + dy)) {
      return NONE;
    }
  }
  return length * std::hypot(dx, dy);
}

#endif

// The shortest steps from a place to all others, by Dijkstra's algorithm over all pairs of places.
std::vector<double> shortest(const grid &map, place start) {
  int count = columns(map) * rows(map);
  auto at = [&](int number) { return place{number % columns(map), number / columns(map)}; };
  auto size = static_cast<std::size_t>(count);
  std::vector<double> passing(size, NONE), ending(size, NONE);
  std::vector<bool> done(size);
  int first = start.y * columns(map) + start.x;
  passing[static_cast<std::size_t>(first)] = ending[static_cast<std::size_t>(first)] = 0;
  for (;;) {
    int nearest = -1;
    for (int i = 0; i < count; ++i) {
      auto known = static_cast<std::size_t>(i);
      if (!done[known] && passing[known] < NONE &&
          (nearest < 0 || passing[known] < passing[static_cast<std::size_t>(nearest)])) {
        nearest = i;
      }
    }
    if (nearest < 0) {
      return ending;
    }
    auto from = static_cast<std::size_t>(nearest);
    done[from] = true;
    for (int i = 0; i < count; ++i) {
      auto to = static_cast<std::size_t>(i);
      // No place is (-1, -1): a step on which the path goes on, and one with which it ends.
      passing[to] = std::min(passing[to], passing[from] + step(map, at(nearest), at(i), start, {-1, -1}));
      ending[to] = std::min(ending[to], passing[from] + step(map, at(nearest), at(i), start, at(i)));
    }
  }
}

// Checks a path, and that it is as long as it must be.
void check(const grid &map, const std::vector<xyLoc> &path, place start, place goal, double known) {
  std::ostringstream shown;
  shown << text(map) << "(" << start.x << ", " << start.y << ") to (" << goal.x << ", " << goal.y << "):";
  std::vector<place> places;
  for (auto [x, y] : path) {
    shown << " (" << x << ", " << y << ")";
    places.push_back({static_cast<int>(x), static_cast<int>(y)});
    if (places.back().x != x || places.back().y != y) {
      fail(shown.str() + ": it bends between vertices");
    }
  }
  bool is_same = start.x == goal.x && start.y == goal.y;
  if (is_same || known == NONE) {
    if (!path.empty()) {
      fail(shown.str() + ": the path must be empty");
    }
    return;
  }
  auto is = [](place one, place other) { return one.x == other.x && one.y == other.y; };
  if (places.size() < 2 || !is(places.front(), start) || !is(places.back(), goal)) {
    fail(shown.str() + ": it does not lead from start to goal");
  }
  double length = 0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    double leg = step(map, places[i - 1], places[i], start, goal);
    if (leg < 0.01) {
      fail(shown.str() + ": a segment that is too short");
    }
    length += leg;
  }
  if (!(std::abs(length - known) < 1e-9)) {
    fail(shown.str() + ": it is " + std::to_string(length) + " long, the shortest is " +
         std::to_string(known));
  }
}

// All paths of a map, by the index in a file, and without one.
std::size_t check_all(const grid &map, const std::string &file) {
  std::size_t paths = 0;
  PreprocessMap(map.free, map.width, map.height, file);
  void *searches[] = {PrepareForSearch(map.free, map.width, map.height, file),
                      PrepareForSearch(map.free, map.width, map.height, file + "-that-is-not-there")};
  std::vector<xyLoc> path;
  for (int start = 0; start < map.width * map.height; ++start) {
    place from{start % map.width, start / map.width};
    if (!map.is_free(from.x, from.y)) {
      continue;
    }
    std::vector<double> known = shortest(map, from);
    for (int goal = 0; goal < map.width * map.height; ++goal) {
      place to{goal % map.width, goal / map.width};
      // Lists of queries for cells name blocked ends, too. At any angle a corner of a blocked cell is an end
      // as good as any, for which nobody asks.
      bool is_free = map.is_free(to.x, to.y);
      if (!is_free && columns(map) > map.width) {
        continue;
      }
      for (void *search : searches) {
        xyLoc s, g;
        s.x = static_cast<decltype(s.x)>(from.x), s.y = static_cast<decltype(s.y)>(from.y);
        g.x = static_cast<decltype(g.x)>(to.x), g.y = static_cast<decltype(g.y)>(to.y);
        if (!GetPath(search, s, g, path)) {
          fail("a path in pieces");
        }
        double length = known[static_cast<std::size_t>(to.y * columns(map) + to.x)];
        check(map, path, from, to, is_free ? length : NONE);
        ++paths;
      }
    }
  }
  return paths;
}

std::string bytes_of(const std::string &file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Whether loading what is in a file ends the program, and with which words.
std::string refused(const grid &map, const std::string &file) {
  std::string said = file + ".said";
  pid_t child = fork();
  if (child == 0) {
    if (!std::freopen(said.c_str(), "w", stderr)) {
      _exit(2);
    }
    PrepareForSearch(map.free, map.width, map.height, file);
    _exit(0);
  }
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 1) {
    fail("an index that is not the map's was taken");
  }
  return bytes_of(said);
}

void expect(const std::string &said, std::initializer_list<const char *> parts) {
  for (const char *part : parts) {
    if (said.find(part) == std::string::npos) {
      fail("`" + std::string(part) + "` is missing in: " + said);
    }
  }
}

// Writes an index of the map, for the rules of the other track.
void save_for_other_rules(const grid &map, const std::string &file) {
#ifdef ANY_ANGLE
  const char *rules = "k=3 corners=never";
#else
  const char *rules = "k=any gap=closed";
#endif
  mediant::Space space(mediant::Map::parse(text(map)), rules);
  mediant::Index::prepare(space, "engine=subgoal").save(file);
}

void refuses_others(const grid &map, const std::string &folder) {
  std::string file = folder + "/index";
  PreprocessMap(map.free, map.width, map.height, file);
  std::string index = bytes_of(file);
  auto with = [&](std::string bytes) { std::ofstream(file, std::ios::binary) << bytes; };
  // Behind the first eight bytes of a saved index is the version of its format.
  std::string older = index;
  older[8] = 1;
  with(older);
  expect(refused(map, file), {"version 2", "found version 1", "./run -pre", "Mediant 0."});
  std::string damaged = index;
  damaged[index.size() / 2] ^= 1;
  with(damaged);
  expect(refused(map, file), {"./run -pre"});
  with(index.substr(0, index.size() / 2));
  expect(refused(map, file), {"./run -pre"});
  with("");
  expect(refused(map, file), {"./run -pre"});
  with(index);
  grid other = map;
  other.free[0] = !other.free[0];
  expect(refused(other, file), {"./run -pre"});
  // What was refused above was not refused for nothing.
  PrepareForSearch(map.free, map.width, map.height, file);
  save_for_other_rules(map, file);
  expect(refused(map, file), {"expected an index for k=", "./run -pre"});
}

} // namespace

int main(int count, char **arguments) {
  if (count < 2) {
    std::fprintf(stderr, "usage: %s FOLDER [MAPS [SEED]]\n", arguments[0]);
    return 2;
  }
  std::string folder = arguments[1];
  int maps = count > 2 ? std::atoi(arguments[2]) : 100;
  seed = count > 3 ? static_cast<unsigned>(std::atoi(arguments[3])) : seed;
  std::mt19937 random(seed);
  std::size_t paths = 0;
  for (int i = 0; i < maps; ++i) {
    grid map{static_cast<int>(1 + random() % 6), static_cast<int>(1 + random() % 5), {}};
    auto blocked = random() % 60;
    for (int cell = 0; cell < map.width * map.height; ++cell) {
      map.free.push_back(random() % 100 >= blocked);
    }
    paths += check_all(map, folder + "/" + GetName() + "-map");
  }
  refuses_others({4, 3, std::vector<bool>(12, true)}, folder);
  std::printf("%zu paths on %d maps are the shortest\n", paths, maps);
  return paths == 0;
}
