// The entry of the any-angle track: shortest paths between corners of cells, which pass no gap between two
// blocked cells that meet at a corner. Where such a gap is a start or a goal, the library has the rule of the
// track: the path leaves it, or comes to it, through the cell to the south-east.
#include "Entry.h"

#include "entry.hpp"

#include <algorithm>

namespace {

constexpr entry::track TRACK{"k=any gap=closed", ":any:closed", "engine=anya"};

}

void PreprocessMap(const std::vector<bool> &bits, int width, int height, const std::string &filename) {
  entry::preprocess(TRACK, bits, width, height, filename);
}

void *PrepareForSearch(const std::vector<bool> &bits, int width, int height, const std::string &filename) {
  return entry::search::prepare(TRACK, bits, width, height, filename);
}

// The bends of the whole path. They are corners of cells: no two of them are closer than a side of a cell.
bool GetPath(void *data, xyLoc s, xyLoc g, std::vector<xyLoc> &path) {
  auto points = static_cast<entry::search *>(data)->path({s.x, s.y}, {g.x, g.y});
  path.resize(points.size());
  std::transform(points.begin(), points.end(), path.begin(), [](mediant::point at) {
    return xyLoc{at.x, at.y};
  });
  return true;
}

std::string GetName() { return entry::NAME; }
