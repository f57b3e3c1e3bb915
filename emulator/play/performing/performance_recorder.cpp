#include "emulator/play/performing/performance_recorder.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "base/files/content_kind.h"
#include "base/files/growing_file.h"
#include "emulator/play/results/result.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/names/names.h"
#include "emulator/world/recording/recording.h"
#include "emulator/world/recording/recording_spool.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/snapshot_file.h"
#include "emulator/world/world.h"

namespace understudy::emulator::play {

namespace {

world::RecordedFailure recorded_failure(const ScenarioResult& result) {
  if (!result.failure) return {};
  world::RecordedFailure failed{
      .what = result.failure->what, .at = result.failure->at, .scenario = result.name};
  // If a condition is false, its values follow.
  const std::size_t values = result.failure->came.find("  (");
  if (values != std::string::npos) failed.what += result.failure->came.substr(values + 1);
  if (result.steps.empty()) return failed;
  const StepResult& step = result.steps.back();
  failed.place = std::filesystem::path(step.file).filename().string() + ":" + std::to_string(step.line);
  failed.step = step.text;
  return failed;
}

}  // namespace

PerformanceRecorder::PerformanceRecorder(world::World& world, world::RecordingHeader header, std::string path)
    : world_(world), header_(std::move(header)), path_(std::move(path)) {
  begin();
}

void PerformanceRecorder::begin() {
  // Finishes the previous recording, so that its file can be used again.
  spool_.reset();
  const auto log = [](const std::string&) {};  // the end of the scenario reports an interruption
  spool_ = std::make_unique<world::RecordingSpool>(
      world_, header_, std::make_unique<GrowingFile>(path_, ContentKind::recording, log),
      world::kRecordingCapBytes, log);
}

void PerformanceRecorder::world_restored(std::size_t) {
  header_.snapshot = world::to_text(
      world::save(world_),
      world::bench_hash(world::parse_recorded_bench(world::models_of(world_.known()), header_.bench)));
  begin();
}

void PerformanceRecorder::step_over() { spool_->poll(); }

void PerformanceRecorder::finish(ScenarioResult& result) {
  // Most recordings are discarded, so only those of failures end with a state. Saving it takes a third of the
  // time of a short scenario.
  if (result.verdict != ScenarioResult::Verdict::passed) {
    spool_->finish(recorded_failure(result));
  }
  const std::string failure = spool_->close();
  spool_.reset();
  if (!failure.empty()) throw GrowingFileError(failure);
  result.recording = path_;
}

}  // namespace understudy::emulator::play
