// `understudy ctl` against a running daemon.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/acceptance/modbus_host.h"
#include "tests/acceptance/raw_host.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace control_test {

using Json = nlohmann::json;

/// Returns the reply of `ctl --json WORDS`, which must be one object on one line.
Json json(const RunningUnderstudy& daemon, Words words) {
  words.insert(words.begin(), "--json");
  const Finished finished = daemon.ctl(words);
  EXPECT_EQ(finished.exit_code, 0) << finished.output << finished.errors;
  EXPECT_EQ(finished.errors, "");
  EXPECT_EQ(lines_of(finished.output).size(), 1U) << finished.output;
  const Json reply = Json::parse(finished.output);
  EXPECT_EQ(reply["ok"], true) << finished.output;
  return reply;
}

std::int64_t value(const RunningUnderstudy& daemon, const std::string& name) {
  return json(daemon, {"get", name})["values"][name].get<std::int64_t>();
}

std::int64_t simulated_ns(const RunningUnderstudy& daemon) {
  return json(daemon, {"status"})["status"]["simulated_time_ns"].get<std::int64_t>();
}

void expect_done(const RunningUnderstudy& daemon, const Words& words) {
  const Finished finished = daemon.ctl(words);
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  EXPECT_EQ(finished.errors, "");
}

/// Expects a refusal with one line that contains `why`.
void expect_refused(const RunningUnderstudy& daemon, const Words& words, const std::string& why) {
  const Finished finished = daemon.ctl(words);
  EXPECT_EQ(finished.exit_code, 2) << words.back();
  EXPECT_EQ(finished.output, "") << words.back();
  EXPECT_EQ(lines_of(finished.errors).size(), 1U) << finished.errors;
  EXPECT_NE(finished.errors.find(why), std::string::npos) << finished.errors;
}

TEST(ControlStatus, TellsTimeLinesStationsAndLateness) {
  const RunningUnderstudy daemon;
  ModbusHost host(daemon.port());
  EXPECT_EQ(host.read(kHardwareCode), Registers{0xC001});
  EXPECT_TRUE(host.read(kHole).empty());
  const Json status = json(daemon, {"status"})["status"];
  EXPECT_EQ(status["speed"], "real");
  EXPECT_EQ(status["paused"], false);
  EXPECT_TRUE(status["lateness"].contains("p50_us")) << status["lateness"];
  EXPECT_TRUE(status["lateness"].contains("p99_us")) << status["lateness"];
  const Json& line = status["lines"].at(0);
  EXPECT_EQ(line["name"], "line");
  EXPECT_EQ(line["pty"], daemon.ports()[0].pty);
  EXPECT_EQ(line["link"], daemon.port());
  EXPECT_EQ(line["host"], "open");
  EXPECT_EQ(line["host_baud"], 19200);
  EXPECT_EQ(line["bytes_in"], 16);
  EXPECT_EQ(line["bytes_out"], 12);
  const Json& station = line["stations"].at(0);
  EXPECT_EQ(station["requests"], 2);
  EXPECT_EQ(station["replies"], 2);
  EXPECT_EQ(station["exceptions"], 1);
  EXPECT_EQ(status["devices"].at(0)["model"], "simple2-r3");

  const Finished plain = daemon.ctl({"status"});
  EXPECT_EQ(plain.exit_code, 0);
  for (const char* word : {"simulated time", "lateness", "19200 8E1", "station 1", "firmware 1.52"})
    EXPECT_NE(plain.output.find(word), std::string::npos) << word << " in\n" << plain.output;
}

/// Checks that simulated time passes `factor` times as fast as a clock around the two requests, or between
/// them.
void expect_pace(const RunningUnderstudy& daemon, double factor) {
  using Clock = std::chrono::steady_clock;
  const auto ns = [](Clock::duration time) {
    return static_cast<double>(time / std::chrono::nanoseconds(1));
  };
  const auto before = Clock::now();
  const std::int64_t first = simulated_ns(daemon);
  const auto between = Clock::now();
  std::this_thread::sleep_for(Wait(300));
  const auto slept = Clock::now() - between;
  const auto passed = static_cast<double>(simulated_ns(daemon) - first);
  EXPECT_GE(passed, factor * ns(slept) - 1e6);
  EXPECT_LE(passed, factor * ns(Clock::now() - before) + 1e6);
}

TEST(Speed, RealIsTheClocks) { expect_pace(RunningUnderstudy(), 1); }

TEST(Speed, MayBeAFactor) { expect_pace(RunningUnderstudy({"--speed", "10x"}), 10); }

TEST(Speed, FreeRunsFarAheadAndStillAnswersAHost) {
  const RunningUnderstudy daemon({"--speed", "free"});
  const std::int64_t first = simulated_ns(daemon);
  ModbusHost host(daemon.port());
  for (int time = 0; time < 5; ++time) EXPECT_EQ(host.read(kHardwareCode), Registers{0xC001});
  EXPECT_TRUE(eventually([&] { return simulated_ns(daemon) > first + 100'000'000'000; }));
}

TEST(ControlSet, WritesWhatGetAndTheWireRead) {
  const RunningUnderstudy daemon;
  expect_done(daemon, {"set", "Aaxis_Speed=200", "device.Aaxis_Pulse=-70000"});
  EXPECT_EQ(value(daemon, "Aaxis_Speed"), 200);
  EXPECT_EQ(value(daemon, "device.Aaxis_Pulse"), -70000);
  const Finished plain = daemon.ctl({"get", "Aaxis_Pulse", "Aaxis_Speed", "HW_Code"});
  EXPECT_EQ(plain.output, "Aaxis_Pulse -70000\nAaxis_Speed 200\nHW_Code 49153\n");
  EXPECT_EQ(ModbusHost(daemon.port()).read_long(kAaxisPulse), -70000);
}

TEST(ControlSet, IsRefusedWholeWithOneClearLine) {
  const RunningUnderstudy daemon;
  expect_refused(daemon, {"set", "Aaxis_Speed=5", "Aaxis_Sped=7"}, "'Aaxis_Speed'");
  expect_refused(daemon, {"set", "Aaxis_Speed=5", "Aaxis_AccTime=3001"}, "0 to 3000");
  expect_refused(daemon, {"set", "Aaxis_Speed=5", "HW_Code=1"}, "read-only");
  expect_refused(daemon, {"set", "nobody.Aaxis_Speed=5"}, "nobody");
  expect_refused(daemon, {"set", "Aaxis_Speed"}, "NAME=VALUE");
  expect_refused(daemon, {"set", "Aaxis_Speed=fast"}, "'fast' is not a number; expected 0 to 32768");
  expect_refused(daemon, {"get", "Cord_Q"}, "'Cord_A'");
  EXPECT_EQ(value(daemon, "Aaxis_Speed"), 0);
  const Finished refused = daemon.ctl({"--json", "get", "Cord_Q"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(Json::parse(refused.output)["ok"], false) << refused.output;
}

TEST(ControlInput, HoldsAnInputAndLetsItGo) {
  const RunningUnderstudy daemon;
  EXPECT_EQ(value(daemon, "DIN_10"), 0);
  expect_done(daemon, {"input", "DIN_10=1", "DIN_2=1"});
  EXPECT_TRUE(eventually([&] { return value(daemon, "DIN_ALL") == (1 << 10 | 1 << 2); }));
  EXPECT_EQ(ModbusHost(daemon.port()).read(0x0D1A), Registers{1});
  expect_done(daemon, {"input", "DIN_10=0"});
  EXPECT_TRUE(eventually([&] { return value(daemon, "DIN_ALL") == 1 << 2; }));
  expect_refused(daemon, {"input", "DIN_2=0", "DIN_10=2"}, "0 or 1");
  expect_refused(daemon, {"input", "DIN_11=1"}, "DIN_1");
  expect_refused(daemon, {"input", "DOUT_0=1"}, "DOUT_0");
  EXPECT_EQ(value(daemon, "DIN_ALL"), 1 << 2);
}

// --- time ----------------------------------------------------------------------------------------

constexpr const char* kStart = "Aaxis_Move_INC=1";
const Words kManualsExample{
    "set", "Aaxis_SVON=1", "Aaxis_Pulse=32000", "Aaxis_Speed=200", "Aaxis_AccTime=5", "Aaxis_DecTime=5",
    kStart};

TEST(ManualSpeed, MovesNothingUntilTimeIsAdvanced) {
  const RunningUnderstudy daemon({"--speed", "manual"});
  expect_done(daemon, kManualsExample);
  EXPECT_EQ(value(daemon, "STATUS.4"), 1) << "moving, from the moment it is accepted";
  std::this_thread::sleep_for(Wait(100));
  EXPECT_EQ(value(daemon, "Cord_A"), 0);
  EXPECT_EQ(simulated_ns(daemon), 0);
}

TEST(ManualSpeed, TheManualsExampleTakesExactly3050Milliseconds) {
  const RunningUnderstudy daemon({"--speed", "manual"});
  expect_done(daemon, kManualsExample);
  const auto position_after = [&](const char* duration) {
    expect_done(daemon, {"advance", duration});
    return value(daemon, "Cord_A");
  };
  EXPECT_EQ(position_after("1ms"), 0);     // t = 0 is the first tick
  EXPECT_EQ(position_after("25ms"), 66);   // 66.667
  EXPECT_EQ(position_after("25ms"), 266);  // 266.667, full speed
  EXPECT_EQ(position_after("950ms"), 10400);
  EXPECT_EQ(position_after("2s"), 31733);    // 31733.33, begins to decelerate
  EXPECT_EQ(position_after("49ms"), 31999);  // 31999.89; 3050 ms in all
  EXPECT_EQ(value(daemon, "STATUS.4"), 1);
  EXPECT_EQ(position_after("1ms"), 32000);
  EXPECT_EQ(value(daemon, "STATUS.4"), 0);
  EXPECT_EQ(value(daemon, "Aaxis_Move_INC"), 0);
  EXPECT_EQ(simulated_ns(daemon), 3'051'000'000);
}

TEST(ManualSpeed, CompletesAMoveThatTheWireHasStarted) {
  const RunningUnderstudy daemon({"--speed", "manual", "--timing", "instant"});
  ModbusHost host(daemon.port());
  EXPECT_TRUE(host.write(kAaxisSvon, 1)) << modbus_strerror(host.error());
  EXPECT_TRUE(host.write(kAaxisPulse, Registers{32000, 0, 200, 5, 5, 1})) << modbus_strerror(host.error());
  EXPECT_TRUE(host.is_moving());
  expect_done(daemon, {"advance", "3050ms"});
  EXPECT_TRUE(host.is_moving());
  expect_done(daemon, {"advance", "1ms"});
  EXPECT_FALSE(host.is_moving());
  EXPECT_EQ(host.read_long(kCordA), 32000);
}

TEST(ManualSpeed, KeepsARequestThatIsStillOnTheWire) {
  const RunningUnderstudy daemon({"--speed", "manual", "--timing", "wire"});
  Host host(daemon.port());
  ASSERT_TRUE(host.set_even_parity(B19200));
  host.write(kReadHardwareCode);
  ASSERT_TRUE(
      eventually([&] { return daemon.ctl({"status"}).output.find(" 8 bytes in") != std::string::npos; }));
  expect_done(daemon, {"advance", "2ms"});                     // three of eight characters
  std::this_thread::sleep_for(std::chrono::milliseconds(50));  // longer than any timeout
  expect_done(daemon, {"advance", "20ms"});
  EXPECT_EQ(host.read(kHardwareCodeReply.size()), kHardwareCodeReply);
}

// Only silence shows the length of 0x41, and in simulated time there is no silence.
TEST(ManualSpeed, ServesWhatOnlySilenceEnds) {
  const RunningUnderstudy daemon({"--speed", "manual", "--timing", "instant"});
  Host host(daemon.port());
  ASSERT_TRUE(host.set_even_parity(B19200));
  const Bytes refusal = pty::hex("01 C1 01 B0 50");
  EXPECT_EQ(exchange(host, pty::hex("01 41 01 02 03 1D 5D"), refusal.size()), refusal);
}

TEST(ControlAdvance, IsRefusedWhereTimeRunsByItself) {
  const RunningUnderstudy daemon;
  expect_refused(daemon, {"advance", "1s"}, "manual");
}

TEST(ControlAdvance, CrossesAnHourAtOnce) {
  const RunningUnderstudy daemon({"--speed", "manual"});
  expect_done(daemon, {"advance", "3600s"});
  EXPECT_EQ(simulated_ns(daemon), 3'600'000'000'000);
}

TEST(ControlPause, StopsTimeAndResumeLetsItRunAgain) {
  const RunningUnderstudy daemon;
  expect_done(daemon, {"pause"});
  const std::int64_t paused_at = simulated_ns(daemon);
  EXPECT_EQ(json(daemon, {"status"})["status"]["paused"], true);
  expect_done(daemon, {"set", "Aaxis_SVON=1", "Aaxis_Pulse=320", "Aaxis_Speed=600", kStart});
  std::this_thread::sleep_for(Wait(100));
  EXPECT_EQ(simulated_ns(daemon), paused_at);
  EXPECT_EQ(value(daemon, "Cord_A"), 0);
  expect_done(daemon, {"advance", "250ms"});
  EXPECT_EQ(simulated_ns(daemon), paused_at + 250'000'000);
  EXPECT_EQ(value(daemon, "Cord_A"), 320);
  expect_done(daemon, {"resume"});
  EXPECT_TRUE(eventually([&] { return simulated_ns(daemon) > paused_at + 300'000'000; }));
  EXPECT_LT(simulated_ns(daemon), paused_at + 5'000'000'000) << "paused time is not made up for";
  EXPECT_EQ(ModbusHost(daemon.port()).read(kHardwareCode), Registers{0xC001});
}

// --- the socket ----------------------------------------------------------------------------------

TEST(ControlSocket, IsItsOwnersAlone) {
  const RunningUnderstudy daemon;
  struct stat status {};
  ASSERT_EQ(stat(daemon.control().c_str(), &status), 0);
  EXPECT_TRUE(S_ISSOCK(status.st_mode));
  EXPECT_EQ(status.st_mode & 0777U, 0600U);
}

TEST(ControlSocket, IsNotTakenFromARunningDaemon) {
  const RunningUnderstudy daemon;
  const Finished second = understudy({"serve", "--model", "simple2-r3", "--link", daemon.folder() / "second",
                                      "--control", daemon.control()});
  EXPECT_EQ(second.exit_code, 3);
  EXPECT_EQ(second.output, "");
  EXPECT_EQ(lines_of(second.errors).size(), 1U) << second.errors;
  EXPECT_NE(second.errors.find(daemon.control()), std::string::npos) << second.errors;
  EXPECT_FALSE(std::filesystem::is_symlink(daemon.folder() / "second"));
  EXPECT_EQ(daemon.ctl({"status"}).exit_code, 0) << "the first one still answers";
}

TEST(ControlSocket, NeverReplacesAForeignFile) {
  const PrivateFolder folder;
  const std::string file = folder.write("control", "precious");
  const Finished refused =
      understudy({"serve", "--model", "simple2-r3", "--link", folder / "port", "--control", file});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_EQ(lines_of(refused.errors).size(), 1U) << refused.errors;
  EXPECT_TRUE(std::filesystem::is_regular_file(file));
}

TEST(ControlSocket, ThatNobodyAnswersEndsCtlWithOneLine) {
  const PrivateFolder folder;
  for (const Words& verb : {Words{"status"}, Words{"get", "Cord_A"}, Words{"advance", "1ms"}}) {
    Words words{"ctl", "--control", folder / "nobody"};
    words.insert(words.end(), verb.begin(), verb.end());
    const Finished finished = understudy(words);
    EXPECT_EQ(finished.exit_code, 3) << verb[0];
    EXPECT_EQ(finished.output, "") << verb[0];
    EXPECT_EQ(lines_of(finished.errors).size(), 1U) << finished.errors;
  }
}

TEST(ControlSocket, IsFoundByTheEnvironmentToo) {
  const RunningUnderstudy daemon;
  const Finished finished = understudy({"ctl", "get", "HW_Code"}, {{"UNDERSTUDY_CONTROL", daemon.control()}});
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  EXPECT_EQ(finished.output, "HW_Code 49153\n");
}

TEST(ControlSocket, AnEmptyVariableIsAsIfItWereNotSet) {
  const PrivateFolder folder;
  const Finished finished =
      understudy({"ctl", "status"}, {{"UNDERSTUDY_CONTROL", ""}, {"XDG_RUNTIME_DIR", folder.path()}});
  EXPECT_EQ(finished.exit_code, 3);
  EXPECT_NE(finished.errors.find("ctl: no daemon answers in " + folder.path()), std::string::npos)
      << finished.errors;
}

// --- run-until and watch ---------------------------------------------------------------------------

TEST(ControlRunUntil, MovesTimeToWhereItIsTrue) {
  const RunningUnderstudy daemon({"--speed", "manual"});
  expect_done(daemon, {"set", "Aaxis_SVON=1", "Aaxis_Pulse=3200", "Aaxis_Speed=200", "Aaxis_Move_INC=1"});
  EXPECT_EQ(daemon.ctl({"run-until", "device.STATUS.4 == 0"}).output, "simulated time 311ms\n");
  const Finished never = daemon.ctl({"run-until", "device.STATUS.4 == 1", "--within", "10ms"});
  EXPECT_EQ(never.exit_code, 1);
  EXPECT_EQ(never.errors,
            "understudy: ctl run-until: 'device.STATUS.4 == 1' did not become true within 10ms\n");
  EXPECT_EQ(simulated_ns(daemon), 321'000'000);
  expect_refused(daemon, {"run-until", "device.STATU.4 == 1"}, "the nearest is 'STATUS'");
  expect_refused(daemon, {"run-until"}, "expected one condition");
}

TEST(ControlWatch, PrintsTablesOneAfterAnother) {
  const RunningUnderstudy daemon({"--speed", "manual"});
  const Finished finished = daemon.ctl({"watch", "--times", "3", "--every", "10ms"});
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  const auto lines = lines_of(finished.output);
  EXPECT_EQ(std::count(lines.begin(), lines.end(), "time         0s, speed manual"), 3);
  EXPECT_EQ(std::count(lines.begin(), lines.end(), ""), 2 * 3) << finished.output;
  EXPECT_EQ(finished.output.find('\x1b'), std::string::npos) << "this is not a terminal";
  expect_refused(daemon, {"watch", "--every", "often"}, "expected 10ms or more");
}

}  // namespace control_test
}  // namespace understudy::acceptance
