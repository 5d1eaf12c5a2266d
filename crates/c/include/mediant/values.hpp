// Values of mediant.hpp: points, paths, answers, mistakes, watchers; and what its classes share.
#ifndef MEDIANT_VALUES_HPP
#define MEDIANT_VALUES_HPP

#if !defined(__cpp_exceptions) && !defined(_CPPUNWIND)
#error "mediant.hpp throws exceptions, which this compiler leaves out: use mediant.h"
#endif

#include "../mediant.h"

#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace mediant {

// The types of mediant.h that need no other face.
using point = mediant_point;
using cell = mediant_cell;
using area = mediant_area;
using ends = mediant_ends;
using code = mediant_code;
using status = mediant_status;
using limit = mediant_limit;

// A mistake. what() is the sentence of the library.
class error : public std::runtime_error {
public:
  error(mediant::code code, const std::string &sentence) : std::runtime_error(sentence), code_(code) {}
  mediant::code code() const noexcept { return code_; }
  // The code's name in all languages, such as "start-blocked".
  const char *name() const noexcept {
    const char *name = mediant_code_name(code_);
    return name ? name : "other";
  }

private:
  mediant::code code_;
};

// Values that are read, in memory of another: of a vector, an array, a std::span, a list in braces. As an
// argument it leads to memory that has to stay during the call.
template <class T> class view {
public:
  using value_type = T;
  constexpr view() noexcept = default;
  // A pointer alone: {0, 0} is a point, and no view.
  template <class Pointer,
            class = std::enable_if_t<std::is_pointer_v<Pointer> && std::is_convertible_v<Pointer, const T *>>>
  constexpr view(Pointer data, std::size_t size) noexcept : data_(data), size_(size) {}
  constexpr view(std::initializer_list<T> values) noexcept : data_(std::data(values)), size_(values.size()) {}
  // What has data and a size, and an array of C.
  template <class Values, class Pointer = decltype(std::data(std::declval<const Values &>())),
            class = decltype(std::size(std::declval<const Values &>())),
            class = std::enable_if_t<std::is_same_v<Pointer, const T *> || std::is_same_v<Pointer, T *>>>
  constexpr view(const Values &values) noexcept : data_(std::data(values)), size_(std::size(values)) {}

  constexpr const T *data() const noexcept { return data_; }
  constexpr std::size_t size() const noexcept { return size_; }
  constexpr bool empty() const noexcept { return size_ == 0; }
  constexpr const T *begin() const noexcept { return data_; }
  constexpr const T *end() const noexcept { return data_ + size_; }
  constexpr const T &operator[](std::size_t at) const noexcept { return data_[at]; }
  std::vector<T> copy() const { return std::vector<T>(begin(), end()); }

private:
  const T *data_ = nullptr;
  std::size_t size_ = 0;
};

// A path: its turns, with start and end, and its length in cells, or its cost where cells have costs.
struct path {
  std::vector<mediant::point> points;
  double length = 0;
};

// The answer to a query. Its numbers are those of mediant_answer.
struct answer {
  mediant::status status = MEDIANT_STATUS_UNREACHABLE;
  mediant::limit stopped_by = MEDIANT_LIMIT_NONE;
  // The path's points; none without a path. Of a search that was stopped, those of the best one so far.
  std::vector<mediant::point> points;
  double distance = 0;
  double length = 0;
  double lower_bound = 0;
  double any_angle_lower_bound = 0;

  bool found() const noexcept { return status == MEDIANT_STATUS_FOUND; }
};

namespace detail {

// An answer, whose points are still to come.
inline mediant::answer told(const mediant_answer &raw) {
  return {raw.status,      raw.stopped_by,           {}, raw.distance, raw.length,
          raw.lower_bound, raw.any_angle_lower_bound};
}

} // namespace detail

// Functions that are called while some work goes on, from any thread, and from several at once. An exception
// of theirs stops the work, and is thrown again by the function that was called. Each may be empty.
struct watcher {
  // Whether to stop.
  std::function<bool()> stop;
  // Is told how much is done of how much.
  std::function<void(std::uint64_t done, std::uint64_t total)> progress;
};

// Cells that count otherwise than on the map, for one query.
struct exceptions {
  view<cell> blocked;
  view<cell> free;
  // Whether the cells at start and goal count as free.
  bool free_ends = false;
};

namespace detail {

inline void check(mediant_code result) {
  if (result != MEDIANT_CODE_OK) {
    throw error(result, mediant_message());
  }
}

// Checks, once, that the library has the interface that this was compiled against.
inline void check_interface() {
  static const bool is_same = [] {
    if (mediant_interface() != MEDIANT_INTERFACE) {
      throw error(MEDIANT_CODE_OTHER, "the library has the interface " + std::to_string(mediant_interface()) +
                                          "; the program was compiled against " +
                                          std::to_string(MEDIANT_INTERFACE));
    }
    return true;
  }();
  static_cast<void>(is_same);
}

inline void require(bool holds, const char *sentence) {
  if (!holds) {
    throw error(MEDIANT_CODE_ARGUMENT, sentence);
  }
}

// A text of C. One with a 0 in it would be cut off there.
inline const char *text(const std::string &text) {
  require(text.find('\0') == std::string::npos, "a text with a 0 in it");
  return text.c_str();
}

// What is handed to the library for a watcher. Exceptions end here, and are kept.
class watched {
public:
  explicit watched(mediant::watcher functions) : functions_(std::move(functions)) {
    raw_.stop = [](void *data) -> std::int32_t { return static_cast<watched *>(data)->stop(); };
    raw_.progress = [](void *data, std::uint64_t done, std::uint64_t total) {
      static_cast<watched *>(data)->guard([&](const mediant::watcher &watcher) {
        if (watcher.progress) {
          watcher.progress(done, total);
        }
      });
    };
    raw_.data = this;
  }
  watched(const watched &) = delete;
  watched &operator=(const watched &) = delete;

  // None if there is nothing to call.
  const mediant_watcher *get() const noexcept {
    return functions_.stop || functions_.progress ? &raw_ : nullptr;
  }

  // Throws what a function threw, and else what the code says.
  void check(mediant_code result) {
    rethrow();
    detail::check(result);
  }

  void rethrow() {
    std::lock_guard<std::mutex> lock(mutex_);
    if (thrown_) {
      std::rethrow_exception(std::exchange(thrown_, nullptr));
    }
  }

private:
  template <class Work> void guard(const Work &work) noexcept {
    try {
      work(functions_);
    } catch (...) {
      std::lock_guard<std::mutex> lock(mutex_);
      if (!thrown_) {
        thrown_ = std::current_exception();
      }
      failed_ = true;
    }
  }

  std::int32_t stop() noexcept {
    bool stops = false;
    guard([&](const mediant::watcher &watcher) { stops = watcher.stop && watcher.stop(); });
    return stops || failed_;
  }

  const mediant::watcher functions_;
  mediant_watcher raw_{};
  std::mutex mutex_;
  std::exception_ptr thrown_;
  std::atomic<bool> failed_{false};
};

// Holds a handle, and frees it.
template <class Handle, mediant_code (*Free)(Handle)> class held {
public:
  held(held &&other) noexcept : handle_(std::exchange(other.handle_, Handle{})) {}
  held &operator=(held &&other) noexcept {
    if (this != &other) {
      free();
      handle_ = std::exchange(other.handle_, Handle{});
    }
    return *this;
  }
  ~held() { free(); }
  // The handle, for functions of mediant.h. It stays this object's.
  Handle handle() const noexcept { return handle_; }
  // Whether it holds one: not after it was moved from.
  explicit operator bool() const noexcept { return handle_.id != 0; }
  // Gives the handle away: the caller frees it.
  Handle release() noexcept { return std::exchange(handle_, Handle{}); }

protected:
  held() { check_interface(); }
  explicit held(Handle handle) noexcept : handle_(handle) {}

  Handle handle_{};

private:
  void free() noexcept {
    if (handle_.id != 0) {
      Free(handle_);
    }
  }
};

// Makes an object of a function that writes a handle. What its watcher threw is thrown, and the object freed.
template <class Object, class Make> Object made(const Make &make, watched *watched = nullptr) {
  check_interface();
  decltype(std::declval<Object &>().handle()) handle{};
  mediant_code result = make(&handle);
  if (result != MEDIANT_CODE_OK) {
    handle = {};
  }
  Object object = Object(handle);
  if (watched) {
    watched->rethrow();
  }
  check(result);
  return object;
}

// The values of a function that writes as many as there is room for, and tells how many there are.
template <class T, class Write> std::vector<T> all(const Write &write, std::size_t room = 32) {
  std::vector<T> values(room);
  std::size_t count = 0;
  check(write(values.data(), values.size(), &count));
  bool is_all = count <= values.size();
  values.resize(count);
  if (!is_all) {
    check(write(values.data(), values.size(), &count));
  }
  return values;
}

// The text of a function that writes as much as there is room for, and tells how long it is.
template <class Write> std::string words(const Write &write) {
  std::string text(256, '\0');
  std::size_t length = 0;
  check(write(text.data(), text.size(), &length));
  bool is_all = length < text.size();
  text.resize(is_all ? length : length + 1);
  if (!is_all) {
    check(write(text.data(), text.size(), &length));
    text.resize(length);
  }
  return text;
}

// Whether a rectangle has so many cells.
inline bool has(std::size_t size, std::uint32_t width, std::uint32_t height) noexcept {
  return size == std::uint64_t{width} * height;
}

// A number where there is one.
inline std::optional<double> number(double value) {
  return std::isnan(value) ? std::nullopt : std::optional<double>(value);
}

// The value of a function that writes one.
template <class T, class Write> T one(const Write &write) {
  T value{};
  check(write(&value));
  return value;
}

} // namespace detail

// The version of the library.
inline std::string version() {
  return mediant_version();
}

// The number of objects of all kinds that were made and not freed.
inline std::size_t objects() {
  return mediant_objects();
}

// The moves of N(k), clockwise from (0, 1).
inline std::vector<cell> moves(std::uint32_t k) {
  detail::check_interface();
  return detail::all<cell>([&](cell *moves, std::size_t room, std::size_t *count) {
    return mediant_moves(k, moves, room, count);
  });
}

// How much longer than the shortest at any angle the shortest paths of a motion can be; none if no bound is
// proven.
inline std::optional<double> bound(const std::string &motion = {}) {
  detail::check_interface();
  return detail::number(
      detail::one<double>([&](double *bound) { return mediant_bound(detail::text(motion), bound); }));
}

} // namespace mediant

#endif
