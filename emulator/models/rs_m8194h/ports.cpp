#include "emulator/models/rs_m8194h/ports.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "emulator/device/device.h"
#include "emulator/device/machine_edges.h"
#include "emulator/device/terminals.h"
#include "emulator/models/rs_m8194h/chip/axis_unit.h"
#include "emulator/models/rs_m8194h/module.h"
#include "emulator/models/rs_m8194h/rows/terminals.h"
#include "emulator/models/rs_m8194h/state.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

/// The pulse modes in 3.3.
constexpr std::string_view kPulseFormats[] = {"CW/CCW rising",      "CW/CCW falling",
                                              "PULSE rising/DIR -", "PULSE falling/DIR -",
                                              "PULSE rising/DIR +", "PULSE falling/DIR +"};

}  // namespace

// --- terminals -------------------------------------------------------------------------------------------

bool Ports::output(int terminal) const {
  if (terminal >= kFirstDo) return output_word(terminal, 1) != 0;
  if (!device_.powered() || terminal < kFirstServo) return false;
  const State& state = module_.state();
  if (terminal < kFirstOut) return state.units[static_cast<std::size_t>(terminal - kFirstServo)].basic.servo;
  if (terminal >= kFirstDi) return false;
  // At rest, the level of the pin is opposite to its pulses: outEdge 0 selects low pulses, and a low pin does
  // not conduct.
  const OutSettings& out = state.units[static_cast<std::size_t>(terminal - kFirstOut)].out;
  return (out.level == 0) != (device_.now() < out.pulse_until);
}

std::uint32_t Ports::output_word(int first, int count) const {
  if (first < kFirstDo) return Terminals::output_word(first, count);
  const int at = first - kFirstDo;
  std::uint64_t words = 0;
  for (int i = 0; i < 3 && device_.powered(); ++i) {
    const int group = at / kFrnetChannels + i;
    if (group >= kFrnetGroups) break;
    words |= std::uint64_t{module_.state().sent[static_cast<std::size_t>(group)]} << (i * kFrnetChannels);
  }
  return static_cast<std::uint32_t>(words >> (at % kFrnetChannels) & ((std::uint64_t{1} << count) - 1));
}

std::int64_t Ports::output_pulses(int terminal) const {
  if (terminal < kFirstOut || terminal >= kFirstOut + kOuts) return 0;
  return module_.state().units[static_cast<std::size_t>(terminal - kFirstOut)].out.pulses;
}

// --- axes ------------------------------------------------------------------------------------------------

std::int64_t Ports::pulses_this_tick(int axis) const {
  return device_.powered() ? module_.state().units[static_cast<std::size_t>(axis)].sent_pulses : 0;
}

double Ports::speed_pps(int axis) const {
  return device_.powered() ? module_.chip.speed_pps(static_cast<std::size_t>(axis)) : 0;
}

std::optional<bool> Ports::servo_on(int axis) const {
  return device_.powered() && module_.state().units[static_cast<std::size_t>(axis)].basic.servo;
}

std::int64_t Ports::pulses_to_come(int axis) const {
  const auto a = static_cast<std::size_t>(axis);
  if (!device_.powered()) return 0;
  const State& state = module_.state();
  return state.paths.together.takes(a) ? state.paths.together.pulses_to_come(a, state.motors)
                                       : state.motors[a].pulses_to_come();
}

void Ports::connect_encoder(int axis, std::int64_t counts) {
  module_.chip.connect_encoder(static_cast<std::size_t>(axis), counts);
}

void Ports::set_encoder(int axis, std::int64_t counts) {
  module_.chip.set_encoder(static_cast<std::size_t>(axis), counts);
}

std::int64_t Ports::place_pulses(int axis) const {
  return module_.state().motors[static_cast<std::size_t>(axis)].travel_pulses;
}

void Ports::set_edges(int axis, const MachineEdges& edges) {
  module_.chip.set_edges(static_cast<std::size_t>(axis), edges);
}

std::span<const std::string_view> Ports::pulse_formats() const { return kPulseFormats; }

std::size_t Ports::pulse_format_number() const { return module_.state().units[0].basic.pulse_mode; }

}  // namespace understudy::emulator::models::rs_m8194h
