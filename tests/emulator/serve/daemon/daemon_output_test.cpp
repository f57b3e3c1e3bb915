// What a world says while time goes by faster than hosts read.
#include <gtest/gtest.h>

#include <string>
#include <thread>

#include "emulator/models/models.h"
#include "emulator/serve/control/server.h"
#include "tests/emulator/serve/control/daemon_rig.h"
#include "tests/pty/pty_host.h"

namespace understudy::emulator::serve {
namespace daemon_output_test {

/// A daemon of a SLIM that runs in a thread of its own until stop(), and a host at its line.
struct Rig {
  explicit Rig(Speed speed)
      : bench(world::parse_bench(models::all_models(),
                                 "understudy: 1\nlines: { text: { link: ./slim.port, stations: "
                                 "[ { name: chain, model: slim } ] } }\n",
                                 "bench.yaml", folder.path)),
        daemon(bench, options(speed), [](const std::string&) {}),
        host(folder.path + "/slim.port"),
        thread([this] { daemon.run(); }) {
    host.set_even_parity(B9600);
  }
  ~Rig() {
    daemon.post([this] { daemon.stop(); });
    thread.join();
  }
  DaemonOptions options(Speed speed) const {
    DaemonOptions made;
    made.speed = speed;
    made.enforce_settings = false;
    made.watch_signals = false;
    made.door = control_door(folder.path + "/control");
    return made;
  }
  void advance(const std::string& by) {
    const Json reply =
        Json::parse(ask_control(folder.path + "/control", R"({"do":"advance","by":")" + by + "\"}"));
    EXPECT_EQ(reply["ok"], true) << reply;
  }
  void type(std::string_view text) { host.write({text.begin(), text.end()}); }

  TestFolder folder;
  world::Bench bench;
  Daemon daemon;
  pty::Host host;
  std::thread thread;
};

std::string counted(std::size_t bytes) {
  std::string text;
  for (int number = 0; text.size() < bytes; ++number) text += std::to_string(number) + "\r\n";
  return text.substr(0, bytes);
}

/// Says 0, 1, 2 ... without end.
constexpr std::string_view kCounting = "PG\rOUT N0\rN0=N0+1\rJP 0\r.\rG\r";

TEST(DaemonOutput, OfALongAdvanceComesWhole) {
  Rig rig({.kind = Speed::Kind::manual});
  rig.type(kCounting);
  rig.advance("1s");
  std::thread advancing([&] { rig.advance("60s"); });
  // 9600 8N1: 960 characters a second, and some of the first one go by with the typing.
  constexpr std::size_t kMost = 61 * 960;
  const pty::Bytes heard = rig.host.read(kMost - 960);
  advancing.join();
  EXPECT_EQ(std::string(heard.begin(), heard.end()), counted(kMost - 960));
}

TEST(DaemonOutput, NobodyReadsIsNotWaitedForLong) {
  Rig rig({.kind = Speed::Kind::manual});
  rig.type(kCounting);
  rig.advance("100s");
  const pty::Bytes heard = rig.host.read(20'000);
  EXPECT_EQ(std::string(heard.begin(), heard.end()), counted(20'000)) << "as much as the kernel keeps";
}

TEST(DaemonOutput, OfFreeTimeComesWhole) {
  Rig rig({.kind = Speed::Kind::free});
  rig.type(kCounting);
  const pty::Bytes heard = rig.host.read(60'000);
  EXPECT_EQ(std::string(heard.begin(), heard.end()), counted(60'000));
}

}  // namespace daemon_output_test
}  // namespace understudy::emulator::serve
