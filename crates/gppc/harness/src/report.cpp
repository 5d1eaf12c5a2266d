#include "report.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

namespace harness {

namespace {

// More messages than that help nobody.
constexpr std::size_t MOST_MESSAGES = 20;

void add_times(Times &sum, const Times &times) {
  sum.total += times.total;
  sum.change += times.change;
  sum.first += times.first;
  sum.longest = std::max(sum.longest, times.longest);
}

double per(std::int64_t time, std::size_t count, double unit) {
  return count == 0 ? 0 : static_cast<double>(time) / static_cast<double>(count) / unit;
}

void print_row(const Row &row) {
  std::printf("%-32s %9zu %9zu %9zu %6zu %8zu %10.2f %10.2f %10.2f %10.2f %10.1f %9.2f %9.2f %8.1f %11lld\n",
              row.name.c_str(), row.instances, row.valid, row.optimal, row.wrong, row.none,
              per(row.times.total, 1, 1e6), per(row.times.change, 1, 1e6),
              per(row.times.total, row.instances, 1e3), per(row.times.first, row.instances, 1e3),
              per(row.times.longest, 1, 1e3), per(row.init, 1, 1e6), per(row.prepare, 1, 1e6),
              static_cast<double>(row.kilobytes) / 1024, static_cast<long long>(row.index_bytes));
}

void add_row(Row &sum, const Row &row) {
  sum.instances += row.instances;
  sum.valid += row.valid;
  sum.optimal += row.optimal;
  sum.wrong += row.wrong;
  sum.unknown += row.unknown;
  sum.misstated += row.misstated;
  sum.none += row.none;
  add_times(sum.times, row.times);
  sum.init += row.init;
  sum.prepare += row.prepare;
  sum.kilobytes = std::max(sum.kilobytes, row.kilobytes);
  sum.index_bytes += row.index_bytes;
}

const char *word_for(const Verdict &verdict) {
  return !verdict.why.empty() ? "wrong" : verdict.unknown ? "unknown" : verdict.none ? "none" : "optimal";
}

} // namespace

Report::Report(const std::string &csv) {
  if (csv.empty()) {
    return;
  }
  csv_.open(csv);
  if (!csv_) {
    throw std::runtime_error(csv + ": it cannot be written");
  }
  csv_.precision(15);
  csv_ << "name,index,sx,sy,gx,gy,points,length,shortest,verdict,total_ns,change_ns,first_ns,longest_ns\n";
}

void Report::complain(const std::string &sentence) {
  if (++complaints_ <= MOST_MESSAGES) {
    std::fprintf(stderr, "wrong: %s\n", sentence.c_str());
  }
}

void Report::add_one(Row &row, const Timeline &timeline, const Query &query, const Answer &answer,
                     const Verdict &verdict) {
  row.valid += verdict.valid;
  row.optimal += verdict.optimal;
  row.wrong += !verdict.why.empty();
  row.unknown += verdict.unknown && verdict.why.empty();
  row.misstated += verdict.misstated;
  row.none += verdict.none;
  add_times(row.times, answer.times);
  if (!verdict.why.empty()) {
    complain(timeline.which + ", query " + std::to_string(query.number) + " from (" +
             std::to_string(query.start.x) + ", " + std::to_string(query.start.y) + ") to (" +
             std::to_string(query.goal.x) + ", " + std::to_string(query.goal.y) + "): " + verdict.why +
             "; length " + std::to_string(verdict.length) + ", shortest " + std::to_string(verdict.shortest));
  }
  if (csv_.is_open()) {
    csv_ << timeline.name << ',' << query.number << ',' << query.start.x << ',' << query.start.y << ','
         << query.goal.x << ',' << query.goal.y << ',' << answer.points.size() << ',' << verdict.length << ','
         << verdict.shortest << ',' << word_for(verdict) << ',' << answer.times.total << ','
         << answer.times.change << ',' << answer.times.first << ',' << answer.times.longest << '\n';
  }
}

void Report::add(const Timeline &timeline, const Answers &answers, const std::vector<Verdict> &verdicts) {
  auto same = [&](const Row &row) { return row.name == timeline.name; };
  auto found = std::find_if(rows_.begin(), rows_.end(), same);
  if (found == rows_.end()) {
    found = rows_.insert(rows_.end(), Row());
    found->name = timeline.name;
  }
  Row &row = *found;
  entry_ = answers.name.empty() ? entry_ : answers.name;
  row.instances += timeline.queries.size();
  row.init += answers.init;
  row.prepare += answers.prepare;
  row.kilobytes = std::max(row.kilobytes, answers.kilobytes);
  row.index_bytes += answers.index_bytes;
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    add_one(row, timeline, timeline.queries[i], answers.answers[i], verdicts[i]);
  }
  std::size_t missing = timeline.queries.size() - verdicts.size();
  if (missing > 0 || !answers.failure.empty()) {
    row.wrong += std::max<std::size_t>(missing, 1);
    complain(timeline.which + ": " + std::to_string(missing) + " queries are without an answer; " +
             answers.failure);
  }
}

int Report::print() const {
  std::printf("Entry: %s\n", entry_.c_str());
  std::printf("%-32s %9s %9s %9s %6s %8s %10s %10s %10s %10s %10s %9s %9s %8s %11s\n", "name", "instances",
              "valid", "optimal", "wrong", "no path", "total ms", "change ms", "mean us", "first us",
              "longest us", "init ms", "pre ms", "mem MB", "index bytes");
  Row sum;
  sum.name = "in all";
  for (const Row &row : rows_) {
    print_row(row);
    add_row(sum, row);
  }
  if (rows_.size() > 1) {
    print_row(sum);
  }
  if (sum.unknown > 0) {
    std::printf("Of %zu answers only the path was checked: nobody states the shortest length.\n",
                sum.unknown);
  }
  if (sum.misstated > 0) {
    std::printf("Of %zu queries the file states another length than the harness found.\n", sum.misstated);
  }
  if (complaints_ > MOST_MESSAGES) {
    std::fprintf(stderr, "%zu more are wrong\n", complaints_ - MOST_MESSAGES);
  }
  if (sum.instances == 0) {
    std::fprintf(stderr, "nothing was asked\n");
  }
  std::fflush(stdout);
  return sum.wrong == 0 && sum.instances > 0 ? 0 : 1;
}

} // namespace harness
