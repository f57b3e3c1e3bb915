#include "emulator/command_line/replay_looks.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "base/files/file_claims.h"
#include "base/files/growing_file.h"
#include "base/simulated_time.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/log.h"
#include "emulator/command_line/output_paths.h"
#include "emulator/play/report/run_log.h"
#include "emulator/play/report/run_logger.h"
#include "emulator/play/results/result.h"
#include "emulator/world/names/names.h"
#include "emulator/world/recording/event_text.h"
#include "emulator/world/recording/recording.h"
#include "emulator/world/recording/replay.h"
#include "emulator/world/trace/trace_file.h"
#include "emulator/world/trace/world_capture.h"
#include "emulator/world/world.h"

namespace understudy::emulator::command_line {

void require_looks(const ReplayArguments& arguments, FileClaims& claims) {
  require_capture(claims, arguments.capture);
  require_trace(claims, arguments.trace, arguments.trace_also);
  require_output(claims, "--report", arguments.report);
}

ReplayLooks::ReplayLooks(world::World& world, const ReplayArguments& arguments, play::ScenarioResult& seen)
    : world_(world), seen_(seen) {
  if (!arguments.capture.empty()) {
    capture_ = std::make_unique<world::WorldCapture>(world, arguments.capture, log_line);
  }
  if (!arguments.trace.empty()) {
    try {
      trace_ = std::make_unique<world::TraceFile>(world, arguments.trace, arguments.trace_also, log_line);
    } catch (const world::NameError& error) {
      throw UsageError(std::string("--trace-also: ") + error.what());
    }
  }
  // All files are opened before any of them is emptied.
  if (capture_) capture_->begin();
  if (trace_) trace_->begin();
  if (arguments.report.empty()) return;
  run_logger_ = std::make_unique<play::RunLogger>(world);
  seen_.file = arguments.recording;
  begin_step("the recording begins", 1);
}

ReplayLooks::~ReplayLooks() = default;

void ReplayLooks::begin_step(std::string text, std::size_t line_number) {
  const SimTime now = world_.now();
  if (!seen_.steps.empty()) seen_.steps.back().end = now;
  seen_.steps.push_back({.file = seen_.file,
                         .line = static_cast<int>(line_number),
                         .text = std::move(text),
                         .begin = now,
                         .end = now});
}

void ReplayLooks::happened(const world::RecordedEvent& event, std::size_t line_number) {
  if (!run_logger_) return;
  if (event.what == world::RecordedEvent::What::wait)
    run_logger_->add({.thread = event.where, .begin = event.since, .end = event.at, .text = event.text});
  if (std::string text = world::text_of(event, world_); !text.empty())
    begin_step(std::move(text), line_number);
}

void ReplayLooks::ended() {
  if (run_logger_) {
    seen_.steps.back().end = world_.now();
    seen_.simulated = world_.now() - seen_.steps.front().begin;
    run_logger_->finish(seen_);
  }
  for (const std::string& failure :
       {trace_ ? trace_->finish() : std::string(), capture_ ? capture_->finish() : std::string()}) {
    if (!failure.empty()) throw GrowingFileError(failure);
  }
}

play::ScenarioResult result_of(const world::Replayed& replayed, const std::string& recording,
                               play::ScenarioResult seen) {
  seen.name = std::filesystem::path(recording).filename().string();
  seen.file = recording;
  if (replayed.result.verdict == world::ReplayResult::Verdict::different) {
    seen.verdict = play::ScenarioResult::Verdict::failed;
    seen.failure =
        play::Failure{.at = replayed.result.reached, .what = "differs: " + replayed.result.difference};
    seen.steps.back().has_failed = true;
  }
  return seen;
}

}  // namespace understudy::emulator::command_line
