// Converts the steps of a scenario file to the list of steps that is run. Loops, tables and includes are
// unrolled, and everything is checked.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/files/file_error.h"
#include "base/text/one_line.h"
#include "emulator/play/reading/hunt_plan.h"
#include "emulator/play/reading/parameters.h"
#include "emulator/play/reading/shared_reading.h"
#include "emulator/play/reading/story.h"
#include "emulator/play/reading/trial.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::play {

/// The state that the cases of a file share.
struct FileReading {
  static constexpr int kMaxSteps = 100'000;  // for all cases together
  /// The maximum size of the texts and messages of all steps, in bytes.
  static constexpr std::size_t kMaxBytes = std::size_t{64} << 20;
  static constexpr int kDeepest = 32;  // nesting depth of loops, forks and includes
  int steps = 0;
  std::size_t bytes = 0;
  SharedReading& shared;
};

struct StepRow;

/// Reads the time limit of a wait.
inline SimTime read_within(const world::YamlFields& field) {
  const SimTime within = field.duration();
  if (within <= SimTime{0}) field.fail("takes no time; expected a duration above 0");
  return within;
}

class StepsReader {
 public:
  StepsReader(const Trial& trial, FileReading& file, const std::string& path);

  /// Reads the steps. Throws all mistakes in them. If `written` is not null, appends the source of each step.
  Steps read(const world::YamlFields& list, const Parameters& parameters,
             std::vector<WrittenStep>* written = nullptr);
  /// Reads a step that needs no parameters and whose names are not used by other steps. Throws all mistakes
  /// in it.
  Steps read_apart(const world::YamlFields& step);

  // --- for the readers of single kinds of steps (step_rows.h) ------------------------------------
  const Trial& trial() const { return trial_; }
  const Parameters& parameters() const { return *parameters_; }
  Story& story() { return story_; }
  /// Adds a file from which a step is read.
  void add_file(const std::string& path, const std::string& what) { files_.push_back({path, what}); }
  const std::vector<FileClaim>& files() const { return files_; }
  /// Adds a file that a step will write, and the place in the scenario that specifies it.
  void add_saved(const std::string& path, const world::YamlFields& field) {
    saved_.emplace_back(path, field);
  }
  const std::vector<std::pair<std::string, world::YamlFields>>& saved() const { return saved_; }
  /// Adds a step. `text` describes it.
  template <typename What>
  void add(const world::YamlFields& where, const std::string& text, What what) {
    count(where);
    into_->push_back(
        {.file = where.file(), .line = where.line(), .text = one_line(text), .what = std::move(what)});
    count_bytes(where, into_->back());
    if (written_ != nullptr && into_ == top_) note_written();
  }
  /// Adds the steps of a list at this position, with different parameters.
  void read_here(const world::YamlFields& list, const Parameters& parameters);
  /// Reads the steps of a branch, which continue the story so far. Afterwards, the story is restored.
  Steps read_branch(const world::YamlFields& list);
  void read_included(const world::YamlFields& field);
  /// Reads a part of a step, so that an error in it does not hide errors in other parts. Returns true if
  /// there is no error.
  template <typename Read>
  bool attempt(const Read& read) {
    const bool is_read = diagnostics_.attempt([&] {
      try {
        read();
      } catch (const world::LastError&) {
        throw;
      } catch (const FileError&) {
        if (may_lack_name_) throw world::AlreadyReported();
        throw;
      }
    });
    has_failed_ = has_failed_ || !is_read;
    return is_read;
  }
  /// Returns true if part of the current step could not be read.
  bool has_failed() const { return has_failed_; }
  /// Returns true if a step could not be read. Another iteration of a loop would only repeat the error.
  bool has_diagnostics() const { return diagnostics_.count() > 0; }

 private:
  void read_or_report(const world::YamlFields& step);
  void read_step(const world::YamlFields& step, const StepRow* row);
  void note_written();
  void count(const world::YamlFields& where);
  void count_bytes(const world::YamlFields& where, const Step& step);

  const Trial& trial_;
  FileReading& file_;
  const Parameters* parameters_ = nullptr;
  Story story_;
  Steps* into_ = nullptr;
  const Steps* top_ = nullptr;                   // the steps of the scenario, not of a branch
  std::vector<WrittenStep>* written_ = nullptr;  // the sources of the steps
  std::optional<world::YamlFields> current_;     // the step that is being read
  bool has_added_ = false;                       // the current step has already added a step
  std::vector<FileClaim> files_;
  std::vector<std::pair<std::string, world::YamlFields>> saved_;
  std::vector<std::string> paths_;  // the nested files that are being included
  int depth_ = 0;
  world::Diagnostics diagnostics_;
  bool lacks_names_ = false;    // a step that could not be read may define names
  bool may_lack_name_ = false;  // the current step may use one of these names
  bool has_failed_ = false;     // part of the current step could not be read
};

}  // namespace understudy::emulator::play
