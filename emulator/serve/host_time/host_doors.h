// The TCP addresses of a bench for a host in simulated time. Nobody listens at them: instead, the preloaded
// library connects the host's socket to a local socket, on which bytes arrive as soon as they are written.
// Therefore cases can run side by side with the same addresses, and any address and port number can be used.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/files/descriptor.h"
#include "base/simulated_time.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/serve/host_time/host_page.h"
#include "emulator/serve/host_time/host_waits.h"

namespace understudy::emulator::serve {

class HostDoors {
 public:
  /// `place` is the prefix of the sockets' paths. Throws pty::PortError, std::system_error.
  HostDoors(Daemon& daemon, const std::string& place, HostPage& page);
  ~HostDoors();
  HostDoors(const HostDoors&) = delete;
  HostDoors& operator=(const HostDoors&) = delete;

  /// Admits newly connected hosts, and reads the bytes that they have written.
  void attend();
  /// Ends the waits of threads whose door has sent something. Returns true if there were such threads.
  bool report_news(HostWaits& waits);
  /// Returns the next timeout of a door, such as a gateway's timeout for an answer, or nothing.
  std::optional<SimTime> due() const;
  /// Returns true if a thread is waiting for a door of the port.
  bool is_waited_for(const Port& port, const HostWaits& waits) const;

 private:
  struct Entrance {
    std::string path;
    Descriptor listening;
    std::uint64_t news = 0;  // TcpDoor::news() when the host was last notified
  };
  Daemon& daemon_;
  std::vector<Entrance> entrances_;  // one for each of the daemon's doors
};

/// Returns a packet or stream socket that listens at a path. Throws std::system_error.
Descriptor listen_locally(const std::string& path, int type);

}  // namespace understudy::emulator::serve
