// Real hosts of a SUPER-40NC on real ptys: libmodbus, mbpoll, pymodbus, the frames that the manual prints,
// and a panel and a PC on both ports at once. Addresses are the wire's: D0 is 0, M0 is 1000, M8000 is 2000,
// D8000 is 7000.
#include <gtest/gtest.h>
#include <signal.h>

#include <atomic>
#include <fstream>
#include <regex>
#include <sstream>
#include <thread>

#include "tests/acceptance/modbus_host.h"
#include "tests/acceptance/raw_host.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace super40nc_hosts_test {

constexpr const char* kPython = "/usr/bin/python3";  // Debian's packages are for this one

constexpr int kY0 = 0;
constexpr int kM0 = 1000;
constexpr int kM8000 = 2000;
constexpr int kM8100 = 2100;
constexpr int kD0 = 0;
constexpr int kD53 = 106;
constexpr int kD8117 = 7234;
constexpr int kD9000 = 9000;
constexpr int kHole = 2128;

constexpr const char* kProgram =
    "AREA X\nINC D0\nRPM K3000\nDRV K100\nDRV K0\nEND\nAREA PLC\nLD X3\nOUT Y0\nEND\n";

/// A bench with one on both its ports, with a station address and a program for X.
std::unique_ptr<RunningUnderstudy> serve(int station, const Words& flags = {},
                                         const std::string& timing = "wire") {
  std::string program;
  for (const std::string& line : lines_of(kProgram)) program += "      " + line + "\n";
  return RunningUnderstudy::of_bench(
      "understudy: 1\nlines:\n"
      "  rs232: { link: panel.port, timing: " +
          timing +
          ", stations: [ { device: mill, port: RS232 } ] }\n"
          "  rs485: { link: pc.port, timing: " +
          timing +
          ", stations: [ { device: mill, port: RS485 } ] }\n"
          "devices:\n  mill:\n    model: super-40nc\n    set: { D9000: " +
          std::to_string(station) + " }\n    program: |\n" + program,
      flags);
}
std::string panel_port(const RunningUnderstudy& daemon) { return daemon.ports().at(0).link; }
std::string pc_port(const RunningUnderstudy& daemon) { return daemon.ports().at(1).link; }

/// Bits and words of all kinds, refusals, and a program started and watched to its end.
void expect_served(ModbusHost& host, const RunningUnderstudy& daemon) {
  ASSERT_TRUE(host.connected());
  EXPECT_TRUE(host.write_bit(kM0 + 7, true));
  EXPECT_EQ(host.read_coils(kM0 + 6, 3), (Bits{0, 1, 0}));
  const Bits pattern{1, 0, 1, 1, 0, 0, 1, 0, 1, 1};
  EXPECT_TRUE(host.write_coils(kM0 + 100, pattern));
  EXPECT_EQ(host.read_coils(kM0 + 100, 10), pattern);
  EXPECT_EQ(daemon.ctl({"input", "X3=1"}).exit_code, 0);
  EXPECT_TRUE(eventually([&] { return host.read_inputs(2, 3) == Bits{0, 1, 0}; }));
  EXPECT_TRUE(eventually([&] { return host.read_coils(kY0) == Bits{1}; }));
  EXPECT_EQ(host.read_inputs(0, 48).size(), 48U);
  EXPECT_EQ(host.read_coils(kM0, 512).size(), 512U);

  EXPECT_TRUE(host.write(kD53, Registers{0x022B, 0, 0xFFFE, 0xFFFF}));
  EXPECT_EQ(host.read_long(kD53), 0x022B);
  EXPECT_EQ(host.read_long(kD53 + 2), -2);
  EXPECT_TRUE(host.write(kD53 + 2, 7));  // half of it
  EXPECT_EQ(host.read_long(kD53 + 2), -65529);
  EXPECT_EQ(host.read(kD0, 125).size(), 125U);

  EXPECT_TRUE(host.read_input(kD0).empty());
  EXPECT_EQ(host.error(), EMBXILFUN);
  EXPECT_TRUE(host.read(kHole).empty());
  EXPECT_EQ(host.error(), EMBXILADD);
  EXPECT_TRUE(host.read_coils(32).empty());
  EXPECT_EQ(host.error(), EMBXILADD);

  const std::int32_t before = host.read_long(kD0);
  EXPECT_TRUE(host.write_bit(kM8100, true));
  EXPECT_TRUE(eventually([&] { return host.read_coils(kM8100) == Bits{0}; }));
  EXPECT_EQ(host.read_long(kD0), before + 1);
  EXPECT_EQ(host.read_long(kD8117), 0);
  EXPECT_EQ(daemon.errors(), "");
}

TEST(Super40ncHosts, LibmodbusIsServedAtStation0) {
  const auto daemon = serve(0);
  for (const std::string& port : {panel_port(*daemon), pc_port(*daemon)}) {
    ModbusHost host(port, {.station = 0});
    expect_served(host, *daemon);
  }
}

TEST(Super40ncHosts, LibmodbusIsServedAtAnother) {
  const auto daemon = serve(5);
  ModbusHost host(pc_port(*daemon), {.station = 5});
  expect_served(host, *daemon);
  // The number changes after its own reply.
  EXPECT_TRUE(host.write(kD9000, 0));
  host.set_station(0);
  EXPECT_EQ(host.read_long(kD9000), 0);
}

TEST(Super40ncHosts, BroadcastsAreExecutedInSilence) {
  const auto daemon = serve(5);
  ModbusHost host(pc_port(*daemon), {.station = 0, .patience = std::chrono::milliseconds(300)});
  EXPECT_FALSE(host.write(kD53, 1234));
  EXPECT_EQ(host.error(), ETIMEDOUT);
  host.set_station(5);
  EXPECT_EQ(host.read_long(kD53), 1234);
}

TEST(Super40ncHosts, UnderstudyPollReadsAndWritesAtStation0) {
  const auto daemon = serve(0);
  const auto poll = [&](const Words& words) {
    Words all{"poll", panel_port(*daemon), "--model", "super-40nc", "--station", "0"};
    all.insert(all.end(), words.begin(), words.end());
    return understudy(all);
  };
  EXPECT_EQ(poll({"D53=-7", "M5=1"}).exit_code, 0);
  const Finished read = poll({"D53", "M5", "D9000"});
  EXPECT_EQ(read.exit_code, 0) << read.errors;
  EXPECT_EQ(read.output, "D53 -7\nM5 1\nD9000 0\n");
  // Nothing replies there while the number is different.
  EXPECT_EQ(poll({"D9000=3"}).exit_code, 0);
  EXPECT_EQ(poll({"--timeout", "200ms", "D53"}).exit_code, 1);
}

class Super40ncMbpoll : public testing::Test {
 protected:
  void SetUp() override {
    if (run({"mbpoll", "-V"}).exit_code == 127) GTEST_SKIP() << "mbpoll is not installed";
  }
  Words command(const std::string& type, int address, const Words& rest) const {
    Words words{"mbpoll", "-m",    "rtu", "-a",   "9",
                "-b",     "19200", "-P",  "even", "-0",
                "-q",     "-t",    type,  "-r",   std::to_string(address)};
    words.insert(words.end(), rest.begin(), rest.end());
    words.push_back(panel_port(*daemon_));
    return words;
  }
  /// Its output, value by value.
  std::string values(const std::string& type, int address, int count = 1) const {
    const Finished finished = run(command(type, address, {"-1", "-c", std::to_string(count)}));
    EXPECT_EQ(finished.exit_code, 0) << finished.errors;
    std::string all;
    const std::regex value("\\]:\\s*(\\S+)");
    for (std::sregex_iterator found(finished.output.begin(), finished.output.end(), value), end; found != end;
         ++found) {
      all += (all.empty() ? "" : " ") + (*found)[1].str();
    }
    return all;
  }
  Finished write(const std::string& type, int address, const Words& values) const {
    Words words = command(type, address, {});
    words.push_back("--");
    words.insert(words.end(), values.begin(), values.end());
    return run(words);
  }

  std::unique_ptr<RunningUnderstudy> daemon_ = serve(9);
};

TEST_F(Super40ncMbpoll, ReadsAndWritesItsThreeTypes) {
  EXPECT_EQ(write("0", kM0 + 7, {"1"}).exit_code, 0);
  EXPECT_EQ(values("0", kM0 + 6, 3), "0 1 0");
  EXPECT_EQ(write("0", kM0 + 20, {"1", "0", "1", "1"}).exit_code, 0);
  EXPECT_EQ(values("0", kM0 + 20, 4), "1 0 1 1");
  EXPECT_EQ(daemon_->ctl({"input", "X3=1", "X5=1"}).exit_code, 0);
  EXPECT_TRUE(eventually([&] { return values("1", 3, 3) == "1 0 1"; }));
  EXPECT_EQ(values("0", kY0), "1");
  EXPECT_EQ(write("4", kD53, {"555"}).exit_code, 0);
  EXPECT_EQ(values("4", kD53, 2), "555 0");
  EXPECT_EQ(write("4:int", kD53, {"-70000"}).exit_code, 0);
  EXPECT_EQ(values("4:int", kD53), "-70000");
  EXPECT_EQ(daemon_->errors(), "");
}

TEST_F(Super40ncMbpoll, LearnsWhyARequestIsRefused) {
  for (const auto& [type, address, why] :
       {std::tuple{"3", kD0, "Illegal function"}, std::tuple{"4", kHole, "Illegal data address"},
        std::tuple{"0", 32, "Illegal data address"}, std::tuple{"1", 48, "Illegal data address"}}) {
    const Finished finished = run(command(type, address, {"-1"}));
    EXPECT_EQ(finished.exit_code, 1);
    EXPECT_NE(finished.errors.find(why), std::string::npos) << finished.errors;
  }
}

TEST_F(Super40ncMbpoll, StartsAProgramAndWatchesIt) {
  EXPECT_EQ(write("0", kM8100, {"1"}).exit_code, 0);
  EXPECT_TRUE(eventually([&] { return values("0", kM8100) == "0"; }));
  EXPECT_EQ(values("4:int", kD0), "1");
}

class Super40ncPymodbus : public testing::TestWithParam<const char*> {};

TEST_P(Super40ncPymodbus, IsServed) {
  if (!std::filesystem::exists("/usr/lib/python3/dist-packages/pymodbus")) {
    GTEST_SKIP() << "python3-pymodbus is not installed";
  }
  const auto daemon = serve(3);
  EXPECT_EQ(daemon->ctl({"input", "X3=1"}).exit_code, 0);
  const Finished finished = run({kPython, std::string(TEST_FACTS) + "/hosts/pymodbus_super40nc_host.py",
                                 panel_port(*daemon), pc_port(*daemon), GetParam()});
  EXPECT_EQ(finished.exit_code, 0) << finished.output << finished.errors;
  EXPECT_EQ(daemon->errors(), "");
}
INSTANTIATE_TEST_SUITE_P(Case, Super40ncPymodbus,
                         testing::Values("types", "refusals", "program", "both_ports", "asynchronous"),
                         [](const auto& parameter) { return std::string(parameter.param); });

/// A checksum as in the manual's C++ example, except for its damaged table: the byte tables are computed.
Bytes with_checksum(Bytes frame) {
  std::uint16_t crc = 0xFFFF;
  for (const std::uint8_t byte : frame) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit)
      crc = static_cast<std::uint16_t>(crc & 1 ? crc >> 1 ^ 0xA001 : crc >> 1);
  }
  frame.push_back(static_cast<std::uint8_t>(crc & 0xFF));
  frame.push_back(static_cast<std::uint8_t>(crc >> 8));
  return frame;
}

TEST(Super40ncHosts, TheManualsOwnProgramGetsItsReply) {
  const auto daemon = serve(0);
  // It reads D8340, and prints the two bytes that its checksum gives.
  const Bytes printed = hex("00 03 1E 00 00 02 C3 F2");
  EXPECT_EQ(with_checksum(hex("00 03 1E 00 00 02")), printed);
  EXPECT_EQ(daemon->ctl({"set", "D8340=-123456"}).exit_code, 0);
  const Bytes reply = with_checksum(hex("00 03 04 1D C0 FF FE"));
  for (const std::string& port : {panel_port(*daemon), pc_port(*daemon)}) {
    Host host(port);
    EXPECT_TRUE(host.set_even_parity(B19200));
    for (int time = 0; time < 3; ++time) EXPECT_EQ(exchange(host, printed, reply.size()), reply);
  }
}

/// Everything that the manual prints with a checksum, as a terminal program would send it.
TEST(Super40ncHosts, PrintedFramesAreAnsweredOnPtys) {
  const auto daemon = serve(0);
  Host host(pc_port(*daemon));
  EXPECT_TRUE(host.set_even_parity(B19200));
  std::ifstream facts(std::string(PROJECT_FOLDER) + "/tests/emulator/models/super_40nc/printed_frames.csv");
  int answered = 0;
  int silent = 0;
  for (std::string line; std::getline(facts, line);) {
    std::istringstream row(line);
    std::string direction;
    std::string frame;
    std::string checksum;
    std::getline(row, direction, ',');
    std::getline(row, frame, ',');
    std::getline(row, checksum, ',');
    if (checksum != "yes" && checksum != "no") continue;
    const Bytes bytes = hex(frame);
    host.write(bytes);
    if (checksum == "no") {
      EXPECT_TRUE(is_silent(host));
      ++silent;
    } else if (bytes[1] == 3) {
      EXPECT_EQ(host.read(9).size(), 9U) << frame;
      ++answered;
    } else {
      EXPECT_EQ(host.read(bytes.size()), bytes) << frame;  // an echo
      ++answered;
    }
  }
  EXPECT_EQ(answered, 33);
  EXPECT_EQ(silent, 1);
  EXPECT_EQ(daemon->ctl({"get", "D8098", "D8097"}).output, "D8098 1\nD8097 0\n");
}

TEST(Super40ncHosts, TsharkNamesTheFunctions) {
  if (run({"tshark", "--version"}).exit_code != 0) GTEST_SKIP() << "tshark is not installed";
  const PrivateFolder folder;
  const auto daemon = serve(4, {"--capture", folder / "a.pcapng"});
  {
    ModbusHost panel(panel_port(*daemon), {.station = 4});
    ModbusHost pc(pc_port(*daemon), {.station = 4});
    EXPECT_EQ(panel.read_coils(kM0, 9).size(), 9U);
    EXPECT_EQ(panel.read_inputs(0, 24).size(), 24U);
    EXPECT_TRUE(pc.write_bit(kM8000, true));
    EXPECT_TRUE(pc.write_coils(kM0, Bits{1, 1, 0}));
    EXPECT_TRUE(panel.read_coils(32).empty());
  }
  EXPECT_EQ(daemon->stop(SIGTERM), 0);
  const Finished decoded =
      run({"tshark", "-r", folder / "a.pcapng", "-o", "mbrtu.tcp.port:19200", "-T", "fields", "-E",
           "separator=|", "-e", "frame.interface_name", "-e", "_ws.col.Info"});
  const std::string panel = "rs232 (mill RS232)|";
  const std::string pc = "rs485 (mill RS485)|";
  const std::string asks = "   Query: Unit:   4, Func: ";
  const std::string says = "Response: Unit:   4, Func: ";
  std::string expected;
  for (const auto& [port, function] :
       {std::pair{panel, "  1: Read Coils"}, std::pair{panel, "  2: Read Discrete Inputs"},
        std::pair{pc, "  5: Write Single Coil"}, std::pair{pc, " 15: Write Multiple Coils"}}) {
    expected += port + asks + function + "\n" + port + says + function + "\n";
  }
  expected += panel + asks + "  1: Read Coils\n" + panel + says + "  1: Read Coils. Exception returned \n";
  EXPECT_EQ(decoded.output, expected) << decoded.errors;
}

/// A panel on RS232 reads without pause what a PC writes over RS485: whole blocks of equal words and equal
/// bits, and a parameter whose halves are equal. Neither sees half of anything, nor the other's replies.
TEST(Super40ncHosts, APanelPollsWhileAPcWrites) {
  constexpr int kRounds = 1000;
  constexpr int kStarts = 12;
  constexpr int kWords = 80;    // D100 to D139
  constexpr int kCoils = 40;    // M100 to M139
  constexpr int kD9185 = 9370;  // the soft limit of X, which takes effect at once
  const auto daemon = serve(0, {}, "instant");
  ModbusHost pc(pc_port(*daemon), {.station = 0, .patience = std::chrono::seconds(5)});
  // The limit is at least 6,553,700. It is set before the panel reads, because its factory halves differ.
  const std::uint16_t first = 100;
  EXPECT_TRUE(pc.write(kD9185, Registers{first, first}));
  int requests = 1;
  std::atomic<bool> done{false};
  int polls = 0;
  int torn = 0;
  int failed = 0;
  int values_seen = 0;
  std::thread panel([&] {
    ModbusHost host(panel_port(*daemon), {.station = 0, .patience = std::chrono::seconds(5)});
    int last = -1;
    while (!done || polls < 20) {
      const Registers words = host.read(kD0 + 200, kWords);
      const Bits bits = host.read_coils(kM0 + 100, kCoils);
      const Registers limit = host.read(kD9185, 2);
      polls += 3;
      if (words.empty() || bits.empty() || limit.empty()) {
        ++failed;
        continue;
      }
      const auto are_equal = [](const auto& all) {
        return std::all_of(all.begin(), all.end(), [&](auto each) { return each == all[0]; });
      };
      if (!are_equal(words) || !are_equal(bits) || !are_equal(limit)) ++torn;
      if (words[0] != last) ++values_seen;
      last = words[0];
    }
  });
  int starts = 0;
  bool runs = false;
  for (int round = 0; round < kRounds || starts < kStarts; ++round) {
    const auto number = static_cast<std::uint16_t>(first + round % 50);
    EXPECT_TRUE(pc.write(kD0 + 200, Registers(kWords, number)));
    EXPECT_TRUE(pc.write_coils(kM0 + 100, Bits(kCoils, static_cast<std::uint8_t>(round % 2))));
    EXPECT_TRUE(pc.write(kD9185, Registers{number, number}));
    runs = pc.read_coils(kM8100) == Bits{1};
    requests += 4;
    if (runs) continue;
    EXPECT_TRUE(pc.write_bit(kM8100, true));
    ++requests;
    ++starts;
  }
  EXPECT_TRUE(eventually([&] {
    ++requests;
    return pc.read_coils(kM8100) == Bits{0};
  }));
  EXPECT_EQ(pc.read_long(kD0), starts);
  ++requests;
  done = true;
  panel.join();
  EXPECT_EQ(torn, 0);
  EXPECT_EQ(failed, 0);
  EXPECT_GT(values_seen, 10);
  const std::string status = daemon->ctl({"status"}).output;
  for (const auto& [line, count] : {std::pair{"rs232", polls}, std::pair{"rs485", requests}}) {
    const std::size_t at = status.find(std::string("line ") + line);
    ASSERT_NE(at, std::string::npos) << status;
    const std::string number = std::to_string(count);
    const std::string counted = ": " + number + " requests, " + number + " replies, 0 of them exceptions";
    const std::string its = status.substr(at, status.find("\nline", at + 1) - at);
    EXPECT_NE(its.find(counted), std::string::npos) << counted << "\n" << status;
  }
  EXPECT_EQ(daemon->ctl({"get", "D8097", "D8098"}).output, "D8097 0\nD8098 0\n");
}

}  // namespace super40nc_hosts_test
}  // namespace understudy::acceptance
