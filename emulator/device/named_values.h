// What a device without registers knows by name (T2PE, R3), for scenarios, traces and the control socket.
// They do not use the line, so they take no time and leave no trace in the dialogue. A facet:
// Device::named_values() is null where a device has none.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/simulated_time.h"

namespace understudy::emulator {

class NamedValues {
 public:
  /// Nothing if it has no value of that name.
  virtual std::optional<double> value_named(std::string_view name) const = 0;
  /// The first tick after `done` at which that value may be another although nothing happens, because it
  /// tells time; kNever if it does not.
  virtual Tick next_change(std::string_view /*name*/, Tick /*done*/) const { return kNever; }
  /// Sets a value as a command over the line would. Returns nothing, or why not ("is out of range; expected 0
  /// to 8"), and then nothing has changed.
  virtual std::optional<std::string> assign(std::string_view name, double value) = 0;
  /// Those that people meet most, for messages that suggest one.
  virtual std::vector<std::string> names() const = 0;

 protected:
  ~NamedValues() = default;
};

}  // namespace understudy::emulator
