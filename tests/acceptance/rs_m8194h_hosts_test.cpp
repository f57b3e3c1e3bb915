// Real hosts of an RS-M8194H on real ptys: libmodbus, mbpoll and pymodbus at 115200 8N1, and tshark's view of
// a capture. Addresses are those on the wire: LP_X is holding 90, VAR0 300, the window 8000.
#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>
#include <regex>

#include "tests/acceptance/modbus_host.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace rs_m8194h_hosts_test {

constexpr const char* kPython = "/usr/bin/python3";  // Debian's packages are for this one

constexpr int kDo4 = 4;
constexpr int kCallMp = 8;
constexpr int kWordOrder = 14;
constexpr int kLpX = 90;
constexpr int kVar0 = 300;
constexpr int kMd1024 = 5048;
constexpr int kWindow = 8000;
constexpr int kDiAllX = 16;  // input registers
constexpr int kFreeBlocks = 71;
constexpr int kDrivingAxis = 96;
constexpr int kIllegal = 102;
constexpr HostSetup kAsItComes{.baud = 115200, .parity = 'N'};

/// Station 1; DI_9_2 is on, and MP 21 adds VAR1 and VAR2 up in VAR3.
std::unique_ptr<RunningUnderstudy> serve(const Words& flags = {}) {
  auto daemon = RunningUnderstudy::of_bench(
      "understudy: 1\nlines:\n  com:\n    baud: 115200\n    link: com.port\n    stations:\n"
      "      - name: cell\n        model: rs-m8194h\n        address: 1\n        program: |\n"
      "          MP 21\n            RSM_MACRO_VAR_CALCULATE VAR1 + VAR2 VAR3\n          END\n",
      flags);
  EXPECT_EQ(daemon->ctl({"input", "DI_9_2=1"}).exit_code, 0);
  return daemon;
}

Registers command(std::uint16_t code, std::uint16_t axes, std::int32_t number) {
  const auto bits = static_cast<std::uint32_t>(number);
  return {code, axes, static_cast<std::uint16_t>(bits >> 16U), static_cast<std::uint16_t>(bits)};
}

/// 32 bits, high word first.
std::int32_t number_in(const Registers& words) {
  if (words.size() != 2) throw std::runtime_error("no reply");
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(words[0]) << 16U | words[1]);
}

TEST(RsM8194hHosts, LibmodbusReadsAndWritesEveryTable) {
  const auto daemon = serve();
  ModbusHost host(daemon->port(), kAsItComes);
  ASSERT_TRUE(host.connected());
  EXPECT_TRUE(host.write_bit(5, true));
  EXPECT_EQ(host.read_coils(4, 3), (Bits{0, 1, 0}));
  const Bits pattern{1, 0, 1, 1, 0, 0, 1, 0, 1, 1};
  EXPECT_TRUE(host.write_coils(64, pattern));
  EXPECT_EQ(host.read_coils(64, 10), pattern);
  EXPECT_EQ(host.read(kDo4), Registers{0b1101001101});
  EXPECT_TRUE(eventually([&] { return host.read_inputs(17, 3) == Bits{0, 1, 0}; }));
  EXPECT_EQ(host.read_coils(0, 132).size(), 132U);
  EXPECT_EQ(host.read_inputs(0, 388).size(), 388U);
  EXPECT_EQ(host.read_input(kDiAllX), Registers{0x03E0});
  EXPECT_TRUE(host.write(kVar0, Registers{0xFFFE, 0xEE90, 0, 5}));
  EXPECT_EQ(number_in(host.read(kVar0, 2)), -70000);
  EXPECT_TRUE(host.write(kWordOrder, 1));
  EXPECT_EQ(host.read_long(kVar0), -70000);
  EXPECT_TRUE(host.write(kWordOrder, 0));
  EXPECT_EQ(host.read(3000, 124).size(), 124U);
  EXPECT_EQ(daemon->errors(), "");
}

TEST(RsM8194hHosts, LibmodbusLearnsOfItAndCarriesOn) {
  const auto daemon = serve();
  ModbusHost host(daemon->port(), kAsItComes);
  struct Case {
    const char* what;
    std::function<bool()> request;
    int error;
    int reason;
  };
  const std::vector<Case> kCases = {
      {"an unknown function",
       [&] {
         return host.request({1, 7});
       },
       EMBXILFUN, 1},
      {"half of a pair", [&] { return !host.read(kLpX).empty(); }, EMBXILADD, 0xC0},
      {"beyond the table", [&] { return !host.read(8101).empty(); }, EMBXILADD, 2},
      {"a servo coil", [&] { return host.write_bit(128, true); }, EMBXILADD, 2},
      {"an undefined command", [&] { return host.write(kWindow, Registers{0x0A66}); }, EMBXILVAL, 2},
      {"a macro line outside", [&] { return host.write(kWindow, Registers{0x0CD6}); }, EMBXILVAL, 7},
      {"no axis", [&] { return host.write(kWindow, command(0x0A4E, 0, 1)); }, EMBXILVAL, 2},
  };
  for (const Case& one : kCases) {
    EXPECT_FALSE(one.request()) << one.what;
    EXPECT_EQ(host.error(), one.error) << one.what << ": " << modbus_strerror(host.error());
    EXPECT_EQ(host.read_input(kIllegal), Registers{static_cast<std::uint16_t>(one.reason)}) << one.what;
    EXPECT_EQ(host.read_input(kFreeBlocks), Registers{30}) << one.what;
  }
}

TEST(RsM8194hHosts, LibmodbusMovesStopsAndCallsAMacro) {
  const auto daemon = serve();
  ModbusHost host(daemon->port(), kAsItComes);
  EXPECT_TRUE(host.write(kWindow, command(0x0A48, 15, 2000)));  // V
  EXPECT_TRUE(host.write(kWindow, command(0x0A47, 15, 2000)));  // SV
  EXPECT_TRUE(host.write(kWindow, command(0x0A4E, 9, 600)));    // FIXED_MOVE of X and U
  EXPECT_EQ(host.read_input(kDrivingAxis), Registers{9});
  EXPECT_TRUE(eventually([&] { return host.read_input(kDrivingAxis) == Registers{0}; }));
  EXPECT_EQ(number_in(host.read(kLpX, 2)), 600);
  EXPECT_EQ(number_in(host.read(kLpX + 6, 2)), 600);
  EXPECT_TRUE(host.write(kVar0 + 2, Registers{0, 40, 0, 2}));
  EXPECT_TRUE(host.write(kCallMp, 21));
  EXPECT_TRUE(eventually([&] { return number_in(host.read(kVar0 + 6, 2)) == 42; }));
  EXPECT_EQ(daemon->errors(), "");
}

TEST(RsM8194hHosts, BroadcastsAreExecutedInSilence) {
  const auto daemon = serve();
  ModbusHost host(daemon->port(),
                  {.baud = 115200, .parity = 'N', .station = 0, .patience = std::chrono::milliseconds(300)});
  EXPECT_FALSE(host.write(kVar0, Registers{0, 1234}));
  EXPECT_EQ(host.error(), ETIMEDOUT);
  host.set_station(1);
  host.set_patience(std::chrono::seconds(5));
  EXPECT_EQ(number_in(host.read(kVar0, 2)), 1234);
}

TEST(RsM8194hHosts, CtlSetFollowsTheOrderThatItSets) {
  const auto daemon = serve();
  ModbusHost host(daemon->port(), kAsItComes);
  for (const std::uint16_t order : {1, 0}) {
    EXPECT_EQ(daemon->ctl({"set", "WORD_ORDER=" + std::to_string(order), "VAR0=10000"}).exit_code, 0);
    EXPECT_EQ(host.read(kVar0, 2), order == 1 ? (Registers{10000, 0}) : (Registers{0, 10000}));
  }
}

class RsM8194hMbpoll : public testing::Test {
 protected:
  void SetUp() override {
    if (run({"mbpoll", "-V"}).exit_code == 127) GTEST_SKIP() << "mbpoll is not installed";
  }
  Words command(const std::string& type, int address, const Words& rest) const {
    Words words{"mbpoll", "-m",     "rtu", "-a",   "1",
                "-b",     "115200", "-P",  "none", "-0",
                "-q",     "-t",     type,  "-r",   std::to_string(address)};
    words.insert(words.end(), rest.begin(), rest.end());
    words.push_back(daemon_->port());
    return words;
  }
  /// Returns its output, value by value.
  std::string values(const std::string& type, int address, int count = 1, const Words& order = {}) const {
    Words rest{"-1", "-c", std::to_string(count)};
    rest.insert(rest.end(), order.begin(), order.end());
    const Finished finished = run(command(type, address, rest));
    EXPECT_EQ(finished.exit_code, 0) << finished.errors;
    std::string all;
    const std::regex value("\\]:\\s*(\\S+)");
    for (std::sregex_iterator found(finished.output.begin(), finished.output.end(), value), end; found != end;
         ++found) {
      all += (all.empty() ? "" : " ") + (*found)[1].str();
    }
    return all;
  }
  void write(const std::string& type, int address, const Words& values, const Words& order = {}) const {
    Words words = command(type, address, order);
    words.push_back("--");
    words.insert(words.end(), values.begin(), values.end());
    const Finished finished = run(words);
    EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  }

  std::unique_ptr<RunningUnderstudy> daemon_ = serve();
};

TEST_F(RsM8194hMbpoll, ReadsAndWritesItsFourTypes) {
  write("0", 5, {"1"});
  EXPECT_EQ(values("0", 4, 3), "0 1 0");
  write("0", 64, {"1", "0", "1", "1"});
  EXPECT_EQ(values("0", 64, 4), "1 0 1 1");
  EXPECT_TRUE(eventually([&] { return values("1", 17, 3) == "0 1 0"; }));
  EXPECT_EQ(values("3:hex", kDiAllX), "0x03E0");
  EXPECT_EQ(values("3", kFreeBlocks), "30");
  write("4", kWordOrder, {"0"});
  // -B: the high word first, as in this controller.
  write("4:int", kVar0, {"-70000"}, {"-B"});
  EXPECT_EQ(values("4:int", kVar0, 1, {"-B"}), "-70000");
  EXPECT_EQ(values("4:hex", kVar0, 2), "0xFFFE 0xEE90");
  write("4:float", kMd1024, {"321.625"}, {"-B"});
  EXPECT_EQ(values("4:float", kMd1024, 1, {"-B"}), "321.625");
  write("4", kWordOrder, {"1"});
  EXPECT_EQ(values("4:int", kVar0), "-70000");
  EXPECT_EQ(daemon_->errors(), "");
}

TEST_F(RsM8194hMbpoll, LearnsWhyARequestIsRefused) {
  for (const auto& [type, address] :
       {std::pair{"0", 132}, std::pair{"1", 388}, std::pair{"3", 170}, std::pair{"4", kLpX}}) {
    const Finished finished = run(command(type, address, {"-1"}));
    EXPECT_EQ(finished.exit_code, 1) << type;
    EXPECT_NE(finished.errors.find("Illegal data address"), std::string::npos) << finished.errors;
  }
}

TEST_F(RsM8194hMbpoll, SendsACommandThroughTheWindow) {
  write("4", kWindow, {"2632", "1", "0", "4000"});  // SET_V X 4000
  write("4", kWindow, {"2638", "1", "0", "1000"});  // FIXED_MOVE X 1000
  EXPECT_TRUE(eventually([&] { return values("3", kDrivingAxis) == "0"; }));
  EXPECT_EQ(values("4:int", kLpX, 1, {"-B"}), "1000");
}

class RsM8194hPymodbus : public testing::TestWithParam<const char*> {};

TEST_P(RsM8194hPymodbus, IsServed) {
  if (!std::filesystem::exists("/usr/lib/python3/dist-packages/pymodbus")) {
    GTEST_SKIP() << "python3-pymodbus is not installed";
  }
  const auto daemon = serve();
  const Finished finished = run(
      {kPython, std::string(TEST_FACTS) + "/hosts/pymodbus_rs_m8194h_host.py", daemon->port(), GetParam()});
  EXPECT_EQ(finished.exit_code, 0) << finished.output << finished.errors;
  EXPECT_EQ(daemon->errors(), "");
}
INSTANTIATE_TEST_SUITE_P(Case, RsM8194hPymodbus,
                         testing::Values("types", "refusals", "motion", "asynchronous"),
                         [](const auto& parameter) { return std::string(parameter.param); });

TEST(RsM8194hHosts, TsharkNamesTheFunctions) {
  if (run({"tshark", "--version"}).exit_code != 0) GTEST_SKIP() << "tshark is not installed";
  const PrivateFolder folder;
  const auto daemon = serve({"--capture", folder / "a.pcapng"});
  {
    ModbusHost host(daemon->port(), kAsItComes);
    EXPECT_EQ(host.read_coils(0, 9).size(), 9U);
    EXPECT_EQ(host.read_inputs(0, 24).size(), 24U);
    EXPECT_TRUE(host.write_bit(3, true));
    EXPECT_TRUE(host.write_coils(0, Bits{1, 1, 0}));
    EXPECT_EQ(host.read_input(kFreeBlocks).size(), 1U);
    EXPECT_TRUE(host.read_coils(132).empty());
  }
  EXPECT_EQ(daemon->stop(SIGTERM), 0);
  const Finished decoded = run({"tshark", "-r", folder / "a.pcapng", "-o", "mbrtu.tcp.port:19200", "-T",
                                "fields", "-e", "_ws.col.Info"});
  const std::string asks = "   Query: Unit:   1, Func: ";
  const std::string says = "Response: Unit:   1, Func: ";
  std::string expected;
  for (const std::string function : {"  1: Read Coils", "  2: Read Discrete Inputs", "  5: Write Single Coil",
                                     " 15: Write Multiple Coils", "  4: Read Input Registers"}) {
    expected += asks + function + "\n" + says + function + "\n";
  }
  expected += asks + "  1: Read Coils\n" + says + "  1: Read Coils. Exception returned \n";
  EXPECT_EQ(decoded.output, expected) << decoded.errors;
}

}  // namespace rs_m8194h_hosts_test
}  // namespace understudy::acceptance
