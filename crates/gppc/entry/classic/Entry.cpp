// The entry of the classic track: shortest paths over eight directions between cells, corners never cut.
#include "Entry.h"

#include "entry.hpp"

#include <algorithm>

namespace {

constexpr entry::track TRACK{"k=3 corners=never", ":3:never", "engine=jps-block"};

}

void PreprocessMap(const std::vector<bool> &bits, int width, int height, const std::string &filename) {
  entry::preprocess(TRACK, bits, width, height, filename);
}

void *PrepareForSearch(const std::vector<bool> &bits, int width, int height, const std::string &filename) {
  return entry::search::prepare(TRACK, bits, width, height, filename);
}

// The turns of the whole path.
bool GetPath(void *data, xyLoc s, xyLoc g, std::vector<xyLoc> &path) {
  mediant::point start{double(s.x), double(s.y)}, goal{double(g.x), double(g.y)};
  auto points = static_cast<entry::search *>(data)->path(start, goal);
  path.resize(points.size());
  std::transform(points.begin(), points.end(), path.begin(), [](mediant::point at) {
    return xyLoc{static_cast<std::int16_t>(at.x), static_cast<std::int16_t>(at.y)};
  });
  return true;
}

std::string GetName() { return entry::NAME; }
