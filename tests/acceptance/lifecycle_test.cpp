// The beginning and the end of a daemon: links, signals, readiness, and its cost while nothing happens.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <fstream>
#include <thread>

#include "tests/acceptance/modbus_host.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace lifecycle_test {

namespace fs = std::filesystem;

class EndBySignal : public testing::TestWithParam<int> {};

TEST_P(EndBySignal, IsCleanWithOrWithoutAHost) {
  for (const bool with_host : {false, true}) {
    RunningUnderstudy daemon;
    std::unique_ptr<ModbusHost> host;
    if (with_host) {
      host = std::make_unique<ModbusHost>(daemon.port());
      EXPECT_EQ(host->read(kHardwareCode), Registers{0xC001});
    }
    EXPECT_TRUE(fs::is_symlink(daemon.port()));
    EXPECT_EQ(daemon.stop(GetParam()), 0);
    EXPECT_EQ(daemon.errors(), "");
    EXPECT_FALSE(fs::is_symlink(daemon.port())) << "the link is removed";
    EXPECT_FALSE(fs::exists(daemon.control())) << "so is the control socket";
  }
}

INSTANTIATE_TEST_SUITE_P(With, EndBySignal, testing::Values(SIGTERM, SIGINT), [](const auto& parameter) {
  return std::string(parameter.param == SIGTERM ? "SIGTERM" : "SIGINT");
});

TEST(Link, LeadsToThePtyThatTheReadyLineNames) {
  const RunningUnderstudy daemon;
  EXPECT_EQ(fs::read_symlink(daemon.port()), daemon.ports()[0].pty);
  EXPECT_EQ(daemon.ports()[0].line, "line");
}

TEST(Link, OfAKilledDaemonIsReplacedByTheNext) {
  RunningUnderstudy killed;
  EXPECT_EQ(killed.stop(SIGKILL), 128 + SIGKILL);
  ASSERT_TRUE(fs::is_symlink(killed.port())) << "left behind";
  ASSERT_TRUE(fs::exists(killed.control())) << "left behind";
  const RunningUnderstudy next({"--baud", "115200"});  // may get the number of the killed one's pty
  Process daemon({UNDERSTUDY_BINARY, "serve", "--model", "simple2-r3", "--link", killed.port(), "--control",
                  killed.control()});
  ASSERT_TRUE(eventually([&] { return daemon.output().ends_with('\n'); })) << daemon.errors();
  EXPECT_EQ(ModbusHost(killed.port()).read(kHardwareCode), Registers{0xC001});
  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(kPatience), 0);
  EXPECT_FALSE(fs::is_symlink(killed.port()));
}

TEST(Link, OfADaemonThatRunsIsNotTakenByAnother) {
  const RunningUnderstudy first;
  const Finished second = understudy({"serve", "--model", "simple2-r3", "--link", first.port(), "--control",
                                      first.folder() / "another_control"});
  EXPECT_EQ(second.exit_code, 3);
  EXPECT_EQ(lines_of(second.errors).size(), 1U) << second.errors;
  ModbusHost host(first.port());
  EXPECT_EQ(host.read(kHardwareCode), Registers{0xC001});
}

TEST(Link, ThatDanglesIsReplaced) {
  const PrivateFolder folder;
  fs::create_symlink("/dev/pts/nothing", folder / "port");
  const RunningUnderstudy daemon({"--station", "3"});
  Process other({UNDERSTUDY_BINARY, "serve", "--model", "simple2-r3", "--link", folder / "port", "--control",
                 folder / "control"});
  ASSERT_TRUE(eventually([&] { return other.output().ends_with('\n'); })) << other.errors();
  EXPECT_EQ(ModbusHost(folder / "port").read(kHardwareCode), Registers{0xC001});
  other.send(SIGTERM);
  EXPECT_EQ(other.wait(kPatience), 0);
}

TEST(Link, NeverReplacesAForeignFile) {
  const PrivateFolder folder;
  const std::string file = folder.write("precious", "do not touch\n");
  fs::create_symlink(file, folder / "link-to-precious");
  fs::create_directory(folder / "folder");
  for (const char* name : {"precious", "link-to-precious", "folder", "missing-folder/port"}) {
    const Finished refused = understudy(
        {"serve", "--model", "simple2-r3", "--link", folder / name, "--control", folder / "control"});
    EXPECT_EQ(refused.exit_code, 3) << name;
    EXPECT_EQ(lines_of(refused.errors).size(), 1U) << refused.errors;
    EXPECT_NE(refused.errors.find(folder / name), std::string::npos) << refused.errors;
    EXPECT_EQ(refused.output, "") << name;
  }
  std::ifstream content(file);
  std::string line;
  std::getline(content, line);
  EXPECT_EQ(line, "do not touch");
  EXPECT_EQ(fs::read_symlink(folder / "link-to-precious"), file);
  EXPECT_TRUE(fs::is_directory(folder / "folder"));
  EXPECT_FALSE(fs::exists(folder / "control"));
}

TEST(Bench, WhoseSecondLinkIsTakenLeavesNothingBehind) {
  const PrivateFolder folder;
  folder.write("taken", "");
  const std::string bench = folder.write("bench.yaml", R"(understudy: 1
lines:
  first: { link: first, stations: [ { name: a, model: simple2-r3 } ] }
  second: { link: taken, stations: [ { name: b, model: simple2-r3 } ] }
)");
  const Finished refused = understudy({"serve", bench, "--control", folder / "control"});
  EXPECT_EQ(refused.exit_code, 3) << refused.errors;
  EXPECT_EQ(refused.output, "");
  EXPECT_FALSE(fs::is_symlink(folder / "first"));
}

TEST(Line, WithoutALinkGetsAPrivateOneThatGoesAway) {
  std::string link;
  {
    const auto daemon = RunningUnderstudy::of_bench(R"(understudy: 1
lines:
  bus: { stations: [ { name: a, model: simple2-r3 } ] }
)");
    link = daemon->port();
    EXPECT_EQ(ModbusHost(link).read(kHardwareCode), Registers{0xC001});
    EXPECT_EQ(fs::status(fs::path(link).parent_path()).permissions(), fs::perms::owner_all);
  }
  EXPECT_FALSE(fs::exists(fs::path(link).parent_path())) << link;
}

TEST(ServiceManager, LearnsThatTheDaemonIsReadyAndThatItStops) {
  const PrivateFolder folder;
  const std::string path = folder / "notify";
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof(address.sun_path) - 1);
  const Descriptor socket_of_manager(socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  ASSERT_EQ(bind(socket_of_manager.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  const auto received = [&] {
    std::array<char, 256> text{};
    const ssize_t size = recv(socket_of_manager.get(), text.data(), text.size(), 0);
    return size > 0 ? std::string(text.data(), static_cast<std::size_t>(size)) : std::string();
  };
  RunningUnderstudy daemon({}, {{"NOTIFY_SOCKET", path}});
  EXPECT_TRUE(eventually([&] { return received().find("READY=1") != std::string::npos; }));
  EXPECT_EQ(daemon.stop(SIGTERM), 0);
  EXPECT_NE(received().find("STOPPING=1"), std::string::npos);
}

// --- idle ----------------------------------------------------------------------------------------

double processor_milliseconds(pid_t pid) {
  std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
  std::string text;
  std::getline(stat, text);
  std::istringstream fields(text.substr(text.rfind(')') + 2));
  std::string ignored;
  for (int field = 3; field < 14; ++field) fields >> ignored;
  double user = 0;
  double system = 0;
  fields >> user >> system;
  return (user + system) * 1000.0 / static_cast<double>(sysconf(_SC_CLK_TCK));
}

double processor_milliseconds_of_a_second(const RunningUnderstudy& daemon) {
  const double before = processor_milliseconds(daemon.process().pid());
  std::this_thread::sleep_for(std::chrono::seconds(1));
  return processor_milliseconds(daemon.process().pid()) - before;
}

TEST(IdleDaemon, UsesNearlyNoProcessorTimeWithoutAHost) {
  const RunningUnderstudy daemon;
  EXPECT_LE(processor_milliseconds_of_a_second(daemon), 20);
}

TEST(IdleDaemon, UsesNearlyNoProcessorTimeWithASilentHost) {
  const RunningUnderstudy daemon;
  ModbusHost host(daemon.port());
  EXPECT_EQ(host.read(kHardwareCode), Registers{0xC001});
  EXPECT_LE(processor_milliseconds_of_a_second(daemon), 20);
}

TEST(IdleDaemon, DoesNotSpinAfterAHostHasClosed) {
  const RunningUnderstudy daemon;
  EXPECT_EQ(ModbusHost(daemon.port()).read(kHardwareCode), Registers{0xC001});
  EXPECT_LE(processor_milliseconds_of_a_second(daemon), 20);
}

}  // namespace lifecycle_test
}  // namespace understudy::acceptance
