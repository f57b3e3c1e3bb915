// RS-M8194H: handles requests before and after the module does. Admits them, converts writes to the tables
// into macro lines or (a choice) into one message, and records exceptions.
#pragma once

#include <cstddef>
#include <cstdint>

#include "emulator/device/register_map/refusal.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/models/rs_m8194h/module.h"
#include "emulator/models/rs_m8194h/rows/ground.h"
#include "emulator/models/rs_m8194h/state.h"

namespace understudy::emulator::models::rs_m8194h {

class Requests final : public Part {
 public:
  Requests(const Ground& ground, RequestState& state, Module& module)
      : Part(ground), state_(state), module_(module) {}

  /// `bank` determines which addresses have registers.
  DeviceAnswer admits(const RegisterRequest& request, Checked checked, const RegisterBank& bank) const;
  bool diverts(const Place& place, std::uint32_t bits);
  void read_answered(const RegisterRequest& request);
  void exception_answered(const RefusedRequest& request);

  // --- writes that a choice combines into one message (whole_writes.cpp) ----------------------------
  bool takes_whole(const RegisterRequest& request) const;
  DeviceAnswer take_whole(const RegisterRequest& request);

 private:
  DeviceAnswer admits_lines(const RegisterRequest& request) const;
  DeviceAnswer admits_whole(const RegisterRequest& request, Checked checked) const;
  void write_group(std::size_t group, std::uint32_t number);

  RequestState& state_;
  Module& module_;
};

}  // namespace understudy::emulator::models::rs_m8194h
