// The way in for those who ask a daemon things: a control socket (control/control_door.h).
#pragma once

#include <functional>
#include <memory>
#include <string>

namespace understudy::emulator::serve {

class Daemon;

class Door {
 public:
  virtual ~Door() = default;
  /// Where it is in the file system.
  virtual const std::string& path() const = 0;
};

/// Makes a door that lives as long as the daemon, served by its event loop; null if it could not, and `log`
/// is told why.
using DoorMaker =
    std::function<std::unique_ptr<Door>(Daemon& daemon, const std::function<void(const std::string&)>& log)>;

}  // namespace understudy::emulator::serve
