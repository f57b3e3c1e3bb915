// The named values of a device without registers (T2PE, R3), for scenarios, traces and the control socket.
// Access to them bypasses the line, so it takes no time and does not appear in the dialogue. This is a facet:
// Device::named_values() is null if a device has none.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/simulated_time.h"

namespace understudy::emulator {

class NamedValues {
 public:
  /// Returns nothing if there is no value with that name.
  virtual std::optional<double> value_named(std::string_view name) const = 0;
  /// Returns the first tick after `done` in which the value may change merely because time passes, or kNever
  /// if it does not depend on time.
  virtual Tick next_change(std::string_view /*name*/, Tick /*done*/) const { return kNever; }
  /// Sets a value as a command over the line would. Returns nothing, or why the value is refused ("is out of
  /// range; expected 0 to 8"); in that case, nothing changes.
  virtual std::optional<std::string> assign(std::string_view name, double value) = 0;
  /// Returns the most common names, for messages that suggest one.
  virtual std::vector<std::string> names() const = 0;

 protected:
  ~NamedValues() = default;
};

}  // namespace understudy::emulator
