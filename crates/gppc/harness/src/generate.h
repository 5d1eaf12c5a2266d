// Timelines and maps by seed.
#ifndef GPPC_HARNESS_GENERATE_H
#define GPPC_HARNESS_GENERATE_H

#include "timeline.h"

#include <cstdint>

namespace harness {

// A timeline of about a hundred queries. The kinds take turns by number: doors, noise, moving rooms, a map
// revealed, a map that fades into another, patches in heaps, tiny maps. Sides are `side` at most.
Timeline generate_timeline(std::uint64_t seed, std::size_t number, int side);

// A map with sides up to `side`, and fifty queries. Ends are free cells only if `free_ends`.
Timeline generate_static(std::uint64_t seed, std::size_t number, int side, bool free_ends);

} // namespace harness

#endif
