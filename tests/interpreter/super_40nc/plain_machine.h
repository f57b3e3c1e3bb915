// The simplest machine on which programs can run: plain memory, without motion. For benchmarks and fuzz
// targets.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "interpreter/super_40nc/machine.h"
#include "interpreter/super_40nc/plc.h"

namespace understudy::interpreter::super_40nc {

/// Plain memory; nothing moves.
class PlainMachine : public Machine {
 public:
  CellLayout layout() const override {
    return {.x = 0, .y = 48, .m = 80, .t = 592, .c = 656, .t_value = 688, .c_value = 752, .d = 784};
  }
  std::span<std::uint32_t> cells() override { return memory; }
  void retentive_cell_written(std::uint32_t) override {}
  bool special_contact(int number) const override { return contacts.at(place(number)) != 0; }
  bool set_special_contact(int number, bool on) override {
    const bool was_on = std::exchange(contacts.at(place(number)), on ? 1 : 0) != 0;
    return was_on != on;
  }
  std::int32_t special_register(int number) const override { return registers.at(place(number)); }
  bool set_special_register(int number, std::int32_t value) override {
    return std::exchange(registers.at(place(number)), value) != value;
  }
  std::int32_t rpm_at_power_up(int) const override { return 100; }
  void report(Code, Area, int) override {}
  bool is_held_in_reset(Area) const override { return false; }
  void program_starts(Area) override {}
  void program_ended(Area) override {}
  Begun begin(Area, const LinearMove&) override { return Begun::done; }
  Begun begin(Area, const CentreArc&) override { return Begun::done; }
  Begun begin(Area, const PointArc&) override { return Begun::done; }
  Begun begin(Area, const RadiusArc&) override { return Begun::done; }
  Begun begin(Area, const Drive&) override { return Begun::done; }
  Begun begin(Area, const MarkSearch&) override { return Begun::done; }
  Begun begin(Area, const HomeSearch&) override { return Begun::done; }
  Begun begin(Area, const Rotation&) override { return Begun::done; }
  Begun begin(Area, const WheelRatios&) override { return Begun::done; }
  bool is_running(Area) const override { return false; }
  void hold(Area) override {}
  void resume_motions(Area) override {}
  void drop_held(Area) override {}
  Areas stop(Area) override { return 0; }
  void waits_no_more(Area) override {}
  void plc_drive(const Drive&, int) override {}
  void plc_home(const HomeSearch&, int) override {}
  bool plc_jog(const Jogs&, const JogSteps&) override { return false; }
  bool set_positions(const SetPositions&) override { return false; }

  std::array<std::uint32_t, 1800> memory{};
  std::array<std::uint8_t, 1500> contacts{};   // from M8000
  std::array<std::int32_t, 1500> registers{};  // from D8000

 private:
  static std::size_t place(int number) { return static_cast<std::size_t>(number - 8000); }
};

class NoPrograms : public StepControl {
 public:
  void start(Area) override {}
  void stop(Area) override {}
};

}  // namespace understudy::interpreter::super_40nc
