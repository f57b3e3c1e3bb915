// Input from unknown clients to a line's TCP port, in pieces, and how they disconnect: by FIN, by closing,
// without a word. Whatever it was, nothing crashes, the door closes connections that have ended, and the next
// host is served.
//
// An input is one byte of options (which protocol, how it ends, whether characters take time), then pieces: a
// byte of length, whose top bit lets time pass first, and its bytes.
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/files/descriptor.h"
#include "emulator/models/simple2_r3/model.h"
#include "emulator/serve/loop/event_loop.h"
#include "emulator/serve/ports/port.h"
#include "emulator/serve/ports/tcp_door.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench/listening.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/world.h"
#include "pty/presence_watch.h"
#include "tests/fuzz/fuzzing.h"

namespace {

using namespace understudy;
using namespace std::chrono_literals;
using emulator::serve::EventLoop;
using emulator::serve::Port;
using emulator::serve::TcpDoor;
using fuzzing::require;
using Bytes = std::vector<std::uint8_t>;

const Bytes kRequest{0x01, 0x03, 0x00, 0x01, 0x00, 0x01, 0xD5, 0xCA};
const Bytes kReply{0x01, 0x03, 0x02, 0xC0, 0x01, 0x29, 0x84};
const Bytes kMasterRequest{0x12, 0x34, 0x00, 0x00, 0x00, 0x06, 0x01, 0x03, 0x00, 0x01, 0x00, 0x01};
const Bytes kMasterReply{0x12, 0x34, 0x00, 0x00, 0x00, 0x05, 0x01, 0x03, 0x02, 0xC0, 0x01};
constexpr std::size_t kLongest = 2048;
constexpr std::size_t kMaxPieces = 24;

/// One controller, which is restored to its initial state.
struct Bench {
  explicit Bench(pty::Timing timing)
      : world(
            [timing] {
              emulator::DeviceSettings settings;
              settings.name = "d";
              emulator::world::Bench bench =
                  emulator::world::bench_of_one(emulator::models::simple2_r3::model(), settings, "");
              bench.lines.front().timing = timing;
              return bench;
            }(),
            {}, {}),
        begin(emulator::world::save(world)) {}
  emulator::world::World world;
  emulator::world::WorldState begin;
};

/// A client's end of a connection.
class Client {
 public:
  explicit Client(TcpDoor& door) {
    std::array<int, 2> ends{};
    require(socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, ends.data()) == 0, "two ends");
    mine_ = Descriptor(ends[0]);
    door.admit(Descriptor(ends[1]));
  }
  void say(std::span<const std::uint8_t> bytes) const {
    send(mine_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
  }
  void hear() {
    std::array<std::uint8_t, 4096> bytes;
    const ssize_t count = recv(mine_.get(), bytes.data(), bytes.size(), 0);
    if (count > 0) received.insert(received.end(), bytes.begin(), bytes.begin() + count);
    is_over = is_over || count == 0;
  }
  bool has(const Bytes& reply) const {
    return std::search(received.begin(), received.end(), reply.begin(), reply.end()) != received.end();
  }
  void close_sending_half() const { shutdown(mine_.get(), SHUT_WR); }
  void close() { mine_.close(); }
  Bytes received;
  bool is_over = false;

 private:
  Descriptor mine_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1 || size > kLongest) return 0;
  static EventLoop loop;
  static Bench instant(pty::Timing::instant);
  static Bench wire(pty::Timing::wire);
  static const std::array addresses{"rtu://127.0.0.1:0", "rfc2217://127.0.0.1:0",
                                    "modbus-tcp://127.0.0.1:0?timeout=1ms"};
  const std::size_t protocol = data[0] % addresses.size();
  const unsigned end = data[0] / 8 % 3;
  Bench& bench = (data[0] & 0x80) != 0 ? wire : instant;
  emulator::world::restore(bench.world, bench.begin);
  const auto log = [](const std::string&) {};
  static const auto presence = std::make_shared<pty::PresenceWatch>();
  Port port(
      loop, bench.world, 0, Port::Link(), presence, [] {}, log);
  TcpDoor door(loop, port, emulator::world::parse_tcp_address(addresses[protocol]), log);
  const auto go_on = [&](SimTime time) {
    loop.wait(emulator::serve::WallTime{0});
    bench.world.advance_to(bench.world.now() + time);
    port.flush();
  };

  std::optional<Client> stranger(door);
  std::span<const std::uint8_t> rest(data + 1, size - 1);
  for (std::size_t pieces = 0; !rest.empty() && pieces < kMaxPieces; ++pieces) {
    const std::size_t length = std::min<std::size_t>(rest[0] & 0x7F, rest.size() - 1);
    go_on((rest[0] & 0x80) != 0 ? 25ms : 100us);
    stranger->say(rest.subspan(1, length));
    stranger->hear();
    rest = rest.subspan(1 + length);
  }
  go_on(100us);
  if (end == 0) stranger->close_sending_half();
  if (end == 1) stranger->close();
  // A gateway waits for stations by the wall clock.
  const bool is_gateway = protocol == 2;
  for (int i = 0; i < (is_gateway ? 2 : 20); ++i) go_on(500ms);
  if (is_gateway) return 0;
  if (end == 0) {
    for (int i = 0; i < 20; ++i) stranger->hear();
    require(stranger->is_over, "one that has said all is let go when it has its replies");
  }
  stranger.reset();
  go_on(10ms);
  Client good(door);
  good.say(kRequest);
  for (int i = 0; i < 20 && !good.has(kReply); ++i) {
    go_on(300ms);
    good.hear();
  }
  require(good.has(kReply), "the next host is served");
  return 0;
}
