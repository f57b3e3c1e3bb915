// A performance with real controllers. Only their answers provide information about them: names become
// requests, waits become polls, and everything that would need the world is done by a rig or a person, or is
// skipped.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/play/executors/real_box.h"
#include "emulator/play/performing/performance.h"
#include "emulator/world/expression/expression.h"

namespace understudy::emulator::play {

class Performance::OnBox {
 public:
  OnBox(Performance& performance, RealBox& box) : performance_(performance), box_(box) {}

  std::optional<Failure> begin();
  std::optional<Failure> play(const Step& step);
  void begin_step_now() { due_ = performance_.executor_->now(); }
  world::Number value_of(const std::string& expression);

 private:
  friend struct StepOnBox;
  class Asking;

  /// Thrown if a step cannot be executed. If later steps depend on its effect, they are also skipped.
  struct Skip : std::runtime_error {
    Skip(const std::string& why, bool are_later_ones_too)
        : std::runtime_error(why), cuts(are_later_ones_too) {}
    bool cuts;
  };
  struct Span {
    std::string name;
    std::string expression;
    bool is_never = false;
    std::string place;
  };

  std::optional<Failure> attempt(const Step* step, const std::function<void()>& act);
  Failure fail(const StepError& error);
  void cut(const Step* step, const std::string& why);

  void use_line(const WriteStep& step);
  void use_line(const CommandStep& step);
  void use_line(const SendStep& step);
  void use_line(const TextStep& step);
  static void look(const std::function<void()>& at);
  void expect(const ExpectStep& step);
  void wait(const WaitStep& step);
  void check(const AssertStep& step);
  void open(const Step& at, const SpanStep& step);
  void check_spans();
  void act(const std::vector<std::string>& words);
  void load(std::size_t device, const std::string& file, const std::string& text);
  void require_reachable(std::size_t line);
  void require_reachable(std::size_t device, const Via& via);
  void set_up(std::size_t device);
  void set_up_surroundings(std::size_t device);
  std::vector<std::string> words_of_input(const world::InputSetup& input) const;
  std::string device_name(std::size_t device) const;
  void let_time_pass(SimTime by);

  Performance& performance_;
  RealBox& box_;
  std::vector<Span> spans_;
  std::string cut_;  // why all later steps are skipped
  /// When the current step would have begun if reading values took no time, as in simulated time.
  SimTime due_{0};
};

}  // namespace understudy::emulator::play
