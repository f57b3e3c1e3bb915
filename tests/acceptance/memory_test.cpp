// Non-volatile memory, power, programs and DIP switches of a served daemon.
#include <gtest/gtest.h>
#include <signal.h>

#include <fstream>
#include <iterator>

#include "tests/acceptance/modbus_host.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace memory_test {

namespace fs = std::filesystem;

constexpr int kEepromWriting = 0x000F;
constexpr int kParmsSpeed1 = 0x2002;
constexpr int kMem0 = 0x8000;
constexpr int kLine0 = 0x4000;
constexpr int kOutputs = 0x0DF0;

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

bool eeprom_rests(ModbusHost& host) {
  return eventually([&] { return host.read(kEepromWriting) == Registers{0}; });
}

std::string value(const RunningUnderstudy& daemon, const std::string& name) {
  const Finished got = daemon.ctl({"get", name});
  EXPECT_EQ(got.exit_code, 0) << got.errors;
  return got.output.substr(got.output.find(' ') + 1);
}

void expect_done(const RunningUnderstudy& daemon, const Words& words) {
  const Finished finished = daemon.ctl(words);
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  EXPECT_EQ(finished.errors, "");
}

/// Expects a refusal with one line that contains `why`.
void expect_refused(const Finished& finished, const std::string& why) {
  EXPECT_EQ(finished.exit_code, 2) << finished.output << finished.errors;
  EXPECT_EQ(finished.output, "");
  EXPECT_EQ(lines_of(finished.errors).size(), 1U) << finished.errors;
  EXPECT_NE(finished.errors.find(why), std::string::npos) << finished.errors;
  EXPECT_NE(finished.errors.find("; "), std::string::npos) << finished.errors;
}

/// Runs `serve`, which must not start.
Finished serve(Words words) {
  words.insert(words.begin(), "serve");
  return understudy(words);
}

std::string image(const std::string& registers) {
  return R"({"understudy": 1, "kind": "nv-image", "model": "simple2-r3", "firmware": "1.52", "registers": )" +
         registers + "}\n";
}

std::string bench_of(const std::string& feeder, const std::string& line = "") {
  return "understudy: 1\n"
         "lines:\n"
         "  line:\n"
         "    link: ./port\n"
         "    timing: instant\n" +
         line +
         "    stations:\n"
         "      - { name: feeder, model: simple2-r3" +
         feeder + " }\n";
}

// --- over restarts
// ------------------------------------------------------------------------------------------

TEST(Memory, OutlivesTheDaemonHoweverItIsAskedToEnd) {
  const PrivateFolder kept;
  const std::string nv = kept / "nv";
  int number = 0;
  for (const int signal_number : {SIGTERM, SIGINT, SIGHUP}) {
    ++number;
    RunningUnderstudy daemon({"--nv", nv, "--timing", "instant"});
    {
      ModbusHost host(daemon.port());
      EXPECT_EQ(host.read(kParmsSpeed1), Registers{static_cast<std::uint16_t>(number - 1)});
      EXPECT_EQ(host.read_long(kMem0), -1000 * (number - 1));
      EXPECT_EQ(host.read(kLine0), Registers{static_cast<std::uint16_t>(number - 1)});
      EXPECT_EQ(host.read(kAaxisSpeed), Registers{0}) << "not a persistent one";
      EXPECT_TRUE(host.write(kAaxisSpeed, 200));
      EXPECT_TRUE(host.write(kParmsSpeed1, number));
      const auto bits = static_cast<std::uint32_t>(-1000 * number);
      EXPECT_TRUE(host.write(
          kMem0, Registers{static_cast<std::uint16_t>(bits), static_cast<std::uint16_t>(bits >> 16)}));
      EXPECT_TRUE(host.write(kLine0, number));
      EXPECT_TRUE(eeprom_rests(host));
    }
    EXPECT_EQ(daemon.stop(signal_number), 0) << daemon.errors();
    EXPECT_EQ(daemon.errors(), "");
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(nv), fs::directory_iterator()), 1);
  EXPECT_NE(text_of(nv + "/device.json").find("\"Parms_Speed1\": 3,"), std::string::npos);
}

TEST(Memory, IsOnTheDiskSoonAfterTheEepromHasItAlsoWithoutAnEnd) {
  const PrivateFolder kept;
  const RunningUnderstudy daemon({"--nv", kept.path(), "--timing", "instant"});
  ModbusHost host(daemon.port());
  EXPECT_TRUE(host.write(kParmsSpeed1, 777));
  EXPECT_TRUE(eventually(
      [&] { return text_of(kept / "device.json").find("\"Parms_Speed1\": 777") != std::string::npos; }));
}

TEST(Memory, DoesNotHoldWhatStillWaitedWhenTheDaemonEnded) {
  // The clock is stopped, so the EEPROM never stores it, and the end of the emulator is a power cut.
  const PrivateFolder kept;
  {
    RunningUnderstudy daemon({"--nv", kept.path(), "--timing", "instant", "--speed", "manual"});
    expect_done(daemon, {"set", "Parms_Speed1=5"});
    expect_done(daemon, {"advance", "6ms"});
    expect_done(daemon, {"set", "Parms_Speed2=6"});
    expect_done(daemon, {"advance", "5ms"});  // one too few
    EXPECT_EQ(value(daemon, "EEPROM_Writing"), "1\n");
    EXPECT_EQ(daemon.stop(SIGTERM), 0);
  }
  const RunningUnderstudy daemon({"--nv", kept.path()});
  EXPECT_EQ(value(daemon, "Parms_Speed1"), "5\n");
  EXPECT_EQ(value(daemon, "Parms_Speed2"), "0\n");
}

TEST(Memory, WithoutAFolderLastsAsLongAsTheRun) {
  for (int i = 0; i < 2; ++i) {
    const RunningUnderstudy daemon({"--timing", "instant"});
    EXPECT_EQ(value(daemon, "Parms_Speed1"), "0\n");
    expect_done(daemon, {"set", "Parms_Speed1=5"});
    EXPECT_TRUE(eventually([&] { return value(daemon, "EEPROM_Writing") == "0\n"; }));
    expect_done(daemon, {"power", "cycle"});
    EXPECT_EQ(value(daemon, "Parms_Speed1"), "5\n");
  }
}

TEST(Memory, OfABenchIsWhereItSaysRelativeToTheBench) {
  const std::string bench = bench_of(", nv: ./mine.json");
  const auto daemon = RunningUnderstudy::of_bench(bench);
  const std::string path = daemon->folder() / "mine.json";
  expect_done(*daemon, {"set", "PROG_MEM31=-5"});
  EXPECT_TRUE(eventually([&] { return text_of(path).find("\"PROG_MEM31\": -5") != std::string::npos; }));
}

TEST(Memory, ThatCannotBeWrittenIsReportedWhileDevicesContinue) {
  const auto daemon = RunningUnderstudy::of_bench(bench_of(", nv: ./gone/mine.json"));
  EXPECT_TRUE(eventually([&] { return daemon->errors().find("cannot be written") != std::string::npos; }));
  EXPECT_EQ(lines_of(daemon->errors()).size(), 1U) << daemon->errors();
  EXPECT_NE(daemon->errors().find("gone/mine.json"), std::string::npos) << daemon->errors();
  EXPECT_EQ(value(*daemon, "HW_Code"), "49153\n");
}

// --- files that are refused
// -------------------------------------------------------------------------------------

TEST(Memory, OfAnotherKindIsRefusedAndLeftAlone) {
  const std::string whole = image("{\"Parms_Speed1\": 5}");
  const std::pair<std::string, const char*> cases[] = {
      {whole.substr(0, whole.size() - 3), "device.json:1: is damaged or not JSON; expected an NV image"},
      {"", "device.json:1: is damaged or not JSON"},
      {"understudy: 1\n", "device.json:1: is damaged or not JSON"},
      {"{\"somebody\": \"else's\"}", "device.json: understudy: is missing; expected an NV image"},
      {image("{\"Parms_Speed99\": 5}"), "'Parms_Speed99'"},
      {image("{\"Parms_Speed1\": 99999}"), "'Parms_Speed1': 99999 does not fit; expected 0 to 32768"},
      {image("{\"Parms_Speed1\": 1e999}"), "a number is too large"},
  };
  for (const auto& [text, why] : cases) {
    const PrivateFolder folder;
    const std::string path = folder.write("device.json", text);
    const std::string link = folder / "port";
    expect_refused(serve({"--model", "simple2-r3", "--link", link, "--nv", folder.path()}), why);
    EXPECT_EQ(text_of(path), text);
    EXPECT_FALSE(fs::exists(fs::symlink_status(link))) << "nothing was started";
    EXPECT_FALSE(fs::exists(path + ".new"));
  }
}

TEST(Memory, OfTwoDevicesInOneFileIsRefused) {
  const PrivateFolder folder;
  const std::string two =
      "understudy: 1\nlines:\n  line:\n    stations:\n"
      "      - { name: feeder, model: simple2-r3, address: 1, nv: one.json }\n"
      "      - { name: turner, model: simple2-r3, address: 2, nv: ./one.json }\n";
  expect_refused(serve({folder.write("two.yaml", two)}), "device 'feeder' has the same file");
  const std::string by_folder =
      "understudy: 1\nlines:\n  line:\n    stations:\n"
      "      - { name: feeder, model: simple2-r3, address: 1 }\n"
      "      - { name: turner, model: simple2-r3, address: 2, nv: nv/feeder.json }\n";
  expect_refused(serve({folder.write("by_folder.yaml", by_folder), "--nv", folder / "nv"}),
                 "is the memory of 'feeder' and of 'turner'; expected a file for each");
}

TEST(Memory, InAFolderThatCannotBeIsRefused) {
  const PrivateFolder folder;
  const std::string file = folder.write("file", "");
  const Finished finished = serve({"--model", "simple2-r3", "--nv", file + "/nv"});
  EXPECT_EQ(finished.exit_code, 3) << finished.errors;
  EXPECT_EQ(lines_of(finished.errors).size(), 1U) << finished.errors;
  EXPECT_NE(finished.errors.find(file), std::string::npos) << finished.errors;
}

// --- power
// ------------------------------------------------------------------------------------------------------

TEST(Power, CycledKeepsWhatIsKeptAndForgetsTheRest) {
  const RunningUnderstudy daemon({"--timing", "instant"});
  ModbusHost host(daemon.port());
  EXPECT_TRUE(host.write(kParmsSpeed1, 55));
  EXPECT_TRUE(host.write(kAaxisSpeed, 66));
  EXPECT_TRUE(host.write(kAaxisSvon, 1));
  EXPECT_TRUE(eeprom_rests(host));
  expect_done(daemon, {"power", "device", "cycle"});
  EXPECT_EQ(host.read(kParmsSpeed1), Registers{55});
  EXPECT_EQ(host.read(kAaxisSpeed), Registers{0});
  EXPECT_EQ(host.read(kStatus), Registers{0});
}

TEST(Power, OffSilencesTheLineAndTheSocketSaysSoClearly) {
  const RunningUnderstudy daemon({"--timing", "instant"});
  ModbusHost host(daemon.port(), {.patience = Wait(200)});
  expect_done(daemon, {"power", "off"});
  EXPECT_TRUE(host.read(kHardwareCode).empty());
  EXPECT_EQ(host.error(), ETIMEDOUT);
  for (const Words& words :
       {Words{"get", "HW_Code"}, Words{"set", "Aaxis_Speed=1"}, Words{"program", "device"}}) {
    expect_refused(daemon.ctl(words), "device has no power; expected it to be on");
  }
  EXPECT_NE(daemon.ctl({"status"}).output.find("no power"), std::string::npos);
  expect_done(daemon, {"power", "off"});
  expect_done(daemon, {"power", "on"});
  EXPECT_EQ(host.read(kHardwareCode), Registers{0xC001});
  expect_done(daemon, {"power", "on"});
  expect_refused(daemon.ctl({"power", "device", "dim"}), "'dim' is unknown; expected on, off or cycle");
  expect_refused(daemon.ctl({"power", "devise", "off"}), "'device'");
}

// --- programs
// ---------------------------------------------------------------------------------------------------

const char* const kListing =
    "        SVON_A\n"
    "JMP1:   VAR_Inc MEM0\n"
    "        Out DOUT_3 ON\n"
    "        Delay_mSec 300\n"
    "        VAR_DirectGT MEM0 -5\n"
    "        Jump JMP1\n"
    "        END\n";

TEST(Program, IsLoadedAndPrintedBackAsItWas) {
  const PrivateFolder folder;
  const RunningUnderstudy daemon({"--timing", "instant"});
  expect_done(daemon, {"program", "device", folder.write("count.lst", kListing)});
  const Finished printed = daemon.ctl({"program", "device"});
  EXPECT_EQ(printed.exit_code, 0) << printed.errors;
  EXPECT_EQ(printed.output, kListing);
  // The printed text, assembled, is what the wire reads.
  const std::string cells = understudy({"asm", folder.write("again.lst", printed.output)}).output;
  ModbusHost host(daemon.port());
  std::string read;
  for (int line = 0; line < 7; ++line) {
    const Registers words = host.read(kLine0 + 4 * line, 4);
    ASSERT_EQ(words.size(), 4U);
    for (int i = 0; i < 4; ++i)
      read += std::to_string(words[static_cast<std::size_t>(i)]) + (i < 3 ? " " : "\n");
  }
  EXPECT_EQ(read, cells);
  // And it runs.
  EXPECT_TRUE(host.write(0x3000, 0));
  EXPECT_TRUE(eventually([&] { return host.read(kOutputs) == Registers{1 << 3}; }));
}

TEST(Program, ThatIsWrongIsRefusedWithItsLineAndChangesNothing) {
  const PrivateFolder folder;
  const RunningUnderstudy daemon({"--timing", "instant"});
  expect_done(daemon, {"program", "device", folder.write("good.lst", kListing)});
  struct Case {
    const char* name;
    std::string listing;
    const char* why;
  };
  std::string too_long;
  for (int i = 0; i < 257; ++i) too_long += "NOP\n";
  const Case cases[] = {
      {"unknown.lst", "NOP\nNOP\nJumpp JMP1\n",
       "unknown.lst:3:1: mnemonic: no instruction is called 'Jumpp'"},
      {"operand.lst", "NOP\nOut DOUT_9 ON\n", "operand.lst:2:5: operand 1: "},
      {"long.lst", too_long, "long.lst:257:1: "},
      {"binary.lst", std::string("NOP\n\x01\x02\xff\xfe\n"), "binary.lst:2:1: "},
  };
  for (const Case& c : cases) {
    expect_refused(daemon.ctl({"program", "device", folder.write(c.name, c.listing)}), c.why);
    EXPECT_EQ(daemon.ctl({"program", "device"}).output, kListing) << c.name;
  }
  expect_refused(daemon.ctl({"program", "device", folder / "missing.lst"}), "missing.lst: cannot be read");
  expect_refused(daemon.ctl({"program", "nobody", folder / "good.lst"}), "nobody");
  EXPECT_EQ(daemon.ctl({"program", "device"}).output, kListing);
}

TEST(Program, OutlivesTheRestart) {
  const PrivateFolder kept;
  const std::string listing = kept.write("count.lst", kListing);
  for (const bool again : {false, true}) {
    const RunningUnderstudy daemon({"--nv", kept / "nv", "--timing", "instant", "--speed", "100x"});
    if (!again) expect_done(daemon, {"program", "device", listing});
    EXPECT_EQ(daemon.ctl({"program", "device"}).output, kListing);
    EXPECT_TRUE(eventually([&] { return value(daemon, "EEPROM_Writing") == "0\n"; }));
  }
}

TEST(Program, OfABenchStartsByItselfAtEachPowerUp) {
  const PrivateFolder elsewhere;
  const auto daemon = RunningUnderstudy::of_bench(
      bench_of(", program: " + elsewhere.write("count.lst", kListing) + ", set: { AutoStart_MainProg: 1 }"));
  ModbusHost host(daemon->port());
  EXPECT_TRUE(eventually([&] { return host.read(kOutputs) == Registers{1 << 3}; }));
  EXPECT_TRUE(eventually([&] { return host.read_long(kMem0) >= 3; }));
  expect_done(*daemon, {"power", "cycle"});
  EXPECT_TRUE(eventually([&] { return host.read(kOutputs) == Registers{1 << 3}; }));
  const std::int32_t counted = host.read_long(kMem0);
  EXPECT_GE(counted, 3) << "MEM survives power-off";
  EXPECT_TRUE(eventually([&] { return host.read_long(kMem0) > counted; }));
}

TEST(Program, OfABenchThatIsWrongIsRefusedWithItsFileAndLine) {
  const PrivateFolder folder;
  folder.write("bad.lst", "NOP\nNOP\nJumpp JMP1\n");
  const std::string path = folder.write("bench.yaml", bench_of(", program: bad.lst"));
  for (const char* command : {"serve", "check"}) {
    const Finished finished = understudy({command, path});
    expect_refused(finished, "bad.lst:3:1: mnemonic: no instruction is called 'Jumpp'");
  }
  expect_refused(serve({folder.write("none.yaml", bench_of(", program: none.lst"))}),
                 "none.lst cannot be read");
}

// --- DIP switches
// -------------------------------------------------------------------------------------------------

TEST(DipSwitch, OneSetsTheSpeedOfTheLine) {
  const auto daemon = RunningUnderstudy::of_bench(bench_of(", dip: { DIP1: on }"));
  EXPECT_EQ(ModbusHost(daemon->port(), {.baud = 115200}).read(kHardwareCode), Registers{0xC001});
  ModbusHost deaf(daemon->port(), {.baud = 19200, .patience = Wait(200)});
  EXPECT_TRUE(deaf.read(kHardwareCode).empty());
}

TEST(DipSwitch, AgreesWithTheBaudOrTheBenchIsRefused) {
  for (const auto& [dip, baud, agree] : {std::tuple{"on", 115200, true}, std::tuple{"off", 19200, true},
                                         std::tuple{"on", 19200, false}, std::tuple{"off", 115200, false}}) {
    const PrivateFolder folder;
    const std::string path = folder.write("bench.yaml", bench_of(std::string(", dip: { DIP1: ") + dip + " }",
                                                                 "    baud: " + std::to_string(baud) + "\n"));
    const Finished finished = understudy({"check", path});
    if (agree) {
      EXPECT_EQ(finished.exit_code, 0) << finished.errors;
    } else {
      expect_refused(finished, "lines.line.stations[0].dip: ");
      const std::string switches = std::string(dip) == "on" ? "115200" : "19200";
      EXPECT_NE(finished.errors.find("the switches select " + switches + " baud, but the line has " +
                                     std::to_string(baud)),
                std::string::npos)
          << finished.errors;
    }
  }
}

TEST(DipSwitch, ThatTheModelDoesNotHaveIsRefused) {
  const PrivateFolder folder;
  expect_refused(serve({folder.write("bench.yaml", bench_of(", dip: { DIP3: on }"))}),
                 "'DIP3' is not a switch of simple2-r3; the nearest is 'DIP");
  expect_refused(serve({folder.write("level.yaml", bench_of(", dip: { DIP1: upwards }"))}),
                 "level.yaml:7:57: ");
}

TEST(DipSwitch, ChangedWhileItRunsCountsAtTheNextPowerUp) {
  const auto daemon = RunningUnderstudy::of_bench(bench_of(""));
  expect_done(*daemon, {"input", "DIP1=on", "DIP2=on"});
  EXPECT_EQ(ModbusHost(daemon->port()).read(kHardwareCode), Registers{0xC001});
  EXPECT_NE(daemon->ctl({"status"}).output.find("CW/CCW"), std::string::npos);
  expect_done(*daemon, {"power", "cycle"});
  EXPECT_EQ(ModbusHost(daemon->port(), {.baud = 115200}).read(kHardwareCode), Registers{0xC001});
  EXPECT_NE(daemon->ctl({"status"}).output.find("PLS/DIR"), std::string::npos);
}

TEST(Memory, OfTwoDaemonsIsNotOneFile) {
  const PrivateFolder folder;
  const std::string nv = folder / "nv";
  {
    const RunningUnderstudy first({"--nv", nv});
    const Finished refused = serve({"--model", "simple2-r3", "--nv", nv, "--control", folder / "control"});
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_EQ(refused.errors, "understudy: " + nv +
                                  "/device.json: nv: another running understudy uses this memory; expected a "
                                  "separate file, or a separate folder with --nv, for each\n");
  }
  const RunningUnderstudy next({"--nv", nv});
  EXPECT_EQ(value(next, "HW_Code"), "49153\n");
}

}  // namespace memory_test
}  // namespace understudy::acceptance
