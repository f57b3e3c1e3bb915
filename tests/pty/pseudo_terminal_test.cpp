// Real pseudo-terminals, with the host and the server in one thread.
#include "pty/pseudo_terminal.h"

#include <sys/ioctl.h>
#include <sys/wait.h>

#include <csignal>

#include "pty/terminal_settings.h"
#include "tests/pty/pty_host.h"

namespace understudy::pty {
namespace pseudo_terminal_test {

const Bytes kRequest = hex("01 03 00 01 00 01 D5 CA");
const Bytes kReply = hex("01 03 02 C0 01 29 84");

int unread_by_host(const Host& host) {
  int count = -1;
  ::ioctl(host.descriptor(), FIONREAD, &count);
  return count;
}

TEST(PseudoTerminal, CarriesBytesInBothDirections) {
  PseudoTerminal port("");
  EXPECT_TRUE(port.path().starts_with("/dev/pts/")) << port.path();
  Host host(port.path());
  Bytes every(256);
  for (std::size_t i = 0; i < every.size(); ++i) every[i] = static_cast<std::uint8_t>(i);
  host.write(every);
  EXPECT_EQ(read_some(port), every);
  EXPECT_EQ(port.write(every), every.size());
  EXPECT_EQ(host.read(every.size()), every);
}

TEST(PseudoTerminal, NeverBlocks) {
  PseudoTerminal port("");
  std::array<std::uint8_t, 4096> buffer{};
  EXPECT_EQ(port.read(buffer), 0u);
  Host host(port.path());
  port.poll_presence();
  std::size_t taken = 0;
  for (int i = 0; i < 100; ++i) taken += port.write(buffer);
  EXPECT_GT(taken, 0u);
  EXPECT_LT(taken, 100 * buffer.size());
  EXPECT_EQ(port.write(buffer), 0u);
  EXPECT_EQ(host.read(1000).size(), 1000u);
}

TEST(PseudoTerminal, ReportsWhoComesAndGoes) {
  WatchedTerminal terminal;
  PseudoTerminal& port = terminal.port;
  EXPECT_FALSE(port.host_present());
  EXPECT_TRUE(terminal.is_quiet());
  for (int i = 0; i < 3; ++i) {
    Host host(port.path());
    ASSERT_TRUE(terminal.has_news(kTimeoutMs));
    auto presence = port.poll_presence();
    EXPECT_TRUE(presence.opened);
    EXPECT_FALSE(presence.closed);
    EXPECT_TRUE(port.host_present());
    EXPECT_TRUE(terminal.is_quiet());
    host.close();
    ASSERT_TRUE(terminal.has_news(kTimeoutMs));
    presence = port.poll_presence();
    EXPECT_FALSE(presence.opened);
    EXPECT_TRUE(presence.closed);
    EXPECT_FALSE(port.host_present());
    EXPECT_TRUE(terminal.is_quiet());  // our own check causes no event, and nothing hangs up
    presence = port.poll_presence();
    EXPECT_FALSE(presence.opened || presence.closed);
  }
}

TEST(PseudoTerminal, SeesAHostThatCameAndWent) {
  WatchedTerminal terminal;
  PseudoTerminal& port = terminal.port;
  Host(port.path()).close();
  const auto presence = port.poll_presence();
  EXPECT_TRUE(presence.opened);
  EXPECT_TRUE(presence.closed);
  EXPECT_FALSE(port.host_present());
  EXPECT_TRUE(terminal.is_quiet());
}

TEST(PseudoTerminal, SeesAQuickReopening) {
  PseudoTerminal port("");
  Host first(port.path());
  port.poll_presence();
  first.close();
  Host second(port.path());
  const auto presence = port.poll_presence();
  EXPECT_TRUE(presence.opened);
  EXPECT_TRUE(presence.closed);
  EXPECT_TRUE(port.host_present());
}

TEST(PseudoTerminal, StaysTakenUntilTheLastOfSeveralHostsHasGone) {
  WatchedTerminal terminal;
  PseudoTerminal& port = terminal.port;
  // inotify merges both openings into one event, and later both closings.
  Host first(port.path());
  Host second(port.path());
  EXPECT_TRUE(port.poll_presence().opened);
  first.close();
  EXPECT_FALSE(port.poll_presence().closed);
  EXPECT_TRUE(port.host_present());
  EXPECT_TRUE(port.is_in_doubt());  // the count says that there is no host, the kernel says the contrary
  EXPECT_EQ(port.write(kReply), kReply.size());
  EXPECT_FALSE(port.is_in_doubt());
  EXPECT_EQ(second.read(kReply.size()), kReply);
  Host third(port.path());
  Host reader(port.path());
  EXPECT_FALSE(port.poll_presence().opened);
  second.close();
  third.close();
  EXPECT_FALSE(port.poll_presence().closed);
  reader.close();
  EXPECT_TRUE(port.poll_presence().closed);
  EXPECT_FALSE(port.host_present());
  EXPECT_TRUE(terminal.is_quiet());
}

TEST(PseudoTerminal, AClaimEndsWithTheLastHost) {
  PseudoTerminal port("");
  const auto is_claimed = [](const Host& host) {
    int claimed = -1;
    ::ioctl(host.descriptor(), TIOCGEXCL, &claimed);
    return claimed;
  };
  Host first(port.path());
  Host second(port.path());
  port.poll_presence();
  ASSERT_EQ(::ioctl(first.descriptor(), TIOCEXCL), 0);
  first.close();
  port.poll_presence();
  EXPECT_EQ(is_claimed(second), 1);
  second.close();
  port.poll_presence();
  EXPECT_FALSE(port.host_present());
  EXPECT_FALSE(port.is_lost());
  EXPECT_EQ(is_claimed(Host(port.path())), 0);
}

// --- settings ------------------------------------------------------------------------------------

TEST(PseudoTerminal, SeesSpeedAndStopBits) {
  struct Case {
    speed_t speed;
    int stop_bits;
    HostSettings seen;
  };
  PseudoTerminal port("");
  for (const Case& host_case : {Case{B9600, 1, {9600, 1}}, Case{B19200, 2, {19200, 2}},
                                Case{B115200, 1, {115200, 1}}, Case{B230400, 1, {230400, 1}}}) {
    Host host(port.path());
    ASSERT_TRUE(host.set_even_parity(host_case.speed, host_case.stop_bits));
    host.write(kRequest);
    EXPECT_EQ(read_some(port), kRequest);
    EXPECT_TRUE(port.poll_presence().opened);
    EXPECT_EQ(port.poll_host_settings(), host_case.seen);
    host.write(kRequest);  // remembered, although the resting speed is back
    EXPECT_EQ(read_some(port), kRequest);
    EXPECT_EQ(port.poll_host_settings(), host_case.seen);
    host.close();
    port.poll_presence();
  }
}

TEST(PseudoTerminal, SeesAHostThatSetsNothing) {
  PseudoTerminal port("");
  for (const bool set_before : {false, true}) {
    if (set_before) {
      Host host(port.path());
      ASSERT_TRUE(host.set_even_parity(B9600));
      host.close();
      port.poll_presence();
    }
    Host host(port.path());
    host.write(kRequest);
    EXPECT_EQ(read_some(port), kRequest);
    EXPECT_EQ(port.poll_host_settings(), std::nullopt);
    host.close();
    port.poll_presence();
  }
}

TEST(PseudoTerminal, LetsAnOpenHostAskForParityAgainAfterTraffic) {
  PseudoTerminal port("");
  Host host(port.path());
  for (int i = 0; i < 10; ++i) {
    EXPECT_TRUE(host.set_even_parity(B19200)) << i;
    host.write(kRequest);
    EXPECT_EQ(read_some(port), kRequest);
    EXPECT_EQ(port.poll_host_settings(), HostSettings{.baud = 19200});
  }
}

TEST(PseudoTerminal, LetsEveryHostAskForParityWithoutTraffic) {
  PseudoTerminal port("");
  for (int i = 0; i < 10; ++i) {
    Host host(port.path());
    EXPECT_TRUE(host.set_even_parity(B19200)) << i;
    host.close();
    port.poll_presence();
  }
}

TEST(PseudoTerminal, NeverSendsAReplyBackAsAnEcho) {
  PseudoTerminal port("");
  Host host(port.path());
  termios settings = {};
  ASSERT_EQ(::tcgetattr(host.descriptor(), &settings), 0);
  settings.c_lflag |= ECHO;
  ASSERT_EQ(::tcsetattr(host.descriptor(), TCSANOW, &settings), 0);
  host.write(kRequest);
  EXPECT_EQ(read_some(port), kRequest);
  port.write(kReply);
  EXPECT_EQ(host.read(kReply.size()), kReply);
  EXPECT_FALSE(is_readable(port.data_descriptor(), 20));
}

TEST(PseudoTerminal, IsRawAgainForTheNextHost) {
  PseudoTerminal port("");
  Host cooked(port.path());
  termios settings = {};
  ASSERT_EQ(::tcgetattr(cooked.descriptor(), &settings), 0);
  settings.c_lflag |= ICANON | ECHO | ISIG;
  settings.c_iflag |= ICRNL | IXON;
  settings.c_oflag |= OPOST | ONLCR;
  ASSERT_EQ(::tcsetattr(cooked.descriptor(), TCSANOW, &settings), 0);
  cooked.close();
  port.poll_presence();
  Host host(port.path());
  const Bytes controls = hex("03 0A 0D 11 13 1A 04");
  host.write(controls);
  EXPECT_EQ(read_some(port), controls);
  port.write(controls);
  EXPECT_EQ(host.read(controls.size()), controls);
}

// --- closing -------------------------------------------------------------------------------------

TEST(PseudoTerminal, LosesNoRequestOfAHostThatClosesAtOnce) {
  PseudoTerminal port("");
  for (int i = 0; i < 20; ++i) {
    Host host(port.path());
    ASSERT_TRUE(host.set_even_parity(B19200)) << i;
    host.write(kRequest);
    host.close();
    if (i % 2 == 0) port.poll_presence();  // in either order
    EXPECT_EQ(read_some(port), kRequest) << i;
    EXPECT_EQ(port.poll_host_settings(), HostSettings{.baud = 19200}) << i;
    port.poll_presence();
    EXPECT_FALSE(port.host_present());
    EXPECT_EQ(port.write(kReply), kReply.size());  // to nobody
  }
  Host host(port.path());
  EXPECT_EQ(host.read(1, 20), Bytes{});
}

TEST(PseudoTerminal, HidesAReplyThatWasNotReadFromTheNextHost) {
  PseudoTerminal port("");
  for (const bool is_quick : {false, true}) {
    Host first(port.path());
    port.poll_presence();
    EXPECT_EQ(port.write(kReply), kReply.size());
    ASSERT_TRUE(is_readable(first.descriptor(), kTimeoutMs));
    first.close();
    if (!is_quick) port.poll_presence();
    Host second(port.path());
    EXPECT_TRUE(port.poll_presence().opened);
    EXPECT_EQ(unread_by_host(second), 0);
    second.write(kRequest);
    EXPECT_EQ(read_some(port), kRequest);
    EXPECT_EQ(port.write(kReply), kReply.size());
    EXPECT_EQ(second.read(kReply.size()), kReply);
    second.close();
    port.poll_presence();
  }
}

TEST(PseudoTerminal, KeepsTheReplyToAHostThatReopenedBeforeAnyoneLooked) {
  PseudoTerminal port("");
  Host first(port.path());
  port.poll_presence();
  first.close();
  Host second(port.path());
  second.write(kRequest);
  // The server has only seen the bytes: when the old host disconnects, the reply to the new one must not be
  // flushed.
  EXPECT_EQ(read_some(port), kRequest);
  EXPECT_EQ(port.write(kReply), kReply.size());
  port.poll_presence();
  EXPECT_EQ(second.read(kReply.size()), kReply);
}

TEST(PseudoTerminal, SurvivesAHostThatIsKilled) {
  WatchedTerminal terminal;
  PseudoTerminal& port = terminal.port;
  for (int i = 0; i < 5; ++i) {
    const pid_t child = ::fork();
    if (child == 0) {
      Host host(port.path());
      if (!host.set_even_parity(B19200)) ::_exit(1);
      host.write(kRequest);
      ::kill(::getpid(), SIGKILL);
    }
    EXPECT_EQ(read_some(port), kRequest);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFSIGNALED(status));
    port.poll_presence();
    EXPECT_FALSE(port.host_present());
    EXPECT_TRUE(terminal.is_quiet());
  }
  Host host(port.path());
  EXPECT_TRUE(host.set_even_parity(B19200));
}

// --- with a server in a separate thread ------------------------------------------------------------

TEST(PseudoTerminalServed, LetsAHostReopenAtOnceWithParityAgainAndAgain) {
  WatchedTerminal terminal;
  PseudoTerminal& port = terminal.port;
  {
    ComplementServer server(terminal);
    for (int i = 0; i < 50; ++i) {
      Host host(port.path());
      ASSERT_TRUE(host.set_even_parity(B19200)) << i;
      host.write(hex("00 0F FF"));
      ASSERT_EQ(host.read(3), hex("FF F0 00")) << i;
    }
    EXPECT_EQ(server.wrong_settings, 0);
  }
  port.poll_presence();
  EXPECT_FALSE(port.host_present());
}

TEST(PseudoTerminalServed, AnswersALongStream) {
  WatchedTerminal terminal;
  PseudoTerminal& port = terminal.port;
  ComplementServer server(terminal);
  Host host(port.path());
  ASSERT_TRUE(host.set_even_parity(B19200));
  for (int i = 0; i < 300; ++i) {
    const auto value = static_cast<std::uint8_t>(i);
    host.write(Bytes(100, value));
    ASSERT_EQ(host.read(100), Bytes(100, static_cast<std::uint8_t>(~value))) << i;
  }
  EXPECT_EQ(server.wrong_settings, 0);
}

}  // namespace pseudo_terminal_test
}  // namespace understudy::pty
