// Reads the current values of a world by the names of probe_names.h. Reading changes nothing.
#pragma once

#include <optional>
#include <string_view>

#include "emulator/world/expression/expression.h"
#include "emulator/world/probe/peaks.h"
#include "emulator/world/probe/probe_names.h"
#include "emulator/world/view/world_view.h"

namespace understudy::emulator::world {

class Probes final : public NameResolver, public ValueSource {
 public:
  /// `view` and `peaks` must outlive this object. Without `peaks`, the names of peaks exist but have no
  /// value.
  explicit Probes(const WorldView& view, const Peaks* peaks = nullptr)
      : view_(view), peaks_(peaks), names_(view) {}

  /// Throws NameError. A name that was resolved before gets the same handle.
  NamedNumber resolve(std::string_view name) const override { return names_.resolve(name); }
  /// Registers and values of a device without power are 0. Throws NameError for a peak if there are no peaks.
  Number value(std::int32_t handle) const override;
  /// Returns the first tick after `done` in which the value may change merely because time passes.
  Tick next_change(std::int32_t handle, Tick done) const;
  /// The same, for all names in a condition.
  Tick next_change(const Expression& condition, Tick done) const;
  /// Returns the device of a register or a named value, because these have no value without power. Returns
  /// nothing for other names.
  std::optional<std::size_t> device_read(std::int32_t handle) const;
  /// Returns true if the value is not always an integer, or, for a device without registers, if it is not an
  /// integer now.
  bool may_be_a_fraction(std::int32_t handle) const;

 private:
  using What = ProbeNames::What;
  using Probe = ProbeNames::Probe;

  std::uint64_t count_of_stations(std::size_t device, std::uint64_t StationCounters::*counter) const;
  double peak_value(const Probe& probe) const;

  const WorldView& view_;
  const Peaks* peaks_;
  ProbeNames names_;
};

}  // namespace understudy::emulator::world
