// Real processes: a running `understudy serve`, and programs that run to their end. Every wait is bounded.
// Processes end with their owner, even if the test crashes.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/files/descriptor.h"

namespace understudy::acceptance {

using Words = std::vector<std::string>;
using Environment = std::vector<std::pair<std::string, std::string>>;  // added to the test's own
using Wait = std::chrono::milliseconds;                                // by the wall clock

inline constexpr Wait kPatience{60'000};  // for a failing test; a passing one waits only for events

/// Polls until `holds` is true. Returns false if it never was.
bool eventually(const std::function<bool()>& holds, Wait patience = kPatience);

/// A temporary folder of the test, which is removed with its contents.
class PrivateFolder {
 public:
  PrivateFolder();
  ~PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  const std::string& path() const { return path_; }
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  /// Writes a file and returns its path.
  std::string write(const std::string& name, const std::string& text) const;

 private:
  std::string path_;
};

class Process {
 public:
  explicit Process(const Words& command, const Environment& environment = {});
  ~Process();  // ends it if it is still running
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  pid_t pid() const { return pid_; }
  void send(int signal_number) const;
  /// Returns its exit code, or 128 + n if signal n ended it; nothing while it runs.
  std::optional<int> wait(Wait patience);
  /// Returns what it has printed so far.
  std::string output() const;
  std::string errors() const;

 private:
  pid_t pid_ = -1;
  std::optional<int> exit_code_;
  Descriptor output_;
  Descriptor errors_;
};

struct Finished {
  int exit_code = -1;  // -1: it did not end in time and was killed
  std::string output;
  std::string errors;
};
Finished run(const Words& command, const Environment& environment = {}, Wait patience = kPatience);
/// `understudy ARGUMENTS`.
Finished understudy(Words arguments, const Environment& environment = {});

std::vector<std::string> lines_of(const std::string& text);

/// A running `understudy serve`. At the end of the test it is told to stop, and must exit with 0.
class RunningUnderstudy {
 public:
  /// Serves one Simple2-R3 on a line called "line" with the link folder()/port. `flags` are added.
  explicit RunningUnderstudy(const Words& flags = {}, const Environment& environment = {});
  /// Serves one device of another model, as above.
  static std::unique_ptr<RunningUnderstudy> of_model(const std::string& model, const Words& flags = {});
  /// Serves a bench file, written to folder(). `flags` are added.
  static std::unique_ptr<RunningUnderstudy> of_bench(const std::string& yaml, const Words& flags = {});
  ~RunningUnderstudy();
  RunningUnderstudy(const RunningUnderstudy&) = delete;
  RunningUnderstudy& operator=(const RunningUnderstudy&) = delete;

  struct Port {
    std::string line;
    std::string pty;
    std::string link;
  };
  const std::vector<Port>& ports() const { return ports_; }
  const std::string& port() const { return ports_.at(0).link; }
  std::string control() const { return folder_ / "control"; }
  const PrivateFolder& folder() const { return folder_; }
  const Process& process() const { return *process_; }
  std::string errors() const { return process_->errors(); }

  /// Runs `understudy ctl WORDS` with this daemon's socket.
  Finished ctl(const Words& words) const;
  /// Returns how many requests its first station has served, according to `ctl status`.
  int requests() const;
  /// Sends the signal and returns the exit code, which the caller checks.
  std::optional<int> stop(int signal_number);

 private:
  struct FromBench {};
  struct FromModel {};
  RunningUnderstudy(FromModel, const std::string& model, const Words& flags);
  RunningUnderstudy(FromBench, const std::string& yaml, const Words& flags);
  void start(Words command, const Words& flags, const Environment& environment);

  PrivateFolder folder_;
  std::unique_ptr<Process> process_;
  std::vector<Port> ports_;
  bool stopped_ = false;
};

}  // namespace understudy::acceptance
