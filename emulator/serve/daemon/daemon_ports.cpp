// A daemon's connections to the outside: pseudo-terminals, their hosts, and TCP addresses.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "emulator/serve/daemon/daemon.h"
#include "emulator/serve/loop/event_loop.h"
#include "emulator/serve/ports/port.h"
#include "emulator/serve/ports/tcp_door.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench/listening.h"
#include "pty/port_link.h"
#include "pty/presence_watch.h"

namespace understudy::emulator::serve {

void Daemon::make_ports(const world::Bench& bench) {
  for (std::size_t i = 0; i < bench.lines.size(); ++i) {
    if (!bench.lines[i].has_pty) {
      ports_.push_back(std::make_unique<Port>(
          loop_, world_, i, Port::Link(), presence_, [this] { catch_up_for_bytes(); }, log_));
      continue;
    }
    std::string link = bench.lines[i].link;
    if (link.empty()) link = private_folder_.path() + "/" + bench.lines[i].name + ".port";
    try {
      ports_.push_back(std::make_unique<Port>(
          loop_, world_, i, link, presence_, [this] { catch_up_for_bytes(); }, log_));
    } catch (const pty::PortError& error) {
      const auto folder = std::filesystem::absolute(link).parent_path();
      const bool is_present = faccessat(AT_FDCWD, folder.c_str(), F_OK, AT_EACCESS) == 0;
      if (!is_present || faccessat(AT_FDCWD, folder.c_str(), W_OK, AT_EACCESS) == 0) throw;
      throw pty::PortError(std::string(error.what()) + " (--links FOLDER puts the links elsewhere)");
    }
  }
}

void Daemon::watch_presence() {
  const auto is_unwatched = [](const std::unique_ptr<Port>& port) {
    return port->terminal() != nullptr && !port->terminal()->is_watched();
  };
  if (const auto unwatched = std::count_if(ports_.begin(), ports_.end(), is_unwatched)) {
    log_(std::to_string(unwatched) + (unwatched == 1 ? " port is" : " ports are") +
         " checked for hosts every 50 ms, because the kernel has no inotify instance or watch left "
         "(fs.inotify.max_user_instances, max_user_watches)");
  }
  if (presence_->descriptor() < 0) return;
  loop_.watch(presence_->descriptor(), EventLoop::readable, [this](std::uint32_t) {
    presence_->collect();
    for (const auto& port : ports_) port->follow_hosts();
  });
}

/// Opens all doors before any of them is logged, because opening one may fail. Doors on demand do not listen,
/// so all port numbers are free for them.
void Daemon::make_doors(const world::Bench& bench, TcpDoor::Service service) {
  constexpr int kFirstFree = 49'152;
  const auto is_taken = [&](int number) {
    return std::ranges::any_of(bench.lines, [&](const world::LineSetup& line) {
      return std::ranges::find(line.tcp, number, &world::TcpAddress::port) != line.tcp.end();
    });
  };
  int free = kFirstFree;
  for (std::size_t i = 0; i < bench.lines.size(); ++i) {
    for (world::TcpAddress address : bench.lines[i].tcp) {
      while (is_taken(free)) ++free;
      if (address.port == 0 && service == TcpDoor::Service::on_demand) address.port = free++;
      doors_.push_back(std::make_unique<TcpDoor>(loop_, *ports_[i], address, log_, service));
    }
  }
  for (const auto& port : ports_) {
    for (const std::string& place : port->tcp_places())
      log_("line " + port->line().name() + " listens at " + place);
  }
}

}  // namespace understudy::emulator::serve
