// `understudy ctl` changes a running daemon: faults, power, programs, inputs.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/acceptance/modbus_host.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace faults_control_test {

using Json = nlohmann::json;

constexpr int kAdcA = 0xFF00;

/// Expects success, and returns what it printed.
std::string obeyed(const RunningUnderstudy& daemon, const Words& words) {
  const Finished finished = daemon.ctl(words);
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  EXPECT_EQ(finished.errors, "");
  return finished.output;
}

Json json(const RunningUnderstudy& daemon, Words words) {
  words.insert(words.begin(), "--json");
  return Json::parse(obeyed(daemon, words));
}

/// Expects a refusal with exactly this line.
void expect_refused(const RunningUnderstudy& daemon, const Words& words, const std::string& line) {
  const Finished finished = daemon.ctl(words);
  EXPECT_EQ(finished.exit_code, 2) << line;
  EXPECT_EQ(finished.output, "") << line;
  EXPECT_EQ(finished.errors, "understudy: ctl " + line + "\n");
}

const std::string kTwoDevices =
    "understudy: 1\n"
    "lines:\n"
    "  line:\n"
    "    link: ./port\n"
    "    stations:\n"
    "      - { name: feeder, model: simple2-r3, address: 1 }\n"
    "      - { name: turner, model: simple2-r3, address: 2 }\n"
    "plant: { feeder.A: { drive: { ready_after: 10ms } } }\n";

TEST(ControlFaults, AreInjectedListedAndCleared) {
  const RunningUnderstudy daemon({"--speed", "manual"});
  EXPECT_EQ(obeyed(daemon, {"list"}), "");
  EXPECT_EQ(obeyed(daemon, {"inject", "lost_steps", "A", "one_in=50"}), "fault 1\n");
  EXPECT_EQ(obeyed(daemon, {"inject", "stuck", "device.DIN_2", "level=1"}), "fault 2\n");
  EXPECT_EQ(obeyed(daemon, {"inject", "slip", "B", "pulses=-200"}), "fault 3\n");
  EXPECT_EQ(json(daemon, {"inject", "stall", "device.B"}), (Json{{"ok", true}, {"number", 4}}));
  EXPECT_EQ(obeyed(daemon, {"list"}),
            "1 lost_steps device.A one_in=50\n2 stuck device.DIN_2 level=1\n4 stall device.B\n");
  EXPECT_EQ(json(daemon, {"list"})["faults"][1],
            (Json{{"number", 2}, {"fault", "stuck device.DIN_2 level=1"}}));

  // 1000 pulses: 20 of them are lost.
  obeyed(daemon, {"set", "Aaxis_SVON=1", "Aaxis_Pulse=1000", "Aaxis_Speed=60", "Aaxis_Move_INC=1"});
  obeyed(daemon, {"advance", "1s"});
  EXPECT_EQ(obeyed(daemon, {"get", "Cord_A", "DIN_2"}), "Cord_A 1000\nDIN_2 1\n");
  const std::string status = obeyed(daemon, {"status"});
  EXPECT_NE(status.find("  machine A: at 980 pulses, 20 lost\n"), std::string::npos) << status;
  EXPECT_NE(status.find("  machine B: at -200 pulses, 0 lost\n"), std::string::npos) << status;

  EXPECT_EQ(obeyed(daemon, {"clear", "2"}), "");
  obeyed(daemon, {"advance", "1ms"});
  EXPECT_EQ(obeyed(daemon, {"get", "DIN_2"}), "DIN_2 0\n");
  EXPECT_EQ(obeyed(daemon, {"clear", "all"}), "");
  EXPECT_EQ(obeyed(daemon, {"list"}), "");
  EXPECT_EQ(json(daemon, {"clear", "all"}), (Json{{"ok", true}}));
}

TEST(ControlFaults, ThatAreWrongAreRefusedWithOneLine) {
  const RunningUnderstudy daemon({"--speed", "manual"});
  expect_refused(daemon, {"inject", "jam", "A"},
                 "inject: 'jam' is not a fault; expected one such as 'stall'");
  expect_refused(daemon, {"inject", "stall", "C"},
                 "inject: no axis of device is called 'C'; expected one of A, B");
  expect_refused(daemon, {"inject", "lost_steps", "A"},
                 "inject: lost_steps: one_in is missing; expected 1 to 1000000000000");
  expect_refused(daemon, {"inject", "lost_steps", "A", "one_in=0"},
                 "inject: lost_steps: one_in: 0 is out of range; expected 1 to 1000000000000");
  expect_refused(daemon, {"inject", "stuck", "DIN_2", "level=2"},
                 "inject: stuck: level: 2 is out of range; expected 0 to 1");
  expect_refused(daemon, {"inject", "stuck", "DIN_2", "level"},
                 "inject: 'level' is not understood; expected NAME=VALUE");
  expect_refused(daemon, {"inject", "stuck", "AIN_A", "level=1"},
                 "inject: 'AIN_A' cannot be stuck; expected a digital input");
  expect_refused(daemon, {"inject", "stall"}, "inject: expected a fault and its place");
  expect_refused(daemon, {"inject"}, "inject: expected a fault and its place");
  expect_refused(daemon, {"clear"}, "clear: expected the number of a fault, or all");
  expect_refused(daemon, {"clear", "1", "2"}, "clear: expected the number of a fault, or all");
  expect_refused(daemon, {"clear", "one"},
                 "clear: 'one' is not understood; expected the number of a fault, or all");
  expect_refused(
      daemon, {"clear", "1"},
      "clear: number: 1 is not a fault in force; expected no number, because no fault is in force");
  EXPECT_EQ(daemon.ctl({"list", "all"}).errors,
            "understudy: ctl list: 'all' is one argument too many; expected nothing more\n");
  EXPECT_EQ(obeyed(daemon, {"list"}), "");

  const Finished refused = daemon.ctl({"--json", "inject", "jam", "A"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(Json::parse(refused.output)["ok"], false) << refused.output;
  EXPECT_EQ(refused.errors, "");
}

TEST(ControlPower, OffSilencesAStationOnTheWireAndOnBringsItBack) {
  const auto daemon = RunningUnderstudy::of_bench(kTwoDevices);
  ModbusHost host(daemon->port());
  EXPECT_EQ(host.read(kHardwareCode), Registers{0xC001});
  EXPECT_TRUE(host.write(kAaxisSpeed, 200));

  EXPECT_EQ(obeyed(*daemon, {"power", "feeder", "off"}), "");
  host.set_patience(std::chrono::milliseconds(300));
  EXPECT_TRUE(host.read(kHardwareCode).empty());
  EXPECT_EQ(host.error(), ETIMEDOUT);
  EXPECT_FALSE(host.write(kAaxisSpeed, 100));
  EXPECT_EQ(host.error(), ETIMEDOUT);
  host.set_station(2);
  host.set_patience(kPatience);
  EXPECT_EQ(host.read(kHardwareCode), Registers{0xC001}) << "the other station on the line continues";

  const std::string why = "feeder has no power; expected it to be on";
  expect_refused(*daemon, {"get", "feeder.Cord_A"}, "get: " + why);
  expect_refused(*daemon, {"get", "turner.Cord_A", "feeder.Cord_A"}, "get: " + why);
  expect_refused(*daemon, {"set", "turner.Aaxis_Speed=1", "feeder.Aaxis_Speed=5"}, "set: " + why);
  expect_refused(*daemon, {"program", "feeder"}, "program: " + why);
  EXPECT_EQ(obeyed(*daemon, {"get", "turner.Aaxis_Speed"}), "turner.Aaxis_Speed 0\n");
  const std::string status = obeyed(*daemon, {"status"});
  EXPECT_NE(status.find("device feeder: simple2-r3, firmware 1.52, pulses CW/CCW, no power\n"),
            std::string::npos)
      << status;
  EXPECT_NE(status.find("device turner: simple2-r3, firmware 1.52, pulses CW/CCW\n"), std::string::npos)
      << status;
  EXPECT_NE(status.find(", drive off\n"), std::string::npos) << status;
  EXPECT_EQ(json(*daemon, {"status"})["status"]["devices"][0]["power"], "off");

  EXPECT_EQ(obeyed(*daemon, {"power", "feeder", "on"}), "");
  host.set_station(1);
  EXPECT_EQ(host.read(kHardwareCode), Registers{0xC001});
  EXPECT_EQ(host.read(kAaxisSpeed), Registers{0}) << "lost at power-off";

  EXPECT_TRUE(host.write(kAaxisSpeed, 200));
  EXPECT_EQ(json(*daemon, {"power", "feeder", "cycle"}), (Json{{"ok", true}}));
  EXPECT_EQ(host.read(kAaxisSpeed), Registers{0});
}

TEST(ControlPower, ThatIsWrongIsRefusedWithOneLine) {
  const auto daemon = RunningUnderstudy::of_bench(kTwoDevices);
  expect_refused(*daemon, {"power"}, "power: expected a device, and on, off or cycle");
  expect_refused(*daemon, {"power", "feeder", "off", "now"},
                 "power: expected a device, and on, off or cycle");
  expect_refused(*daemon, {"power", "feeder", "down"},
                 "power: to: 'down' is unknown; expected on, off or cycle");
  expect_refused(*daemon, {"power", "feedr", "off"},
                 "power: no device is called 'feedr'; the nearest is 'feeder'");
  expect_refused(*daemon, {"power", "off"}, "power: the device is missing; expected one of feeder, turner");
  EXPECT_EQ(obeyed(*daemon, {"get", "feeder.HW_Code"}), "feeder.HW_Code 49153\n");
}

TEST(ControlProgram, LoadsAListingRunsItAndPrintsIt) {
  const RunningUnderstudy daemon({"--speed", "manual"});
  const std::string file =
      daemon.folder().write("blink.lst", "  Out DOUT_3 ON\n  Delay_mSec 100\n  Out DOUT_3 OFF\n");
  EXPECT_EQ(obeyed(daemon, {"program", "device", file}), "");
  const std::string text = obeyed(daemon, {"program"});
  for (const char* line : {"Out DOUT_3 ON", "Delay_mSec 100", "Out DOUT_3 OFF"})
    EXPECT_NE(text.find(line), std::string::npos) << text;
  EXPECT_EQ(json(daemon, {"program", "device"})["text"], text);
  // Its output can be loaded, and is the same program.
  EXPECT_EQ(obeyed(daemon, {"program", "device", daemon.folder().write("again.lst", text)}), "");
  EXPECT_EQ(obeyed(daemon, {"program"}), text);

  obeyed(daemon, {"set", "PROG_MAIN_RunTime_START=0"});
  obeyed(daemon, {"advance", "50ms"});
  EXPECT_EQ(obeyed(daemon, {"get", "DOUT_3"}), "DOUT_3 1\n");
  obeyed(daemon, {"advance", "100ms"});
  EXPECT_EQ(obeyed(daemon, {"get", "DOUT_3"}), "DOUT_3 0\n");
}

TEST(ControlProgram, ThatIsWrongIsRefusedWithOneLineAndTheOldOneStays) {
  const RunningUnderstudy daemon({"--speed", "manual"});
  const std::string good = daemon.folder().write("good.lst", "Delay_mSec 7\n");
  const std::string bad = daemon.folder().write("bad.lst", "Delay_mSec 8\nDellay_mSec 5\nJump\n");
  obeyed(daemon, {"program", "device", good});
  const std::string before = obeyed(daemon, {"program"});
  expect_refused(daemon, {"program", "device", bad},
                 "program: " + bad +
                     ":2:1: mnemonic: no instruction is called 'Dellay_mSec'; expected an "
                     "instruction (nearest: 'Delay_mSec') (and 1 more)");
  const std::string nowhere = daemon.folder() / "nowhere.lst";
  expect_refused(daemon, {"program", "device", nowhere},
                 "program: " + nowhere + ": cannot be read (No such file or directory); expected a listing");
  expect_refused(daemon, {"program", "devise", good},
                 "program: no device is called 'devise'; the nearest is 'device'");
  expect_refused(daemon, {"program", "device", good, good}, "program: expected a device and a listing");
  EXPECT_EQ(obeyed(daemon, {"program"}), before);
}

TEST(ControlInput, TakesVoltagesWordsAndSwitches) {
  const RunningUnderstudy daemon;
  EXPECT_EQ(obeyed(daemon, {"input", "AIN_A=2.5V", "DIN_3=on", "DIP2=on"}), "");
  EXPECT_TRUE(eventually([&] {
    return obeyed(daemon, {"get", "ADC_A", "DIN_3"}) == "ADC_A 1000\nDIN_3 1\n";
  }));
  EXPECT_EQ(ModbusHost(daemon.port()).read(kAdcA), Registers{1000});
  EXPECT_NE(obeyed(daemon, {"status"}).find("pulses CW/CCW"), std::string::npos);
  obeyed(daemon, {"power", "cycle"});
  EXPECT_NE(obeyed(daemon, {"status"}).find("pulses PLS/DIR"), std::string::npos);
  EXPECT_EQ(obeyed(daemon, {"input", "AIN_A=0", "DIN_3=off"}), "");
  EXPECT_TRUE(eventually([&] { return obeyed(daemon, {"get", "ADC_A", "DIN_3"}) == "ADC_A 0\nDIN_3 0\n"; }));

  expect_refused(daemon, {"input", "AIN_A=13V"},
                 "input: AIN_A: 13000 is not a level; expected 0 to 12000 millivolts");
  expect_refused(daemon, {"input", "AIN_A=2.5"},
                 "input: AIN_A: '2.5' is not a level; expected a voltage such as 2.5V");
  expect_refused(daemon, {"input", "DIN_3=high"}, "input: DIN_3: 'high' is not a level; expected on or off");
  expect_refused(daemon, {"input", "DIN_3=on", "DIN_3=off"},
                 "input: 'DIN_3' is given twice; expected it only once");
  expect_refused(daemon, {"input", "DIN_3="}, "input: 'DIN_3=' is not understood; expected NAME=LEVEL");
  expect_refused(daemon, {"input"}, "input: nothing to do; expected NAME=LEVEL");
}

const std::string kHandWheel =
    "understudy: 1\n"
    "lines: { line: { link: ./port, stations: [ { name: feeder, model: simple2-r3, address: 1 } ] } }\n"
    "plant: { feeder.A: { encoder: { per_revolution: 4000, on: wheel } } }\n";

TEST(ControlTurn, MovesTheCountsOfAWheelAtOnceOrEvenly) {
  const auto served = RunningUnderstudy::of_bench(kHandWheel, {"--speed", "manual"});
  const RunningUnderstudy& daemon = *served;
  EXPECT_EQ(obeyed(daemon, {"turn", "feeder.A=300"}), "");
  obeyed(daemon, {"advance", "1ms"});
  EXPECT_EQ(obeyed(daemon, {"get", "feeder.A.encoder"}), "feeder.A.encoder 300\n");
  obeyed(daemon, {"turn", "feeder.A=-200", "in=2s"});
  for (const auto& [after, counts] : {std::pair{"500ms", 250}, {"500ms", 200}, {"1s", 100}, {"1s", 100}}) {
    obeyed(daemon, {"advance", after});
    EXPECT_EQ(obeyed(daemon, {"get", "feeder.A.encoder"}),
              "feeder.A.encoder " + std::to_string(counts) + "\n");
  }
}

TEST(ControlTurn, IsRefusedWhereNothingTurns) {
  const auto served = RunningUnderstudy::of_bench(kHandWheel, {"--speed", "manual"});
  const RunningUnderstudy& daemon = *served;
  expect_refused(daemon, {"turn", "feeder.B=1"},
                 "turn: feeder.B has no hand wheel; expected `encoder: { on: wheel }` in `plant`");
  expect_refused(daemon, {"turn", "feeder.A=1", "in=soon"},
                 "turn: in: 'soon' is not valid; expected a duration such as 250ms");
  expect_refused(daemon, {"turn"}, "turn: nothing to do; expected NAME=VALUE");
  EXPECT_EQ(obeyed(daemon, {"get", "feeder.A.encoder"}), "feeder.A.encoder 0\n");
}

}  // namespace faults_control_test
}  // namespace understudy::acceptance
