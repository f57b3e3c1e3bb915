// A bench for tests: starts `understudy serve`, provides its ports, reads values and injects faults through
// `understudy ctl`, and stops the server at the end. This single header needs C++17 and POSIX; copy it into
// your project.
//
//   UnderstudyBench bench("bench.yaml");
//   host.open(bench.port());                          // the port of the first line
//   bench.ctl({"inject", "stall", "feeder.A"});
//   EXPECT_EQ(bench.get("feeder.Cord_A"), 3200);
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

class UnderstudyBench {
 public:
  using Words = std::vector<std::string>;

  /// Returns when the bench is ready. `flags` are flags of `understudy serve`, such as {"--speed", "10x"}.
  /// The program is `understudy` in PATH, or the one that the environment variable UNDERSTUDY names. Throws
  /// std::runtime_error.
  explicit UnderstudyBench(const std::string& bench_file, const Words& flags = {}) {
    std::string folder = "/tmp/bench-XXXXXX";
    if (mkdtemp(folder.data()) == nullptr) throw std::runtime_error("no folder can be made in /tmp");
    folder_ = folder;
    Words words{program(), "serve", bench_file, "--links", folder_, "--control", control()};
    words.insert(words.end(), flags.begin(), flags.end());
    server_ = start(words);
    read_ports();
  }

  ~UnderstudyBench() { stop(); }
  UnderstudyBench(const UnderstudyBench&) = delete;
  UnderstudyBench& operator=(const UnderstudyBench&) = delete;

  /// Returns the port that a host opens: the port of that line, or of the first line.
  const std::string& port(const std::string& line = "") const {
    return line.empty() ? first_port_ : ports_.at(line);
  }
  std::string control() const { return folder_ + "/control"; }

  /// Runs `understudy ctl WORDS` and returns its output. Throws std::runtime_error if it fails.
  std::string ctl(const Words& words) const {
    Words command{program(), "ctl", "--control", control()};
    command.insert(command.end(), words.begin(), words.end());
    const Started started = start(command);
    std::string output;
    while (read_some(started.output, output)) {
    }
    close(started.output);
    int status = 0;
    waitpid(started.pid, &status, 0);
    if (status == 0) return output;
    std::string message = "understudy ctl";
    for (const std::string& word : words) message += " " + word;
    throw std::runtime_error(message + " failed");
  }
  /// Reads one register, bit or terminal, without using the line.
  long get(const std::string& name) const {
    const std::string line = ctl({"get", name});  // "feeder.Cord_A 3200"
    return std::stol(line.substr(line.rfind(' ')));
  }

 private:
  struct Started {
    pid_t pid = -1;
    int output = -1;  // its standard output, to read from
  };

  static std::string program() {
    const char* const named = std::getenv("UNDERSTUDY");
    return named != nullptr ? named : "understudy";
  }

  static Started start(const Words& words) {
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe can be made");
    const pid_t pid = fork();
    if (pid == 0) {
      dup2(ends[1], STDOUT_FILENO);
      execvp(arguments[0], arguments.data());
      _exit(127);
    }
    close(ends[1]);
    if (pid < 0) throw std::runtime_error("no process can be started");
    return {pid, ends[0]};
  }

  /// Appends what can be read from `output` to `text`. Returns false at the end of the output, or on an
  /// error.
  static bool read_some(int output, std::string& text) {
    char buffer[4096];
    const ssize_t size = read(output, buffer, sizeof buffer);
    if (size > 0) text.append(buffer, static_cast<std::size_t>(size));
    return size > 0;
  }

  /// Reads the lines that the server prints at once when all ports are open, one for each port, such as
  /// "ready rs485 /dev/pts/3 /tmp/bench-x/rs485.port".
  void read_ports() {
    std::string text;
    pollfd readable{server_.output, POLLIN, 0};
    while (text.empty() || text.back() != '\n') {
      if (poll(&readable, 1, 10'000) != 1 || !read_some(server_.output, text)) {
        stop();
        throw std::runtime_error("understudy serve does not get ready; what it says is above");
      }
    }
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = text.find('\n', at);
      const std::string line = text.substr(at, end - at);
      at = end + 1;
      const std::size_t name = line.find(' ') + 1;
      const std::string path = line.substr(line.rfind(' ') + 1);
      if (ports_.empty()) first_port_ = path;
      ports_[line.substr(name, line.find(' ', name) - name)] = path;
    }
  }

  void stop() {
    if (server_.pid > 0) {
      kill(server_.pid, SIGTERM);
      waitpid(server_.pid, nullptr, 0);
      close(server_.output);
      server_ = {};
    }
    rmdir(folder_.c_str());  // the server has removed its links
  }

  std::string folder_;
  Started server_;
  std::map<std::string, std::string> ports_;
  std::string first_port_;
};
