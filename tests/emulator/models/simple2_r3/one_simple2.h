// A world of one Simple2-R3, reached through its registers.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/register_map/access.h"
#include "emulator/device/terminals.h"
#include "emulator/models/simple2_r3/model.h"
#include "emulator/world/names/names.h"
#include "emulator/world/world.h"

namespace understudy::emulator::models::simple2_r3 {

struct Given {
  Firmware firmware = 152;
  int address = 1;
  std::map<std::string, std::string> choices{};
  std::vector<std::pair<std::string, Value>> set{};
  std::map<int, world::PlantSetup> plant{};  // by axis
};

inline constexpr Value kMovingA = 1 << 4;
inline constexpr Value kMovingB = 1 << 5;
inline constexpr Value kServoA = 1 << 10;
inline constexpr Value kServoB = 1 << 11;

class OneSimple2 {
 public:
  explicit OneSimple2(const Given& given = {}) : world_(bench(given), {}, {}) {}

  world::World& world() { return world_; }
  Device& device() { return world_.device(0); }

  // --- registers -------------------------------------------------------------------------------
  Value get(std::string_view name) const {
    return read_value(*world_.device(0).register_bank(), world::find_register(world_.known(), name).place);
  }
  bool bit(std::string_view name) const { return get(name) != 0; }
  Refusal try_set(std::string_view name, Value value) {
    return write_value(*world_.device(0).register_bank(), world::find_register(world_.known(), name).place,
                       value);
  }
  void set(std::string_view name, Value value) {
    EXPECT_EQ(try_set(name, value), Refusal::none) << name << " = " << value;
  }
  /// Sends one request that writes several words.
  void write(std::uint16_t first, const std::vector<std::uint16_t>& words) {
    EXPECT_EQ(write_words(*world_.device(0).register_bank(), Table::holding, first, words), Refusal::none)
        << first;
  }
  Refusal try_read(std::uint16_t address) const {
    std::uint16_t word = 0;
    return read_words(*world_.device(0).register_bank(), Table::holding, address, std::span(&word, 1));
  }

  // --- motion, of axis 'A' or 'B' ------------------------------------------------------------------
  void set_move(char axis, Value pulses, Value speed, Value acc, Value dec) {
    set(name(axis, "Pulse"), pulses);
    set(name(axis, "Speed"), speed);
    set(name(axis, "AccTime"), acc);
    set(name(axis, "DecTime"), dec);
  }
  /// Sets one pulse per millisecond and ramps of 10 ms: s(t) = t^2/20 up to 10 ms, then t - 5.
  void set_one_pulse_a_tick(char axis, Value pulses) {
    set(name(axis, "Resoultion"), 3000);
    set_move(axis, pulses, 20, 1, 1);
  }
  bool moving(char axis) const { return bit(axis == 'A' ? "STATUS.4" : "STATUS.5"); }
  Value coordinate(char axis) const { return get(axis == 'A' ? "Cord_A" : "Cord_B"); }
  static std::string name(char axis, std::string_view what) {
    return std::string(1, axis) + "axis_" + std::string(what);
  }

  // --- time and inputs ---------------------------------------------------------------------------
  Tick now() const { return tick_at(world_.now()); }
  void run_to(Tick tick) { world_.advance_to(time_of(tick)); }
  void run(Tick ticks) { run_to(now() + ticks); }
  /// Returns the ticks until the moving bit is 0.
  Tick run_while_moving(char axis, Tick at_most = 200'000) {
    const Tick begin = now();
    while (moving(axis) && now() - begin < at_most) run(1);
    return now() - begin;
  }
  void input(int number, bool on) { world_.set_external_input(0, number, on); }
  bool output(int number) const { return world_.device(0).terminals()->output(11 + number); }

 private:
  static world::Bench bench(const Given& given) {
    world::Bench bench;
    world::DeviceSetup device{.model = &model(), .settings = {}};
    device.settings.name = "feeder";
    device.settings.firmware = given.firmware;
    device.settings.address = given.address;
    device.settings.choices = given.choices;
    device.settings.set = given.set;
    bench.devices.push_back(device);
    bench.lines.push_back({.name = "rs485", .link = {}, .timing = pty::Timing::instant, .stations = {0}});
    for (const auto& [axis, plant] : given.plant)
      bench.machines.push_back({.device = 0, .axis = axis, .plant = plant});
    return bench;
  }

  world::World world_;
};

/// A device with both servos on.
struct ReadySimple2 : OneSimple2 {
  explicit ReadySimple2(const Given& given = {}) : OneSimple2(given) {
    set("ALL_SVON", 1);
    run_to(10);
  }
};

}  // namespace understudy::emulator::models::simple2_r3
