// An entry of the dynamic track: a shared library with functions of C.
#ifndef GPPC_HARNESS_LOAD_H
#define GPPC_HARNESS_LOAD_H

#include <cstdint>
#include <string>

extern "C" {

struct gppc_point {
  std::uint16_t x, y;
};

struct gppc_patch {
  const std::uint8_t *bitarray;
  std::uint16_t width, height;
  gppc_point pos;
};

struct gppc_path {
  const gppc_point *path;
  std::uint32_t length;
  std::uint8_t incomplete;
};
}

namespace harness {

// A loaded library. It stays loaded until the process ends.
class Library {
public:
  // Throws std::runtime_error if it cannot be loaded, or a function is missing.
  explicit Library(const std::string &file);

  void (*preprocess)(gppc_patch map, const char *file) = nullptr;
  void *(*init)(gppc_patch map, const char *file) = nullptr;
  void (*change)(void *data, const gppc_patch *changes, std::uint32_t count) = nullptr;
  gppc_path (*path)(void *data, gppc_point start, gppc_point goal) = nullptr;
  void (*free)(void *data) = nullptr;
  const char *(*name)() = nullptr;
  // Null if the library has none: then it takes part in all kinds.
  int (*tags)(int kinds) = nullptr;
};

} // namespace harness

#endif
