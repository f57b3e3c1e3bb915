// A device that speaks text on a real pty, and a host that opens it, writes lines and reads.
#include <gtest/gtest.h>

#include <future>

#include "emulator/serve/daemon/daemon_thread.h"
#include "tests/emulator/world/stations/echo_box.h"
#include "tests/pty/pty_host.h"

namespace understudy::acceptance {
namespace text_line_test {

using namespace std::chrono_literals;
using pty::Bytes;

Bytes bytes(std::string_view text) { return {text.begin(), text.end()}; }

/// Raw, 9600 8N1.
void set_8n1(const pty::Host& host) {
  termios settings = {};
  ASSERT_EQ(::tcgetattr(host.descriptor(), &settings), 0);
  ::cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cflag &= ~static_cast<tcflag_t>(CSTOPB);
  ::cfsetspeed(&settings, B9600);
  ASSERT_EQ(::tcsetattr(host.descriptor(), TCSANOW, &settings), 0);
}

struct Served {
  explicit Served(pty::Timing timing)
      : thread(emulator::world::echo_bench(timing), options(), [](const std::string&) {}) {
    thread.start();
  }
  static emulator::serve::DaemonOptions options() {
    emulator::serve::DaemonOptions made;
    made.watch_signals = false;
    return made;
  }
  std::string path() { return thread.daemon().ports()[0]->terminal()->path(); }
  emulator::serve::DaemonThread thread;
};

TEST(TextLine, AHostSaysALineAndReadsTheAnswer) {
  for (const pty::Timing timing : {pty::Timing::wire, pty::Timing::instant}) {
    Served served(timing);
    pty::Host host(served.path());
    set_8n1(host);
    host.write(bytes("SAY first\r"));
    EXPECT_EQ(host.read(7), bytes("first\r\n"));
    host.write(bytes("SAY sec"));
    host.write(bytes("ond\r\nSAY third\n"));
    EXPECT_EQ(host.read(15), bytes("second\r\nthird\r\n"));
  }
}

TEST(TextLine, WhatIsSaidUnaskedArrives) {
  Served served(pty::Timing::wire);
  pty::Host host(served.path());
  set_8n1(host);
  host.write(bytes("SAY a\r"));
  ASSERT_EQ(host.read(3), bytes("a\r\n"));
  Tick now = 0;
  std::promise<void> looked;
  served.thread.daemon().post([&] {
    now = tick_at(served.thread.daemon().world().now());
    looked.set_value();
  });
  looked.get_future().get();
  const std::string tick = std::to_string(now + 300);
  host.write(bytes("AT " + tick + "\r"));
  const std::string wanted = "TICK " + tick + "\r\n";
  EXPECT_EQ(host.read(wanted.size(), 2000), bytes(wanted));
}

TEST(TextLine, ALongAnswerComesWholeToAHostThatReadsIt) {
  Served served(pty::Timing::wire);
  pty::Host host(served.path());
  set_8n1(host);
  std::string wanted;
  for (int i = 1; i <= 500; ++i) wanted += "line " + std::to_string(i) + "\r\n";
  host.write(bytes("LIST 500\r"));
  EXPECT_EQ(host.read(wanted.size(), 8000), bytes(wanted));  // 4892 characters take 5.1 s
}

}  // namespace text_line_test
}  // namespace understudy::acceptance
