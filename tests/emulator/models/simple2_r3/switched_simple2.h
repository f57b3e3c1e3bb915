// One Simple2-R3 whose power can be switched.
#pragma once

#include "tests/emulator/models/simple2_r3/one_simple2.h"

namespace understudy::emulator::models::simple2_r3 {

struct Switched : OneSimple2 {
  using OneSimple2::OneSimple2;
  void power(bool on) { world().switch_power(0, on); }
  void cycle(Tick off_for = 0) {
    power(false);
    run(off_for);
    power(true);
  }
  bool outputs_any() const {
    for (int i = 0; i < 7; ++i) {
      if (output(i)) return true;
    }
    return false;
  }
  std::int64_t place(int axis) { return world().plant(0, axis).position_pulses(); }
};

}  // namespace understudy::emulator::models::simple2_r3
