#include "emulator/serve/host_time/host_doors.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "base/files/descriptor.h"
#include "base/simulated_time.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/serve/host_time/host_page.h"
#include "emulator/serve/host_time/host_waits.h"
#include "emulator/serve/ports/port.h"
#include "emulator/serve/ports/tcp_door.h"
#include "emulator/world/bench/listening.h"
#include "pty/host_time/protocol.h"
#include "pty/port_link.h"

namespace understudy::emulator::serve {

namespace {

/// Returns the address in the kernel's notation: empty for this machine itself. The real network resolves the
/// names that a host uses, so the address of a name is not known here.
std::string address_of(const world::TcpAddress& address) {
  const std::string& host = address.host;
  in_addr four{};
  in6_addr six{};
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (host == "localhost") return {};
  if (inet_pton(AF_INET, host.c_str(), &four) == 1) {
    const bool is_here =
        four.s_addr == INADDR_ANY || ntohl(four.s_addr) >> IN_CLASSA_NSHIFT == IN_LOOPBACKNET;
    return is_here ? std::string() : inet_ntop(AF_INET, &four, text.data(), text.size());
  }
  if (inet_pton(AF_INET6, host.c_str(), &six) == 1) {
    const bool is_here = IN6_IS_ADDR_UNSPECIFIED(&six) || IN6_IS_ADDR_LOOPBACK(&six);
    return is_here ? std::string() : inet_ntop(AF_INET6, &six, text.data(), text.size());
  }
  throw pty::PortError(
      "--host-time: " + world::to_string(address) +
      ": host names cannot be resolved in simulated time; expected localhost, or a numeric address");
}

}  // namespace

Descriptor listen_locally(const std::string& path, int type) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path)
    throw std::system_error(ENAMETOOLONG, std::generic_category(), path);
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  Descriptor socket(::socket(AF_UNIX, type | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!socket || ::bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      ::listen(socket.get(), SOMAXCONN) != 0)
    throw std::system_error(errno, std::generic_category(), path);
  return socket;
}

HostDoors::HostDoors(Daemon& daemon, const std::string& place, HostPage& page) : daemon_(daemon) {
  if (daemon.doors().size() > host_time::kMaxDoors) {
    throw pty::PortError("--host-time: the bench listens at " + std::to_string(daemon.doors().size()) +
                         " addresses; expected at most " + std::to_string(host_time::kMaxDoors));
  }
  for (const auto& door : daemon.doors()) {
    const std::size_t number = entrances_.size();
    const std::string address = address_of(door->address());
    for (std::size_t i = 0; i < number; ++i) {
      const world::TcpAddress& other = daemon.doors()[i]->address();
      if (other.port != door->address().port || address_of(other) != address) continue;
      throw pty::PortError("--host-time: " + world::to_string(door->address()) + " and " +
                           world::to_string(other) +
                           " are the same address for a host on this machine; expected another port");
    }
    std::string path = place + host_time::kDoorEnding + std::to_string(number);
    Descriptor listening = listen_locally(path, SOCK_STREAM);
    entrances_.push_back({std::move(path), std::move(listening)});
    page.set_door(number, static_cast<std::uint16_t>(door->address().port), address);
  }
}

HostDoors::~HostDoors() {
  for (const Entrance& entrance : entrances_) ::unlink(entrance.path.c_str());
}

void HostDoors::attend() {
  for (std::size_t i = 0; i < entrances_.size(); ++i) {
    TcpDoor& door = *daemon_.doors()[i];
    door.attend();  // clients that have left make room for new ones
    while (true) {
      Descriptor client(
          accept4(entrances_[i].listening.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
      if (!client) break;
      door.admit(std::move(client));
    }
    door.attend();
  }
}

bool HostDoors::report_news(HostWaits& waits) {
  bool has_ended = false;
  for (std::size_t i = 0; i < entrances_.size(); ++i) {
    const std::uint64_t news = daemon_.doors()[i]->news();
    if (std::exchange(entrances_[i].news, news) != news)
      has_ended = waits.line_has_news(host_time::kFirstDoor + static_cast<int>(i)) || has_ended;
  }
  return has_ended;
}

std::optional<SimTime> HostDoors::due() const {
  std::optional<SimTime> due;
  for (const auto& door : daemon_.doors()) {
    if (door->due() && (!due || *door->due() < *due)) due = door->due();
  }
  return due;
}

bool HostDoors::is_waited_for(const Port& port, const HostWaits& waits) const {
  for (std::size_t i = 0; i < entrances_.size(); ++i) {
    const bool is_of_port = &daemon_.doors()[i]->port() == &port;
    if (is_of_port && waits.is_line_waited_for(host_time::kFirstDoor + static_cast<int>(i))) return true;
  }
  return false;
}

}  // namespace understudy::emulator::serve
