// What can be seen of a world by the names of probe_names.h: their values at this moment. Looking changes
// nothing.
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
  /// Both must outlive it. Without peaks their names are known, but have no value.
  explicit Probes(const WorldView& view, const Peaks* peaks = nullptr)
      : view_(view), peaks_(peaks), names_(view) {}

  /// Throws NameError. A name that was resolved before gets its handle again.
  NamedNumber resolve(std::string_view name) const override { return names_.resolve(name); }
  /// A register of a device without power is 0. NameError for what nobody keeps here.
  Number value(std::int32_t handle) const override;
  /// The first tick after `done` at which its value may be another although nothing happens, because it tells
  /// time.
  Tick next_change(std::int32_t handle, Tick done) const;
  /// The same for all the names of a condition.
  Tick next_change(const Expression& condition, Tick done) const;
  /// The device whose register or value it is: without power it has none.
  std::optional<std::size_t> device_read(std::int32_t handle) const;
  /// Whether it is not always a whole number; of a device without registers, whether it is none now.
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
