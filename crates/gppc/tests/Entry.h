// The declarations by which the kits of the two tracks call an entry, in the place of the kits' own files.
#ifndef MEDIANT_GPPC_TESTS_ENTRY_H
#define MEDIANT_GPPC_TESTS_ENTRY_H

#include <cstdint>
#include <string>
#include <vector>

// A cell on the classic track, a point on the any-angle track.
struct xyLoc {
#ifdef ANY_ANGLE
  double x, y;
#else
  std::int16_t x, y;
#endif
};

// The bits are the map's, row by row; true is free.
void PreprocessMap(const std::vector<bool> &bits, int width, int height, const std::string &filename);
void *PrepareForSearch(const std::vector<bool> &bits, int width, int height, const std::string &filename);
bool GetPath(void *data, xyLoc s, xyLoc g, std::vector<xyLoc> &path);
std::string GetName();

#endif
