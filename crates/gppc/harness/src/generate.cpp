#include "generate.h"
#include "random.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace harness {

namespace {

struct Area {
  int x, y, width, height;
};

// Paints a map, and tells of what it painted by patches.
class Painter {
public:
  Painter(std::uint64_t seed, int width, int height) : random(seed), now(width, height, true), timeline_() {
    timeline_.width = width;
    timeline_.height = height;
  }

  int width() const { return now.width(); }
  int height() const { return now.height(); }

  void fill(Area area, bool free) {
    for (int y = area.y; y < area.y + area.height; ++y) {
      for (int x = area.x; x < area.x + area.width; ++x) {
        if (now.holds(x, y)) {
          now.set(x, y, free);
        }
      }
    }
  }
  // Walls along the border of an area.
  void frame(Area area) {
    fill({area.x, area.y, area.width, 1}, false);
    fill({area.x, area.y + area.height - 1, area.width, 1}, false);
    fill({area.x, area.y, 1, area.height}, false);
    fill({area.x + area.width - 1, area.y, 1, area.height}, false);
  }
  void speckle(Area area, int percent) {
    for (int y = area.y; y < area.y + area.height; ++y) {
      for (int x = area.x; x < area.x + area.width; ++x) {
        if (now.holds(x, y)) {
          now.set(x, y, !random.chance(percent));
        }
      }
    }
  }
  Area area(int most) {
    int w = random.between(1, std::min(most, width())), h = random.between(1, std::min(most, height()));
    return {random.between(0, width() - w), random.between(0, height() - h), w, h};
  }
  Area whole() const { return {0, 0, width(), height()}; }

  // A patch of the map as it is now; what does not lie on the map is left out.
  void tell(Area area) {
    int x = std::max(area.x, 0), y = std::max(area.y, 0);
    int w = std::min(area.x + area.width, width()) - x, h = std::min(area.y + area.height, height()) - y;
    if (w > 0 && h > 0) {
      changes_.push_back({timeline_.patches.size(), {x, y}});
      timeline_.patches.push_back(now.part({x, y}, w, h));
    }
  }

  void ask(bool free_ends) {
    Query query;
    query.number = timeline_.queries.size();
    query.changes.swap(changes_);
    query.start = end(free_ends);
    query.goal = random.chance(4) ? query.start : end(free_ends);
    timeline_.queries.push_back(query);
  }

  Timeline finish(const std::string &name, std::uint64_t seed, std::size_t number) {
    timeline_.name = name;
    timeline_.which = name + ", --seed " + std::to_string(seed) + ", number " + std::to_string(number);
    return timeline_;
  }

  Random random;
  Map now;

private:
  // Any cell now and then, blocked ones too; else a free one if it is found soon.
  Cell end(bool free_ends) {
    int tries = !free_ends && random.chance(8) ? 1 : free_ends ? 1000 : 30;
    Cell at;
    for (int i = 0; i < tries; ++i) {
      at = {random.between(0, width() - 1), random.between(0, height() - 1)};
      if (now.free(at)) {
        break;
      }
    }
    return at;
  }

  Timeline timeline_;
  std::vector<Placed> changes_;
};

constexpr int QUERIES = 100;

// Rooms with doors that open and close.
void doors(Painter &painter) {
  Random &random = painter.random;
  int size = random.between(4, 20);
  std::vector<Cell> found;
  for (int y = 0; y < painter.height(); y += size) {
    for (int x = 0; x < painter.width(); x += size) {
      painter.fill({x, y, size, 1}, false);
      painter.fill({x, y, 1, size}, false);
      found.push_back({std::min(x + random.between(1, size - 1), painter.width() - 1), y});
      found.push_back({x, std::min(y + random.between(1, size - 1), painter.height() - 1)});
    }
  }
  for (Cell door : found) {
    painter.now.set(door.x, door.y, random.chance(80));
  }
  painter.tell(painter.whole());
  for (int i = 0; i < QUERIES; ++i) {
    for (int moved = i > 0 && random.chance(40) ? random.between(1, 8) : 0; moved > 0; --moved) {
      Cell door = found[static_cast<std::size_t>(random.between(0, static_cast<int>(found.size()) - 1))];
      painter.now.set(door.x, door.y, !painter.now.free(door));
      painter.tell({door.x, door.y, 1, 1});
    }
    painter.ask(false);
  }
}

void noise(Painter &painter) {
  Random &random = painter.random;
  int percent = random.between(5, 40);
  painter.speckle(painter.whole(), percent);
  painter.tell(painter.whole());
  for (int i = 0; i < QUERIES; ++i) {
    for (int patches = i > 0 && random.chance(50) ? random.between(1, 5) : 0; patches > 0; --patches) {
      Area area = painter.area(12);
      painter.speckle(area, percent);
      painter.tell(area);
    }
    painter.ask(false);
  }
}

// Rooms of walls that move over a ground, which comes back behind them.
void rooms(Painter &painter) {
  Random &random = painter.random;
  painter.speckle(painter.whole(), random.between(0, 15));
  Map ground = painter.now;
  std::vector<Area> moving;
  for (int i = 0; i < 6; ++i) {
    Area room = painter.area(24);
    moving.push_back(room);
    painter.frame(room);
  }
  painter.tell(painter.whole());
  for (int i = 0; i < QUERIES; ++i) {
    if (i > 0 && random.chance(60)) {
      Area &room = moving[static_cast<std::size_t>(random.between(0, 5))];
      Map behind = ground.part({room.x, room.y}, room.width, room.height);
      painter.now.put(behind, {room.x, room.y});
      painter.tell(room);
      room.x = std::clamp(room.x + random.between(-3, 3), 0, painter.width() - room.width);
      room.y = std::clamp(room.y + random.between(-3, 3), 0, painter.height() - room.height);
      painter.frame(room);
      painter.tell(room);
    }
    painter.ask(false);
  }
}

// A map that is taken to be free, or blocked, until somebody who walks about has seen it.
void reveal(Painter &painter) {
  Random &random = painter.random;
  painter.speckle(painter.whole(), random.between(10, 40));
  Map truth = painter.now;
  painter.fill(painter.whole(), !random.chance(25));
  painter.tell(painter.whole());
  Cell eye{random.between(0, painter.width() - 1), random.between(0, painter.height() - 1)};
  for (int i = 0; i < QUERIES; ++i) {
    if (i > 0) {
      eye.x = std::clamp(eye.x + random.between(-6, 6), 0, painter.width() - 1);
      eye.y = std::clamp(eye.y + random.between(-6, 6), 0, painter.height() - 1);
    }
    int x = std::max(0, eye.x - 5), y = std::max(0, eye.y - 5);
    Area seen{x, y, std::min(11, painter.width() - x), std::min(11, painter.height() - y)};
    painter.now.put(truth.part({seen.x, seen.y}, seen.width, seen.height), {seen.x, seen.y});
    // Every time, also if nothing is new.
    painter.tell(seen);
    painter.ask(false);
  }
}

// A map that turns into another one, strip by strip.
void fade(Painter &painter) {
  Random &random = painter.random;
  painter.speckle(painter.whole(), random.between(5, 35));
  Map later = painter.now;
  painter.speckle(painter.whole(), random.between(0, 35));
  painter.tell(painter.whole());
  int strip = random.between(1, 16);
  for (int i = 0, x = 0; i < QUERIES; ++i) {
    if (i > 0 && x < painter.width() && random.chance(50)) {
      Area area{x, 0, std::min(strip, painter.width() - x), painter.height()};
      painter.now.put(later.part({x, 0}, area.width, area.height), {x, 0});
      painter.tell(area);
      x += strip;
    }
    painter.ask(false);
  }
}

// Patches that overlap, repeat what is there, undo each other, are a cell or all there is.
void heaps(Painter &painter) {
  Random &random = painter.random;
  for (int i = 0; i < QUERIES; ++i) {
    for (int patches = random.chance(60) ? random.between(1, 12) : 0; patches > 0; --patches) {
      int kind = random.between(0, 19);
      Area area = kind < 6 ? painter.area(1) : kind < 18 ? painter.area(40) : painter.whole();
      bool repeats = random.chance(25);
      if (!repeats && random.chance(30)) {
        painter.fill(area, kind != 19 || random.chance(50));
      } else if (!repeats) {
        painter.speckle(area, random.between(0, 50));
      }
      painter.tell(area);
    }
    painter.ask(false);
  }
}

struct Kind {
  const char *name;
  void (*paint)(Painter &);
  int most;
};

constexpr int ANY = MAX_SIDE;

const std::array<Kind, 7> KINDS{{{"doors", doors, ANY},
                                 {"noise", noise, ANY},
                                 {"rooms", rooms, ANY},
                                 {"reveal", reveal, ANY},
                                 {"fade", fade, ANY},
                                 {"heaps", heaps, ANY},
                                 {"tiny", heaps, 9}}};

} // namespace

Timeline generate_timeline(std::uint64_t seed, std::size_t number, int side) {
  const Kind &kind = KINDS[number % KINDS.size()];
  Random random(seed * 1000003 + number);
  int most = std::min(side, kind.most);
  int width = random.between(1, most), height = random.between(1, most);
  Painter painter(random.next(), width, height);
  kind.paint(painter);
  return painter.finish(kind.name, seed, number);
}

Timeline generate_static(std::uint64_t seed, std::size_t number, int side, bool free_ends) {
  Random random(seed * 1000003 + number);
  Painter painter(random.next(), random.between(1, side), random.between(1, side));
  painter.speckle(painter.whole(), random.between(0, 40));
  for (int rooms = random.between(0, 4); rooms > 0; --rooms) {
    Area area = painter.area(side);
    painter.frame(area);
  }
  for (int fills = random.between(0, 6); fills > 0; --fills) {
    painter.fill(painter.area(1 + side / 3), random.chance(50));
  }
  painter.now.set(random.between(0, painter.width() - 1), random.between(0, painter.height() - 1), true);
  painter.tell(painter.whole());
  for (int i = 0; i < QUERIES / 2; ++i) {
    painter.ask(free_ends);
  }
  return painter.finish("generated", seed, number);
}

} // namespace harness
