// The table of a run, and rows of single queries.
#ifndef GPPC_HARNESS_REPORT_H
#define GPPC_HARNESS_REPORT_H

#include "answers.h"
#include "judge.h"
#include "timeline.h"

#include <fstream>
#include <string>
#include <vector>

namespace harness {

// Counts and times of all timelines of a name.
struct Row {
  std::string name;
  std::size_t instances = 0;
  std::size_t valid = 0;
  std::size_t optimal = 0;
  std::size_t wrong = 0;
  std::size_t unknown = 0;
  std::size_t misstated = 0;
  std::size_t none = 0;
  Times times;
  std::int64_t init = 0;
  std::int64_t prepare = 0;
  std::int64_t kilobytes = 0;
  std::int64_t index_bytes = 0;
};

class Report {
public:
  // `csv` may be empty.
  explicit Report(const std::string &csv);
  void add(const Timeline &timeline, const Answers &answers, const std::vector<Verdict> &verdicts);
  // Prints the table, and what is not judged. Returns the exit code: 0 if nothing is wrong.
  int print() const;

private:
  void add_one(Row &row, const Timeline &timeline, const Query &query, const Answer &answer,
               const Verdict &verdict);
  void complain(const std::string &sentence);

  std::vector<Row> rows_;
  std::string entry_;
  std::size_t complaints_ = 0;
  std::ofstream csv_;
};

} // namespace harness

#endif
