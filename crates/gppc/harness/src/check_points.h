// Checks paths of the any-angle track: a point between the cells, corner (x, y) being the top left one of
// cell (x, y). Nothing here is shared with the engines.
#ifndef GPPC_HARNESS_CHECK_POINTS_H
#define GPPC_HARNESS_CHECK_POINTS_H

#include "map.h"

#include <string>
#include <vector>

namespace harness {

struct Point {
  double x = 0;
  double y = 0;
};

struct CheckedPoints {
  // Empty if the path is valid, else the first thing that is wrong.
  std::string wrong;
  long double length = 0;
};

// The least length of a segment.
constexpr double LEAST_SEGMENT = 0.01;

// How far a segment may be off where an end of it is no corner of a cell. Between corners all is exact.
constexpr double SLACK = 1e-6;

// Whether a corner is a double one: two blocked cells meet there, and they lie opposite.
bool is_double_corner(const Map &map, int x, int y);

// Checks a segment: no interior of a blocked cell, no edge between two of them, no double corner between its
// ends. Outside the map all is blocked. Empty if nothing is wrong.
std::string check_segment(const Map &map, Point from, Point to);

// Checks a path of two points or more. Where it turns at a double corner, it comes and goes in the same
// quadrant; an end there is left or entered within its own cell, which lies to the south-east.
CheckedPoints check_points(const Map &map, Cell start, Cell goal, const std::vector<Point> &path);

} // namespace harness

#endif
