// Indexes, planners, goals, batches and bytes of mediant.hpp.
#ifndef MEDIANT_PLANNERS_HPP
#define MEDIANT_PLANNERS_HPP

#include "spaces.hpp"

namespace mediant {

// Bytes that the library made.
class Bytes : public detail::held<mediant_bytes, mediant_bytes_free> {
public:
  // Takes over a handle.
  explicit Bytes(mediant_bytes handle) noexcept : held(handle) {}
  // The bytes. They are this object's: the view ends with it.
  view<std::uint8_t> data() const {
    const std::uint8_t *data = nullptr;
    std::size_t size = 0;
    detail::check(mediant_bytes_data(handle_, &data, &size));
    return {data, size};
  }
};

// The paths of many queries.
class Batch : public detail::held<mediant_batch, mediant_batch_free> {
public:
  // Takes over a handle.
  explicit Batch(mediant_batch handle) : held(handle) {
    if (handle.id != 0) {
      detail::check(mediant_batch_paths(handle, &paths_));
    }
  }
  Batch(Batch &&other) noexcept : held(std::move(other)), paths_(std::exchange(other.paths_, {})) {}
  Batch &operator=(Batch &&other) noexcept {
    paths_ = this == &other ? paths_ : std::exchange(other.paths_, {});
    held::operator=(std::move(other));
    return *this;
  }

  // The number of queries.
  std::size_t size() const noexcept { return paths_.count; }
  // By query the length of its path, or its cost; infinity where none leads, NaN for a query with a mistake.
  // They are this batch's: the view ends with it.
  view<double> lengths() const noexcept { return {paths_.lengths, paths_.count}; }
  double length(std::size_t query) const { return paths_.lengths[known(query)]; }
  // The code of a query: a query with a mistake, such as a blocked end, has one of its own.
  mediant::code code(std::size_t query) const {
    return static_cast<mediant::code>(paths_.codes[known(query)]);
  }
  // The points of the path of a query; none where none leads. They are this batch's: the view ends with it.
  view<point> points(std::size_t query) const {
    std::size_t first = paths_.firsts[known(query)];
    return {paths_.points + first, paths_.firsts[query + 1] - first};
  }

private:
  std::size_t known(std::size_t query) const {
    return query < paths_.count ? query : throw std::out_of_range("a batch has no query of this number");
  }

  mediant_paths paths_{};
};

// What an engine prepared of a space. It never changes.
class Index : public detail::held<mediant_index, mediant_index_free> {
public:
  // Takes over a handle.
  explicit Index(mediant_index handle) noexcept : held(handle) {}
  // Prepares an index for many paths. The engine has the parameters engine, its options, and smooth, as in
  // "engine=subgoal memory=100MB"; without any it is the best one for what the space is.
  static Index prepare(const Space &space, const std::string &engine = {}, const watcher &watch = {}) {
    detail::watched watched(watch);
    return detail::made<Index>(
        [&](mediant_index *index) {
          return mediant_index_prepare(space.handle(), detail::text(engine), watched.get(), index);
        },
        &watched);
  }
  // Reads an index that save wrote, of the same map. Options are those of its engine.
  static Index load(const Map &map, const std::string &path, const std::string &options = {}) {
    return detail::made<Index>([&](mediant_index *index) {
      return mediant_index_load(map.handle(), detail::text(path), detail::text(options), index);
    });
  }
  // The index of bytes that to_bytes gave, of the same map.
  static Index from_bytes(const Map &map, view<std::uint8_t> bytes, const std::string &options = {}) {
    return detail::made<Index>([&](mediant_index *index) {
      return mediant_index_from_bytes(map.handle(), bytes.data(), bytes.size(), detail::text(options), index);
    });
  }
  // Writes the index to a file. The file is whole or not there.
  void save(const std::string &path) const { detail::check(mediant_index_save(handle_, detail::text(path))); }
  Bytes to_bytes() const {
    return detail::made<Bytes>([&](mediant_bytes *bytes) { return mediant_index_to_bytes(handle_, bytes); });
  }

  // The index for a changed map of the same motion. This one stays as it is.
  Index repair(const Space &space) const {
    return detail::made<Index>(
        [&](mediant_index *index) { return mediant_index_repair(handle_, space.handle(), index); });
  }
  // This index with all that a repair left made anew, which takes as long as to prepare it.
  Index finish(const watcher &watch = {}) const {
    detail::watched watched(watch);
    return detail::made<Index>(
        [&](mediant_index *index) { return mediant_index_finish(handle_, watched.get(), index); }, &watched);
  }
  // Its space, such as of an index that was loaded.
  Space space() const {
    return detail::made<Space>([&](mediant_space *space) { return mediant_index_space(handle_, space); });
  }
  // Whether nothing of it is that of an earlier map.
  bool is_finished() const {
    return detail::one<std::int32_t>([&](auto *is) { return mediant_index_is_finished(handle_, is); }) != 0;
  }

  // The memory that it takes beyond its space, in bytes.
  std::uint64_t memory() const {
    return detail::one<std::uint64_t>([&](auto *bytes) { return mediant_index_memory(handle_, bytes); });
  }
  // Its engine, motion and options.
  std::string setup() const {
    return detail::words([&](char *text, std::size_t room, std::size_t *length) {
      return mediant_index_setup(handle_, text, room, length);
    });
  }
  // How much longer than the shortest path at any angle its paths can be; none if no bound is proven.
  std::optional<double> bound() const {
    return detail::number(
        detail::one<double>([&](double *bound) { return mediant_index_bound(handle_, bound); }));
  }
  // The paths of many queries, by so many threads; 0 is one for each core.
  Batch paths(view<ends> queries, std::size_t threads = 0, const watcher &watch = {}) const {
    detail::watched watched(watch);
    return detail::made<Batch>(
        [&](mediant_batch *batch) {
          return mediant_index_paths(handle_, queries.data(), queries.size(), threads, watched.get(), batch);
        },
        &watched);
  }
  // The lengths of the paths from each start to each goal, a row for each start; infinity where none leads.
  std::vector<double> table(view<point> starts, view<point> goals, const watcher &watch = {}) const {
    detail::watched watched(watch);
    std::vector<double> lengths(starts.size() * goals.size());
    watched.check(mediant_index_table(handle_, starts.data(), starts.size(), goals.data(), goals.size(),
                                      watched.get(), lengths.data()));
    return lengths;
  }
};

// Goals that many starts ask for. Planners of indexes with the same map and motion share them.
class Goals : public detail::held<mediant_goals, mediant_goals_free> {
public:
  // Takes over the handle of so many goals.
  Goals(mediant_goals handle, std::size_t size) noexcept : held(handle), size_(size) {}
  Goals(const Index &index, view<point> points) : size_(points.size()) {
    detail::check(mediant_goals_new(index.handle(), points.data(), points.size(), &handle_));
  }
  std::size_t size() const noexcept { return size_; }

private:
  std::size_t size_;
};

// One of several goals, by its number, and the length of the path to it.
struct nearest {
  std::size_t goal = 0;
  double length = 0;
};

// How far a search is: the number of its expansions, and a lower bound on the length that is sought.
struct progress {
  std::uint64_t expansions = 0;
  double lower_bound = 0;
};

// Answers queries on an index, one after another. Each thread makes a planner of its own: of two calls at the
// same time one throws an error with MEDIANT_CODE_BUSY. One that is destroyed while it is used stays.
class Planner : public detail::held<mediant_planner, mediant_planner_free> {
public:
  // Takes over a handle.
  explicit Planner(mediant_planner handle) noexcept : held(handle) {}
  explicit Planner(const Index &index) { detail::check(mediant_planner_new(index.handle(), &handle_)); }

  // The shortest path between two points; none where none leads.
  std::optional<mediant::path> path(point start, point goal) {
    mediant::path path;
    return this->path(start, goal, path) ? std::optional<mediant::path>(std::move(path)) : std::nullopt;
  }
  // The same in a path that is there, whose memory is used again. False where none leads: it has no points
  // then, and its length is infinity.
  bool path(point start, point goal, mediant::path &to) {
    point first[64];
    std::size_t room = std::size(first), count = 0;
    detail::check(mediant_planner_path(handle_, start, goal, first, room, &count, &to.length));
    to.points.assign(first, first + (count < room ? count : room));
    if (count > room) {
      to.points.resize(count);
      detail::check(mediant_planner_points(handle_, to.points.data(), count, &count));
    }
    return count > 0;
  }
  // The length of the path between two points; infinity where none leads.
  double distance(point start, point goal) {
    return detail::one<double>(
        [&](double *length) { return mediant_planner_distance(handle_, start, goal, length); });
  }
  // Answers a query from any of several starts to any of several goals. Wishes are nearest, snap, tolerance,
  // max_cost, max_expansions, timeout (in milliseconds), as in "nearest max_cost=20".
  mediant::answer find(view<point> starts, view<point> goals, const std::string &wishes = {},
                       const watcher &watch = {}) {
    detail::watched watched(watch);
    mediant_answer answer{};
    watched.check(mediant_planner_find(handle_, starts.data(), starts.size(), goals.data(), goals.size(),
                                       detail::text(wishes), watched.get(), &answer));
    return told(answer);
  }
  mediant::answer find(point start, point goal, const std::string &wishes = {}, const watcher &watch = {}) {
    return find(view<point>(&start, 1), view<point>(&goal, 1), wishes, watch);
  }
  // The same as on the map with some cells edited.
  mediant::answer find_except(view<point> starts, view<point> goals, const exceptions &except,
                              const std::string &wishes = {}, const watcher &watch = {}) {
    detail::watched watched(watch);
    mediant_exceptions cells{except.blocked.data(), except.blocked.size(), except.free.data(),
                             except.free.size(), except.free_ends};
    mediant_answer answer{};
    watched.check(mediant_planner_find_except(handle_, starts.data(), starts.size(), goals.data(),
                                              goals.size(), &cells, detail::text(wishes), watched.get(),
                                              &answer));
    return told(answer);
  }
  // The points of the path that path, find, find_except or step found last.
  std::vector<point> points() const {
    return all([&](point *points, std::size_t room, std::size_t *count) {
      return mediant_planner_points(handle_, points, room, count);
    });
  }

  // Begins a search, and forgets the last one. Any other query forgets it. The watcher is copied.
  void begin(view<point> starts, view<point> goals, const std::string &wishes = {},
             const watcher &watch = {}) {
    // A search that could not be begun may have it: so it stays until one was.
    watched_.push_back(std::make_unique<detail::watched>(watch));
    detail::check(mediant_planner_begin(handle_, starts.data(), starts.size(), goals.data(), goals.size(),
                                        detail::text(wishes), watched_.back()->get()));
    watched_.erase(watched_.begin(), watched_.end() - 1);
  }
  // Continues the search by at most so many expansions. The answer, once it has one.
  std::optional<mediant::answer> step(std::uint64_t expansions) {
    std::int32_t done = 0;
    mediant_answer answer{};
    mediant_code result = mediant_planner_step(handle_, expansions, &done, &answer);
    for (const auto &watched : watched_) {
      watched->rethrow();
    }
    detail::check(result);
    return done ? std::optional<mediant::answer>(told(answer)) : std::nullopt;
  }
  // How far the search is that was begun; 0 without one.
  mediant::progress progress() const {
    mediant::progress progress;
    detail::check(mediant_planner_progress(handle_, &progress.expansions, &progress.lower_bound));
    return progress;
  }
  // The best path so far of the search that was begun. No points without a search.
  std::vector<point> best() const {
    return all([&](point *points, std::size_t room, std::size_t *count) {
      return mediant_planner_best(handle_, points, room, count);
    });
  }
  // The path by which the search that was begun has reached a vertex; no points where it has not.
  std::vector<point> path_to(point at) const {
    return all([&](point *points, std::size_t room, std::size_t *count) {
      return mediant_planner_path_to(handle_, at, points, room, count);
    });
  }

  // Continues on another index of the same engine and motion, such as a repaired one.
  void follow(const Index &index) { detail::check(mediant_planner_follow(handle_, index.handle())); }
  // The name of the engine that answered the last query.
  std::string searched_by() const {
    return detail::one<const char *>(
        [&](auto *engine) { return mediant_planner_searched_by(handle_, engine); });
  }
  // The lengths of the paths to each of many goals; infinity where none leads.
  std::vector<double> distances(point start, const Goals &goals) {
    std::vector<double> lengths(goals.size());
    std::size_t count = 0;
    detail::check(
        mediant_planner_distances(handle_, start, goals.handle(), lengths.data(), lengths.size(), &count));
    return lengths;
  }
  // The goal to which the path is shortest; none if there is no way to any.
  std::optional<mediant::nearest> nearest(point start, const Goals &goals) {
    mediant::nearest nearest;
    detail::check(mediant_planner_nearest(handle_, start, goals.handle(), &nearest.goal, &nearest.length));
    return std::isinf(nearest.length) ? std::nullopt : std::optional<mediant::nearest>(nearest);
  }

private:
  template <class Write> static std::vector<point> all(const Write &write) {
    return detail::all<point>(write);
  }

  mediant::answer told(const mediant_answer &raw) const {
    mediant::answer answer = detail::told(raw);
    answer.points.resize(raw.point_count);
    std::size_t count = 0;
    detail::check(mediant_planner_points(handle_, answer.points.data(), raw.point_count, &count));
    return answer;
  }

  std::vector<std::unique_ptr<detail::watched>> watched_;
};

} // namespace mediant

#endif
