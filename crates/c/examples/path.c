// A path at any angle, in C:
//   cc path.c -I ../include -L FOLDER -lmediant -o path
#include <mediant.h>
#include <stdio.h>

// Calls a function of the library. The first mistake ends main.
#define DO(call) \
  do { \
    if ((call) != MEDIANT_CODE_OK) { \
      fprintf(stderr, "%s\n", mediant_message()); \
      return 1; \
    } \
  } while (0)

int main(void) {
  mediant_map map;
  mediant_space space;
  mediant_index index;
  mediant_planner planner;
  DO(mediant_map_parse("......\n"
                       ".@@@@.\n"
                       "......\n",
                       &map));
  DO(mediant_space_new(map, "k=any gap=closed", &space));
  DO(mediant_index_prepare(space, NULL, NULL, &index));
  DO(mediant_planner_new(index, &planner));

  mediant_point start = {0, 0}, goal = {6, 2}, points[100];
  size_t count;
  double length;
  DO(mediant_planner_path(planner, start, goal, points, 100, &count, &length));
  printf("%zu points, length %.3f\n", count, length);
  // The count may be more than there is room for.
  for (size_t i = 0; i < count && i < 100; i++) {
    printf("(%g, %g)\n", points[i].x, points[i].y);
  }

  mediant_planner_free(planner);
  mediant_index_free(index);
  mediant_space_free(space);
  mediant_map_free(map);
  return 0;
}
