// The command line of the three programs.
#ifndef GPPC_HARNESS_OPTIONS_H
#define GPPC_HARNESS_OPTIONS_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace harness {

struct Options {
  // Scenario files; on the dynamic track after the library.
  std::vector<std::string> files;
  // So many generated maps or timelines.
  std::size_t generated = 0;
  std::uint64_t seed = 1;
  // The longest side of generated maps; 0 leaves it to the track.
  std::size_t side = 0;
  // Every n-th instance of a file.
  std::size_t every = 1;
  // Search for all shortest lengths, also those that a file states.
  bool reference = false;
  // Time of the processor, for a machine that is busy.
  bool processor = false;
  // A row for each query.
  std::string csv;
  // A table `index,cost`, or a folder with a table for each map.
  std::string costs;
  // A folder into which generated timelines are written.
  std::string write;
  // The kinds of scenario that `gppc_scenario_tags` is asked about.
  int tags = 0;
  // After so many seconds a process is stopped.
  unsigned seconds = 600;
};

// Throws std::runtime_error.
Options read_options(int count, char **words);

} // namespace harness

#endif
