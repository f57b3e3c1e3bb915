// A line that is only reachable over TCP: a world, its port and a door, driven by the test. Simulated time
// passes 50 times as fast as real time, so its timeouts take milliseconds.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/files/descriptor.h"
#include "emulator/models/models.h"
#include "emulator/serve/loop/event_loop.h"
#include "emulator/serve/ports/port.h"
#include "emulator/serve/ports/tcp_door.h"
#include "emulator/world/bench/listening.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/world.h"

namespace understudy::emulator::serve {

inline constexpr WallTime kDoorPatience = std::chrono::seconds(20);  // how long a failing test waits
inline constexpr const char* kOneFeeder =
    "understudy: 1\nlines: { a: { timing: instant, stations: [ { name: feeder, model: simple2-r3 } ] } }\n";

class DoorRig {
 public:
  explicit DoorRig(const std::string& address, const std::string& bench = kOneFeeder)
      : world(world::parse_bench(models::all_models(), bench, "bench.yaml", "."), {}, {}) {
    port = std::make_unique<Port>(
        loop, world, 0, Port::Link(), std::make_shared<pty::PresenceWatch>(), [this] { catch_up(); },
        [this](const std::string& line) { log.push_back(line); });
    door = std::make_unique<TcpDoor>(loop, *port, world::parse_tcp_address(address),
                                     [this](const std::string& line) { log.push_back(line); });
  }

  void run() {
    loop.wait(wall_now() + std::chrono::milliseconds(1));
    catch_up();
    port->flush();
  }
  bool eventually(const std::function<bool()>& holds) {
    for (const WallTime end = wall_now() + kDoorPatience; wall_now() < end; run()) {
      if (holds()) return true;
    }
    return holds();
  }
  /// Returns the number of requests that the first station has served.
  std::uint64_t requests() const { return world.line(0).stations.front()->counters().requests; }

  world::World world;
  EventLoop loop;
  std::vector<std::string> log;
  std::unique_ptr<Port> port;
  std::unique_ptr<TcpDoor> door;

 private:
  void catch_up() { world.advance_to(50 * (wall_now() - begin_)); }
  WallTime begin_ = wall_now();
};

/// A client on this machine.
class DoorClient {
 public:
  using Bytes = std::vector<std::uint8_t>;

  explicit DoorClient(DoorRig& rig) : rig_(&rig), socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    const std::string place = rig.port->tcp_places().front();
    sockaddr_in where{};
    where.sin_family = AF_INET;
    where.sin_port = htons(static_cast<std::uint16_t>(std::stoi(place.substr(place.rfind(':') + 1))));
    where.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(connect(socket_.get(), reinterpret_cast<sockaddr*>(&where), sizeof where), 0);
  }
  void say(std::span<const std::uint8_t> bytes) const {
    send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
  }
  /// Returns the data that arrives, until there are this many bytes, or the other side closes.
  Bytes hear(std::size_t count) {
    EXPECT_TRUE(rig_->eventually([&] { return has_come(count) || is_over_; }))
        << "received " << received_.size();
    return received_;
  }
  bool sees_the_end() {
    return rig_->eventually([&] { return has_come(100'000) || is_over_; });
  }
  bool is_over() {
    has_come(100'000);
    return is_over_;
  }
  const Bytes& received() const { return received_; }
  void forget() { received_.clear(); }

  void close_sending_half() const { shutdown(socket_.get(), SHUT_WR); }
  void close() { socket_.close(); }
  void reset() {
    const linger at_once{1, 0};
    setsockopt(socket_.get(), SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
    socket_.close();
  }

 private:
  bool has_come(std::size_t count) {
    std::uint8_t byte = 0;
    while (received_.size() < count && !is_over_) {
      const ssize_t got = recv(socket_.get(), &byte, 1, MSG_DONTWAIT);
      if (got == 1) received_.push_back(byte);
      if (got == 0 || (got < 0 && errno != EAGAIN)) is_over_ = true;
      if (got < 0) break;
    }
    return received_.size() >= count;
  }
  DoorRig* rig_;
  Descriptor socket_;
  Bytes received_;
  bool is_over_ = false;
};

}  // namespace understudy::emulator::serve
