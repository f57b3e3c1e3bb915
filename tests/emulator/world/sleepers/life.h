// The data that only a person who knows a controller can provide: its machines, programs for it, and commands
// that move it. The rest of a course is drawn from its model's tables (act.h).
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tests/emulator/world/sleepers/act.h"
#include "tests/emulator/world/sleepers/draw.h"

namespace understudy::emulator::world::sleepers {

class Life {
 public:
  virtual ~Life() = default;
  /// The value of `model:` in a bench.
  virtual std::string model(Draw& draw) const = 0;
  /// Further keys of the device, each with its comma: ", modules: 3".
  virtual std::string keys(Draw& /*draw*/) const { return ""; }
  /// Returns the lines of a listing, or an empty text if the device has no program.
  virtual std::string program(Draw& /*draw*/) const { return ""; }
  virtual Act act(Draw& draw) const = 0;
  /// Returns events that must come first because they enable others.
  virtual std::vector<Act> first_acts(Draw& /*draw*/) const { return {}; }
};

/// Returns the Life for a model's name. "imported" means controllers that files describe.
std::unique_ptr<Life> life_of(std::string_view model);

}  // namespace understudy::emulator::world::sleepers
