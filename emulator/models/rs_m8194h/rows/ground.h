// RS-M8194H: what all parts use. Parts (module.h) may use only the parts below them, and this file is below
// all of them.
#pragma once

#include <cstdint>
#include <string_view>

#include "base/simulated_time.h"
#include "emulator/device/device.h"
#include "emulator/models/rs_m8194h/rows/options.h"

namespace understudy::emulator::models::rs_m8194h {

/// The device that contains the parts, and its choices as options.
struct Ground {
  explicit Ground(const Device& whole)
      : device(whole),
        language(language_options(whole.asked_options())),
        machine(machine_options(whole.asked_options())) {}

  const Device& device;
  const LanguageOptions language;
  const MachineOptions machine;
};

/// The base of a part, with short names for the choices, the clock and the terminals.
class Part {
 public:
  bool chose(const Option& option) const { return ground_.device.chose(option); }
  const LanguageOptions& language_options() const { return ground_.language; }
  const MachineOptions& machine_options() const { return ground_.machine; }
  Firmware firmware() const { return ground_.device.firmware(); }
  /// Returns the last completed tick.
  Tick now() const { return ground_.device.now(); }
  std::int32_t input(int terminal) const { return ground_.device.input(terminal); }

 protected:
  explicit Part(const Ground& ground) : ground_(ground) {}
  ~Part() = default;

  Decisions& decisions() const { return ground_.device.decisions(); }
  void warn_not_implemented(std::string_view what, std::string_view why) const {
    ground_.device.warn_not_implemented(what, why);
  }

 private:
  const Ground& ground_;
};

}  // namespace understudy::emulator::models::rs_m8194h
