// The settings of a chain's modules. The ranges are those of ModuleSettings.
#pragma once

#include <cstdint>

#include "emulator/models/slim/chain/chain_state.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/rules/errors.h"

namespace understudy::emulator::models::slim {

/// Changes the settings. The functions return Error::none, or refuse the value without changing anything.
class ChainSettings {
 public:
  explicit ChainSettings(ChainState& chain) : chain_(chain) {}

  void set_linked(int module, bool linked);  // module 0 is always linked
  /// Refused while the module is moving or has commands to execute.
  Error set_scale(int module, std::int64_t multiplier, std::int64_t divider);
  Error set_pulses_per_revolution(int module, std::int32_t pulses);
  Error set_speed_unit(int module, SpeedUnit unit);
  Error set_working_speed(int module, double rpm_or_rps);  // ends AVM
  Error set_jog_speed(int module, double rpm_or_rps);
  Error set_acceleration(int module, double rpm_or_rps_per_s);
  Error set_path_speed(int module, double units_s);  // PR3 of a module, and of its path
  Error set_line_speed(int module, double units_s);  // PR4; a choice also uses it for lines of two axes
  Error set_tvm(double units_s);                     // for all linked modules, immediately
  Error set_path_acceleration(int module, double units_s2);  // PR2, TVA; does not affect the running path
  Error set_smooth_corner(int module, double degrees);       // PR7, 0 .. 180

 private:
  void change_path_speed(int module, double units_s, bool of_lines);

  ChainState& chain_;
};

/// Applies a change of a module's speed, and starts commands that were waiting for a speed.
void refresh_speed(ChainState& chain, int module);

}  // namespace understudy::emulator::models::slim
