// Maps and patches as the competition has them: bits row by row without padding, 1 = free, the least
// significant bit of a byte first, (0, 0) at the top left.
#ifndef GPPC_HARNESS_MAP_H
#define GPPC_HARNESS_MAP_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace harness {

struct Cell {
  int x = 0;
  int y = 0;
};

inline bool operator==(Cell a, Cell b) {
  return a.x == b.x && a.y == b.y;
}

// The longest side of a map.
constexpr int MAX_SIDE = 8000;

// A rectangle of cells, each of them free or blocked.
class Map {
public:
  Map() = default;
  Map(int width, int height, bool free);

  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t cells() const { return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_); }
  bool holds(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }
  // Cells outside are blocked.
  bool free(int x, int y) const { return holds(x, y) && bit(index(x, y)); }
  bool free(Cell at) const { return free(at.x, at.y); }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  bool bit(std::size_t index) const { return (bytes_[index / 8] >> (index % 8) & 1) != 0; }
  void set(int x, int y, bool free);
  // Copies a patch, whose first cell goes to `at`. It lies within the map.
  void put(const Map &patch, Cell at);
  // The rectangle of cells from `at` on, which lies within the map.
  Map part(Cell at, int width, int height) const;
  // The bytes stay where they are for the life of the map, whatever its cells become.
  const std::uint8_t *bytes() const { return bytes_.data(); }

private:
  int width_ = 0;
  int height_ = 0;
  std::vector<std::uint8_t> bytes_;
};

// Reads a file of MovingAI's format `.map`: `.`, `G` and `S` are free, all else is blocked. Throws
// std::runtime_error for a file that is not one, as do all functions that read files.
Map read_map(const std::string &file);

// Reads the patches of a file of the dynamic track.
std::vector<Map> read_patches(const std::string &file);

// Writes patches as `read_patches` reads them.
void write_patches(const std::string &file, const std::vector<Map> &patches);

} // namespace harness

#endif
