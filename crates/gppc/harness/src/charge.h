// Time as the competition charges it: a change belongs to the query after it, and the longest step is that of
// one call, the first one together with the change.
#ifndef GPPC_HARNESS_CHARGE_H
#define GPPC_HARNESS_CHARGE_H

#include <algorithm>
#include <cstdint>
#include <ctime>

namespace harness {

// In nanoseconds.
struct Times {
  std::int64_t total = 0;
  std::int64_t change = 0;
  // Until so much path was told that an agent walks 20 cells.
  std::int64_t first = 0;
  std::int64_t longest = 0;
};

// The clock by which calls are timed: that of the wall, as the competition's, or that of the processor, which
// stands still while others have it.
inline clockid_t timing_clock = CLOCK_MONOTONIC;

inline std::int64_t clock_now() {
  timespec now{};
  clock_gettime(timing_clock, &now);
  return static_cast<std::int64_t>(now.tv_sec) * 1000000000 + now.tv_nsec;
}

// The time that a call takes.
template <class Call> std::int64_t timed(Call &&call) {
  std::int64_t begin = clock_now();
  call();
  return clock_now() - begin;
}

class Charge {
public:
  void change(std::int64_t time) {
    times_.change += time;
    pending_ += time;
  }
  // `length` is that of the path told so far.
  void call(std::int64_t time, double length) {
    std::int64_t step = pending_ + time;
    pending_ = 0;
    times_.total += step;
    times_.longest = std::max(times_.longest, step);
    if (!walks_) {
      times_.first += step;
      walks_ = length >= 20 - 1e-6;
    }
  }
  // Where there is no path, nobody walked.
  Times finish(bool found) {
    if (!found) {
      times_.first = times_.total;
    }
    return times_;
  }

private:
  Times times_;
  std::int64_t pending_ = 0;
  bool walks_ = false;
};

} // namespace harness

#endif
