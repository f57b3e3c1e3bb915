// Records everything that reaches a world from outside, and everything that its stations send.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "emulator/world/recording/recording.h"

namespace understudy::emulator::world {

class Recorder final : private OutsideListener {
 public:
  /// Starts now. `take` receives each event. The world must outlive the recorder.
  Recorder(World& world, std::function<void(RecordedEvent event)> take);
  /// The same, but as text: `take` receives the header line, followed by a line for each event. All lines
  /// have line endings.
  Recorder(World& world, const RecordingHeader& header, std::function<void(std::string_view line)> take);
  /// Ends the recording without a final state.
  ~Recorder() override;
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Writes that the recording ends at this moment, with the state that a replay must reach and, if a
  /// scenario failed, its failure. Further calls do nothing. Do not call this from within
  /// World::advance_to().
  void finish(RecordedFailure failed = {});
  /// Writes an event that the world does not report.
  void note(RecordedEvent event) { take(std::move(event)); }

 private:
  class LineRecorder;
  void end_with(std::string state, RecordedFailure failed);
  void take(RecordedEvent event);

  void on_input(std::size_t device, int terminal, std::int32_t level) override;
  void on_power(std::size_t device, bool on) override;
  void on_inject(const Fault& fault) override;
  void on_clear_fault(std::size_t number) override;
  void on_write(std::size_t device, const PreparedWrite& write) override;
  void on_assign(std::size_t device, std::string_view name, double value) override;
  void on_program(std::size_t device, std::string_view text, bool is_refused) override;
  void on_command(std::size_t device, std::string_view text) override;

  World& world_;
  std::function<void(RecordedEvent)> take_;
  std::vector<std::unique_ptr<LineRecorder>> line_recorders_;
  bool is_finished_ = false;
};

}  // namespace understudy::emulator::world
