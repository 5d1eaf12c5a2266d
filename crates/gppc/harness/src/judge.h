// Verdicts about answers.
#ifndef GPPC_HARNESS_JUDGE_H
#define GPPC_HARNESS_JUDGE_H

#include "answers.h"
#include "timeline.h"

#include <string>
#include <vector>

namespace harness {

// What a track means by a path, and how lengths are had that no file states.
enum class Track { dynamic, classic, any_angle };

struct Verdict {
  // The path is one, or there is none and none is given.
  bool valid = false;
  // And it is as short as can be.
  bool optimal = false;
  // Valid, but nobody knows the shortest length.
  bool unknown = false;
  // The answer is that there is no path.
  bool none = false;
  // A search of our own contradicts the length that the file states.
  bool misstated = false;
  long double length = -1;
  // -1: none.
  long double shortest = -1;
  // Empty, or the reason why the answer is wrong.
  std::string why;
};

// Which lengths are searched for by the harness.
enum class Reference { none, unstated, all };

// Judges the answers to a timeline in order.
std::vector<Verdict> judge(Track track, Reference reference, const Timeline &timeline,
                           const Answers &answers);

// States the lengths of a timeline for which none are stated.
void state_lengths(Track track, Timeline &timeline);

} // namespace harness

#endif
