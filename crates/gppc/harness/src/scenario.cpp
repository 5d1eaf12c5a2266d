#include "scenario.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace harness {

namespace {

[[noreturn]] void fail(const std::string &file, const std::string &why) {
  throw std::runtime_error(file + ": " + why);
}

std::string folder_of(const std::string &file) {
  std::size_t slash = file.rfind('/');
  return slash == std::string::npos ? "" : file.substr(0, slash + 1);
}

std::string name_of(const std::string &file) {
  std::string name = file.substr(folder_of(file).size());
  for (const char *end : {".scen", ".map"}) {
    std::size_t at = name.rfind(end);
    if (at != std::string::npos && at + std::string(end).size() == name.size()) {
      name.resize(at);
    }
  }
  return name;
}

// How a file writes its numbers: so many digits after the point, and so many that count.
struct Digits {
  int decimals = 0;
  int counting = 0;

  void see(const std::string &number) {
    std::size_t point = number.find('.');
    if (point != std::string::npos) {
      decimals = std::max(decimals, static_cast<int>(number.size() - point - 1));
    }
    auto digits = static_cast<int>(
        std::count_if(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; }));
    counting = std::max(counting, digits);
  }

  // One unit of the last digit. Files leave out zeros at the end, so that no number tells alone. The sums of
  // some were made with 1.41421356 for the root of 2.
  long double unit(long double number) const {
    int before = number >= 1 ? static_cast<int>(std::floor(std::log10(number))) + 1 : 1;
    return std::pow(10.0L, -std::min(decimals, std::max(0, counting - before))) + 2e-9L * number;
  }
};

// Lengths as they are written, until all are known.
class Texts {
public:
  void add(const std::string &file, Query &query, const std::string &text) {
    std::size_t read = 0;
    query.stated.known = true;
    try {
      query.stated.length = std::stold(text, &read);
    } catch (const std::exception &) {
      read = 0;
    }
    if (read != text.size() || text.empty()) {
      fail(file, "'" + text + "' is no length");
    }
    query.stated.none = query.stated.length < 0;
    digits_.see(text);
  }
  void finish(Timeline &timeline) const {
    for (Query &query : timeline.queries) {
      query.stated.tolerance = digits_.unit(query.stated.length);
    }
  }

private:
  Digits digits_;
};

void expect(std::istream &in, const std::string &file, const std::string &word) {
  std::string found;
  if (!(in >> found) || found != word) {
    fail(file, "'" + word + "' is expected, not '" + found + "'");
  }
}

int side(std::istream &in, const std::string &file, const std::string &word) {
  expect(in, file, word);
  int value = 0;
  if (!(in >> value) || value < 1 || value > MAX_SIDE) {
    fail(file, "the " + word + " is missing or out of range");
  }
  return value;
}

// Head of a scenario of version 2. Returns how many lengths a query has, and which one is over eight
// directions.
std::pair<int, int> read_head(std::istream &in, const std::string &file, Timeline &timeline) {
  expect(in, file, "version");
  expect(in, file, "2");
  timeline.height = side(in, file, "height");
  timeline.width = side(in, file, "width");
  expect(in, file, "cost");
  int count = 0, octile = -1;
  in >> count;
  std::string word;
  for (int i = 0; i < count && in >> word; ++i) {
    if (word == "octile") {
      octile = i;
    }
  }
  if (octile < 0) {
    fail(file, "no cost is 'octile'");
  }
  expect(in, file, "patch");
  in >> word;
  timeline.patches = read_patches(word.front() == '/' ? word : folder_of(file) + word);
  expect(in, file, "commands");
  return {count, octile};
}

Placed read_change(std::istream &in, const std::string &file, const Timeline &timeline) {
  int bucket = 0;
  Placed placed;
  if (!(in >> bucket >> placed.patch >> placed.at.x >> placed.at.y) ||
      placed.patch >= timeline.patches.size()) {
    fail(file, "a line P is not whole, or its patch is unknown");
  }
  const Map &patch = timeline.patches[placed.patch];
  if (placed.at.x < 0 || placed.at.y < 0 || placed.at.x + patch.width() > timeline.width ||
      placed.at.y + patch.height() > timeline.height) {
    fail(file, "a patch does not lie within the map");
  }
  return placed;
}

void check_ends(const std::string &file, const Timeline &timeline, const Query &query) {
  for (Cell end : {query.start, query.goal}) {
    if (end.x < 0 || end.y < 0 || end.x >= timeline.width || end.y >= timeline.height) {
      fail(file, "an end of query " + std::to_string(query.number) + " lies outside the map");
    }
  }
}

// The line of an instance of version 1, from its first word on.
bool read_instance(std::istream &in, const std::string &file, Timeline &timeline, Texts &texts) {
  std::string bucket, map, length;
  int width = 0, height = 0;
  Query query;
  if (!(in >> bucket >> map >> width >> height >> query.start.x >> query.start.y >> query.goal.x >>
        query.goal.y >> length)) {
    return false;
  }
  query.number = timeline.queries.size();
  check_ends(file, timeline, query);
  texts.add(file, query, length);
  timeline.queries.push_back(query);
  return true;
}

} // namespace

Timeline read_static(const std::string &file) {
  std::size_t end = file.rfind(".scen");
  if (end == std::string::npos || end + 5 != file.size()) {
    fail(file, "a scenario's name ends with .scen");
  }
  std::ifstream in(file);
  expect(in, file, "version");
  double version = 0;
  if (!(in >> version) || std::fabs(version - 1) > 1e-9) {
    fail(file, "version 1 is expected");
  }
  Timeline timeline;
  timeline.name = timeline.which = name_of(file);
  timeline.patches.push_back(read_map(file.substr(0, end)));
  timeline.width = timeline.patches[0].width();
  timeline.height = timeline.patches[0].height();
  Texts texts;
  while (read_instance(in, file, timeline, texts)) {
  }
  if (timeline.queries.empty()) {
    fail(file, "it has no instance");
  }
  texts.finish(timeline);
  timeline.queries.front().changes.push_back({0, {0, 0}});
  return timeline;
}

Timeline read_dynamic(const std::string &file) {
  std::ifstream in(file);
  Timeline timeline;
  timeline.name = timeline.which = name_of(file);
  auto [count, octile] = read_head(in, file, timeline);
  Texts texts;
  std::vector<Placed> changes;
  std::string word;
  while (in >> word) {
    if (word == "P") {
      changes.push_back(read_change(in, file, timeline));
      continue;
    }
    if (word != "Q") {
      fail(file, "the command '" + word + "' is unknown");
    }
    Query query;
    in >> word >> query.start.x >> query.start.y >> query.goal.x >> query.goal.y;
    std::string length;
    for (int i = 0; i < count && in >> word; ++i) {
      if (i == octile) {
        length = word;
      }
    }
    query.number = timeline.queries.size();
    check_ends(file, timeline, query);
    texts.add(file, query, length);
    query.changes.swap(changes);
    timeline.queries.push_back(query);
  }
  texts.finish(timeline);
  return timeline;
}

void write_dynamic(const std::string &stem, const Timeline &timeline) {
  write_patches(stem + ".patch", timeline.patches);
  std::ofstream out(stem + ".scen");
  out << "version 2\nheight " << timeline.height << "\nwidth " << timeline.width << "\ncost 1 octile\npatch "
      << stem.substr(folder_of(stem).size()) << ".patch\ncommands\n";
  std::size_t bucket = 0;
  for (const Query &query : timeline.queries) {
    bucket += !query.changes.empty() && query.number != 0;
    for (const Placed &placed : query.changes) {
      out << "P " << bucket << " " << placed.patch << " " << placed.at.x << " " << placed.at.y << "\n";
    }
    char length[64];
    std::snprintf(length, sizeof length, "%.11Lf", query.stated.length);
    out << "Q " << bucket << " " << query.start.x << " " << query.start.y << " " << query.goal.x << " "
        << query.goal.y << " " << (query.stated.none ? "-1" : length) << "\n";
  }
  if (!out.flush()) {
    fail(stem, "it cannot be written");
  }
}

void state_from(const std::string &file, Timeline &timeline) {
  std::ifstream in(file);
  std::string line;
  if (!std::getline(in, line) || line.rfind("index,cost", 0) != 0) {
    fail(file, "'index,cost' is expected");
  }
  std::map<std::size_t, std::string> lengths;
  while (std::getline(in, line)) {
    std::size_t comma = line.find(',');
    if (comma == std::string::npos) {
      fail(file, "'" + line + "' is no line of the table");
    }
    lengths[std::stoul(line.substr(0, comma))] = line.substr(comma + 1);
  }
  forget_stated(timeline);
  Texts texts;
  for (Query &query : timeline.queries) {
    auto found = lengths.find(query.number);
    if (found != lengths.end()) {
      texts.add(file, query, found->second);
    }
  }
  texts.finish(timeline);
}

void forget_stated(Timeline &timeline) {
  for (Query &query : timeline.queries) {
    bool some = query.stated.some || (query.stated.known && !query.stated.none);
    query.stated = Stated();
    query.stated.some = some;
  }
}

void keep_every(std::size_t n, Timeline &timeline) {
  std::vector<Query> kept;
  for (std::size_t i = 0; i < timeline.queries.size(); i += n) {
    kept.push_back(timeline.queries[i]);
  }
  timeline.queries.swap(kept);
}

} // namespace harness
