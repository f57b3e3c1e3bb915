// Control messages that disturb: inputs in their units, power, programs, faults. Tests the effect of each,
// and that a bad one gets one line and changes nothing.
#include <gtest/gtest.h>

#include "tests/emulator/serve/control/daemon_rig.h"

namespace understudy::emulator::serve {
namespace disturbance_messages_test {

const std::string kDone = R"({"ok":true})";
constexpr Speed kManual{.kind = Speed::Kind::manual};

/// Returns the ticks of a world with a stopped clock.
void run(DaemonRig& rig, Tick ticks) {
  world::World& world = rig.daemon.world();
  world.advance_to(world.now() + time_of(ticks));
}

std::string error_of(DaemonRig& rig, const std::string& message) {
  const Json reply = rig.ask(message);
  EXPECT_EQ(reply["ok"], false) << message;
  EXPECT_EQ(reply.size(), 2u) << message;
  return reply["error"];
}

std::string power(const std::string& device, const std::string& to) {
  return R"({"do":"power","device":")" + device + R"(","to":")" + to + R"("})";
}

// --- inputs --------------------------------------------------------------------------------------

TEST(InputMessages, TakeWordsVoltagesAndSwitches) {
  DaemonRig rig;
  EXPECT_EQ(
      rig.reply_to(R"({"do":"input","values":{"feeder.DIN_1":"on","feeder.DIN_2":1,"feeder.AIN_A":"2.5V",)"
                   R"("turner.AIN_B":400,"feeder.DIP2":"true"}})"),
      kDone);
  run(rig, 1);
  EXPECT_EQ(rig.value("feeder.DIN_ALL"), 1 << 1 | 1 << 2);
  EXPECT_EQ(rig.value("feeder.ADC_A"), 1000);  // 400 per volt
  EXPECT_EQ(rig.value("turner.ADC_B"), 160);
  EXPECT_EQ(rig.ask(R"({"do":"status"})")["status"]["devices"][0]["pulse_format"], "CW/CCW")
      << "a switch on the housing is read at power-up";
  EXPECT_EQ(rig.reply_to(power("feeder", "cycle")), kDone);
  EXPECT_EQ(rig.ask(R"({"do":"status"})")["status"]["devices"][0]["pulse_format"], "PLS/DIR");
  EXPECT_EQ(rig.reply_to(R"({"do":"input","values":{"feeder.DIN_1":"off","feeder.AIN_A":"0mV"}})"), kDone);
  run(rig, 1);
  EXPECT_EQ(rig.value("feeder.DIN_ALL"), 1 << 2);
  EXPECT_EQ(rig.value("feeder.ADC_A"), 0);
}

// --- power ---------------------------------------------------------------------------------------

TEST(PowerMessages, OffMakesADeviceUnreachableAndOnRestartsIt) {
  DaemonRig rig;
  EXPECT_EQ(
      rig.reply_to(
          R"({"do":"set","values":{"feeder.Aaxis_Speed":200,"feeder.DOUT_4":1,"turner.Aaxis_Speed":7}})"),
      kDone);
  run(rig, 2);
  EXPECT_EQ(rig.value("turner.DIN_10"), 1);
  EXPECT_EQ(rig.reply_to(power("feeder", "off")), kDone);
  const std::string no_power = "feeder has no power; expected it to be on";
  EXPECT_EQ(error_of(rig, R"({"do":"get","names":["feeder.Aaxis_Speed"]})"), no_power);
  EXPECT_EQ(error_of(rig, R"({"do":"get","names":["turner.Aaxis_Speed","feeder.HW_Code"]})"), no_power);
  EXPECT_EQ(error_of(rig, R"({"do":"set","values":{"turner.Aaxis_Speed":8,"feeder.Aaxis_Speed":1}})"),
            no_power);
  EXPECT_EQ(error_of(rig, R"({"do":"program","device":"feeder"})"), no_power);
  EXPECT_EQ(error_of(rig, R"({"do":"program","device":"feeder","text":"NOP\n"})"), no_power);
  EXPECT_EQ(rig.value("turner.Aaxis_Speed"), 7) << "the other one continues";
  const Json devices = rig.ask(R"({"do":"status"})")["status"]["devices"];
  EXPECT_EQ(devices[0]["power"], "off");
  EXPECT_EQ(devices[1]["power"], "on");
  run(rig, 2);
  EXPECT_EQ(rig.value("turner.DIN_10"), 0) << "its outputs are open";

  EXPECT_EQ(rig.reply_to(power("feeder", "off")), kDone) << "the second time changes nothing";
  EXPECT_EQ(rig.reply_to(R"({"do":"input","values":{"feeder.DIN_1":1}})"), kDone) << "whatever holds it";
  EXPECT_EQ(rig.reply_to(power("feeder", "on")), kDone);
  EXPECT_EQ(rig.value("feeder.Aaxis_Speed"), 0) << "not kept";
  run(rig, 1);
  EXPECT_EQ(rig.value("feeder.DIN_1"), 1);
  EXPECT_EQ(rig.ask(R"({"do":"status"})")["status"]["devices"][0]["power"], "on");
}

TEST(PowerMessages, CycleIsOffAndOn) {
  DaemonRig rig;
  rig.reply_to(R"({"do":"set","values":{"feeder.Aaxis_Speed":200,"feeder.Aaxis_Resoultion":5000}})");
  run(rig, 1000);  // Aaxis_Resoultion is written into the EEPROM
  EXPECT_EQ(rig.reply_to(power("feeder", "cycle")), kDone);
  EXPECT_EQ(rig.value("feeder.Aaxis_Speed"), 0);
  EXPECT_EQ(rig.value("feeder.Aaxis_Resoultion"), 5000);
  rig.reply_to(power("feeder", "off"));
  EXPECT_EQ(rig.reply_to(power("feeder", "cycle")), kDone) << "a device that is off is switched on";
  EXPECT_EQ(rig.value("feeder.Aaxis_Resoultion"), 5000);
}

// --- programs ------------------------------------------------------------------------------------

TEST(ProgramMessages, LoadAListingAndPrintTheProgramThatIsThere) {
  DaemonRig rig;
  EXPECT_EQ(
      rig.reply_to(R"({"do":"program","device":"feeder","text":"again: Delay_mSec 1500\n  Jump again\n"})"),
      kDone);
  EXPECT_NE(rig.value("feeder.MAIN_LINE0_CMD"), 0);
  EXPECT_EQ(rig.value("turner.MAIN_LINE0_CMD"), 0);
  const Json reply = rig.ask(R"({"do":"program","device":"feeder"})");
  EXPECT_EQ(reply["ok"], true);
  const std::string text = reply["text"];
  EXPECT_NE(text.find("Delay_mSec 1500"), std::string::npos) << text;
  // It accepts its own output, which is the same program.
  EXPECT_EQ(rig.reply_to(Json{{"do", "program"}, {"device", "turner"}, {"text", text}}.dump()), kDone);
  EXPECT_EQ(rig.ask(R"({"do":"program","device":"turner"})")["text"], text);
}

TEST(ProgramMessages, AWrongListingLeavesTheProgramAsItWas) {
  DaemonRig rig;
  rig.reply_to(R"({"do":"program","device":"feeder","text":"Delay_mSec 1500\n"})");
  const Json before = rig.ask(R"({"do":"program","device":"feeder"})");
  const Json refused = rig.ask(R"({"do":"program","device":"feeder","text":"NOP\nDellay_mSec 5\nJump\n"})");
  EXPECT_EQ(refused["ok"], false);
  EXPECT_EQ(refused["mistakes"].size(), 2U) << refused;
  EXPECT_EQ(refused["error"],
            "line 2, column 1: mnemonic: no instruction is called 'Dellay_mSec'; expected an instruction "
            "(nearest: 'Delay_mSec') (and 1 more)");
  EXPECT_EQ(rig.ask(R"({"do":"program","device":"feeder"})"), before);
}

// --- faults --------------------------------------------------------------------------------------

TEST(FaultMessages, AreNumberedListedAndCleared) {
  DaemonRig rig;
  EXPECT_EQ(rig.reply_to(R"({"do":"list"})"), R"({"ok":true,"faults":[]})");
  EXPECT_EQ(rig.reply_to(R"({"do":"inject","fault":{"stall":"feeder.A"}})"), R"({"ok":true,"number":1})");
  EXPECT_EQ(rig.reply_to(R"({"do":"inject","fault":{"lost_steps":"turner.B","one_in":50}})"),
            R"({"ok":true,"number":2})");
  EXPECT_EQ(rig.reply_to(R"({"do":"inject","fault":{"slip":"feeder.B","pulses":-30}})"),
            R"({"ok":true,"number":3})");
  EXPECT_EQ(rig.reply_to(R"({"do":"inject","fault":{"stuck":"feeder.DIN_2","level":"on"}})"),
            R"({"ok":true,"number":4})");
  EXPECT_EQ(rig.reply_to(R"({"do":"inject","fault":{"alarm":"turner.A"}})"), R"({"ok":true,"number":5})");
  EXPECT_EQ(rig.reply_to(R"({"do":"list"})"),
            R"({"ok":true,"faults":[{"number":1,"fault":"stall feeder.A"},)"
            R"({"number":2,"fault":"lost_steps turner.B one_in=50"},)"
            R"({"number":4,"fault":"stuck feeder.DIN_2 level=1"},{"number":5,"fault":"alarm turner.A"}]})");
  run(rig, 1);
  EXPECT_EQ(rig.value("feeder.DIN_2"), 1);
  EXPECT_EQ(rig.ask(R"({"do":"status"})")["status"]["devices"][0]["machines"]["B"]["position_pulses"], -30);

  EXPECT_EQ(rig.reply_to(R"({"do":"clear","number":4})"), kDone);
  run(rig, 1);
  EXPECT_EQ(rig.value("feeder.DIN_2"), 0);
  for (const char* number : {"4", "3", "0", "6", "-1"}) {
    EXPECT_EQ(error_of(rig, R"({"do":"clear","number":)" + std::string(number) + "}"),
              "number: " + std::string(number) + " is not a fault in force; expected one of 1, 2, 5");
  }
  EXPECT_EQ(rig.ask(R"({"do":"list"})")["faults"].size(), 3u);
  EXPECT_EQ(rig.reply_to(R"({"do":"clear"})"), kDone);
  EXPECT_EQ(rig.reply_to(R"({"do":"list"})"), R"({"ok":true,"faults":[]})");
  EXPECT_EQ(rig.reply_to(R"({"do":"clear"})"), kDone) << "nothing to clear is not an error";
}

TEST(FaultMessages, ThatWaitAreListedWithTheirCourse) {
  DaemonRig rig;
  EXPECT_EQ(rig.reply_to(R"({"do":"inject","fault":{"drop":"feeder","nth":3,"of":"request"}})"),
            R"({"ok":true,"number":1})");
  EXPECT_EQ(rig.reply_to(R"({"do":"inject","fault":{"stall":"feeder.A","at":"30ms","for":"10ms"}})"),
            R"({"ok":true,"number":2})");
  EXPECT_EQ(rig.reply_to(R"({"do":"inject","fault":{"alarm":"turner.B","when":"feeder.DIN_1 == 1"}})"),
            R"({"ok":true,"number":3})");
  const auto course = [&](std::size_t i) { return rig.ask(R"({"do":"list"})")["faults"][i]; };
  EXPECT_EQ(rig.reply_to(R"({"do":"list"})"),
            R"({"ok":true,"faults":[)"
            R"({"number":1,"fault":"drop feeder of=request nth=3","seen":0,"matched":0,"hits":0},)"
            R"({"number":2,"fault":"stall feeder.A at=30ms for=10ms","matched":0,"hits":0,"in_force":false},)"
            R"({"number":3,"fault":"alarm turner.B when=\"feeder.DIN_1 == 1\"",)"
            R"("matched":0,"hits":0,"in_force":false}]})");
  run(rig, 35);
  EXPECT_EQ(course(1)["hits"], 1);
  EXPECT_EQ(course(1)["in_force"], true);
  rig.reply_to(R"({"do":"input","values":{"feeder.DIN_1":"on"}})");
  run(rig, 10);
  EXPECT_EQ(course(1)["in_force"], false);
  EXPECT_EQ(course(2)["in_force"], true);
  rig.reply_to(R"({"do":"clear"})");
  EXPECT_EQ(rig.reply_to(R"({"do":"list"})"), R"({"ok":true,"faults":[]})");
}

TEST(FaultMessages, OfTheBenchAreListedToo) {
  DaemonRig rig(kManual, "faults: [ { stall: turner.A }, { stuck: feeder.DIN_0, level: off } ]\n");
  EXPECT_EQ(rig.reply_to(R"({"do":"list"})"), R"({"ok":true,"faults":[{"number":1,"fault":"stall turner.A"},)"
                                              R"({"number":2,"fault":"stuck feeder.DIN_0 level=0"}]})");
  EXPECT_EQ(rig.reply_to(R"({"do":"clear","number":1})"), kDone);
  EXPECT_EQ(rig.ask(R"({"do":"inject","fault":{"stall":"feeder.A"}})")["number"], 3);
}

TEST(StatusMessage, TellsWhatADriveIsAt) {
  DaemonRig rig(kManual, "plant: { feeder.A: { drive: { ready_after: 5ms } } }\n");
  const auto drive = [&] {
    const Json machines = rig.ask(R"({"do":"status"})")["status"]["devices"][0]["machines"];
    EXPECT_FALSE(machines["B"].contains("drive"));
    return machines["A"]["drive"];
  };
  EXPECT_EQ(drive(), "off");
  rig.reply_to(R"({"do":"set","values":{"feeder.DOUT0_Aaxis_SVON":1,"feeder.Aaxis_SVON":1}})");
  run(rig, 5);
  EXPECT_EQ(drive(), "off");
  run(rig, 1);
  EXPECT_EQ(drive(), "ready");
  rig.reply_to(R"({"do":"inject","fault":{"alarm":"feeder.A"}})");
  EXPECT_EQ(drive(), "alarm");
  run(rig, 1);
  rig.reply_to(R"({"do":"clear"})");
  run(rig, 10);
  EXPECT_EQ(drive(), "alarm");
}

// --- refusals ------------------------------------------------------------------------------------

struct Bad {
  std::string message;
  std::string error;
};

TEST(DisturbanceMessages, ThatAreWrongGetOneLineAndChangeNothing) {
  const auto input = [](const std::string& values) { return R"({"do":"input","values":)" + values + "}"; };
  const auto inject = [](const std::string& more) { return R"({"do":"inject",)" + more + "}"; };
  const std::string such = R"(fault: expected an object such as {"stall":"feeder.A"})";
  const std::vector<Bad> cases = {
      {input(R"({"feeder.DIN_1":"high"})"), "feeder.DIN_1: 'high' is not a level; expected on or off"},
      {input(R"({"feeder.DIN_1":"2.5V"})"), "feeder.DIN_1: '2.5V' is not a level; expected on or off"},
      {input(R"({"feeder.DIN_1":"7"})"), "feeder.DIN_1: 7 is not a level; expected 0 or 1"},
      {input(R"({"feeder.AIN_A":"2.5"})"),
       "feeder.AIN_A: '2.5' is not a level; expected a voltage such as 2.5V"},
      {input(R"({"feeder.AIN_A":2.5})"), "feeder.AIN_A: 2.5 is not a level; expected a voltage such as 2.5V"},
      {input(R"({"feeder.AIN_A":"13V"})"),
       "feeder.AIN_A: 13000 is not a level; expected 0 to 12000 millivolts"},
      {input(R"({"feeder.AIN_A":-1})"), "feeder.AIN_A: -1 is not a level; expected 0 to 12000 millivolts"},
      {input(R"({"feeder.AIN_A":4294967296})"),
       "feeder.AIN_A: 4294967296 is not a level; expected 0 to 12000 millivolts"},
      {input(R"({"feeder.DIP1":2})"), "feeder.DIP1: 2 is not a level; expected 0 or 1"},
      {input(R"({"feeder.DIP3":1})"), "no input of feeder is called 'DIP3'; the nearest is 'DIP1'"},
      {input(R"({"feeder.DIN_1":"on","feeder.AIN_A":"x"})"),
       "feeder.AIN_A: 'x' is not a level; expected a voltage such as 2.5V"},

      {R"({"do":"power"})", "'to' is missing"},
      {R"({"do":"power","device":"feeder"})", "'to' is missing"},
      {R"({"do":"power","to":"off"})", "the device is missing; expected one of feeder, turner"},
      {R"({"do":"power","device":"","to":"off"})", "the device is missing; expected one of feeder, turner"},
      {power("feedr", "off"), "no device is called 'feedr'; the nearest is 'feeder'"},
      {power("feeder", "down"), "to: 'down' is unknown; expected on, off or cycle"},
      {power("feeder", ""), "to: '' is unknown; expected on, off or cycle"},
      {R"({"do":"power","device":1,"to":"off"})", "device: 1 is not a text; expected one"},
      {R"({"do":"power","device":"feeder","to":false})", "to: false is not a text; expected one"},
      {R"({"do":"power","device":"feeder","to":"off","at":1})", "'at' is not a key of this message"},

      {R"({"do":"program"})", "the device is missing; expected one of feeder, turner"},
      {R"({"do":"program","device":"feeder","text":1})", "text: 1 is not a text; expected one"},
      {R"({"do":"program","device":"feeder","text":null})", "text: null is not a text; expected one"},
      {R"({"do":"program","device":"feeder","file":"x"})", "'file' is not a key of this message"},
      {R"({"do":"program","device":"nobody","text":"NOP"})",
       "no device is called 'nobody'; expected one of feeder, turner"},

      {inject(R"("stall":"feeder.A")"), "'stall' is not a key of this message"},
      {R"({"do":"inject"})", "'fault' is missing"},
      {inject(R"("fault":"stall")"), such},
      {inject(R"("fault":{})"), such},
      {inject(R"("fault":["stall","feeder.A"])"), such},
      {inject(R"("fault":{"stall":1})"), such},
      {inject(R"("fault":{"stall":["feeder.A"]})"), such},
      {inject(R"("fault":{"stall":"feeder.A"},"one_in":5)"), "'one_in' is not a key of this message"},
      {inject(R"("fault":{"jam":"feeder.A"})"), "'jam' is not a fault; expected one such as 'stall'"},
      {inject(R"("fault":{"":"feeder.A"})"), "'' is not a fault; expected one such as 'stall'"},
      {inject(R"("fault":{"stall":"feeder.C"})"), "no axis of feeder is called 'C'; expected one of A, B"},
      {inject(R"("fault":{"stall":"A"})"),
       "'A' must begin with its device; expected one of feeder.A, turner.A"},
      {inject(R"("fault":{"stall":"feeder.A","x":1})"),
       "stall: x: is not a field here; expected one such as 'nth'"},
      {inject(R"("fault":{"stall":"feeder.A","":0})"),
       "stall: : is not a field here; expected one such as 'nth'"},
      {inject(R"("fault":{"lost_steps":"feeder.A"})"),
       "lost_steps: one_in is missing; expected 1 to 1000000000000"},
      {inject(R"("fault":{"lost_steps":"feeder.A","one_in":0})"),
       "lost_steps: one_in: 0 is out of range; expected 1 to 1000000000000"},
      {inject(R"("fault":{"lost_steps":"feeder.A","one_in":"5O"})"),
       "lost_steps: one_in: '5O' is not valid; expected a whole number"},
      {inject(R"("fault":{"lost_steps":"feeder.A","one_in":1.5})"),
       "one_in: 1.5 is not a whole number or a text; expected one"},
      {inject(R"("fault":{"lost_steps":"feeder.A","one_in":18446744073709551615})"),
       "lost_steps: one_in: '18446744073709551615' is not valid; expected a whole number"},
      {inject(R"("fault":{"slip":"feeder.A","pulses":1000000001})"),
       "slip: pulses: 1000000001 is out of range; expected -1000000000 to 1000000000"},
      {inject(R"("fault":{"stuck":"feeder.DIN_1"})"), "stuck: level is missing; expected on or off"},
      {inject(R"("fault":{"stuck":"feeder.DIN_1","level":"high"})"),
       "stuck: level: 'high' is not valid; expected on or off"},
      {inject(R"("fault":{"stuck":"feeder.DIN_1","level":[true]})"),
       "level: [true] is not a whole number or a text; expected one"},
      {inject(R"("fault":{"stuck":"feeder.DIP1","level":1})"),
       "'feeder.DIP1' cannot be stuck; expected a digital input"},

      {inject(R"("fault":{"drop":"feeder","nht":3})"),
       "drop: nht: is not a field here; the nearest is 'nth'"},
      {inject(R"("fault":{"drop":"feeder","when":"feeder.A.puls > 5"})"),
       "drop: when: column 1 of 'feeder.A.puls > 5': axis A has no 'puls'; the nearest is 'pulses'"},
      {inject(R"("fault":{"drop":"feeder","when":"feeder.A.pulses >"})"),
       "drop: when: column 18 of 'feeder.A.pulses >': unexpected end; expected a name, a number or '('"},
      {inject(R"("fault":{"drop":"feeder","when":"time"})"),
       "drop: when: 'time' is a duration; expected a condition"},
      {inject(R"("fault":{"encoder_noise":"feeder.A","counts":1})"),
       "feeder.A has no encoder; expected one in `plant`"},

      {R"({"do":"clear","number":1})",
       "number: 1 is not a fault in force; expected no number, because no fault is in force"},
      {R"({"do":"clear","number":"all"})", "number: 'all' is not a whole number; expected one"},
      {R"({"do":"clear","number":null})", "number: null is not a whole number; expected one"},
      {R"({"do":"clear","all":true})", "'all' is not a key of this message"},
      {R"({"do":"list","all":true})", "'all' is not a key of this message"},
  };
  DaemonRig rig;
  for (const Bad& bad : cases) {
    EXPECT_EQ(error_of(rig, bad.message), bad.error) << bad.message;
    EXPECT_TRUE(rig.is_untouched()) << bad.message;
    EXPECT_TRUE(rig.daemon.world().faults().empty()) << bad.message;
    for (std::size_t device = 0; device < 2; ++device)
      EXPECT_TRUE(rig.daemon.world().device(device).powered());
  }
}

}  // namespace disturbance_messages_test
}  // namespace understudy::emulator::serve
