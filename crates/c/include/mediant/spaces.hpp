// Maps, spaces and fields of mediant.hpp.
#ifndef MEDIANT_SPACES_HPP
#define MEDIANT_SPACES_HPP

#include "values.hpp"

namespace mediant {

// Columns and rows.
struct extent {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

namespace detail {

// A path that the library found for a single question.
class one_path : public held<mediant_batch, mediant_batch_free> {
public:
  explicit one_path(mediant_batch handle) noexcept : held(handle) {}
  // Its points; none where none leads.
  std::vector<point> points() const { return {raw().points, raw().points + raw().firsts[1]}; }
  double length() const { return raw().lengths[0]; }

private:
  mediant_paths raw() const {
    return one<mediant_paths>([&](mediant_paths *paths) { return mediant_batch_paths(handle_, paths); });
  }
};

} // namespace detail

// A map: which cells are blocked, and what they cost. It never changes.
class Map : public detail::held<mediant_map, mediant_map_free> {
public:
  // Takes over a handle.
  explicit Map(mediant_map handle) noexcept : held(handle) {}
  // A map without obstacles.
  Map(std::uint32_t width, std::uint32_t height) {
    detail::check(mediant_map_new(width, height, nullptr, &handle_));
  }
  // Of a number for each cell, row by row: 0 is free, all else blocked.
  Map(std::uint32_t width, std::uint32_t height, view<std::uint8_t> blocked) {
    detail::require(detail::has(blocked.size(), width, height), "blocked: a number for each cell is needed");
    detail::check(mediant_map_new(width, height, blocked.data(), &handle_));
  }
  // Of bits, row by row without padding, in each byte the least significant one first; 1 is free.
  static Map from_bits(std::uint32_t width, std::uint32_t height, view<std::uint8_t> free) {
    auto bytes = (std::uint64_t{width} * height + 7) / 8;
    detail::require(free.size() == bytes, "free: a bit for each cell is needed");
    return detail::made<Map>(
        [&](mediant_map *map) { return mediant_map_from_bits(width, height, free.data(), map); });
  }
  // Of a file: a .map of MovingAI, a picture (PNG, PGM), or the YAML of a ROS map. The path is UTF-8.
  static Map open(const std::string &path) {
    return detail::made<Map>([&](mediant_map *map) { return mediant_map_open(detail::text(path), map); });
  }
  // Of rows of text, ended by line breaks: ".", "G" and "S" are free, "@", "O", "T", "W" and "#" blocked.
  static Map parse(const std::string &rows) {
    return detail::made<Map>([&](mediant_map *map) { return mediant_map_parse(detail::text(rows), map); });
  }

  extent size() const {
    extent size;
    detail::check(mediant_map_size(handle_, &size.width, &size.height));
    return size;
  }
  // All cells, row by row: 0 is free, 1 blocked.
  std::vector<std::uint8_t> cells() const {
    std::vector<std::uint8_t> cells(count());
    detail::check(mediant_map_cells(handle_, cells.data(), cells.size()));
    return cells;
  }
  // Whether a cell is blocked. All outside the map is.
  bool is_blocked(cell at) const {
    return detail::one<std::int32_t>([&](auto *is) { return mediant_map_is_blocked(handle_, at, is); }) != 0;
  }
  // This map with other cells in a rectangle: a number for each, row by row, 0 for free.
  Map edit(area where, view<std::uint8_t> blocked) const {
    detail::require(detail::has(blocked.size(), where.width, where.height),
                    "blocked: a number for each cell of the area is needed");
    return detail::made<Map>(
        [&](mediant_map *map) { return mediant_map_edit(handle_, where, blocked.data(), map); });
  }
  // This map with other scattered cells: each is blocked where its number is not 0.
  Map edit_cells(view<cell> cells, view<std::uint8_t> blocked) const {
    detail::require(cells.size() == blocked.size(), "blocked: a number for each cell is needed");
    return detail::made<Map>([&](mediant_map *map) {
      return mediant_map_edit_cells(handle_, cells.data(), blocked.data(), cells.size(), map);
    });
  }
  // This map with a cost a unit of length for each cell, row by row.
  Map costs(view<double> costs) const {
    return detail::made<Map>(
        [&](mediant_map *map) { return mediant_map_costs(handle_, costs.data(), costs.size(), map); });
  }
  // This map, which has costs, with other ones of scattered cells: NaN blocks one, a number frees it.
  Map edit_costs(view<cell> cells, view<double> costs) const {
    detail::require(cells.size() == costs.size(), "costs: a number for each cell is needed");
    return detail::made<Map>([&](mediant_map *map) {
      return mediant_map_edit_costs(handle_, cells.data(), costs.data(), cells.size(), map);
    });
  }
  // The map of a disc: free where one with this radius, in cells, fits around the vertex.
  Map for_disc(double radius, const std::string &motion = {}) const {
    return detail::made<Map>(
        [&](mediant_map *map) { return mediant_map_for_disc(handle_, radius, detail::text(motion), map); });
  }
  // The map of an agent that covers n × n cells; its place is its top left cell.
  Map for_square(std::uint32_t n) const {
    return detail::made<Map>([&](mediant_map *map) { return mediant_map_for_square(handle_, n, map); });
  }
  // The distance of each cell's center to the nearest obstacle, row by row.
  std::vector<double> clearance() const {
    std::vector<double> distances(count());
    detail::check(mediant_map_clearance(handle_, distances.data(), distances.size()));
    return distances;
  }
  // A path from any of several starts to any of several goals, in one call, by parameters of all kinds:
  // "k=any gap=closed nearest". For many paths prepare an index.
  mediant::answer find(view<point> starts, view<point> goals, const std::string &words = {},
                       const watcher &watch = {}) const {
    detail::watched watched(watch);
    mediant_answer raw{};
    auto path = detail::made<detail::one_path>(
        [&](mediant_batch *path) {
          return mediant_map_find(handle_, starts.data(), starts.size(), goals.data(), goals.size(),
                                  detail::text(words), watched.get(), path, &raw);
        },
        &watched);
    mediant::answer answer = detail::told(raw);
    answer.points = path.points();
    return answer;
  }
  mediant::answer find(point start, point goal, const std::string &words = {},
                       const watcher &watch = {}) const {
    return find(view<point>(&start, 1), view<point>(&goal, 1), words, watch);
  }

private:
  std::size_t count() const {
    auto [width, height] = size();
    return std::size_t{width} * height;
  }
};

// A path that keeps off obstacles, and its least distance to them, in cells.
struct wide_path {
  std::vector<point> points;
  double radius = 0;
};

// An engine, and a sentence that says why it is the best one.
struct choice {
  std::string engine;
  std::string why;
};

// A map with rules of motion: what is searched. It never changes.
class Space : public detail::held<mediant_space, mediant_space_free> {
public:
  // Takes over a handle.
  explicit Space(mediant_space handle) noexcept : held(handle) {}
  // The motion has the parameters k or neighbors, placement, corners, gap, as in "k=any gap=closed". Without
  // any it is eight directions between the centers of cells, without cutting corners.
  explicit Space(const Map &map, const std::string &motion = {}) {
    detail::check(mediant_space_new(map.handle(), detail::text(motion), &handle_));
  }

  // Whether a path may stand on a point.
  bool is_free(point at) const {
    return detail::one<std::int32_t>([&](auto *is) { return mediant_space_is_free(handle_, at, is); }) != 0;
  }
  // Whether there is a path between two points, in constant time.
  bool connected(point from, point to) const {
    return detail::one<std::int32_t>(
               [&](auto *is) { return mediant_space_connected(handle_, from, to, is); }) != 0;
  }
  // Whether the straight segment between two points obeys the rules of motion.
  bool sees(point from, point to) const {
    return detail::one<std::int32_t>([&](auto *is) { return mediant_space_sees(handle_, from, to, is); }) !=
           0;
  }
  // Throws an error with MEDIANT_CODE_BROKEN_PATH unless a path obeys the rules of motion, at any angle.
  void check(view<point> path) const {
    detail::check(mediant_space_check(handle_, path.data(), path.size()));
  }
  // Whether it does.
  bool holds(view<point> path) const {
    mediant_code result = mediant_space_check(handle_, path.data(), path.size());
    if (result != MEDIANT_CODE_BROKEN_PATH) {
      detail::check(result);
    }
    return result == MEDIANT_CODE_OK;
  }
  // A path of a single question, without an index; none where none leads.
  std::optional<mediant::path> path(point start, point goal, const watcher &watch = {}) const {
    detail::watched watched(watch);
    auto found = detail::made<detail::one_path>(
        [&](mediant_batch *path) {
          return mediant_space_path(handle_, start, goal, watched.get(), path);
        },
        &watched);
    mediant::path path{found.points(), found.length()};
    return path.points.empty() ? std::nullopt : std::optional<mediant::path>(std::move(path));
  }
  // The path that keeps as far off obstacles as one can that is at most so much longer than the shortest: 0.2
  // is a fifth.
  std::optional<wide_path> widest_path(cell start, cell goal, double surplus,
                                       const watcher &watch = {}) const {
    detail::watched watched(watch);
    wide_path path;
    path.points = detail::made<detail::one_path>(
                      [&](mediant_batch *found) {
                        return mediant_space_widest_path(handle_, start, goal, surplus, watched.get(), found,
                                                         &path.radius);
                      },
                      &watched)
                      .points();
    return path.points.empty() ? std::nullopt : std::optional<wide_path>(std::move(path));
  }
  // The engine that is best for so many paths.
  choice engine(std::uint64_t paths) const {
    const char *engine = nullptr;
    choice choice;
    choice.why = detail::words([&](char *why, std::size_t room, std::size_t *length) {
      return mediant_space_engine(handle_, paths, &engine, why, room, length);
    });
    choice.engine = engine;
    return choice;
  }
  // The cells that a path touches.
  std::vector<cell> path_touched_cells(view<point> path) const {
    return detail::all<cell>([&](cell *cells, std::size_t room, std::size_t *total) {
      return mediant_path_touched_cells(handle_, path.data(), path.size(), cells, room, total);
    });
  }
};

// Every vertex on a path, where its points are the turns alone. A path with points between vertices has none.
inline std::vector<cell> path_vertices(view<point> path) {
  return detail::all<cell>([&](cell *vertices, std::size_t room, std::size_t *total) {
    return mediant_path_vertices(path.data(), path.size(), vertices, room, total);
  });
}

// Points on a path, evenly spaced by so many cells, and its last one.
inline std::vector<point> path_spaced(view<point> path, double spacing) {
  return detail::all<point>([&](point *spaced, std::size_t room, std::size_t *total) {
    return mediant_path_spaced(path.data(), path.size(), spacing, spaced, room, total);
  });
}

// The distance of every vertex to the nearest source. It never changes.
class Field : public detail::held<mediant_field, mediant_field_free> {
public:
  // Takes over a handle.
  explicit Field(mediant_field handle) noexcept : held(handle) {}
  // The distances up to a within, in cells (or costs).
  Field(const Space &space, view<point> sources, double within = INFINITY, const watcher &watch = {}) {
    detail::watched watched(watch);
    watched.check(
        mediant_field_new(space.handle(), sources.data(), sources.size(), within, watched.get(), &handle_));
  }
  // The field of the same sources on a changed map of the same motion.
  Field repair(const Space &space) const {
    return detail::made<Field>(
        [&](mediant_field *field) { return mediant_field_repair(handle_, space.handle(), field); });
  }

  // The numbers of vertices in a row, and of rows.
  extent size() const {
    extent size;
    detail::check(mediant_field_size(handle_, &size.width, &size.height));
    return size;
  }
  // The distances of all vertices, row by row; infinity where no path leads.
  std::vector<double> distances() const {
    std::vector<double> distances(count());
    detail::check(mediant_field_distances(handle_, distances.data(), distances.size()));
    return distances;
  }
  // The directions in which the shortest paths leave the vertices: dx, dy of each, row by row; 0, 0 at
  // sources and where no path leads.
  std::vector<float> flow() const {
    std::vector<float> flow(2 * count());
    detail::check(mediant_field_flow(handle_, flow.data(), flow.size()));
    return flow;
  }
  // The distance of a point; infinity where no path leads.
  double get(point at) const {
    return detail::one<double>([&](double *distance) { return mediant_field_get(handle_, at, distance); });
  }
  // The direction in which the shortest path leaves a point; 0, 0 at a source and where no path leads.
  point direction(point at) const {
    return detail::one<point>([&](point *way) { return mediant_field_direction(handle_, at, way); });
  }
  // The vertex to which the shortest path leads next; none at a source and where no path leads.
  std::optional<point> next(point at) const {
    point next{};
    bool there =
        detail::one<std::int32_t>([&](auto *is) { return mediant_field_next(handle_, at, &next, is); });
    return there ? std::optional<point>(next) : std::nullopt;
  }
  // The source that is nearest to a point; none where no path leads.
  std::optional<point> nearest_source(point at) const {
    point source{};
    bool there = detail::one<std::int32_t>(
        [&](auto *is) { return mediant_field_nearest_source(handle_, at, &source, is); });
    return there ? std::optional<point>(source) : std::nullopt;
  }
  // The points of the shortest path from a point to the nearest source; none where no path leads.
  std::vector<point> path_from(point at) const {
    return detail::all<point>([&](point *points, std::size_t room, std::size_t *count) {
      return mediant_field_path_from(handle_, at, points, room, count);
    });
  }

private:
  std::size_t count() const {
    auto [width, height] = size();
    return std::size_t{width} * height;
  }
};

} // namespace mediant

#endif
