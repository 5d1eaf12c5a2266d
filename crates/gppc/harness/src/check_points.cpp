#include "check_points.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <numeric>

namespace harness {

namespace {

std::string text(double x, double y) {
  char text[80];
  std::snprintf(text, sizeof text, "(%.9g, %.9g)", x, y);
  return text;
}

std::string text(Point at) {
  return text(at.x, at.y);
}

bool is_corner(Point at) {
  return at.x == std::floor(at.x) && at.y == std::floor(at.y);
}

std::string through_cell(int x, int y) {
  return "it passes through the blocked cell " + text(x, y);
}

std::string through_corner(int x, int y) {
  return "it passes through the double corner " + text(x, y);
}

// ---- Between corners: integers

// A segment along a line between cells. (sx, sy) is its unit.
std::string along_edges(const Map &map, int x, int y, int sx, int sy, int count) {
  for (int i = 0; i < count; ++i, x += sx, y += sy) {
    if (i > 0 && is_double_corner(map, x, y)) {
      return through_corner(x, y);
    }
    // The cells on both sides of the edge from (x, y) on.
    int left = std::min(x, x + sx), top = std::min(y, y + sy);
    bool open =
        sy == 0 ? map.free(left, y - 1) || map.free(left, y) : map.free(x - 1, top) || map.free(x, top);
    if (!open) {
      return "it passes between two blocked cells at " + text(left, top);
    }
  }
  return "";
}

std::int64_t floor_of(std::int64_t number, std::int64_t by) {
  return number / by - (number % by != 0 && number < 0);
}

// A slanted segment, from left to right: the cells whose interior it meets, column by column.
std::string through_cells(const Map &map, int x0, int y0, int x1, int y1) {
  std::int64_t dx = x1 - x0, dy = y1 - y0;
  for (std::int64_t column = 0; column < dx; ++column) {
    // The heights where it enters and leaves the column, times dx, above y0.
    std::int64_t enters = column * dy, leaves = enters + dy;
    std::int64_t low = floor_of(std::min(enters, leaves), dx),
                 high = -floor_of(-std::max(enters, leaves), dx);
    for (std::int64_t row = low; row < high; ++row) {
      int x = x0 + static_cast<int>(column), y = y0 + static_cast<int>(row);
      if (!map.free(x, y)) {
        return through_cell(x, y);
      }
    }
  }
  auto parts = static_cast<int>(std::gcd(dx, dy));
  for (int i = 1; i < parts; ++i) {
    int x = x0 + static_cast<int>(dx / parts) * i, y = y0 + static_cast<int>(dy / parts) * i;
    if (is_double_corner(map, x, y)) {
      return through_corner(x, y);
    }
  }
  return "";
}

std::string exact_segment(const Map &map, Point from, Point to) {
  auto x0 = static_cast<int>(from.x), y0 = static_cast<int>(from.y);
  auto x1 = static_cast<int>(to.x), y1 = static_cast<int>(to.y);
  if (y0 == y1) {
    return along_edges(map, x0, y0, x0 < x1 ? 1 : -1, 0, std::abs(x1 - x0));
  }
  if (x0 == x1) {
    return along_edges(map, x0, y0, 0, y0 < y1 ? 1 : -1, std::abs(y1 - y0));
  }
  return x0 < x1 ? through_cells(map, x0, y0, x1, y1) : through_cells(map, x1, y1, x0, y0);
}

// ---- Between other points: a piece for each line that is crossed

// Where along the segment, from 0 to 1, its one coordinate is an integer.
void add_crossings(double from, double to, std::vector<long double> &crossings) {
  double low = std::min(from, to), high = std::max(from, to);
  for (double line = std::floor(low) + 1; line < high; line += 1) {
    crossings.push_back((static_cast<long double>(line) - from) / (static_cast<long double>(to) - from));
  }
}

// A point that is in the middle of a piece, or nearly: a cell near it is free. A piece crosses no line, so
// its depth in a cell is concave along it, and nowhere more than twice the depth of its middle.
bool near_free_cell(const Map &map, long double x, long double y) {
  for (long double cx : {std::floor(x - SLACK), std::floor(x + SLACK)}) {
    for (long double cy : {std::floor(y - SLACK), std::floor(y + SLACK)}) {
      if (map.free(static_cast<int>(cx), static_cast<int>(cy))) {
        return true;
      }
    }
  }
  return false;
}

// A double corner on the segment, which is near no end of it.
bool passes_corner(const Map &map, Point from, Point to, long double x, long double y) {
  long double cx = std::round(x), cy = std::round(y);
  return std::hypot(cx - x, cy - y) <= SLACK && std::hypot(cx - from.x, cy - from.y) > SLACK &&
         std::hypot(cx - to.x, cy - to.y) > SLACK &&
         is_double_corner(map, static_cast<int>(cx), static_cast<int>(cy));
}

std::string near_segment(const Map &map, Point from, Point to) {
  std::vector<long double> crossings{0, 1};
  add_crossings(from.x, to.x, crossings);
  add_crossings(from.y, to.y, crossings);
  std::sort(crossings.begin(), crossings.end());
  long double dx = static_cast<long double>(to.x) - from.x, dy = static_cast<long double>(to.y) - from.y;
  for (std::size_t i = 1; i < crossings.size(); ++i) {
    long double middle = (crossings[i - 1] + crossings[i]) / 2;
    if (!near_free_cell(map, from.x + dx * middle, from.y + dy * middle)) {
      return "it is in no free cell near " +
             text(from.x + static_cast<double>(dx * middle), from.y + static_cast<double>(dy * middle));
    }
    long double x = from.x + dx * crossings[i], y = from.y + dy * crossings[i];
    if (passes_corner(map, from, to, x, y)) {
      return through_corner(static_cast<int>(std::round(x)), static_cast<int>(std::round(y)));
    }
  }
  return "";
}

// ---- Corners at which a path begins, turns and ends

// Whether a direction lies in a closed quadrant. Between corners it is made of integers: the slack adds
// nothing.
bool within(Point direction, int sx, int sy) {
  return direction.x * sx >= -SLACK && direction.y * sy >= -SLACK;
}

Point minus(Point a, Point b) {
  return {a.x - b.x, a.y - b.y};
}

// A path that comes from one point and goes to the next does not change from quadrant to quadrant.
bool keeps_its_quadrant(const Map &map, int x, int y, Point back, Point forth) {
  int sy = map.free(x, y) ? 1 : -1;
  return (within(back, 1, sy) && within(forth, 1, sy)) || (within(back, -1, -sy) && within(forth, -1, -sy));
}

// The double corner that a point is, or is next to.
bool at_double_corner(const Map &map, Point at, int &x, int &y) {
  double cx = std::round(at.x), cy = std::round(at.y);
  x = static_cast<int>(cx);
  y = static_cast<int>(cy);
  return std::hypot(cx - at.x, cy - at.y) <= SLACK && is_double_corner(map, x, y);
}

std::string check_turns(const Map &map, const std::vector<Point> &path) {
  int x = 0, y = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (!at_double_corner(map, path[i], x, y)) {
      continue;
    }
    bool first = i == 0, last = i + 1 == path.size();
    if (first || last) {
      Point direction = minus(path[first ? 1 : i - 1], path[i]);
      if (!within(direction, 1, 1)) {
        return std::string(first ? "the start" : "the goal") + " on a double corner is not " +
               (first ? "left" : "entered") + " through its own cell";
      }
    } else if (!keeps_its_quadrant(map, x, y, minus(path[i - 1], path[i]), minus(path[i + 1], path[i]))) {
      return through_corner(x, y);
    }
  }
  return "";
}

bool is_at(Point at, Cell end) {
  return at.x == end.x && at.y == end.y;
}

bool is_inside(const Map &map, Point at) {
  return at.x >= 0 && at.y >= 0 && at.x <= map.width() && at.y <= map.height();
}

std::string check_ends(const Map &map, Cell start, Cell goal, const std::vector<Point> &path) {
  if (path.size() < 2) {
    return path.empty() ? "no point is no path" : "one point alone is no path";
  }
  if (!is_at(path.front(), start) || !is_at(path.back(), goal)) {
    return "the path leads from " + text(path.front()) + " to " + text(path.back()) + ", not from " +
           text(start.x, start.y) + " to " + text(goal.x, goal.y);
  }
  for (Point at : path) {
    // Written so that a number that is none fails.
    if (!is_inside(map, at)) {
      return "the point " + text(at) + " lies outside the map";
    }
  }
  return map.free(start) && map.free(goal) ? "" : "the cell of an end is blocked";
}

} // namespace

bool is_double_corner(const Map &map, int x, int y) {
  bool south_east = map.free(x, y), south_west = map.free(x - 1, y);
  return south_east != south_west && map.free(x - 1, y - 1) == south_east && map.free(x, y - 1) == south_west;
}

std::string check_segment(const Map &map, Point from, Point to) {
  if (std::hypot(to.x - from.x, to.y - from.y) < LEAST_SEGMENT) {
    return "it is shorter than 0.01";
  }
  return is_corner(from) && is_corner(to) ? exact_segment(map, from, to) : near_segment(map, from, to);
}

CheckedPoints check_points(const Map &map, Cell start, Cell goal, const std::vector<Point> &path) {
  CheckedPoints checked;
  checked.wrong = check_ends(map, start, goal, path);
  for (std::size_t i = 1; checked.wrong.empty() && i < path.size(); ++i) {
    Point from = path[i - 1], to = path[i];
    checked.wrong = check_segment(map, from, to);
    if (!checked.wrong.empty()) {
      checked.wrong = "the segment from " + text(from) + " to " + text(to) + ": " + checked.wrong;
    }
    checked.length +=
        std::hypot(static_cast<long double>(to.x) - from.x, static_cast<long double>(to.y) - from.y);
  }
  if (checked.wrong.empty()) {
    checked.wrong = check_turns(map, path);
  }
  return checked;
}

} // namespace harness
