// A machine that only records what a program requests.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "interpreter/simple2/execution/execution.h"

namespace understudy::interpreter::simple2 {

/// Returns a program with these lines, from line 0 on.
inline Program program_of(const std::vector<Line>& lines) {
  Lines all{};
  for (std::size_t i = 0; i < lines.size(); ++i) all[i] = lines[i];
  return Program(all);
}

class ScriptedMachine final : public Machine {
 public:
  // The program's input, which tests set.
  std::uint16_t inputs = 0;  // bit n: DIN n
  std::uint16_t status = 0;
  std::array<std::int32_t, 256> parameters{};
  bool moving_a = false;
  bool moving_b = false;
  bool cut_short_a = false;
  bool cut_short_b = false;

  // The program's output.
  std::uint8_t outputs = 0;  // bit n: DOUT n
  std::vector<std::string> calls;

  bool operator==(const ScriptedMachine& other) const {
    return inputs == other.inputs && status == other.status && parameters == other.parameters &&
           moving_a == other.moving_a && moving_b == other.moving_b && outputs == other.outputs &&
           calls == other.calls;
  }

  /// Returns the calls since the last take_calls(): "A by 500; B by -3".
  std::string take_calls() {
    std::string text;
    for (const std::string& call : calls) text += (text.empty() ? "" : "; ") + call;
    calls.clear();
    return text;
  }

  bool input(int din) const override {
    EXPECT_TRUE(din >= 0 && din <= 10) << din;
    return (inputs >> din & 1) != 0;
  }
  bool status_bit(int bit) const override {
    EXPECT_TRUE(bit >= 0 && bit <= 15) << bit;
    return (status >> bit & 1) != 0;
  }
  void set_outputs(std::uint8_t which, std::uint8_t levels) override {
    EXPECT_LE(which, 0x7F);
    outputs = static_cast<std::uint8_t>((outputs & ~which) | (levels & which));
    calls.push_back("outputs " + bits(outputs));
  }
  std::int32_t parameter(int number) const override {
    return parameters.at(static_cast<std::size_t>(number));
  }
  void set_parameter(int number, std::int32_t value) override {
    parameters.at(static_cast<std::size_t>(number)) = value;
    calls.push_back("p" + std::to_string(number) + " = " + std::to_string(value));
  }
  void run_timer(int timer, bool run) override {
    EXPECT_TRUE(timer == 1 || timer == 2) << timer;
    calls.push_back("timer " + std::to_string(timer) + (run ? " runs" : " stands"));
  }
  void move_incremental(Axis axis, std::int32_t pulses) override {
    say(axis, "by " + std::to_string(pulses));
  }
  void move_absolute(Axis axis, std::int32_t pulses) override { say(axis, "to " + std::to_string(pulses)); }
  void go_home(Axis axis) override { say(axis, "home"); }
  bool moving(Axis axis) const override { return axis == Axis::a ? moving_a : moving_b; }
  bool cut_short(Axis axis) const override { return axis == Axis::a ? cut_short_a : cut_short_b; }
  void set_speed(Axis axis, std::int32_t rpm) override { say(axis, "speed " + std::to_string(rpm)); }
  void set_ramps(Axis axis, std::int32_t acceleration_10ms, std::int32_t deceleration_10ms) override {
    say(axis, "ramps " + std::to_string(acceleration_10ms) + " " + std::to_string(deceleration_10ms));
  }
  void stop(Axis axis) override { say(axis, "stop"); }
  void switch_servo(Axis axis, bool on) override { say(axis, on ? "servo on" : "servo off"); }
  void run_velocity(Axis axis, std::int32_t milli_rpm) override {
    say(axis, "mRPM " + std::to_string(milli_rpm));
  }
  void output_pwm(Axis axis, std::int32_t percent) override { say(axis, "PWM " + std::to_string(percent)); }
  void follow_encoder(Axis axis) override { say(axis, "follows"); }

 private:
  void say(Axis axis, const std::string& what) { calls.push_back((axis == Axis::a ? "A " : "B ") + what); }

  static std::string bits(std::uint8_t levels) {
    std::string text;
    for (int bit = 6; bit >= 0; --bit) text += (levels >> bit & 1) != 0 ? '1' : '0';
    return text;
  }
};

/// A program on a scripted machine, slot by slot.
struct ProgramRun {
  Program program;
  Dialect dialect{};
  ScriptedMachine machine{};
  Execution execution{};
  std::int64_t next_slot_ms = 0;

  explicit ProgramRun(const Program& code, std::uint8_t first_line = 0) : program(code) {
    start(execution, first_line);
  }

  /// Runs the slot at `next_slot_ms`.
  void slot() {
    step(execution, next_slot_ms, program, dialect, machine);
    next_slot_ms += kSlotMs;
  }
  /// Runs every slot before `ms`.
  void until(std::int64_t ms) {
    while (next_slot_ms < ms) slot();
  }
  /// Runs slots until the program ends, but at most `max`.
  void to_the_end(int max = 10000) {
    while (execution.running && max-- > 0) slot();
    EXPECT_FALSE(execution.running) << "still in line " << int{execution.now_line};
  }
};

}  // namespace understudy::interpreter::simple2
