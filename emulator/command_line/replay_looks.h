// What is written about a recording while it is run again: a trace, a capture, a page.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "emulator/command_line/commands.h"
#include "emulator/file_claims.h"
#include "emulator/recording/replay.h"
#include "emulator/report/camera.h"
#include "emulator/scenario/result.h"
#include "emulator/trace/trace_file.h"
#include "emulator/trace/world_capture.h"

namespace understudy::emulator {

/// The files that are asked for may be written: else UsageError. They are claimed from then on.
void demand_looks(const ReplayArguments& arguments, FileClaims& claims);

/// Opens the files, or throws what says why not.
class ReplayLooks final : public ReplayWatcher {
 public:
  /// `seen` gets what a page tells, once all is over; its footage and its steps.
  ReplayLooks(World& world, const ReplayArguments& arguments, ScenarioResult& seen);
  ~ReplayLooks() override;
  ReplayLooks(const ReplayLooks&) = delete;
  ReplayLooks& operator=(const ReplayLooks&) = delete;

  void happened(const RecordedEvent& event, std::size_t line_number) override;
  void ended() override;

 private:
  void begin_step(std::string text, std::size_t line_number);

  World& world_;
  ScenarioResult& seen_;
  std::unique_ptr<WorldCapture> capture_;
  std::unique_ptr<TraceFile> trace_;
  std::unique_ptr<Camera> camera_;  // of a page
};

/// What came of it, for the page. `seen` is what the looks have seen.
ScenarioResult result_of(const Replayed& replayed, const std::string& recording, ScenarioResult seen);

}  // namespace understudy::emulator
