// A world of one described controller with one axis and a value that follows it.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "emulator/device/axes.h"
#include "emulator/device/device.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/terminals.h"
#include "emulator/world/world.h"
#include "tests/emulator/model_file/described.h"

namespace understudy::emulator::models::imported {

inline const std::string kAxisList =
    "table,address,name,access,type,min,max,unit,persistent,default,bits\n"
    "holding,0,CONTROL,R/W,u16,,,,0,0,\"0 ENABLE, 1 FORWARD, 2 BACKWARD, 8 START\"\n"
    "holding,1,COMMAND,R/W,u16,,,,0,0,\n"
    "holding,2,TARGET,R/W,s32,,,,0,0,\n"
    "holding,4,DISTANCE,R/W,s32,,,,0,0,\n"
    "holding,6,SPEED,R/W,s32,,,pps,0,1000,\n"
    "holding,8,RAMP,R/W,u16,,,ms,1,100,\n"
    "holding,9,STATUS,R,u16,,,,0,0,\"0 BUSY, 1 READY, 2 ARRIVED, 3 HOMED, 4 ENABLED, 5 ALARM\"\n"
    "holding,10,POSITION,R/W,s32,,,,0,0,\n"
    "holding,12,NOW,R,s32,,,pps,0,0,\n"
    "holding,14,COUNTS,R,s32,,,,0,0,\n"
    "holding,16,SETPOINT,R/W,s16,-1000,1000,,1,0,\n"
    "holding,17,VALUE,R,s16,,,,0,0,\n"
    "holding,18,SPARE,R/W,f32,,,,1,0,\n"
    "discrete,0,SWITCHES,R,bit,,,,0,0,\n"
    "discrete,1,HIGH,R,bit,,,,0,0,\n";

inline const std::string kAxisKeys =
    "inputs: { UP: nowhere, DOWN: nowhere, HOME: SWITCHES, ALARM: nowhere }\n"
    "outputs: { LAMP: CONTROL.15 }\n"
    "momentary: [ COMMAND ]\n"
    "axes:\n"
    "  A: { target: TARGET, distance: DISTANCE, speed: SPEED, acceleration_time: RAMP, start: COMMAND == 1,\n"
    "       start_relative: COMMAND == 2, stop: COMMAND == 3, stop_at_once: COMMAND == 4, home: COMMAND == "
    "5,\n"
    "       forward: CONTROL.FORWARD, backward: CONTROL.BACKWARD, position: POSITION, actual_speed: NOW,\n"
    "       encoder: COUNTS, busy: STATUS.BUSY, ready: STATUS.READY, arrived: STATUS.ARRIVED, homed: "
    "STATUS.HOMED,\n"
    "       enabled: STATUS.ENABLED, alarm: STATUS.ALARM,\n"
    "       inputs: { upper_limit: UP, lower_limit: DOWN, home: HOME, alarm: ALARM }@ }\n"
    "follows: { VALUE: { of: SETPOINT, time_constant: 2s, every: 10ms } }\n"
    "shows: { HIGH: VALUE > 500 }\n";

/// `more` has further keys of the axis, after a comma.
inline std::string axis_model(const std::string& more = "") {
  std::string keys = kAxisKeys;
  return model_file::model_with(kAxisList, keys.replace(keys.find('@'), 1, more));
}

struct OneDescribed {
  explicit OneDescribed(const std::string& model = axis_model(), const std::string& machine = "")
      : bench(model_file::bench_with(model, machine.empty() ? "" : "plant: { it.A: { " + machine + " } }\n")),
        world(bench, {}, {}) {}

  Device& device() { return world.device(0); }
  /// Writes a value as a host's request would.
  Refusal write(std::string_view name, Value value) {
    RegisterBank& bank = *device().register_bank();
    const auto place = bank.find(name);
    if (!place) throw std::invalid_argument(std::string(name));
    PreparedWrite prepared;
    const Refusal refusal = prepare_value(bank, *place, value, prepared);
    return refusal == Refusal::none ? write_prepared(bank, prepared) : refusal;
  }
  Value read(std::string_view name) {
    RegisterBank& bank = *device().register_bank();
    const auto place = bank.find(name);
    if (!place) throw std::invalid_argument(std::string(name));
    return read_value(bank, *place);
  }
  void advance(Tick ticks) { world.advance_to(world.now() + ticks * kTickLength); }
  /// Returns the ticks until the axis is no longer busy, or -1 if that takes too long.
  Tick ticks_until_still(Tick max = 100'000) {
    for (Tick ticks = 0; ticks <= max; ++ticks) {
      if (read("STATUS.BUSY") == 0) return ticks;
      advance(1);
    }
    return -1;
  }

  world::Bench bench;
  world::World world;
};

}  // namespace understudy::emulator::models::imported
