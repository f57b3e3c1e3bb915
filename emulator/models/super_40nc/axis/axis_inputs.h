// The signals that affect the axes: switches along their travel, the drive's alarm, the encoder's index.
#pragma once

#include <array>
#include <optional>

#include "emulator/device/machine_edges.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/axis/chips.h"

namespace understudy::emulator::models::super_40nc {

class AxisInputs : protected Chips {
 public:
  explicit AxisInputs(const Chips& chips) : Chips(chips) {}

  /// Returns X33 or X34: 0 not in use, 1 NO, 2 NC.
  Value limit_logic(int axis, int direction) const;
  /// Returns true if D8x18 and D8x19 replace X33 and X34.
  bool has_limit_copies() const { return !chose(option("limit_copies", "plain_registers")); }
  void update_environment(int axis_number);
  void see_first_signals();
  void set_edges(int axis, const MachineEdges& edges);
  /// Returns where along the axis a machine switch changes an input, in the axis's own direction.
  std::optional<MachineEdges::Span> span_of(int axis, int input) const;
  /// Announces that the edges of a restored state will be set again although nothing has changed.
  void await_edges() { is_restored_.fill(true); }
  void await_no_edges() { is_restored_.fill(false); }

 private:
  /// Returns the machine's edges, in the axis's own direction.
  MachineEdges edges_of(int axis) const;

  std::array<MachineEdges, kAxisCount> edges_{};  // not part of the state: set again after a restore
  std::array<bool, kAxisCount> is_restored_{};    // restored, but the edges have not been set again
};

}  // namespace understudy::emulator::models::super_40nc
