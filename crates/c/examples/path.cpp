// A path at any angle, in C++17:
//   c++ -std=c++17 path.cpp -I ../include -L FOLDER -lmediant -o path
#include <cstdio>
#include <mediant.hpp>

int main() {
  try {
    auto map = mediant::Map::parse("......\n"
                                   ".@@@@.\n"
                                   "......\n");
    mediant::Space space(map, "k=any gap=closed");
    auto index = mediant::Index::prepare(space);
    mediant::Planner planner(index);

    if (auto path = planner.path({0, 0}, {6, 2})) {
      std::printf("%zu points, length %.3f\n", path->points.size(), path->length);
      for (auto [x, y] : path->points) {
        std::printf("(%g, %g)\n", x, y);
      }
    } else {
      std::puts("no path");
    }
  } catch (const mediant::error &error) {
    std::fprintf(stderr, "%s: %s\n", error.name(), error.what());
    return 1;
  }
}
