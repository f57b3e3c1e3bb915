// Writes files during the replay of a recording: a trace, a capture, a page.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "base/files/file_claims.h"
#include "emulator/command_line/commands.h"
#include "emulator/play/report/run_logger.h"
#include "emulator/play/results/result.h"
#include "emulator/world/recording/replay.h"
#include "emulator/world/trace/trace_file.h"
#include "emulator/world/trace/world_capture.h"

namespace understudy::emulator::command_line {

/// Checks that the files can be written, and claims them. Throws UsageError.
void require_looks(const ReplayArguments& arguments, FileClaims& claims);

/// Writes the files during a replay. The constructor opens them, or throws an error with the reason.
class ReplayLooks final : public world::ReplayWatcher {
 public:
  /// At the end, `seen` receives the page's content: the run log and the steps.
  ReplayLooks(world::World& world, const ReplayArguments& arguments, play::ScenarioResult& seen);
  ~ReplayLooks() override;
  ReplayLooks(const ReplayLooks&) = delete;
  ReplayLooks& operator=(const ReplayLooks&) = delete;

  void happened(const world::RecordedEvent& event, std::size_t line_number) override;
  void ended() override;

 private:
  void begin_step(std::string text, std::size_t line_number);

  world::World& world_;
  play::ScenarioResult& seen_;
  std::unique_ptr<world::WorldCapture> capture_;
  std::unique_ptr<world::TraceFile> trace_;
  std::unique_ptr<play::RunLogger> run_logger_;  // for the page
};

/// Returns the result for the page. `seen` contains the content collected by ReplayLooks.
play::ScenarioResult result_of(const world::Replayed& replayed, const std::string& recording,
                               play::ScenarioResult seen);

}  // namespace understudy::emulator::command_line
