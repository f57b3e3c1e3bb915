// The way in for those who ask a daemon things: a control socket (control/control_door.h). All that a daemon
// knows about it is when to look after it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "emulator/serve/loop/event_loop.h"

namespace understudy::emulator::serve {

class Daemon;

class Door {
 public:
  virtual ~Door() = default;
  /// Where it is in the file system.
  virtual const std::string& path() const = 0;
  /// When look() should be called even if nothing is readable.
  virtual std::optional<WallTime> next_look() const = 0;
  virtual void look(WallTime now) = 0;
};

/// Makes a door that lives as long as the daemon, served by its event loop; null if it could not, and `log`
/// is told why.
using DoorMaker =
    std::function<std::unique_ptr<Door>(Daemon& daemon, const std::function<void(const std::string&)>& log)>;

}  // namespace understudy::emulator::serve
