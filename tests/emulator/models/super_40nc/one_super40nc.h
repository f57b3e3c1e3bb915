// A world of one SUPER-40NC on both its ports, reached through its registers or by frames.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/device/axes.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/terminals.h"
#include "emulator/models/super_40nc/device.h"
#include "emulator/models/super_40nc/model.h"
#include "emulator/world/names/names.h"
#include "emulator/world/world.h"
#include "pty/rtu_crc.h"
#include "tests/emulator/world/stations/pdus.h"

namespace understudy::emulator::models::super_40nc {

struct Given {
  std::vector<std::pair<std::string, Value>> set{};
  std::map<int, world::PlantSetup> plant{};  // by axis
  std::string program{};
  std::map<std::string, std::string> choices{};
};

/// Returns a listing of the manual by its name in the tests: "S2".
inline std::string sample(const std::string& name) {
  std::ifstream file(std::string(PROJECT_FOLDER) + "/tests/interpreter/super_40nc/samples/" + name + ".lst");
  EXPECT_TRUE(file) << name;
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

class OneSuper40nc {
 public:
  static constexpr std::size_t kRs232 = 0;
  static constexpr std::size_t kRs485 = 1;

  explicit OneSuper40nc(const Given& given = {}) : world_(bench(given), {}, {}) {}

  world::World& world() { return world_; }
  Device& device() { return world_.device(0); }
  Super40nc& it() { return static_cast<Super40nc&>(world_.device(0)); }
  const Super40nc& it() const { return static_cast<const Super40nc&>(world_.device(0)); }

  // --- registers: "D8117", "M8103", "coil.T5" -----------------------------------------------------------
  Value get(std::string_view name) const {
    return read_value(*world_.device(0).register_bank(), world::find_register(world_.known(), name).place);
  }
  bool on(std::string_view name) const { return get(name) != 0; }
  void set(std::string_view name, Value value) {
    EXPECT_EQ(write_value(*world_.device(0).register_bank(), world::find_register(world_.known(), name).place,
                          value),
              Refusal::none)
        << name << " = " << value;
  }
  /// Switches a contact ON, runs a scan, and switches it OFF again.
  void press(std::string_view name) {
    set(name, 1);
    run(1);
    set(name, 0);
    run(1);
  }

  // --- time and inputs ---------------------------------------------------------------------------------
  Tick now() const { return tick_at(world_.now()); }
  void run(Tick ticks) { world_.advance_to(time_of(now() + ticks)); }
  /// Returns the ticks until a contact is OFF.
  Tick run_while(std::string_view name, Tick at_most = 100'000) {
    const Tick begin = now();
    while (on(name) && now() - begin < at_most) run(1);
    return now() - begin;
  }
  void input(std::string_view terminal, std::int32_t level) {
    world_.set_external_input(0, find_terminal(model(), terminal), level);
  }
  bool output(std::string_view terminal) {
    return device().terminals()->output(find_terminal(model(), terminal));
  }

  // --- frames ------------------------------------------------------------------------------------------
  void send_raw(std::size_t line, const world::Bytes& frame) {
    world_.receive(line, frame);
    world_.advance_to(world_.now() + std::chrono::milliseconds(200));
  }
  /// Returns the frame received since the last send_raw(), without its checksum.
  std::string came(std::size_t line) {
    const auto output = world_.line(line).line.output();
    const world::Bytes bytes(output.begin(), output.end());
    world_.take_output(line, bytes.size());
    if (bytes.size() < 4 || !pty::rtu_crc_ok(bytes)) return world::text(bytes);
    return world::text(std::span(bytes).first(bytes.size() - 2));
  }
  std::string ask(std::size_t line, std::string_view text) {
    world::Bytes frame = world::hex(text);
    pty::append_rtu_crc(frame);
    send_raw(line, frame);
    return came(line);
  }

 private:
  static world::Bench bench(const Given& given) {
    world::Bench bench;
    world::DeviceSetup device{.model = &model(), .settings = {}};
    device.settings.name = "mill";
    device.settings.set = given.set;
    device.settings.program = given.program;
    device.settings.choices = given.choices;
    bench.devices.push_back(device);
    for (std::size_t port = 0; port < 2; ++port) {
      world::LineSetup line;
      line.name = port == kRs232 ? "rs232" : "rs485";
      line.timing = pty::Timing::instant;
      line.stations = {{0, port}};
      bench.lines.push_back(line);
    }
    for (const auto& [axis, plant] : given.plant) {
      bench.machines.push_back({.device = 0, .axis = axis, .plant = plant});
    }
    return bench;
  }

  world::World world_;
};

}  // namespace understudy::emulator::models::super_40nc
