// A line on RFC 2217: with python3-serial (hosts/rfc2217_host.py), through ser2net as a gateway, and with raw
// sockets.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/acceptance/raw_host.h"
#include "tests/acceptance/running_understudy.h"
#include "tests/acceptance/tcp_client.h"

namespace understudy::acceptance {
namespace rfc2217_test {

constexpr const char* kPython = "/usr/bin/python3";
constexpr const char* kPyserial = "/usr/lib/python3/dist-packages/serial";
constexpr const char* kSer2net = "/usr/sbin/ser2net";

const Words kListens{"--listen", "rfc2217://:0"};
// The telnet options that each new client gets, 15 bytes.
constexpr std::size_t kGreeting = 15;

std::string url_of(const RunningUnderstudy& served) {
  return "rfc2217://127.0.0.1:" + std::to_string(listened_port(served));
}

class Rfc2217ByPyserial : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kPyserial)) GTEST_SKIP() << "python3-serial is not installed";
  }
  static void expect_case(const std::string& url, const std::string& name) {
    const Finished host = run({kPython, std::string(TEST_FACTS) + "/hosts/rfc2217_host.py", url, name});
    EXPECT_EQ(host.exit_code, 0) << host.output << host.errors;
  }
};

TEST_F(Rfc2217ByPyserial, IsDeafToEachWrongSetting) {
  const RunningUnderstudy served(kListens);
  expect_case(url_of(served), "settings");
  EXPECT_NE(
      served.errors().find("the host set 19200 8N1; the station expects 19200 8E1, so it receives nothing"),
      std::string::npos)
      << served.errors();
}

TEST_F(Rfc2217ByPyserial, HasTheLinesOfAPort) {
  const RunningUnderstudy served(kListens);
  expect_case(url_of(served), "lines");
}

TEST_F(Rfc2217ByPyserial, CarriesEveryByte) {
  const RunningUnderstudy served(kListens);
  expect_case(url_of(served), "every_byte");
}

TEST_F(Rfc2217ByPyserial, RefusesTheSecondAndKeepsTheFirst) {
  const RunningUnderstudy served(kListens);
  expect_case(url_of(served), "second");
}

TEST_F(Rfc2217ByPyserial, ReplaysWhatItsHostSetAndTookBack) {
  const PrivateFolder folder;
  for (const char* name : {"settings", "lines"}) {
    {
      RunningUnderstudy served({"--listen", "rfc2217://:0", "--record", folder / "r"});
      expect_case(url_of(served), name);
      EXPECT_EQ(served.stop(SIGTERM), 0);
    }
    const Finished replay = understudy({"replay", folder / "r"});
    EXPECT_EQ(replay.exit_code, 0) << name << replay.errors;
  }
}

// ser2net opens the line with RFC 2217, and passes on the settings of its own client.
TEST_F(Rfc2217ByPyserial, PassesThroughSer2netAsAGateway) {
  if (!std::filesystem::exists(kSer2net)) GTEST_SKIP() << "ser2net is not installed";
  const RunningUnderstudy served(kListens);
  const PrivateFolder folder;
  const std::string gate = std::to_string(free_port());
  const Process ser2net({kSer2net, "-n", "-d", "-c",
                         folder.write("ser2net.yaml",
                                      "connection: &line\n"
                                      "  accepter: telnet(rfc2217),tcp,127.0.0.1," +
                                          gate + "\n  connector: telnet(rfc2217),tcp,127.0.0.1," +
                                          std::to_string(listened_port(served)) + "\n")});
  ASSERT_TRUE(eventually([&] { return TcpClient(std::stoi(gate)).is_connected; })) << ser2net.errors();
  // The client that checked whether it listens must be gone at both ends.
  ASSERT_TRUE(
      eventually([&] { return served.ctl({"status"}).output.find("host closed") != std::string::npos; }));
  expect_case("rfc2217://127.0.0.1:" + gate, "settings");
}

TEST_F(Rfc2217ByPyserial, CarriesLinesOfTextByUrlsOfAllKinds) {
  for (const char* scheme : {"rfc2217", "rtu"}) {
    const auto served = RunningUnderstudy::of_bench(
        "understudy: 1\nlines:\n  serial:\n    listen: " + std::string(scheme) +
        "://:0\n    pty: false\n    stations: [ { name: robot, model: slim, modules: 3 } ]\n");
    std::string url = served->port();
    if (url.starts_with("rtu")) url.replace(0, 3, "socket");
    const Finished host =
        run({kPython, std::string(TEST_FACTS) + "/hosts/slim_serial_host.py", url, "palletising"});
    EXPECT_EQ(host.exit_code, 0) << url << host.output << host.errors;
    EXPECT_EQ(served->ctl({"get", "robot.PE", "robot.T1PE"}).output, "robot.PE 0\nrobot.T1PE 25\n");
  }
}

TEST(Rfc2217Line, ServesAClientThatSetsNothing) {
  const RunningUnderstudy served(kListens);
  const TcpClient client(listened_port(served));
  EXPECT_EQ(client.read(kGreeting).size(), kGreeting);
  client.write(kReadHardwareCode);
  EXPECT_EQ(client.read(kHardwareCodeReply.size()), kHardwareCodeReply);
}

// Data that it does not accept waits within limits; the daemon continues, and so does the next client.
TEST(Rfc2217Line, OutlivesAClientThatNeverReads) {
  const RunningUnderstudy served({"--listen", "rfc2217://:0", "--listen", "rtu://:0", "--timing", "instant"});
  const int port = listened_port(served);
  {
    const TcpClient silent(port);
    const Bytes asks_signature = pty::hex("FF FA 2C 00 FF F0");
    Bytes many;
    for (int i = 0; i < 5000; ++i) {
      many.insert(many.end(), asks_signature.begin(), asks_signature.end());
      many.insert(many.end(), kReadHardwareCode.begin(), kReadHardwareCode.end());
    }
    for (int i = 0; i < 20; ++i) silent.write_what_goes(many);
    const Finished status = served.ctl({"status"});
    EXPECT_EQ(status.exit_code, 0) << status.errors;
    EXPECT_TRUE(TcpClient(port).is_closed()) << "the line has a host";
  }
  const TcpClient next(port);
  EXPECT_EQ(next.read(kGreeting).size(), kGreeting);
  next.write(kReadHardwareCode);
  EXPECT_EQ(next.read(kHardwareCodeReply.size()), kHardwareCodeReply);
}

// A client that closes its sending half counts as gone, and its last bytes are served.
TEST(Rfc2217Line, ServesWhatAGoneClientHasSent) {
  for (const char* scheme : {"rfc2217://:0", "rtu://:0"}) {
    const RunningUnderstudy served({"--listen", scheme});
    {
      const TcpClient client(listened_port(served));
      client.write(kSetSpeed200);
    }
    EXPECT_TRUE(eventually([&] {
      return served.ctl({"get", "Aaxis_Speed"}).output == "Aaxis_Speed 200\n";
    })) << scheme;
    const TcpClient next(listened_port(served));
    const std::size_t greeting = std::string(scheme).starts_with("rfc") ? kGreeting : 0;
    EXPECT_EQ(next.read(greeting).size(), greeting);
    next.write(kReadHardwareCode);
    EXPECT_EQ(next.read(kHardwareCodeReply.size()), kHardwareCodeReply) << "and no reply but its own";
  }
}

TEST(Rfc2217Line, HasNoPseudoTerminalIfToldSo) {
  const std::string far = "stations: [ { name: a, model: simple2-r3 } ]";
  const std::string near = "near: { link: near.port, stations: [ { name: b, model: simple2-r3 } ] }\n";
  for (const bool in_bench : {true, false}) {
    const std::string keys = in_bench ? "listen: 'rtu://:0', pty: false, " : "";
    const auto served =
        RunningUnderstudy::of_bench("understudy: 1\nlines:\n  far: { " + keys + far + " }\n  " + near,
                                    in_bench ? Words{} : Words{"--listen", "far=rtu://:0", "--no-pty"});
    ASSERT_EQ(served->ports().size(), 2U);
    const std::string url = "rtu://127.0.0.1:" + std::to_string(listened_port(*served));
    EXPECT_EQ(served->ports()[0].pty, url);
    EXPECT_EQ(served->ports()[0].link, url);
    EXPECT_TRUE(served->ports()[1].pty.starts_with("/dev/pts/"));
    const TcpClient client(listened_port(*served));
    client.write(kReadHardwareCode);
    EXPECT_EQ(client.read(kHardwareCodeReply.size()), kHardwareCodeReply);
    Host host(served->ports()[1].link);
    EXPECT_EQ(exchange(host, kReadHardwareCode, kHardwareCodeReply.size()), kHardwareCodeReply);
    EXPECT_NE(served->ctl({"status"}).output.find("line far: " + url), std::string::npos);
  }
}

TEST(Rfc2217Line, RefusesAClientWhileThePseudoTerminalIsOpen) {
  const RunningUnderstudy served(kListens);
  Host early(served.port());
  EXPECT_TRUE(TcpClient(listened_port(served)).is_closed());
  EXPECT_EQ(exchange(early, kReadHardwareCode, kHardwareCodeReply.size()), kHardwareCodeReply);
}

// Data that was written there is not served later either.
TEST(Rfc2217Line, DoesNotHearAPseudoTerminalBesideAClient) {
  const RunningUnderstudy served({"--listen", "rtu://:0"});
  const auto client = std::make_unique<TcpClient>(listened_port(served));
  client->write(kReadHardwareCode);
  EXPECT_EQ(client->read(kHardwareCodeReply.size()), kHardwareCodeReply);
  Host beside(served.port());
  beside.write(kSetSpeed200);
  EXPECT_TRUE(is_silent(beside));
  EXPECT_NE(served.errors().find("the host is ignored until the client disconnects"), std::string::npos);
  client->write(kReadHardwareCode);
  EXPECT_EQ(client->read(kHardwareCodeReply.size()), kHardwareCodeReply);
  EXPECT_EQ(served.ctl({"get", "Aaxis_Speed"}).output.find("200"), std::string::npos);
}

TEST(Rfc2217Line, SaysWhatFitsNoLine) {
  struct Case {
    Words flags;
    const char* message;
  };
  for (const Case& c :
       {Case{{"--no-pty"}, "no line listens on TCP"},
        Case{{"--listen", "rtu://:0", "--no-pty", "--link", "p"}, "--link needs a pseudo-terminal"},
        Case{{"--listen", "rfc2217://"}, "is not an address"}}) {
    Words words{"serve", "--model", "simple2-r3"};
    words.insert(words.end(), c.flags.begin(), c.flags.end());
    const Finished refused = understudy(words);
    EXPECT_EQ(refused.exit_code, 2) << c.message;
    EXPECT_NE(refused.errors.find(c.message), std::string::npos) << refused.errors;
  }
}

TEST(Rfc2217Line, GivesACommandItsAddress) {
  const Finished host = understudy({"exec", "--model", "simple2-r3", "--listen", "rtu://:0", "--no-pty", "--",
                                    "/bin/sh", "-c", "echo $UNDERSTUDY_PORT $UNDERSTUDY_PORT_LINE"});
  EXPECT_EQ(host.exit_code, 0) << host.errors;
  EXPECT_TRUE(host.output.starts_with("rtu://127.0.0.1:")) << host.output;
}

}  // namespace rfc2217_test
}  // namespace understudy::acceptance
