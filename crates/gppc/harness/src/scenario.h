// Scenario files: version 1 of the static tracks, version 2 of the dynamic one, and tables of lengths.
#ifndef GPPC_HARNESS_SCENARIO_H
#define GPPC_HARNESS_SCENARIO_H

#include "timeline.h"

#include <string>

namespace harness {

// Reads a scenario of version 1. Its map is the file of its name without `.scen`.
Timeline read_static(const std::string &file);

// Reads a scenario of version 2, and the patches that it names.
Timeline read_dynamic(const std::string &file);

// Writes a timeline as a scenario of version 2, STEM.scen and STEM.patch. All lengths are known.
void write_dynamic(const std::string &stem, const Timeline &timeline);

// Replaces what is stated by a table `index,cost`. A query that it has not has no length stated.
void state_from(const std::string &file, Timeline &timeline);

// Forgets what is stated.
void forget_stated(Timeline &timeline);

// Keeps every n-th query of a timeline whose map does not change.
void keep_every(std::size_t n, Timeline &timeline);

} // namespace harness

#endif
