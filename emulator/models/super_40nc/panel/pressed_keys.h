// The panel keys that are pressed in a scan, and the contacts that stop or inhibit an axis.
#pragma once

#include <array>

#include "emulator/models/super_40nc/axis/chips.h"
#include "emulator/models/super_40nc/panel/keys.h"

namespace understudy::emulator::models::super_40nc {

struct PanelState {
  std::array<bool, kAxisCount> were_held{};  // the axes that were held in reset in the last scan
  bool wheel_selected = false;               // D8020 or D8021 was written since the last scan

  bool operator==(const PanelState&) const = default;
};

class PressedKeys : protected Chips {
 public:
  PressedKeys(const Chips& chips, PanelState& state) : Chips(chips), state_(state) {}

  /// Switches the contacts of the keys.
  void read_keys();
  bool is_locked(const Key& key) const;
  bool is_wheel_locked(int axis) const;
  /// Returns true if M8514 means HOME rather than ZERO SET.
  bool is_origin_the_home_key() const { return chose(option("m8514_meaning", "home")); }
  /// Returns true if the key is pressed in this scan. Axis -1 is the main page.
  bool is_pressed(KeyDoes what, int axis) const;

  bool is_stopped_by_emergency() const;
  bool is_held_in_reset(int axis) const;
  /// Returns true during M8004, an emergency or a reset. Starts by hand are then dropped without an error
  /// code.
  bool is_inhibited(int axis) const;
  /// Returns true if levels that stayed ON during a reset take effect now.
  bool acts_behind_reset(int axis) const;
  /// Returns true for a level that stayed ON during a stop, if a choice makes it take effect.
  bool is_level_again(int axis, int contact) const;
  /// Called after a write to D8020 or D8021.
  void select_wheel() { state_.wheel_selected = true; }
  /// Records for the next scan which axes are held in reset.
  void see_held();

 private:
  void read_jog_keys();

  PanelState& state_;
};

}  // namespace understudy::emulator::models::super_40nc
