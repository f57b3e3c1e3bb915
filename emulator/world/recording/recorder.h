// Writes down what reaches a world from outside and what its stations say.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "emulator/world/recording/recording.h"

namespace understudy::emulator::world {

class Recorder final : private OutsideListener {
 public:
  /// Begins now: `take` gets the header's line, then a line for each event, each with its line end. The world
  /// must outlive it.
  Recorder(World& world, const RecordingHeader& header, std::function<void(std::string_view line)> take);
  /// Ends it, without a state.
  ~Recorder() override;
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Writes that the recording ends at this moment, once; and in which state, which a replay must reach as
  /// well; and in what a scenario failed, if one did. Not from within World::advance_to().
  void finish(std::string failed = {});

 private:
  class LineEar;
  void end_with(std::string state, std::string failed);
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
  std::function<void(std::string_view)> take_;
  std::vector<std::unique_ptr<LineEar>> ears_;
  bool is_finished_ = false;
};

}  // namespace understudy::emulator::world
