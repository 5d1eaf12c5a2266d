// Lengths over eight directions, exactly: so many straight steps and so many diagonal ones. Since the root
// of 2 is irrational, two lengths are equal only if both numbers are.
#ifndef GPPC_HARNESS_OCTILE_H
#define GPPC_HARNESS_OCTILE_H

#include <cmath>
#include <cstdint>

namespace harness {

struct Octile {
  std::int64_t straight = 0;
  std::int64_t diagonal = 0;

  long double length() const {
    return static_cast<long double>(straight) + static_cast<long double>(diagonal) * std::sqrt(2.0L);
  }
};

inline Octile operator+(Octile a, Octile b) {
  return {a.straight + b.straight, a.diagonal + b.diagonal};
}

inline bool operator==(Octile a, Octile b) {
  return a.straight == b.straight && a.diagonal == b.diagonal;
}

// Which one is less is asked of p + q √2 < 0, by comparing p² with 2 q².
inline bool operator<(Octile a, Octile b) {
  std::int64_t p = a.straight - b.straight, q = a.diagonal - b.diagonal;
  if (p >= 0 && q >= 0) {
    return false;
  }
  if (p <= 0 && q <= 0) {
    return true;
  }
  return p < 0 ? p * p > 2 * q * q : p * p < 2 * q * q;
}

} // namespace harness

#endif
