// Executes the steps of a scenario one by one on an executor, with all observers.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "emulator/play/executors/executor.h"
#include "emulator/play/performing/watches.h"
#include "emulator/play/results/result.h"
#include "emulator/play/scenario/requests.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/frames/frame_log.h"
#include "emulator/world/outcome_hash.h"
#include "emulator/world/probe/peaks.h"
#include "emulator/world/probe/probes.h"
#include "emulator/world/snapshot.h"

namespace understudy::emulator::play {

/// Why a step failed. `what`, `expected`, `came` and `details` are as in Failure.
struct StepError : std::runtime_error {
  StepError(const std::string& what_is_wrong, std::string what_was_expected = {}, std::string what_came = {},
            std::vector<std::string> further_details = {})
      : std::runtime_error(what_is_wrong),
        expected(std::move(what_was_expected)),
        came(std::move(what_came)),
        details(std::move(further_details)) {}
  std::string expected;
  std::string came;
  std::vector<std::string> details;
};

class Performance {
 public:
  /// A state between two steps, from which another performance of the same scenario can continue.
  struct Checkpoint {
    world::WorldState world;
    std::vector<SpanWatch::Span> spans;
    world::Peaks::State peaks;
    std::vector<std::pair<std::string, std::size_t>> faults;
    Tick last_write = 0;
    std::map<std::string, ConditionHistory::State> histories;
    std::vector<SimTime> quiet_since;  // see Executor::quiet_since()
    std::uint64_t hash = 0;
  };

  /// The scenario must outlive this object. `with_hash` enables outcome_hash(), which takes time to compute.
  /// `command` is the command that runs with the scenario, or null.
  Performance(const Scenario& scenario, std::unique_ptr<Executor> executor, bool with_hash,
              HostCommand* command = nullptr);
  ~Performance();
  Performance(const Performance&) = delete;
  Performance& operator=(const Performance&) = delete;

  /// Executes the first of `steps`, which must not be a snapshot, a restore or a fork. The other steps show
  /// what will be awaited.
  std::optional<Failure> play(std::span<const Step> steps);
  /// After the last step, continues until the command that runs with the scenario has ended. Until then,
  /// `always` and `never` conditions are checked.
  std::optional<Failure> finish_with_command();
  /// Returns true if the controllers are real. In this case, steps may be skipped.
  bool is_on_box() const { return on_box_ != nullptr; }
  /// Returns why the last step was skipped, or an empty text if it was not.
  const std::string& skipped() const { return skipped_; }
  /// Brings a real controller into the initial state of the scenario, as far as that state can be read or
  /// written over the line. Called before the first step.
  std::optional<Failure> begin_on_box();
  /// Makes the next step begin now. Otherwise, an `advance` compensates for the time since the last step.
  void begin_step_now();
  /// Returns the present value, from the world or from a real controller.
  world::Number present_value(const std::string& expression);

  Checkpoint save();
  void restore(const Checkpoint& checkpoint);

  SimTime now() { return executor_->now(); }
  /// See Executor::with_world().
  void with_world(const std::function<void(world::World&)>& act) { executor_->with_world(act); }
  std::uint64_t outcome_hash();

 private:
  class OnBox;  // performance_on_box.h
  friend struct StepOnBox;

  /// The observers of the world.
  struct WorldObservers {
    WorldObservers(world::World& of, bool with_hash);
    world::World& world;
    world::Peaks peaks;
    world::Probes probes;
    SpanWatch spans;
    world::FrameLog frames;
    std::unique_ptr<world::OutcomeHash> hash;
    std::map<std::string, ConditionHistory> histories;  // for the condition of a `wait` that follows a write
  };
  struct Place {
    std::size_t line = 0;
    int station = 0;
    std::string on_line{};  // " on line rs485" if the device is on several lines, for messages
  };

  // Steps that use the line are in performance_line.cpp.
  void perform(const WriteStep& step);
  void perform(const CommandStep& step);
  void perform(const ExpectStep& step);
  void perform(const SendStep& step);
  void perform(const TextStep& step);  // performance_text.cpp
  /// Reads the words of all targets, one after another.
  std::vector<std::vector<std::uint16_t>> read_over_line(const std::vector<Target>& targets,
                                                         const Answer& answer, const Via& via);
  /// Returns the line and the present station number of a device.
  Place spoken_to(std::size_t device, const Via& via);
  void require(const HostReply& reply, const Answer& answer, const std::string& what);
  void require_silence(const Place& place, const std::vector<std::uint8_t>& request, SimTime within,
                       const std::string& what);
  std::vector<Words> words_of_all(const std::vector<Target>& targets, std::vector<bool>& low_word_first);

  // Steps that wait, or that check every tick, are in performance_time.cpp.
  void perform(const WaitStep& step);
  void perform(const AdvanceStep& step);
  void perform(const AssertStep& step);
  void perform(const SpanStep& step);
  void perform(const EndSpanStep& step);
  void perform(const ResetPeaksStep& step);
  void perform(const SayStep&) {}
  bool wait_for_command(SimTime deadline);
  Tick wait_for(const WaitStep& step);
  Tick poll_for(const WaitStep& step);
  /// Runs to that time, or to the tick in which a span is violated.
  void pass_time(SimTime until);
  /// Returns the moment after that duration. Throws StepError if it is beyond the end of time.
  SimTime moment_in(SimTime duration);
  Tick last_write();
  void begin_history(const std::string& condition, const ConditionHistory::State& past = {});
  void end_histories();

  // Steps that act on the bench are in performance_outside.cpp.
  void perform(const InputStep& step);
  void perform(const TurnStep& step);
  void perform(const InjectStep& step);
  void perform(const ClearStep& step);
  void perform(const PowerStep& step);
  void perform(const ProgramStep& step);
  void perform(const MemoryStep& step);
  void perform(const CommandEndStep& step);

  // run.h executes these.
  void perform(const SnapshotStep&) {}
  void perform(const RestoreStep&) {}
  void perform(const ForkStep&) {}

  void throw_if_broken();
  Failure explain_failure(const StepError& error);

  std::unique_ptr<Executor> executor_;
  std::unique_ptr<OnBox> on_box_;  // null: the world emulates the controllers
  std::string skipped_;
  HostCommand* command_;
  const world::Bench& bench_;
  std::vector<std::vector<std::size_t>> lines_;  // by device: its lines
  std::unique_ptr<WorldObservers> world_observers_;
  bool keeps_peaks_ = false;
  const Step* step_ = nullptr;                               // the step that is being executed
  std::vector<std::pair<std::string, std::size_t>> faults_;  // names, with the world's numbers
  Tick last_write_ = 0;                                      // that of the checkpoint, until the next write
};

}  // namespace understudy::emulator::play
