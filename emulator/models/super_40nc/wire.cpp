// Decides which requests a SUPER-40NC answers, and at which addresses.
#include "emulator/models/super_40nc/wire.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "emulator/device/device.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/register_map/refusal.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/device.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"

namespace understudy::emulator::models::super_40nc {

MapPolicy chosen_map_policy(const Device& device, MapPolicy policy) {
  if (device.chose(option("holes", "read_0_swallow_writes")))
    policy.unmapped = MapPolicy::Unmapped::reads_zero;
  if (device.chose(option("read_only_write", "exception_2"))) policy.read_only = MapPolicy::ReadOnly::refused;
  if (device.chose(option("half_write", "the_sign_fills_the_other_half"))) {
    policy.halves = MapPolicy::Halves::low_gives_the_sign;
  }
  if (device.chose(option("range_checks", "exception_3")))
    policy.out_of_range = MapPolicy::OutOfRange::refused;
  if (device.chose(option("frame_effects", "each_in_its_turn")))
    policy.effects = MapPolicy::Effects::one_by_one;
  if (device.chose(option("range_checks", "nearest_one")))
    policy.out_of_range = MapPolicy::OutOfRange::clamped;
  return policy;
}

Addressing Super40nc::addressing(std::uint8_t address) const {
  // D9000 is the station number. 0 is also a valid number, which the device answers.
  if (address == 0 && chose(option("station_rule", "0_is_never_answered")))
    return Addressing::execute_silently;
  const StoredRegister kept = stored_d(d9::kStation);
  const Value number = chose(option("station_change", "at_the_next_power_up"))
                           ? std::clamp<Value>(state_.station, kept.min, kept.max)
                           : parts_.ground.registers().of(kept);
  if (address == number) return Addressing::execute_and_reply;
  if (address != 0) return Addressing::ignore;
  const bool answers = chose(option("station_rule", "0_answered_as_well"));
  return answers ? Addressing::execute_and_reply : Addressing::execute_silently;
}

bool Super40nc::knows(std::uint8_t function) const {
  constexpr std::uint8_t kInputRegisters = 0x04;
  constexpr std::uint8_t kSeveralCoils = 0x0F;
  if (function == kInputRegisters) return chose(option("input_registers", "as_function_03"));
  return function != kSeveralCoils || !chose(option("coils_at_once", "exception_1"));
}

/// By default, the silence is 3.5 characters.
pty::SimTime Super40nc::end_silence(pty::SimTime usual) const {
  if (chose(option("frame_gap", "10_ms"))) return std::chrono::milliseconds(10);
  return chose(option("frame_gap", "1_5_characters")) ? usual * 3 / 7 : usual;
}

DeviceAnswer Super40nc::admits(const RegisterRequest& request, Checked checked) const {
  constexpr std::size_t kMaxRegisters = 64;
  constexpr std::size_t kMaxBits = 1024;
  const bool is_of_bits = request.table == Table::coil || request.table == Table::discrete;
  const bool is_too_long = request.count > (is_of_bits ? kMaxBits : kMaxRegisters);
  const bool is_limited =
      checked == Checked::everything && chose(option("request_counts", "64_registers_1024_bits"));
  return is_limited && is_too_long ? Refusal::bad_value : Refusal::none;
}

bool Super40nc::answers_refusals() const { return !chose(option("exceptions", "no_answer")); }

void Super40nc::receive_failed(std::size_t port, pty::ReceiveError) {
  ++state_.receive_errors[port];
  state_.touched = true;  // D8097, D8098
}

}  // namespace understudy::emulator::models::super_40nc
