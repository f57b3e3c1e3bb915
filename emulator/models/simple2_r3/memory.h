// The memory that a Simple2-R3 retains without power, and the password that locks its program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "emulator/device/memory/eeprom.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/simple2_r3/setup.h"
#include "emulator/models/simple2_r3/state.h"

namespace understudy::emulator::models::simple2_r3 {

std::uint32_t factory_bits(const Setup& setup, const RegisterRow& row);
Eeprom factory_memory(const Setup& setup);
bool is_unlocked(const State& state, const Setup& setup);

class Memory {
 public:
  Memory(State& state, const Setup& setup) : state_(state), setup_(setup) {}

  /// Saves a register that a host or a program has written. `was_saving` indicates whether the EEPROM was
  /// being written when the request arrived; the first register of a request sets it.
  void save(const RegisterRow& row, std::size_t slot, std::optional<bool>& was_saving);
  /// Changes the password to NEW_PWD.
  void take_password();
  /// Compares PWD_Input with the password, and locks or unlocks the program.
  void judge_lock();
  /// Handles a write to NEW_PWD, which has no effect while the program is locked.
  void change_password(std::uint16_t password);

 private:
  State& state_;
  const Setup& setup_;
};

}  // namespace understudy::emulator::models::simple2_r3
