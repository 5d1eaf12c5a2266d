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

// Judges the answers to a timeline in order, by the lengths that are stated. If an answer over cells differs
// from its own, or if `search_all`, a search of the harness decides.
std::vector<Verdict> judge(Track track, bool search_all, const Timeline &timeline, const Answers &answers);

// States the lengths of a timeline for which none are stated.
void state_lengths(Track track, Timeline &timeline);

} // namespace harness

#endif
