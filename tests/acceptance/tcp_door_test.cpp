// Network hosts: a line on TCP, with raw sockets and python3-serial.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "tests/acceptance/raw_host.h"
#include "tests/acceptance/running_understudy.h"
#include "tests/acceptance/tcp_client.h"

namespace understudy::acceptance {
namespace tcp_door_test {

TEST(TcpDoor, ServesRawRtuToOneClientAfterTheOther) {
  const RunningUnderstudy served({"--listen", "rtu://:0"});
  for (int i = 0; i < 5; ++i) {
    const TcpClient client(listened_port(served));
    ASSERT_TRUE(client.is_connected);
    client.write(kReadHardwareCode);
    EXPECT_EQ(client.read(kHardwareCodeReply.size()), kHardwareCodeReply);
  }
  EXPECT_EQ(served.errors().find("deaf"), std::string::npos) << served.errors();
}

TEST(TcpDoor, RefusesTheSecondClientAndKeepsTheFirst) {
  const RunningUnderstudy served({"--listen", "rtu://:0"});
  const TcpClient first(listened_port(served));
  first.write(kReadHardwareCode);
  EXPECT_EQ(first.read(kHardwareCodeReply.size()), kHardwareCodeReply);
  EXPECT_TRUE(TcpClient(listened_port(served)).is_closed());
  first.write(kReadHardwareCode);
  EXPECT_EQ(first.read(kHardwareCodeReply.size()), kHardwareCodeReply);
}

TEST(TcpDoor, ReplaysWhatCameByTcp) {
  const PrivateFolder folder;
  {
    RunningUnderstudy served({"--listen", "rtu://:0", "--record", folder / "r"});
    const TcpClient client(listened_port(served));
    client.write(kSetSpeed200);
    EXPECT_EQ(client.read(kSetSpeed200.size()), kSetSpeed200);
    EXPECT_EQ(served.stop(SIGTERM), 0);
  }
  const Finished replay = understudy({"replay", folder / "r"});
  EXPECT_EQ(replay.exit_code, 0) << replay.errors;
}

TEST(TcpDoor, IsOpenToPythonSerial) {
  const RunningUnderstudy served({"--listen", "rtu://:0"});
  const std::string script =
      "import serial; s = serial.serial_for_url('socket://127.0.0.1:" +
      std::to_string(listened_port(served)) +
      "', timeout=5); s.write(bytes.fromhex('010300010001D5CA')); print(s.read(7).hex())";
  const Finished host = run({"/usr/bin/python3", "-c", script});
  EXPECT_EQ(host.output, "010302c0012984\n") << host.errors;
}

// socat turns the address into a port on the host's side.
TEST(TcpDoor, IsAPortElsewhereBySocat) {
  if (access("/usr/bin/socat", X_OK) != 0) GTEST_SKIP() << "socat is not installed";
  const RunningUnderstudy served({"--listen", "rtu://:0"});
  const std::string port = served.folder() / "elsewhere";
  const Process socat({"socat", "pty,raw,echo=0,link=" + port,
                       "tcp:127.0.0.1:" + std::to_string(listened_port(served)) + ",nodelay"});
  ASSERT_TRUE(eventually([&] { return std::filesystem::exists(port); })) << socat.errors();
  for (int i = 0; i < 3; ++i) {
    const Finished host = run({"mbpoll", "-q", "-m", "rtu", "-b", "19200", "-P", "none", "-a", "1", "-0",
                               "-t", "4:hex", "-r", "1", "-1", port});
    EXPECT_NE(host.output.find("0xC001"), std::string::npos) << host.output << host.errors;
  }
}

/// A host that disappears without a final message, after its link is removed: in network namespaces, if they
/// are allowed. It waits for half a minute, so it runs only with UNDERSTUDY_HEAVY_HOSTS=1.
TEST(TcpDoor, NoticesThatAHostHasVanished) {
  const char* wanted = getenv("UNDERSTUDY_HEAVY_HOSTS");
  if (wanted == nullptr || std::string(wanted) != "1") GTEST_SKIP() << "UNDERSTUDY_HEAVY_HOSTS=1 is not set";
  Process hosts(
      {"/usr/bin/python3", std::string(TEST_FACTS) + "/hosts/vanishing_hosts.py", UNDERSTUDY_BINARY});
  const auto exit_code = hosts.wait(std::chrono::seconds(90));
  if (exit_code == 77) GTEST_SKIP() << "network namespaces are not allowed here";
  EXPECT_EQ(exit_code, 0) << hosts.output() << hosts.errors();
}

TEST(TcpDoor, SaysWhyItCannotListen) {
  const RunningUnderstudy served({"--listen", "rtu://:0"});
  const std::string taken = "rtu://127.0.0.1:" + std::to_string(listened_port(served));
  struct Case {
    const char* wish;
    int exit_code;
    const char* message;
  };
  for (const Case& c :
       {Case{taken.c_str(), 3, "Address already in use"}, Case{"tcp://:1", 2, "expected rtu://"},
        Case{"modbus-tcp://1", 2, "expected rtu://"},
        Case{"rtu://:70000", 2, "has port 70000; expected 0 to 65535"},
        Case{"rtu://here..there:1", 3, "expected an address of this machine, or a name for one"},
        Case{"rtu://192.0.2.1:0", 3, "Cannot assign requested address; expected an address of this machine"},
        Case{"rtu://::1:5020", 2, "expected it as in rtu://[::1]:5020"},
        Case{"rtu://[here]:5020", 2, "expected rtu://"},
        Case{"rtu://:0?timeout=1s", 2, "expected them only with modbus-tcp://"},
        Case{"modbus-tcp://:0?timeout=2h", 2, "expected a duration of 1ms to 1h such as 200ms, or 0"},
        Case{"modbus-tcp://:0?unit=300", 2, "expected the number of a station, 1 to 247, or any"},
        Case{"modbus-tcp://:0?exception=no", 2, "has exception 'no'; expected on or off"},
        Case{"modbus-tcp://:0?unit=1&unit=2", 2, "has unit twice; expected it only once"},
        Case{"modbus-tcp://:0?time=1s", 2, "which is not a setting; the nearest is 'timeout'"},
        Case{"other=rtu://:0", 2, "is not a line"}}) {
    const Finished refused = understudy({"serve", "--model", "simple2-r3", "--listen", c.wish});
    EXPECT_EQ(refused.exit_code, c.exit_code) << c.wish;
    EXPECT_EQ(lines_of(refused.errors).size(), 1U) << refused.errors;
    EXPECT_NE(refused.errors.find(c.message), std::string::npos) << refused.errors;
  }
}

TEST(TcpDoor, ListensAtAGivenNameOrIpv6Address) {
  for (const char* host : {"localhost", "[::1]"}) {
    const std::string port = std::to_string(free_port());
    const RunningUnderstudy served({"--listen", "rtu://" + std::string(host) + ":" + port});
    if (served.errors().find("listens at") == std::string::npos) continue;
    const std::string script = "import socket; s = socket.create_connection(('" +
                               std::string(host[0] == '[' ? "::1" : host) + "', " + port +
                               ")); s.sendall(bytes.fromhex('010300010001D5CA')); "
                               "print(s.recv(7, socket.MSG_WAITALL).hex())";
    const Finished asked = run({"/usr/bin/python3", "-c", script});
    EXPECT_EQ(asked.output, "010302c0012984\n") << asked.errors;
  }
}

TEST(TcpDoor, IsNotToListenAtOnePlaceTwice) {
  const std::string place = "rtu://127.0.0.1:" + std::to_string(free_port());
  const Finished refused =
      understudy({"serve", "--model", "simple2-r3", "--listen", place, "--listen", place});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(refused.errors, "understudy: --listen: '" + place +
                                "': line line already listens there; expected another port\n");
}

// With Nagle's algorithm the second piece is not sent before the first is acknowledged.
TEST(TcpDoor, UnderstandsFramesThatAreWrittenInPieces) {
  const RunningUnderstudy served({"--listen", "rtu://:0"});
  const TcpClient client(listened_port(served));
  const auto piece = [&](std::size_t from, std::size_t to) {
    client.write(
        {kReadHardwareCode.begin() + std::ptrdiff_t(from), kReadHardwareCode.begin() + std::ptrdiff_t(to)});
  };
  for (int i = 0; i < 12; ++i) {
    if (i % 3 == 0) {
      piece(0, 1);
      piece(1, 6);
      piece(6, 8);
    } else if (i % 3 == 1) {
      piece(0, 6);
      piece(6, 8);
    } else {
      for (std::size_t at = 0; at < 8; ++at) piece(at, at + 1);
    }
    EXPECT_EQ(client.read(kHardwareCodeReply.size()), kHardwareCodeReply) << i;
  }
}

TEST(TcpDoor, UnderstandsFramesWithAPauseInside) {
  const RunningUnderstudy served({"--listen", "rtu://:0"});
  const TcpClient client(listened_port(served));
  for (std::size_t cut = 1; cut < kReadHardwareCode.size(); ++cut) {
    client.write({kReadHardwareCode.begin(), kReadHardwareCode.begin() + std::ptrdiff_t(cut)});
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    client.write({kReadHardwareCode.begin() + std::ptrdiff_t(cut), kReadHardwareCode.end()});
    EXPECT_EQ(client.read(kHardwareCodeReply.size()), kHardwareCodeReply) << cut;
  }
}

// As users try a port from a shell: `printf ... | socat -t 1 - TCP:...`.
TEST(TcpDoor, AnswersOneShotClientsOfTextAsWell) {
  const auto served = RunningUnderstudy::of_model("slim", {"--listen", "rtu://:0"});
  const std::string script = "import socket; s = socket.create_connection(('127.0.0.1', " +
                             std::to_string(listened_port(*served)) +
                             ")); s.sendall(b'?PE\\r'); s.shutdown(socket.SHUT_WR)\n"
                             "heard = b''\n"
                             "while (got := s.recv(64)): heard += got\n"
                             "print(heard)";
  for (int i = 0; i < 3; ++i) {
    const Finished asked = run({"/usr/bin/python3", "-c", script});
    EXPECT_NE(asked.output.find("0"), std::string::npos) << asked.output << asked.errors;
  }
}

}  // namespace tcp_door_test
}  // namespace understudy::acceptance
