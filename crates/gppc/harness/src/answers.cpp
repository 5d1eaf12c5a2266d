#include "answers.h"

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

namespace harness {

namespace {

// ---- Values to bytes and back

template <class T> void add(std::string &bytes, const T &value) {
  bytes.append(reinterpret_cast<const char *>(&value), sizeof value);
}

void add_text(std::string &bytes, const std::string &text) {
  add(bytes, text.size());
  bytes += text;
}

class Bytes {
public:
  explicit Bytes(const std::string &bytes) : bytes_(bytes) {}
  template <class T> T take() {
    T value;
    need(sizeof value);
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  std::string take_text() {
    auto size = take<std::size_t>();
    need(size);
    at_ += size;
    return bytes_.substr(at_ - size, size);
  }

private:
  void need(std::size_t size) const {
    if (bytes_.size() - at_ < size) {
      throw std::runtime_error("its answers are cut short");
    }
  }
  const std::string &bytes_;
  std::size_t at_ = 0;
};

std::string to_bytes(const Answers &answers) {
  std::string bytes;
  add_text(bytes, answers.name);
  add_text(bytes, answers.failure);
  add(bytes, answers.init);
  add(bytes, answers.kilobytes);
  add(bytes, answers.answers.size());
  for (const Answer &answer : answers.answers) {
    add(bytes, answer.times);
    add_text(bytes, answer.complaint);
    add(bytes, answer.points.size());
    for (const Point &point : answer.points) {
      add(bytes, point);
    }
  }
  return bytes;
}

void from_bytes(const std::string &bytes, Answers &answers) {
  Bytes in(bytes);
  answers.name = in.take_text();
  answers.failure = in.take_text();
  answers.init = in.take<std::int64_t>();
  answers.kilobytes = in.take<std::int64_t>();
  answers.answers.resize(in.take<std::size_t>());
  for (Answer &answer : answers.answers) {
    answer.times = in.take<Times>();
    answer.complaint = in.take_text();
    answer.points.resize(in.take<std::size_t>());
    for (Point &point : answer.points) {
      point = in.take<Point>();
    }
  }
}

// ---- Processes

void write_all(int file, const std::string &bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    ssize_t wrote = write(file, bytes.data() + done, bytes.size() - done);
    if (wrote <= 0) {
      _exit(3);
    }
    done += static_cast<std::size_t>(wrote);
  }
}

std::string read_all(int file) {
  std::string bytes;
  char buffer[1 << 16];
  for (ssize_t got; (got = read(file, buffer, sizeof buffer)) > 0;) {
    bytes.append(buffer, static_cast<std::size_t>(got));
  }
  return bytes;
}

// Runs work in a process of its own. Returns what it returned, and says in `death` if it did not end well.
std::string in_process(const std::function<std::string()> &work, unsigned seconds, std::string &death) {
  int ends[2];
  if (pipe(ends) != 0) {
    throw std::runtime_error("no pipe can be made");
  }
  pid_t child = fork();
  if (child < 0) {
    throw std::runtime_error("no process can be made");
  }
  if (child == 0) {
    close(ends[0]);
    alarm(seconds);
    try {
      write_all(ends[1], work());
    } catch (const std::exception &error) {
      Answers failed;
      failed.failure = error.what();
      write_all(ends[1], to_bytes(failed));
    }
    _exit(0);
  }
  close(ends[1]);
  std::string bytes = read_all(ends[0]);
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFSIGNALED(status)) {
    death = WTERMSIG(status) == SIGALRM ? "it was stopped after " + std::to_string(seconds) + " seconds"
                                        : "it died of signal " + std::to_string(WTERMSIG(status));
  } else if (WEXITSTATUS(status) != 0) {
    death = "it ended with code " + std::to_string(WEXITSTATUS(status));
  }
  return bytes;
}

// Takes over the answers of a process. Returns why there are none, or nothing.
std::string understand(const std::string &bytes, const std::string &death, Answers &answers) {
  if (!death.empty()) {
    return death;
  }
  try {
    from_bytes(bytes, answers);
  } catch (const std::runtime_error &error) {
    answers.answers.clear();
    return error.what();
  }
  return answers.failure;
}

// An empty folder, which goes with its files.
class Folder {
public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "gppc-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
      throw std::runtime_error("no folder can be made for the index");
    }
    path_ = name;
  }
  Folder(const Folder &) = delete;
  Folder &operator=(const Folder &) = delete;
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::string file() const { return (path_ / "index").string(); }
  std::int64_t bytes() const {
    std::int64_t sum = 0;
    for (const auto &entry : std::filesystem::recursive_directory_iterator(path_)) {
      sum += entry.is_regular_file() ? static_cast<std::int64_t>(entry.file_size()) : 0;
    }
    return sum;
  }

private:
  std::filesystem::path path_;
};

std::int64_t of_status(const std::string &key) {
  std::ifstream in("/proc/self/status");
  std::string word;
  std::int64_t number = 0;
  while (in >> word) {
    if (word == key && in >> number) {
      return number;
    }
  }
  return 0;
}

} // namespace

std::int64_t memory_now() {
  return of_status("VmRSS:");
}

std::int64_t memory_at_most() {
  return of_status("VmHWM:");
}

Answers run_task(const Task &task, unsigned seconds) {
  Answers answers;
  Folder folder;
  std::string death;
  auto prepare = [&] {
    Answers prepared;
    prepared.init = timed([&] { task.prepare(folder.file()); });
    return to_bytes(prepared);
  };
  std::string bytes = in_process(prepare, seconds, death);
  death = understand(bytes, death, answers);
  if (!death.empty()) {
    answers.failure = "while preparing " + death;
    return answers;
  }
  std::int64_t time = answers.init;
  auto answer = [&] {
    Answers made;
    task.answer(folder.file(), made);
    return to_bytes(made);
  };
  bytes = in_process(answer, seconds, death);
  death = understand(bytes, death, answers);
  answers.failure = death.empty() ? "" : "while answering " + death;
  answers.prepare = time;
  answers.index_bytes = folder.bytes();
  return answers;
}

} // namespace harness
