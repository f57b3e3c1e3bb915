// Changes that affect a Simple2-R3 as a whole: power-up, power-down, factory reset, erasure.
#pragma once

#include "emulator/device/register_map/register_bank.h"
#include "emulator/models/simple2_r3/memory.h"
#include "emulator/models/simple2_r3/programs.h"
#include "emulator/models/simple2_r3/setup.h"
#include "emulator/models/simple2_r3/state.h"

namespace understudy::emulator::models::simple2_r3 {

class Power {
 public:
  Power(State& state, const Setup& setup, RegisterBank& bank)
      : state_(state), setup_(setup), memory_(state, setup), programs_(state, setup, bank) {}

  void up();
  void down();
  void reset_to_factory();
  void erase_program();

 private:
  State& state_;
  const Setup& setup_;
  Memory memory_;
  Programs programs_;
};

}  // namespace understudy::emulator::models::simple2_r3
