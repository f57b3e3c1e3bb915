#include "emulator/serve/control/control_door.h"

#include <functional>
#include <memory>
#include <string>

#include "emulator/serve/control/messages.h"
#include "emulator/serve/control/server.h"
#include "emulator/serve/control/sockets.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/serve/daemon/door.h"

namespace understudy::emulator::serve {

DoorMaker control_door(const std::string& path) {
  return [path](Daemon& daemon, const std::function<void(const std::string&)>& log) -> std::unique_ptr<Door> {
    const auto handle = [&daemon](const std::string& line, const ControlServer::Reply& reply) {
      handle_message(daemon, line, reply);
    };
    try {
      return std::make_unique<ControlServer>(daemon.loop(), path.empty() ? own_control_path() : path, handle);
    } catch (const ControlError& error) {
      if (!path.empty()) throw;
      log(std::string("no control socket: ") + error.what() + " (--control SOCKET chooses another path)");
      return nullptr;
    }
  };
}

}  // namespace understudy::emulator::serve
