// Paths on a grid, for Godot 4, as a GDExtension: one map that can be edited, and a planner on it.
//
//   var grid := MediantGrid.new()
//   grid.create(Vector2i(64, 64), solid, "neighbors=8 corners=never")
//   var path := grid.find_path(Vector2(3, 4), Vector2(60, 50), true)
//
// Godot is compiled without exceptions, so it takes mediant.h: mistakes are codes, and are told in the console.
#include <mediant.h>

#include <gdextension_interface.h>
#include <godot_cpp/classes/ref_counted.hpp>
#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/core/error_macros.hpp>
#include <godot_cpp/godot.hpp>

using namespace godot;

// Whether a call did what it should; else Godot is told.
static bool done(mediant_code code) {
  ERR_FAIL_COND_V_MSG(code != MEDIANT_CODE_OK, false, String::utf8(mediant_message()));
  return true;
}

static mediant_point point(Vector2 at) {
  return {at.x, at.y};
}

class MediantGrid : public RefCounted {
  GDCLASS(MediantGrid, RefCounted)

public:
  ~MediantGrid() override { free_all(); }

  // A byte for each cell, row by row: 0 is free. The motion is a text of parameters, as "k=any gap=closed".
  bool create(Vector2i size, const PackedByteArray &solid, const String &motion) {
    ERR_FAIL_COND_V_MSG(mediant_interface() != MEDIANT_INTERFACE, false, "libmediant has another interface");
    ERR_FAIL_COND_V_MSG(size.x < 0 || size.y < 0 || solid.size() != int64_t{size.x} * size.y, false,
                        "solid: a byte for each cell is needed");
    free_all();
    motion_ = motion.utf8();
    return done(mediant_map_new(size.x, size.y, solid.ptr(), &map_)) &&
           done(mediant_space_new(map_, motion_.get_data(), &space_)) &&
           done(mediant_index_prepare(space_, nullptr, nullptr, &index_)) &&
           done(mediant_planner_new(index_, &planner_));
  }

  // Blocks and frees the cells of a rectangle: a byte for each, row by row.
  bool set_solid(Rect2i region, const PackedByteArray &solid) {
    ERR_FAIL_COND_V_MSG(region.position.x < 0 || region.position.y < 0 || region.size.x < 0 || region.size.y < 0 ||
                            solid.size() != int64_t{region.size.x} * region.size.y,
                        false, "solid: a byte for each cell of the region is needed");
    mediant_area area = {uint32_t(region.position.x), uint32_t(region.position.y), uint32_t(region.size.x),
                         uint32_t(region.size.y)};
    mediant_map map{};
    mediant_space space{};
    mediant_index index{};
    bool is_done = done(mediant_map_edit(map_, area, solid.ptr(), &map)) &&
                   done(mediant_space_new(map, motion_.get_data(), &space)) &&
                   done(mediant_index_repair(index_, space, &index)) &&
                   done(mediant_planner_follow(planner_, index));
    if (is_done) {
      SWAP(map, map_);
      SWAP(space, space_);
      SWAP(index, index_);
    }
    // The old ones, or after a mistake the new ones.
    mediant_index_free(index);
    mediant_space_free(space);
    mediant_map_free(map);
    return is_done;
  }

  // The turns of the shortest path, with its ends; empty without one. With allow_partial it leads to the
  // reachable place that is nearest then, and ends that are solid are moved to a free place.
  PackedVector2Array find_path(Vector2 from, Vector2 to, bool allow_partial) {
    mediant_point start = point(from), goal = point(to);
    mediant_answer answer;
    const char *wishes = allow_partial ? "nearest snap" : nullptr;
    if (!done(mediant_planner_find(planner_, &start, 1, &goal, 1, wishes, nullptr, &answer))) {
      return {};
    }
    LocalVector<mediant_point> points;
    points.resize(answer.points);
    size_t count = 0;
    if (!done(mediant_planner_points(planner_, points.ptr(), points.size(), &count))) {
      return {};
    }
    PackedVector2Array path;
    path.resize(count);
    Vector2 *to_points = path.ptrw();
    for (size_t i = 0; i < count; i++) {
      to_points[i] = Vector2(points[i].x, points[i].y);
    }
    return path;
  }

protected:
  static void _bind_methods() {
    ClassDB::bind_method(D_METHOD("create", "size", "solid", "motion"), &MediantGrid::create, DEFVAL(""));
    ClassDB::bind_method(D_METHOD("set_solid", "region", "solid"), &MediantGrid::set_solid);
    ClassDB::bind_method(D_METHOD("find_path", "from", "to", "allow_partial"), &MediantGrid::find_path, DEFVAL(false));
  }

private:
  // Of a handle that is {0} nothing is freed.
  void free_all() {
    mediant_planner_free(planner_);
    mediant_index_free(index_);
    mediant_space_free(space_);
    mediant_map_free(map_);
    planner_ = {};
    index_ = {};
    space_ = {};
    map_ = {};
  }

  mediant_map map_{};
  mediant_space space_{};
  mediant_index index_{};
  mediant_planner planner_{};
  CharString motion_;
};

static void begin(ModuleInitializationLevel level) {
  if (level == MODULE_INITIALIZATION_LEVEL_SCENE) {
    GDREGISTER_CLASS(MediantGrid);
  }
}

static void end(ModuleInitializationLevel) {}

extern "C" GDExtensionBool GDE_EXPORT mediant_grid_init(GDExtensionInterfaceGetProcAddress get_address,
                                                        GDExtensionClassLibraryPtr library,
                                                        GDExtensionInitialization *initialization) {
  GDExtensionBinding::InitObject object(get_address, library, initialization);
  object.register_initializer(begin);
  object.register_terminator(end);
  object.set_minimum_library_initialization_level(MODULE_INITIALIZATION_LEVEL_SCENE);
  return object.init();
}
