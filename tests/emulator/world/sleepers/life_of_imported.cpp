#include <cstdint>

#include "tests/emulator/model_file/described.h"
#include "tests/emulator/world/sleepers/lives.h"

namespace understudy::emulator::world::sleepers {
namespace sleepers_imported {

constexpr const char* kList =
    "table,address,name,access,type,min,max,unit,persistent,default,bits\n"
    "holding,0,CONTROL,R/W,u16,,,,0,0,\"0 ENABLE, 1 FORWARD, 2 BACKWARD, 8 START\"\n"
    "holding,1,COMMAND,R/W,u16,,,,0,0,\n"
    "holding,2,TARGET,R/W,s32,,,,0,0,\n"
    "holding,4,DISTANCE,R/W,s32,,,,0,0,\n"
    "holding,6,SPEED,R/W,s32,,,pps,0,1000,\n"
    "holding,8,RAMP,R/W,u16,,,ms,1,100,\n"
    "holding,9,STATUS,R,u16,,,,0,0,\"0 BUSY, 1 READY, 2 ARRIVED, 3 HOMED, 4 ENABLED, 5 ALARM, 6 HOT\"\n"
    "holding,10,POSITION,R/W,s32,,,,0,0,\n"
    "holding,12,NOW,R,s32,,,pps,0,0,\n"
    "holding,14,COUNTS,R,s32,,,,0,0,\n"
    "holding,16,SETPOINT,R/W,s16,-1000,1000,,1,0,\n"
    "holding,17,VALUE,R,s32,,,,0,0,\n"
    "holding,19,OTHER_VALUE,R,f32,,,,0,0,\n"
    "holding,30,B_CONTROL,R/W,u16,,,,0,0,\n"
    "holding,31,B_NOW,R,s32,,,,0,0,\n"
    "holding,33,B_POSITION,R,f32,,,,0,0,\n"
    "holding,35,B_SPEED,R/W,s16,,,,1,200,\n"
    "holding,36,B_RAMP,R/W,u16,,,ms,0,50,\n"
    "holding,40,LIMIT,R/W,s32,,,,1,500,\n"
    "input,0,LEVEL,R,s16,,,,0,0,\n"
    "discrete,0,SWITCHES,R,bit,,,,0,0,\n"
    "discrete,1,ZONE,R,bit,,,,0,0,\n"
    "discrete,2,FAST,R,bit,,,,0,0,\n"
    "discrete,3,NEAR,R,bit,,,,0,0,\n";

constexpr const char* kShown[] = {"POSITION", "NOW",   "COUNTS",      "B_NOW",       "B_POSITION", "VALUE",
                                  "SETPOINT", "LEVEL", "STATUS.BUSY", "OTHER_VALUE", "LIMIT"};

std::string comparison(Draw& draw) {
  static const std::string kRelations[] = {" < ", " <= ", " == ", " != ", " >= ", " > "};
  const std::string left = draw.one_of(kShown);
  const std::string right = draw.one_in(3) ? "LIMIT" : std::to_string(draw.of_any_size_and_sign(4000));
  return left + draw.one_of(kRelations) + right;
}

/// One of each possible kind, bound at random.
std::string some_keys(Draw& draw) {
  const std::string b_speed = draw.one_in(4) ? draw.one_of(kShown) : "B_SPEED";
  std::string text =
      "inputs: { UP: nowhere, DOWN: nowhere, HOME: SWITCHES, ALARM: nowhere, LEVEL_IN: LEVEL }\n"
      "outputs: { LAMP: CONTROL.15, ZONE_OUT: ZONE, FAST_OUT: FAST, NEAR_OUT: NEAR, BUSY_OUT: STATUS.BUSY,\n"
      "           HOT_OUT: STATUS.HOT }\n"
      "momentary: [ COMMAND ]\n"
      "axes:\n"
      "  A: { target: TARGET, distance: DISTANCE, speed: SPEED, acceleration_time: RAMP, start: COMMAND == "
      "1,\n"
      "       start_relative: COMMAND == 2, stop: COMMAND == 3, stop_at_once: COMMAND == 4, home: COMMAND == "
      "5,\n"
      "       forward: CONTROL.FORWARD, backward: CONTROL.BACKWARD, position: POSITION, actual_speed: NOW,\n"
      "       encoder: COUNTS, busy: STATUS.BUSY, ready: STATUS.READY, arrived: STATUS.ARRIVED, homed: "
      "STATUS.HOMED,\n"
      "       enabled: STATUS.ENABLED, alarm: STATUS.ALARM, pulses_per_revolution: 200,\n"
      "       inputs: { upper_limit: UP, lower_limit: DOWN, home: HOME, alarm: ALARM } }\n"
      "  B: { speed: " +
      b_speed + ", acceleration_time: " + (draw.one_in(2) ? "B_RAMP" : "0ms") +
      ", forward: B_CONTROL.0, backward: B_CONTROL.1,\n"
      "       position: B_POSITION, actual_speed: B_NOW, pulses_per_revolution: 200 }\n"
      "follows:\n"
      "  VALUE: { of: " +
      draw.one_of(kShown) + ", time_constant: " + draw.number(1, 900) + "ms, every: " + draw.number(1, 60) +
      "ms }\n"
      "  OTHER_VALUE: { of: SETPOINT, while: " +
      (draw.one_in(2) ? "STATUS.HOT" : "CONTROL.0") + ", rest: LIMIT, rate: " + draw.number(1, 900) +
      ", every: " + draw.number(1, 200) +
      "ms }\n"
      "shows: { ZONE: POSITION > " +
      draw.number(-3000, 3000) + ", FAST: " + comparison(draw) + ", NEAR: " + comparison(draw) +
      ", STATUS.HOT: VALUE >= LIMIT }\n";
  return text;
}

class ImportedLife final : public Life {
 public:
  std::string model(Draw& draw) const override {
    return model_file::quoted_scalar(model_file::model_with(kList, some_keys(draw)));
  }
  Act act(Draw& draw) const override {
    switch (draw.between(0, 15)) {
      case 0: return write_act("TARGET", draw.between(-5000, 5000));
      case 1: return write_act("DISTANCE", draw.between(-3000, 3000));
      case 2: return write_act("SPEED", draw.one_in(4) ? draw.between(-100, 100) : draw.between(0, 40'000));
      case 3: return write_act("RAMP", draw.between(0, 900));
      case 4:
      case 5: return write_act("CONTROL", draw.between(0, 7));
      case 6:
      case 7:
      case 8: return write_act("COMMAND", draw.between(0, 5));
      case 9: return write_act(draw.one_in(2) ? "SETPOINT" : "POSITION", draw.between(-1000, 1000));
      case 10: return write_act("B_SPEED", draw.between(-900, 900));
      case 11: return write_act("LIMIT", draw.of_any_size_and_sign(4000));
      default: return write_act("B_CONTROL", draw.between(0, 2));
    }
  }
};

}  // namespace sleepers_imported

std::unique_ptr<Life> life_of_imported() { return std::make_unique<sleepers_imported::ImportedLife>(); }

}  // namespace understudy::emulator::world::sleepers
