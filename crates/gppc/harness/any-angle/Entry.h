// The functions of an entry of the any-angle track, by the names and types that the competition calls.
#ifndef GPPC_HARNESS_ANY_ANGLE_ENTRY_H
#define GPPC_HARNESS_ANY_ANGLE_ENTRY_H

#include <string>
#include <vector>

namespace GPPC {

// A point: a corner of cells, or any other.
struct xyLoc {
  double x;
  double y;
};

} // namespace GPPC

typedef GPPC::xyLoc xyLoc;

// Cells are row by row, true = free.
void PreprocessMap(const std::vector<bool> &bits, int width, int height, const std::string &filename);
void *PrepareForSearch(const std::vector<bool> &bits, int width, int height, const std::string &filename);
// Returns false if the harness is to call again, with the path as it is by then.
bool GetPath(void *data, xyLoc s, xyLoc g, std::vector<xyLoc> &path);
std::string GetName();

#endif
