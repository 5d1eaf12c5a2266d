#include "options.h"

#include <functional>
#include <map>
#include <stdexcept>

namespace harness {

namespace {

std::uint64_t number(const std::string &word) {
  std::size_t read = 0;
  std::uint64_t number = 0;
  try {
    number = std::stoull(word, &read);
  } catch (const std::exception &) {
    read = 0;
  }
  if (read != word.size() || word.empty()) {
    throw std::runtime_error("'" + word + "' is no number");
  }
  return number;
}

} // namespace

Options read_options(int count, char **words) {
  Options options;
  auto size = [](std::size_t &to) { return [&to](const std::string &word) { to = number(word); }; };
  auto text = [](std::string &to) { return [&to](const std::string &word) { to = word; }; };
  const std::map<std::string, std::function<void(const std::string &)>> known{
      {"--timelines", size(options.generated)},
      {"--generated", size(options.generated)},
      {"--every", size(options.every)},
      {"--side", size(options.side)},
      {"--csv", text(options.csv)},
      {"--costs", text(options.costs)},
      {"--write", text(options.write)},
      {"--seed", [&](const std::string &word) { options.seed = number(word); }},
      {"--tags", [&](const std::string &word) { options.tags = static_cast<int>(number(word)); }},
      {"--seconds", [&](const std::string &word) { options.seconds = static_cast<unsigned>(number(word)); }},
  };
  for (int i = 1; i < count; ++i) {
    std::string word = words[i];
    auto found = known.find(word);
    if (word == "--reference") {
      options.reference = true;
    } else if (word == "--processor") {
      options.processor = true;
    } else if (found != known.end()) {
      if (++i == count) {
        throw std::runtime_error(word + " needs a value");
      }
      found->second(words[i]);
    } else if (word.rfind("--", 0) == 0) {
      throw std::runtime_error("the option " + word + " is unknown");
    } else {
      options.files.push_back(word);
    }
  }
  if (options.every == 0) {
    throw std::runtime_error("--every needs a number from 1 on");
  }
  return options;
}

} // namespace harness
