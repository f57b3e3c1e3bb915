// The interface of a daemon's access point for requests, such as a control socket (control/control_door.h).
#pragma once

#include <functional>
#include <memory>
#include <string>

namespace understudy::emulator::serve {

class Daemon;

class Door {
 public:
  virtual ~Door() = default;
  /// Returns the door's path in the file system.
  virtual const std::string& path() const = 0;
};

/// Creates a door that lives as long as the daemon and is served by its event loop. If it cannot be created,
/// logs the reason in `log` and returns null, or throws ControlError.
using DoorMaker =
    std::function<std::unique_ptr<Door>(Daemon& daemon, const std::function<void(const std::string&)>& log)>;

}  // namespace understudy::emulator::serve
