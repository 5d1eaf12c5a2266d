#include "map.h"

#include <fstream>
#include <stdexcept>

namespace harness {

namespace {

[[noreturn]] void fail(const std::string &file, const std::string &why) {
  throw std::runtime_error(file + ": " + why);
}

void expect(std::istream &in, const std::string &file, const std::string &word) {
  std::string found;
  if (!(in >> found) || found != word) {
    fail(file, "'" + word + "' is expected, not '" + found + "'");
  }
}

int number(std::istream &in, const std::string &file, const std::string &word, int least, int most) {
  expect(in, file, word);
  int value = 0;
  if (!(in >> value) || value < least || value > most) {
    fail(file, "the number after '" + word + "' is missing or out of range");
  }
  return value;
}

bool is_free(char cell) {
  return cell == '.' || cell == 'G' || cell == 'S';
}

// Size and rows, from 'height' on. Other cells than those known are mistakes if `strict`.
Map read_rows(std::istream &in, const std::string &file, bool strict) {
  int height = number(in, file, "height", 1, MAX_SIDE);
  int width = number(in, file, "width", 1, MAX_SIDE);
  expect(in, file, "map");
  Map map(width, height, false);
  std::string row;
  for (int y = 0; y < height; ++y) {
    if (!(in >> row) || row.size() != static_cast<std::size_t>(width)) {
      fail(file, "row " + std::to_string(y) + " of the map has another length");
    }
    if (strict && row.find_first_not_of(".GS@OTW") != std::string::npos) {
      fail(file, "row " + std::to_string(y) + " has an unknown cell");
    }
    for (int x = 0; x < width; ++x) {
      map.set(x, y, is_free(row[static_cast<std::size_t>(x)]));
    }
  }
  return map;
}

} // namespace

Map::Map(int width, int height, bool free)
    : width_(width), height_(height), bytes_((cells() + 7) / 8, static_cast<std::uint8_t>(free ? 255 : 0)) {}

void Map::set(int x, int y, bool free) {
  std::size_t at = index(x, y);
  auto bit = static_cast<std::uint8_t>(1U << (at % 8));
  std::uint8_t &byte = bytes_[at / 8];
  byte = static_cast<std::uint8_t>(free ? byte | bit : byte & ~bit);
}

void Map::put(const Map &patch, Cell at) {
  for (int y = 0; y < patch.height(); ++y) {
    for (int x = 0; x < patch.width(); ++x) {
      set(at.x + x, at.y + y, patch.free(x, y));
    }
  }
}

Map Map::part(Cell at, int width, int height) const {
  Map part(width, height, false);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      part.set(x, y, free(at.x + x, at.y + y));
    }
  }
  return part;
}

Map read_map(const std::string &file) {
  std::ifstream in(file);
  expect(in, file, "type");
  expect(in, file, "octile");
  return read_rows(in, file, false);
}

std::vector<Map> read_patches(const std::string &file) {
  std::ifstream in(file);
  expect(in, file, "type");
  expect(in, file, "patch");
  int count = number(in, file, "patches", 0, 1 << 24);
  std::vector<Map> patches;
  for (int i = 0; i < count; ++i) {
    number(in, file, "patch", i, i);
    patches.push_back(read_rows(in, file, true));
  }
  return patches;
}

void write_patches(const std::string &file, const std::vector<Map> &patches) {
  std::ofstream out(file);
  out << "type patch\npatches " << patches.size() << "\n";
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const Map &patch = patches[i];
    out << "patch " << i << "\nheight " << patch.height() << "\nwidth " << patch.width() << "\nmap\n";
    for (int y = 0; y < patch.height(); ++y) {
      for (int x = 0; x < patch.width(); ++x) {
        out << (patch.free(x, y) ? '.' : '@');
      }
      out << "\n";
    }
  }
  if (!out.flush()) {
    fail(file, "it cannot be written");
  }
}

} // namespace harness
