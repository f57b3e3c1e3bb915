// The output of a world whose time passes faster than hosts read.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <thread>

#include "emulator/models/models.h"
#include "emulator/serve/control/server.h"
#include "tests/emulator/serve/control/daemon_rig.h"
#include "tests/pty/pty_host.h"

namespace understudy::emulator::serve {
namespace daemon_output_test {

/// A daemon of a SLIM that runs in a separate thread until stop(), and a host at its line.
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
  Json ask(const std::string& message) { return Json::parse(ask_control(folder.path + "/control", message)); }
  void advance(const std::string& by) {
    EXPECT_EQ(ask(R"({"do":"advance","by":")" + by + "\"}")["ok"], true);
  }
  /// It has arrived when this returns, at the line at least, which accepts that much at once.
  void type(const std::string& text) {
    host.write({text.begin(), text.end()});
    while (ask(R"({"do":"status"})")["status"]["lines"][0]["bytes_in"] < text.size()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  TestFolder folder;
  world::Bench bench;
  Daemon daemon;
  pty::Host host;
  std::thread thread;
};

constexpr int kLines = 53;

std::string text_of_line(int number) { return "LINE " + std::to_string(number); }

/// Sends its lines over and over.
std::string program() {
  std::string text = "PG\r";
  for (int number = 0; number < kLines; ++number) text += "OUT \"" + text_of_line(number) + "\"\r";
  return text + "JP 0\r\rG\r";
}

/// The expected text, up to that length.
std::string printed(std::size_t bytes) {
  std::string text;
  for (int number = 0; text.size() < bytes; ++number) text += text_of_line(number % kLines) + "\r\n";
  return text.substr(0, bytes);
}

/// Reports the first difference, not all of both texts.
void expect_said(const pty::Bytes& received, std::size_t bytes) {
  const std::string text(received.begin(), received.end());
  const std::string expected = printed(bytes);
  ASSERT_EQ(text.size(), bytes) << text.substr(0, 200);
  const auto [differs, wanted] = std::ranges::mismatch(text, expected);
  EXPECT_EQ(differs, text.end()) << "byte " << differs - text.begin() << ": "
                                 << std::string(differs, std::min(differs + 40, text.end()));
}

TEST(DaemonOutput, OfALongAdvanceComesWhole) {
  Rig rig({.kind = Speed::Kind::manual});
  rig.type(program());
  // 9600 8N1: 960 characters per second in each direction, of which the program has 750.
  std::thread advancing([&] { rig.advance("65s"); });
  const pty::Bytes received = rig.host.read(60'000);
  advancing.join();
  expect_said(received, 60'000);
}

TEST(DaemonOutput, IsKeptByTheKernelForAHostThatReadsLater) {
  Rig rig({.kind = Speed::Kind::manual});
  rig.type(program());
  rig.advance("100s");  // the daemon does not wait for such a host
  expect_said(rig.host.read(12'000), 12'000);
}

TEST(DaemonOutput, OfFreeTimeComesWhole) {
  Rig rig({.kind = Speed::Kind::free});
  rig.type(program());
  expect_said(rig.host.read(60'000), 60'000);
}

}  // namespace daemon_output_test
}  // namespace understudy::emulator::serve
