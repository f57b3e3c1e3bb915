// A machine for programs under test: tests set contacts and registers, motions take as many ticks as the test
// sets, and the requests of programs are recorded.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "interpreter/super_40nc/access.h"
#include "interpreter/super_40nc/machine.h"

namespace understudy::interpreter::super_40nc {

inline std::string text_of(const AxisValues& values) {
  std::string text;
  for (const auto& value : values) text += value ? ' ' + std::to_string(*value) : std::string(" *");
  return text;
}
inline std::string text_of(const PlanePoint& point) {
  std::string text;
  for (const auto& value : point) text += value ? ' ' + std::to_string(*value) : std::string(" *");
  return text;
}

class ScriptedMachine : public Machine {
 public:
  ScriptedMachine() { registers[named::kOwnedAxes] = 4; }

  static constexpr CellLayout kLayout{
      .x = 5, .y = 60, .m = 100, .t = 620, .c = 690, .t_value = 730, .c_value = 800, .d = 840};
  CellLayout layout() const override { return kLayout; }
  std::span<std::uint32_t> cells() override { return memory; }
  void retentive_cell_written(std::uint32_t cell) override {
    kept.insert(cell);
    ++kept_writes;
  }

  bool special_contact(int number) const override {
    return number == named::kAlwaysOn || special.contains(number);
  }
  bool set_special_contact(int number, bool on) override {
    if (special_contact(number) == on) return false;
    on ? static_cast<void>(special.insert(number)) : static_cast<void>(special.erase(number));
    return true;
  }
  std::int32_t special_register(int number) const override {
    const auto found = registers.find(number);
    return found == registers.end() ? 0 : found->second;
  }
  bool set_special_register(int number, std::int32_t value) override {
    const bool has_changed = special_register(number) != value;
    registers[number] = value;
    return has_changed;
  }
  std::int32_t rpm_at_power_up(int axis) const override { return 100 * (axis + 1); }
  void report(Code code, Area, int step) override { codes.push_back({static_cast<int>(code), step, 0}); }

  bool is_held_in_reset(Area area) const override { return held_in_reset.contains(area); }
  void program_starts(Area area) override { say(area, "starts"); }
  void program_ended(Area area) override { say(area, "ended"); }

  Begun begin(Area by, const LinearMove& move) override {
    return begun(
        by, "LIN" + text_of(move.target_lu) + mode(move.targets) + " F" + std::to_string(move.feed_lu_per_s));
  }
  Begun begin(Area by, const CentreArc& arc) override {
    return begun(by, std::string(arc.turn == Turn::clockwise ? "CW" : "CCW") + plane(arc.plane) +
                         text_of(arc.end_lu) + " around " + std::to_string(arc.centre_lu[0]) + ' ' +
                         std::to_string(arc.centre_lu[1]) + mode(arc.targets) + " F" +
                         std::to_string(arc.feed_lu_per_s));
  }
  Begun begin(Area by, const PointArc& arc) override {
    return begun(by, "C3P" + plane(arc.plane) + text_of(arc.through_lu) + " to" + text_of(arc.end_lu) +
                         mode(arc.targets) + " F" + std::to_string(arc.feed_lu_per_s));
  }
  Begun begin(Area by, const RadiusArc& arc) override {
    return begun(by, std::string(arc.turn == Turn::clockwise ? "CWR" : "CCWR") + plane(arc.plane) +
                         text_of(arc.end_lu) + " R" + std::to_string(arc.radius_lu) + mode(arc.targets) +
                         " F" + std::to_string(arc.feed_lu_per_s));
  }
  Begun begin(Area by, const Drive& drive) override {
    return begun(by, "DRV" + text_of(drive.target_lu) + mode(drive.targets) +
                         speeds(drive.target_lu, drive.rpm) + (drive.is_waited_for ? "" : " unwaited"));
  }
  Begun begin(Area by, const MarkSearch& search) override {
    return begun(
        by, "MRK" + text_of(search.target_lu) + mode(search.targets) + speeds(search.target_lu, search.rpm));
  }
  Begun begin(Area by, const HomeSearch& search) override {
    return begun(by, "HOM " + std::to_string(search.axes));
  }
  Begun begin(Area by, const Rotation& rotation) override {
    return begun(by, "VDRV" + text_of(rotation.rpm));
  }
  Begun begin(Area by, const WheelRatios& ratios) override {
    return begun(by, "MPG" + text_of(ratios.lu_per_count));
  }
  bool is_running(Area by) const override { return left.at(index_of(by)) > 0; }
  void hold(Area by) override {
    say(by, "hold");
    holds.insert(by);
  }
  void resume_motions(Area by) override {
    say(by, "go on");
    holds.erase(by);
  }
  void drop_held(Area by) override {
    say(by, "drop");
    holds.erase(by);
    left.at(index_of(by)) = 0;
  }
  Areas stop(Area area) override {
    say(area, "stop");
    holds.erase(area);
    left.at(index_of(area)) = 0;
    return lost;
  }
  void waits_no_more(Area) override {}

  void plc_drive(const Drive& drive, int) override {
    say(Area::plc,
        "DRV" + text_of(drive.target_lu) + mode(drive.targets) + speeds(drive.target_lu, drive.rpm));
  }
  void plc_home(const HomeSearch& search, int) override {
    say(Area::plc, "HOM " + std::to_string(search.axes));
  }
  bool plc_jog(const Jogs& jogs, const JogSteps&) override {
    say(Area::plc, "JOG " + std::to_string(jogs.positive) + ' ' + std::to_string(jogs.negative));
    return false;
  }
  bool set_positions(const SetPositions& positions) override {
    log.push_back((positions.of_machine ? "MSET" : "PSET") + text_of(positions.position_lu));
    return false;
  }

  // --- for tests -----------------------------------------------------------------------------------
  /// Runs one tick of motion.
  void move() {
    for (std::size_t i = 0; i < left.size(); ++i) {
      if (left.at(i) > 0 && !holds.contains(static_cast<Area>(i))) --left.at(i);
    }
  }
  bool contact(Operand operand) { return Access(*this).contact(operand); }
  std::int32_t value(Operand operand) { return Access(*this).value(operand); }
  void set(Operand operand, bool on) { Access(*this).switch_contact(operand, on); }
  void write(Operand operand, std::int32_t value) { Access(*this).write(operand, value); }

  std::array<std::uint32_t, 1900> memory{};
  std::set<std::uint32_t> kept;
  int kept_writes = 0;
  std::set<int> special;  // those that are ON
  std::map<int, std::int32_t> registers;
  std::vector<std::array<int, 3>> codes;
  std::set<Area> held_in_reset;
  std::set<Area> holds;
  std::array<int, kStepProgramCount> left{};  // ticks of their motions
  int motion_ticks = 3;
  std::map<std::string, Begun> answers;  // by the first word
  Areas lost = 0;
  std::vector<std::string> log;

 private:
  static std::string mode(Targets targets) { return targets == Targets::relative ? " relative" : ""; }
  static std::string plane(Plane plane) {
    constexpr const char* kNames[] = {" XY", " XZ", " YZ"};
    return kNames[static_cast<int>(plane)];
  }
  static std::string speeds(const AxisValues& values, const std::array<std::int32_t, kAxisCount>& rpm) {
    std::string text;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i]) text += (text.empty() ? " at " : ",") + std::to_string(rpm[i]);
    }
    return text;
  }
  void say(Area area, const std::string& what) {
    log.push_back(std::string(row_of(area).name) + ": " + what);
  }
  Begun begun(Area by, const std::string& what) {
    const auto answer = answers.find(what.substr(0, what.find(' ')));
    if (answer != answers.end() && answer->second != Begun::runs) {
      if (answer->second == Begun::done) say(by, what);
      return answer->second;
    }
    say(by, what);
    left.at(index_of(by)) = motion_ticks;
    return Begun::runs;
  }
};

inline Operand x(std::int32_t number) { return {Letter::x, number}; }
inline Operand y(std::int32_t number) { return {Letter::y, number}; }
inline Operand m(std::int32_t number) { return {Letter::m, number}; }
inline Operand t(std::int32_t number) { return {Letter::t, number}; }
inline Operand c(std::int32_t number) { return {Letter::c, number}; }
inline Operand d(std::int32_t number) { return {Letter::d, number}; }

}  // namespace understudy::interpreter::super_40nc
