// RS-M8194H: its terminals and axes, for the bench: the outputs that the module drives, and what the bench's
// machine reports to the module.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "emulator/device/axes.h"
#include "emulator/device/machine_edges.h"
#include "emulator/device/terminals.h"
#include "emulator/models/rs_m8194h/module.h"

namespace understudy::emulator::models::rs_m8194h {

class Ports final : public Terminals, public Axes {
 public:
  Ports(const Device& device, Module& module) : device_(device), module_(module) {}

  bool output(int terminal) const override;
  bool output_moves(int /*terminal*/) const override { return false; }  // outputs change only in full ticks
  std::uint32_t output_word(int first, int count) const override;
  std::int64_t output_pulses(int terminal) const override;

  std::int64_t pulses_this_tick(int axis) const override;
  double speed_pps(int axis) const override;
  std::int64_t pulses_to_come(int axis) const override;
  std::optional<bool> servo_on(int axis) const override;
  void connect_encoder(int axis, std::int64_t counts) override;
  void set_encoder(int axis, std::int64_t counts) override;
  bool meets_edges() const override { return true; }
  std::int64_t place_pulses(int axis) const override;
  void set_edges(int axis, const MachineEdges& edges) override;
  std::string_view pulse_format() const override { return pulse_formats()[pulse_format_number()]; }
  std::span<const std::string_view> pulse_formats() const override;
  std::size_t pulse_format_number() const override;

 private:
  const Device& device_;
  Module& module_;
};

}  // namespace understudy::emulator::models::rs_m8194h
