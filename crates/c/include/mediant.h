#ifndef MEDIANT_H
#define MEDIANT_H

#include <stddef.h>
#include <stdint.h>

// The first number of the version that this header is of.
#define MEDIANT_VERSION_MAJOR 0

// The second number of the version that this header is of.
#define MEDIANT_VERSION_MINOR 1

// The third number of the version that this header is of.
#define MEDIANT_VERSION_PATCH 0

// The number of the interface that this header describes. It is another one as soon as something of it is
// changed or goes; what is added leaves it.
#define MEDIANT_INTERFACE 1

// The outcome of a call. The numbers stay from version to version; new ones may come.
enum mediant_code
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // It did what it should.
  MEDIANT_CODE_OK = 0,
  // A map with a side of 0, or one that is too long.
  MEDIANT_CODE_MAP_SIZE = 1,
  // A map with rows of different lengths.
  MEDIANT_CODE_MAP_RAGGED = 2,
  // An edit outside the map.
  MEDIANT_CODE_EDIT_OUTSIDE = 3,
  // A k that does not exist, or that nothing is made for.
  MEDIANT_CODE_K = 4,
  // Rules and a k that no engine searches together.
  MEDIANT_CODE_MOTION = 5,
  // The name of an engine, or of a value of an option, that does not exist.
  MEDIANT_CODE_UNKNOWN_NAME = 6,
  // A text that is no setup.
  MEDIANT_CODE_SETUP_TEXT = 7,
  // An option, or a value of it, that the engine does not take.
  MEDIANT_CODE_ENGINE_OPTION = 8,
  // A k that the engine does not take.
  MEDIANT_CODE_ENGINE_K = 9,
  // A placement or rule that the engine does not take.
  MEDIANT_CODE_ENGINE_RULES = 10,
  // Something that the engine does not have: a saved index, or distances.
  MEDIANT_CODE_ENGINE_WITHOUT = 11,
  // Two things that belong to other maps, rules or k.
  MEDIANT_CODE_MISMATCH = 12,
  // A start that is blocked.
  MEDIANT_CODE_START_BLOCKED = 13,
  // A goal that is blocked.
  MEDIANT_CODE_GOAL_BLOCKED = 14,
  // A start outside the map.
  MEDIANT_CODE_START_OUTSIDE = 15,
  // A goal outside the map.
  MEDIANT_CODE_GOAL_OUTSIDE = 16,
  // No path was found, though there is one.
  MEDIANT_CODE_GAVE_UP = 17,
  // An index that cannot be made: too large, or with levels or a side that do not exist.
  MEDIANT_CODE_INDEX_RANGE = 18,
  // An index that does not have the levels, the side or the landmarks that were named.
  MEDIANT_CODE_INDEX_OPTIONS = 19,
  // An index that is damaged, cut short, or none.
  MEDIANT_CODE_INDEX_DAMAGED = 20,
  // An index of another engine, or of another version.
  MEDIANT_CODE_INDEX_ENGINE = 21,
  // A file that does not exist.
  MEDIANT_CODE_FILE_MISSING = 22,
  // A file that cannot be read.
  MEDIANT_CODE_FILE_UNREADABLE = 23,
  // A file that cannot be written.
  MEDIANT_CODE_FILE_UNWRITABLE = 24,
  // A file that is no map.
  MEDIANT_CODE_MAP_FORMAT = 25,
  // A file that is no scenario.
  MEDIANT_CODE_SCENARIO_FORMAT = 26,
  // A query without a start or a goal.
  MEDIANT_CODE_NO_END = 27,
  // An end lies between vertices, for an engine whose paths start and end at vertices.
  MEDIANT_CODE_BETWEEN = 28,
  // A tolerance, a limit, a radius or a spacing that is negative, or no number.
  MEDIANT_CODE_NUMBER = 29,
  // A step of a search that was never begun.
  MEDIANT_CODE_NOT_BEGUN = 30,
  // Memory that there is not.
  MEDIANT_CODE_MEMORY = 31,
  // Work that its watcher stopped.
  MEDIANT_CODE_CANCELLED = 32,
  // Work that a limit stopped: on its time, on cost or expansions.
  MEDIANT_CODE_STOPPED = 33,
  // An argument of another type, or with a value that it cannot have.
  MEDIANT_CODE_ARGUMENT = 34,
  // A path that does not hold on a map.
  MEDIANT_CODE_BROKEN_PATH = 35,
  // A map with a character that is neither free nor blocked, or with characters that cannot be either.
  MEDIANT_CODE_MAP_TILE = 36,
  // A cost or an elevation of a cell that cannot be one, numbers that do not fit together or on the map,
  // or a cell without one.
  MEDIANT_CODE_COST = 37,
  // A handle that is null, was freed, is of another type, or was never made here.
  MEDIANT_CODE_HANDLE = 38,
  // An object that another call is using.
  MEDIANT_CODE_BUSY = 39,
  // A mistake of a kind that has no name yet.
  MEDIANT_CODE_OTHER = 255,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum mediant_code mediant_code;
#else
typedef int32_t mediant_code;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// The status of an answer.
enum mediant_status
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // There is a path.
  MEDIANT_STATUS_FOUND = 0,
  // There is none.
  MEDIANT_STATUS_UNREACHABLE = 1,
  // A path to the reachable vertex nearest to a goal.
  MEDIANT_STATUS_NEAREST = 2,
  // A limit stopped the search.
  MEDIANT_STATUS_STOPPED = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum mediant_status mediant_status;
#else
typedef int32_t mediant_status;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// The limit that stopped a search.
enum mediant_limit
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // None did.
  MEDIANT_LIMIT_NONE = 0,
  // The limit on the cost of the path.
  MEDIANT_LIMIT_COST = 1,
  // The limit on expansions.
  MEDIANT_LIMIT_EXPANSIONS = 2,
  // The time.
  MEDIANT_LIMIT_TIMEOUT = 3,
  // The watcher, which said so.
  MEDIANT_LIMIT_CANCELLED = 4,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum mediant_limit mediant_limit;
#else
typedef int32_t mediant_limit;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// A cell, or a vertex: column and row.
typedef struct {
  // The column, from the left.
  int32_t x;
  // The row, from the top.
  int32_t y;
} mediant_cell;

// A space, prepared for an engine. It never changes; any number of threads may use it. `{0}` is no index.
typedef struct {
  // Its number.
  uint64_t id;
} mediant_index;

// A point: x to the right, y down, in cells. At centers (0, 0) is the middle of the first cell, at corners
// its top left corner. Numbers are rounded to 1/1024; between vertices ends are for any angle alone.
typedef struct {
  // To the right.
  double x;
  // Down.
  double y;
} mediant_point;

// A start and a goal.
typedef struct {
  // The start.
  mediant_point start;
  // The goal.
  mediant_point goal;
} mediant_ends;

// Functions that are called while some work goes on. They may be called from any thread, and must not let
// an exception out. They may call the library, but for the planner whose call they are in: it is busy. Each
// may be null.
typedef struct {
  // Whether to stop: any number but 0 stops the work, which then returns `MEDIANT_CODE_CANCELLED`; a
  // search answers with `MEDIANT_STATUS_STOPPED` and `MEDIANT_LIMIT_CANCELLED`. It is asked some hundred
  // times a second or more, and not again once it has said so.
  int32_t (*stop)(void *data);
  // Is told how much is done of how much, at most some hundred times.
  void (*progress)(void *data, uint64_t done, uint64_t total);
  // Is handed to both.
  void *data;
} mediant_watcher;

// Paths, one after another in three arrays. `{0}` is none.
typedef struct {
  // Its number.
  uint64_t id;
} mediant_batch;

// The paths of a batch. All arrays are the library's, and stay until the batch is freed.
typedef struct {
  // The number of queries.
  size_t count;
  // By query the length of its path; infinity where there is none, NaN for a query with a mistake.
  const double *lengths;
  // By query its code.
  const int32_t *codes;
  // By query the number of its first point, and after the last the number of all: path i has the points
  // from `firsts[i]` up to `firsts[i + 1]`.
  const size_t *firsts;
  // The points of all paths.
  const mediant_point *points;
} mediant_paths;

// Bytes that the library made. `{0}` is none.
typedef struct {
  // Its number.
  uint64_t id;
} mediant_bytes;

// A map with rules of motion: what is searched. It never changes; any number of threads may use it. `{0}`
// is no space.
typedef struct {
  // Its number.
  uint64_t id;
} mediant_space;

// The distance of every vertex to the nearest source. It never changes; any number of threads may use it.
// `{0}` is no field.
typedef struct {
  // Its number.
  uint64_t id;
} mediant_field;

// A map: which cells are blocked, and what they cost. It never changes; any number of threads may use it.
// `{0}` is no map.
typedef struct {
  // Its number.
  uint64_t id;
} mediant_map;

// The answer to a query.
typedef struct {
  // Whether there is a path.
  mediant_status status;
  // The limit that stopped the search, if its status is stopped.
  mediant_limit stopped_by;
  // The number of the path's points; 0 without one.
  size_t point_count;
  // The length of the path that was asked for, in cells, or its cost where cells have costs; infinity
  // where there is none, NaN where the search was stopped.
  double distance;
  // The length of the path that is told, in cells, whatever cells cost; 0 without one.
  double length;
  // A lower bound on `distance`.
  double lower_bound;
  // A lower bound on the length of all paths at any angle; NaN where there is none.
  double any_angle_lower_bound;
} mediant_answer;

// Goals that are prepared for an index. They never change; planners of indexes with the same map and motion
// share them. `{0}` is none.
typedef struct {
  // Its number.
  uint64_t id;
} mediant_goals;

// A rectangle of cells.
typedef struct {
  // The first column.
  uint32_t x;
  // The first row.
  uint32_t y;
  // The number of columns.
  uint32_t width;
  // The number of rows.
  uint32_t height;
} mediant_area;

// Answers queries on an index, one after another. One call at a time may use it: another one at the same
// time returns `MEDIANT_CODE_BUSY`. Each thread makes a planner of its own. `{0}` is no planner.
typedef struct {
  // Its number.
  uint64_t id;
} mediant_planner;

// Cells that count otherwise than on the map, for one query.
typedef struct {
  // Cells that count as blocked.
  const mediant_cell *blocked;
  // The number of these.
  size_t blocked_count;
  // Cells that count as free.
  const mediant_cell *free;
  // The number of these.
  size_t free_count;
  // Whether the cells at start and goal count as free: 1 or 0.
  int32_t free_ends;
} mediant_exceptions;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// The version of the library, as `0.1.0`. It stays for ever.
const char *mediant_version(void);

// The number of the interface that the library has. Where it is not `MEDIANT_INTERFACE`, the program was
// compiled against another one, and must not call anything but this and `mediant_version`.
uint32_t mediant_interface(void);

// The number of objects that were made and not freed, of all kinds: for tests that nothing is forgotten.
size_t mediant_objects(void);

// The moves of N(k), clockwise from (0, 1): as many as there is room for, and how many there are: 2^k.
//
// Required:
// `moves` leads to memory for `room` cells; `count` leads to memory for a number.
mediant_code mediant_moves(uint32_t k,
                           mediant_cell *moves,
                           size_t room,
                           size_t *count);

// The bound of a motion: its shortest paths over the shortest at any angle, at most. 1.08 is 8 %. NaN
// where no bound is proven.
//
// Required:
// `motion` is a text or null; `bound` leads to memory for a number.
mediant_code mediant_bound(const char *motion,
                           double *bound);

// The paths of many queries, by so many threads; 0 is one for each core. A query with a mistake, such as a
// blocked end, has a code of its own. The watcher is told how many queries are done.
//
// Required:
// `ends` leads to `count` pairs; `watcher` is null or leads to one; `batch` leads to a handle's memory.
mediant_code mediant_index_paths(mediant_index index,
                                 const mediant_ends *ends,
                                 size_t count,
                                 size_t threads,
                                 const mediant_watcher *watcher,
                                 mediant_batch *batch);

// The paths of a batch.
//
// Required:
// `paths` leads to memory for it.
mediant_code mediant_batch_paths(mediant_batch batch, mediant_paths *paths);

// Frees a batch.
mediant_code mediant_batch_free(mediant_batch batch);

// Where the bytes are, and how many. They stay until they are freed.
//
// Required:
// `data` leads to memory for a pointer, `size` to a number's.
mediant_code mediant_bytes_data(mediant_bytes bytes, const uint8_t **data, size_t *size);

// Frees bytes.
mediant_code mediant_bytes_free(mediant_bytes bytes);

// The sentence about the last mistake in this thread: it says what to do. Empty before the first one. The
// next mistake in this thread writes over it.
const char *mediant_message(void);

// The name of a code, the same in all languages, such as `start-blocked`; null for a number that is none. It
// stays for ever.
const char *mediant_code_name(int32_t code);

// The distances of all vertices to the nearest source, up to `limit` cells (or costs); infinity is none.
//
// Required:
// `sources` leads to `count` points; `watcher` is null or leads to one; `field` leads to a handle's memory.
mediant_code mediant_field_new(mediant_space space,
                               const mediant_point *sources,
                               size_t count,
                               double limit,
                               const mediant_watcher *watcher,
                               mediant_field *field);

// Frees a field.
mediant_code mediant_field_free(mediant_field field);

// The field of the same sources on a changed map of the same motion, by work that follows the vertices whose
// distances change, where that can be.
//
// Required:
// `repaired` leads to a handle's memory.
mediant_code mediant_field_repair(mediant_field field,
                                  mediant_space space,
                                  mediant_field *repaired);

// The numbers of vertices in a row, and of rows.
//
// Required:
// Both lead to memory for a number.
mediant_code mediant_field_size(mediant_field field, uint32_t *width, uint32_t *height);

// Writes the distances of all vertices, row by row, as many as there is room for; infinity where no path
// leads.
//
// Required:
// `distances` leads to memory for `room` numbers.
mediant_code mediant_field_distances(mediant_field field,
                                     double *distances,
                                     size_t room);

// Writes the directions in which the shortest paths leave the vertices, row by row: dx, dy, of length 1
// together; 0, 0 at sources and where no path leads. As many numbers as there is room for.
//
// Required:
// `flow` leads to memory for `room` numbers.
mediant_code mediant_field_flow(mediant_field field,
                                float *flow,
                                size_t room);

// The distance of a point; infinity where no path leads. Threads that ask one field wait for one another, a
// tenth of a microsecond each time: for many vertices `mediant_field_distances` has them all.
//
// Required:
// `distance` leads to memory for a number.
mediant_code mediant_field_get(mediant_field field,
                               mediant_point at,
                               double *distance);

// The direction in which the shortest path leaves a point; 0, 0 at a source and where no path leads.
//
// Required:
// `direction` leads to memory for a point.
mediant_code mediant_field_direction(mediant_field field,
                                     mediant_point at,
                                     mediant_point *direction);

// The vertex to which the shortest path leads next, and whether there is one: 1, or 0 at a source and where
// no path leads.
//
// Required:
// `next` leads to memory for a point, `there` to a number's.
mediant_code mediant_field_next(mediant_field field,
                                mediant_point at,
                                mediant_point *next,
                                int32_t *there);

// The source that is nearest to a point, and whether there is one: 1, or 0 where no path leads.
//
// Required:
// `source` leads to memory for a point, `there` to a number's.
mediant_code mediant_field_nearest_source(mediant_field field,
                                          mediant_point at,
                                          mediant_point *source,
                                          int32_t *there);

// The shortest path from a point to the nearest source: its points, as many as there is room for, and how
// many there are; 0 where none leads.
//
// Required:
// `points` leads to memory for `room` points; `count` leads to memory for a number.
mediant_code mediant_field_path_from(mediant_field field,
                                     mediant_point at,
                                     mediant_point *points,
                                     size_t room,
                                     size_t *count);

// A path from any of several starts to any of several goals, in one call. Space and engine are chosen by
// what is asked, and kept with the map for the next call. `words` has parameters of all kinds, as in
// `"k=any gap=closed nearest"`; null is none. The path is a batch with this path alone, as that of
// `mediant_space_path`. For many paths prepare an index, and ask a planner.
//
// Required:
// `starts` and `goals` lead to as many points as they have; `words` is a text or null; `watcher` is null or
// leads to one; `path` leads to a handle's memory, `answer` to an answer's.
mediant_code mediant_map_find(mediant_map map,
                              const mediant_point *starts,
                              size_t start_count,
                              const mediant_point *goals,
                              size_t goal_count,
                              const char *words,
                              const mediant_watcher *watcher,
                              mediant_batch *path,
                              mediant_answer *answer);

// Prepares goals that many starts ask for.
//
// Required:
// `points` leads to `count` points; `goals` leads to a handle's memory.
mediant_code mediant_goals_new(mediant_index index,
                               const mediant_point *points,
                               size_t count,
                               mediant_goals *goals);

// Frees goals.
mediant_code mediant_goals_free(mediant_goals goals);

// The lengths of the paths from each of many starts to each of many goals, a row for each start; infinity
// where none leads. On all cores.
//
// Required:
// `starts` and `goals` lead to as many points as they have; `watcher` is null or leads to one; `lengths`
// leads to memory for `start_count` · `goal_count` numbers.
mediant_code mediant_index_table(mediant_index index,
                                 const mediant_point *starts,
                                 size_t start_count,
                                 const mediant_point *goals,
                                 size_t goal_count,
                                 const mediant_watcher *watcher,
                                 double *lengths);

// Prepares an index for many paths. `engine` has the parameters `engine`, its options, and `smooth`, as in
// `"engine=subgoal memory=100MB"`; null is the best engine for what the space is. The watcher is told how
// far each stage is.
//
// Required:
// `engine` is a text or null; `watcher` is null or leads to one; `index` leads to a handle's memory.
mediant_code mediant_index_prepare(mediant_space space,
                                   const char *engine,
                                   const mediant_watcher *watcher,
                                   mediant_index *index);

// Reads an index that `mediant_index_save` wrote, of the same map. `options` are those of its engine; null
// is as it was prepared.
//
// Required:
// `path` is a text, `options` one or null; `index` leads to a handle's memory.
mediant_code mediant_index_load(mediant_map map,
                                const char *path,
                                const char *options,
                                mediant_index *index);

// The index of bytes that `mediant_index_to_bytes` gave, of the same map.
//
// Required:
// `bytes` leads to `size` bytes; `options` is a text or null; `index` leads to a handle's memory.
mediant_code mediant_index_from_bytes(mediant_map map,
                                      const uint8_t *bytes,
                                      size_t size,
                                      const char *options,
                                      mediant_index *index);

// Writes an index to a file. The file is whole or not there.
//
// Required:
// `path` is a text.
mediant_code mediant_index_save(mediant_index index, const char *path);

// The index as bytes.
//
// Required:
// `bytes` leads to a handle's memory.
mediant_code mediant_index_to_bytes(mediant_index index, mediant_bytes *bytes);

// Frees an index. Its planners stay.
mediant_code mediant_index_free(mediant_index index);

// The index for a changed map of the same motion, repaired by work that follows the difference of the maps.
// This index stays as it is.
//
// Required:
// `repaired` leads to a handle's memory.
mediant_code mediant_index_repair(mediant_index index,
                                  mediant_space space,
                                  mediant_index *repaired);

// This index with all that a repair left made anew, which takes as long as to prepare it: do it after some
// edits, in another thread.
//
// Required:
// `watcher` is null or leads to one; `finished` leads to a handle's memory.
mediant_code mediant_index_finish(mediant_index index,
                                  const mediant_watcher *watcher,
                                  mediant_index *finished);

// The space of an index, such as of one that was loaded: another handle of the same space. Threads that look
// up one handle wait for one another, for a moment each; with one of its own a thread does not.
//
// Required:
// `space` leads to a handle's memory.
mediant_code mediant_index_space(mediant_index index,
                                 mediant_space *space);

// Whether nothing of an index is that of an earlier map: 1 or 0.
//
// Required:
// `finished` leads to memory for a number.
mediant_code mediant_index_is_finished(mediant_index index, int32_t *finished);

// The memory that an index takes beyond its space, in bytes.
//
// Required:
// `bytes` leads to memory for a number.
mediant_code mediant_index_memory(mediant_index index, uint64_t *bytes);

// The engine, motion and options of an index as a text, ended by 0: as much as there is room for, always
// ended; and its whole length without the end.
//
// Required:
// `text` leads to memory for `room` bytes; `length` leads to memory for a number.
mediant_code mediant_index_setup(mediant_index index,
                                 char *text,
                                 size_t room,
                                 size_t *length);

// The bound of an index: its paths over the shortest at any angle, at most. 1.08 is 8 %. NaN where no
// bound is proven.
//
// Required:
// `bound` leads to memory for a number.
mediant_code mediant_index_bound(mediant_index index,
                                 double *bound);

// Reads a map from a file: a `.map` of `MovingAI`, a picture (PNG, PGM), or the YAML of a ROS map.
//
// Required:
// `path` is a text; `map` leads to a handle's memory.
mediant_code mediant_map_open(const char *path, mediant_map *map);

// Makes a map of rows of text, ended by line breaks: `.`, `G` and `S` are free, `@`, `O`, `T`, `W` and `#`
// blocked.
//
// Required:
// `rows` is a text; `map` leads to a handle's memory.
mediant_code mediant_map_parse(const char *rows,
                               mediant_map *map);

// Makes a map of bytes, row by row: 0 is free, all else blocked. Null is a map without obstacles.
//
// Required:
// `blocked` is null or leads to `width` · `height` bytes; `map` leads to a handle's memory.
mediant_code mediant_map_new(uint32_t width,
                             uint32_t height,
                             const uint8_t *blocked,
                             mediant_map *map);

// Makes a map of bits, row by row without padding: bit i is in byte i / 8, the least significant one first;
// 1 is free.
//
// Required:
// `free` leads to (`width` · `height` + 7) / 8 bytes; `map` leads to a handle's memory.
mediant_code mediant_map_from_bits(uint32_t width,
                                   uint32_t height,
                                   const uint8_t *free,
                                   mediant_map *map);

// Frees a map. What was made of it stays.
mediant_code mediant_map_free(mediant_map map);

// The numbers of columns and of rows.
//
// Required:
// `width` and `height` lead to memory for a number each.
mediant_code mediant_map_size(mediant_map map, uint32_t *width, uint32_t *height);

// Writes all cells, row by row: 0 is free, 1 blocked; as many as there is room for.
//
// Required:
// `blocked` leads to memory for `room` bytes.
mediant_code mediant_map_cells(mediant_map map, uint8_t *blocked, size_t room);

// Whether a cell is blocked: 1 or 0. All outside the map is. Threads that ask one map wait for one another,
// a tenth of a microsecond each time: for many cells `mediant_map_cells` has them all.
//
// Required:
// `blocked` leads to memory for a number.
mediant_code mediant_map_is_blocked(mediant_map map,
                                    mediant_cell cell,
                                    int32_t *blocked);

// This map with other cells in a rectangle: `blocked` has a byte for each of its cells, row by row, 0 for
// free; those beyond the map are left out. The work follows the rectangle, and the maps share the rest.
//
// Required:
// `blocked` leads to a byte for each cell of the area; `edited` leads to a handle's memory.
mediant_code mediant_map_edit(mediant_map map,
                              mediant_area area,
                              const uint8_t *blocked,
                              mediant_map *edited);

// This map with other scattered cells: each is blocked where its byte is not 0, and else free.
//
// Required:
// `cells` and `blocked` lead to `count` values each; `edited` leads to a handle's memory.
mediant_code mediant_map_edit_cells(mediant_map map,
                                    const mediant_cell *cells,
                                    const uint8_t *blocked,
                                    size_t count,
                                    mediant_map *edited);

// This map with a cost a unit of length for each cell, row by row: a positive number; those of blocked cells
// do not matter.
//
// Required:
// `costs` leads to a number for each cell; `priced` leads to a handle's memory.
mediant_code mediant_map_costs(mediant_map map,
                               const double *costs,
                               size_t count,
                               mediant_map *priced);

// This map, which has costs, with other ones of scattered cells: a cell with a number is free, one with NaN
// blocked.
//
// Required:
// `cells` and `costs` lead to `count` values each; `edited` leads to a handle's memory.
mediant_code mediant_map_edit_costs(mediant_map map,
                                    const mediant_cell *cells,
                                    const double *costs,
                                    size_t count,
                                    mediant_map *edited);

// The map of a disc: free where one with this radius, in cells, fits around the vertex. `motion` as for
// `mediant_space_new`.
//
// Required:
// `motion` is a text or null; `fitted` leads to a handle's memory.
mediant_code mediant_map_for_disc(mediant_map map,
                                  double radius,
                                  const char *motion,
                                  mediant_map *fitted);

// The map of an agent that covers n × n cells; its place is its top left cell.
//
// Required:
// `fitted` leads to a handle's memory.
mediant_code mediant_map_for_square(mediant_map map, uint32_t n, mediant_map *fitted);

// Writes the distance of each cell's center to the nearest obstacle, in cells, row by row: 0 in blocked
// cells; as many as there is room for. The outside is an obstacle.
//
// Required:
// `distances` leads to memory for `room` numbers.
mediant_code mediant_map_clearance(mediant_map map,
                                   double *distances,
                                   size_t room);

// A path of a single question, without an index, by the engine that is best for one path: as a batch with
// this path alone, so that however many points it has, it is found once.
//
// Required:
// `watcher` is null or leads to one; `path` leads to a handle's memory.
mediant_code mediant_space_path(mediant_space space,
                                mediant_point start,
                                mediant_point goal,
                                const mediant_watcher *watcher,
                                mediant_batch *path);

// The path that keeps as far off obstacles as one can that is at most so much longer than the shortest: 0.2
// is a fifth. As a batch with this path alone, as `mediant_space_path`; and its least distance to obstacles,
// in cells, NaN where there is no path.
//
// Required:
// As for `mediant_space_path`; `radius` leads to memory for a number.
mediant_code mediant_space_widest_path(mediant_space space,
                                       mediant_cell start,
                                       mediant_cell goal,
                                       double surplus,
                                       const mediant_watcher *watcher,
                                       mediant_batch *path,
                                       double *radius);

// The name of the engine that is best for so many paths in this space, and a sentence that says why.
//
// Required:
// `engine` leads to memory for a pointer; `why` to `room` bytes, `length` to a number's.
mediant_code mediant_space_engine(mediant_space space,
                                  uint64_t paths,
                                  const char **engine,
                                  char *why,
                                  size_t room,
                                  size_t *length);

// Every vertex on a path, where its points are the turns alone: as many as there is room for, and how many
// there are. A path with points between vertices has none.
//
// Required:
// `points` leads to `count` points, `vertices` to memory for `room` cells, `total` to a number's.
mediant_code mediant_path_vertices(const mediant_point *points,
                                   size_t count,
                                   mediant_cell *vertices,
                                   size_t room,
                                   size_t *total);

// The cells that a path touches in a space, with blocked ones beside it and ones outside the map: as many as
// there is room for, and how many there are.
//
// Required:
// As for `mediant_path_vertices`.
mediant_code mediant_path_touched_cells(mediant_space space,
                                        const mediant_point *points,
                                        size_t count,
                                        mediant_cell *cells,
                                        size_t room,
                                        size_t *total);

// Points on a path, evenly spaced by so many cells, and its last one: as many as there is room for, and how
// many there are.
//
// Required:
// `points` leads to `count` points, `spaced` to memory for `room` points, `total` to a number's.
mediant_code mediant_path_spaced(const mediant_point *points,
                                 size_t count,
                                 double spacing,
                                 mediant_point *spaced,
                                 size_t room,
                                 size_t *total);

// A planner on an index, with scratch memory of its own.
//
// Required:
// `planner` leads to a handle's memory.
mediant_code mediant_planner_new(mediant_index index, mediant_planner *planner);

// Frees a planner.
mediant_code mediant_planner_free(mediant_planner planner);

// The shortest path between two points: writes its points, as many as there is room for, how many there are
// (0 where there is no path), and its length (infinity then; where cells have costs, its cost). With more
// points than room, `mediant_planner_points` has all of them.
//
// Required:
// `points` leads to memory for `room` points; `count` and `length` lead to memory for a number each.
mediant_code mediant_planner_path(mediant_planner planner,
                                  mediant_point start,
                                  mediant_point goal,
                                  mediant_point *points,
                                  size_t room,
                                  size_t *count,
                                  double *length);

// The points of the path that the planner found last: of `mediant_planner_path`, `_find`, `_step`,
// `_find_except`. Any query forgets it first.
//
// Required:
// `points` leads to memory for `room` points; `count` leads to memory for a number.
mediant_code mediant_planner_points(mediant_planner planner,
                                    mediant_point *points,
                                    size_t room,
                                    size_t *count);

// Answers a query from any of several starts to any of several goals. `wishes` has the parameters `nearest`,
// `snap`, `tolerance`, `max_cost`, `max_expansions`, `timeout` (in milliseconds), as in
// `"nearest max_cost=20"`; null is none. `mediant_planner_points` has the path.
//
// Required:
// `starts` and `goals` lead to as many points as they have; `wishes` is a text or null; `watcher` is null or
// leads to one; `answer` leads to an answer's memory.
mediant_code mediant_planner_find(mediant_planner planner,
                                  const mediant_point *starts,
                                  size_t start_count,
                                  const mediant_point *goals,
                                  size_t goal_count,
                                  const char *wishes,
                                  const mediant_watcher *watcher,
                                  mediant_answer *answer);

// The length of the path between two points, without the path: infinity where there is none.
//
// Required:
// `length` leads to memory for a number.
mediant_code mediant_planner_distance(mediant_planner planner,
                                      mediant_point start,
                                      mediant_point goal,
                                      double *length);

// Begins a search, and forgets the last one. Nothing is expanded yet. Any other query of this planner
// forgets it. What a watcher calls, and its data, must stay until the search has answered or is forgotten.
//
// Required:
// As for `mediant_planner_find`.
mediant_code mediant_planner_begin(mediant_planner planner,
                                   const mediant_point *starts,
                                   size_t start_count,
                                   const mediant_point *goals,
                                   size_t goal_count,
                                   const char *wishes,
                                   const mediant_watcher *watcher);

// Continues the search by at most so many expansions, and writes whether it has answered: 1 or 0. The answer
// is written then.
//
// Required:
// `done` leads to memory for a number, `answer` to an answer's.
mediant_code mediant_planner_step(mediant_planner planner,
                                  uint64_t expansions,
                                  int32_t *done,
                                  mediant_answer *answer);

// The progress of the search that was begun: the number of its expansions, and a lower bound on the length
// of the path that is sought. 0 without one.
//
// Required:
// Both lead to memory for a number.
mediant_code mediant_planner_progress(mediant_planner planner,
                                      uint64_t *expansions,
                                      double *lower_bound);

// The best path so far of the search that was begun: to a goal, if one was found, else to the vertex nearest
// to a goal among those that it expanded. No points without a search.
//
// Required:
// As for `mediant_planner_points`.
mediant_code mediant_planner_best(mediant_planner planner,
                                  mediant_point *points,
                                  size_t room,
                                  size_t *count);

// The path by which the search that was begun has reached a vertex; no points where it has not.
//
// Required:
// As for `mediant_planner_points`.
mediant_code mediant_planner_path_to(mediant_planner planner,
                                     mediant_point at,
                                     mediant_point *points,
                                     size_t room,
                                     size_t *count);

// Continues on another index of the same engine and motion, such as a repaired one, with the same scratch
// memory. The last path and the search that was begun are forgotten.
mediant_code mediant_planner_follow(mediant_planner planner,
                                    mediant_index index);

// The name of the engine that answered the last query. It stays for ever.
//
// Required:
// `engine` leads to memory for a pointer.
mediant_code mediant_planner_searched_by(mediant_planner planner, const char **engine);

// The lengths of the paths to each of many goals, in their order, as many as there is room for, and how many
// there are; infinity where none leads.
//
// Required:
// `lengths` leads to memory for `room` numbers; `count` leads to memory for a number.
mediant_code mediant_planner_distances(mediant_planner planner,
                                       mediant_point start,
                                       mediant_goals goals,
                                       double *lengths,
                                       size_t room,
                                       size_t *count);

// The goal to which the path is shortest, by its number, and the length of that path: infinity if there is
// no way to any.
//
// Required:
// `goal` and `length` lead to memory for a number each.
mediant_code mediant_planner_nearest(mediant_planner planner,
                                     mediant_point start,
                                     mediant_goals goals,
                                     size_t *goal,
                                     double *length);

// Answers a query as on the map with some cells edited: as `mediant_planner_find`.
//
// Required:
// As for `mediant_planner_find`; `exceptions` leads to one, whose arrays have as many cells as it says.
mediant_code mediant_planner_find_except(mediant_planner planner,
                                         const mediant_point *starts,
                                         size_t start_count,
                                         const mediant_point *goals,
                                         size_t goal_count,
                                         const mediant_exceptions *exceptions,
                                         const char *wishes,
                                         const mediant_watcher *watcher,
                                         mediant_answer *answer);

// A map with rules of motion: `motion` has the parameters `k` or `neighbors`, `placement`, `corners`, `gap`,
// as in `"k=any gap=closed"`. Null is eight directions between the centers of cells, without cutting
// corners.
//
// Required:
// `motion` is a text or null; `space` leads to a handle's memory.
mediant_code mediant_space_new(mediant_map map,
                               const char *motion,
                               mediant_space *space);

// Frees a space. What was made of it stays.
mediant_code mediant_space_free(mediant_space space);

// Whether a path may stand on a point: 1 or 0.
//
// Required:
// `free` leads to memory for a number.
mediant_code mediant_space_is_free(mediant_space space, mediant_point at, int32_t *free);

// Whether there is a path between two points: 1 or 0, in constant time.
//
// Required:
// `connected` leads to memory for a number.
mediant_code mediant_space_connected(mediant_space space,
                                     mediant_point from,
                                     mediant_point to,
                                     int32_t *connected);

// Whether the straight segment between two points obeys the rules of motion: 1 or 0. It is judged for
// itself: a closed gap that it passes is in its way, one at which it begins or ends is not.
//
// Required:
// `seen` leads to memory for a number.
mediant_code mediant_space_sees(mediant_space space,
                                mediant_point from,
                                mediant_point to,
                                int32_t *seen);

// Checks whether a path obeys the rules of motion, at any angle: so whether it still holds after an edit. If
// it does not, the code is `MEDIANT_CODE_BROKEN_PATH`, and the message names the segment and the first
// blocked cell on it.
//
// Required:
// `points` leads to `count` points.
mediant_code mediant_space_check(mediant_space space,
                                 const mediant_point *points,
                                 size_t count);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* MEDIANT_H */
