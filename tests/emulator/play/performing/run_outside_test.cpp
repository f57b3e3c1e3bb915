// Inputs, faults, power, programs and memories in scenarios.
#include <filesystem>
#include <fstream>

#include "emulator/models/models.h"
#include "tests/emulator/play/performing/played.h"

namespace understudy::emulator::play {
namespace runner_outside_test {

/// The test's own folder; a scenario's paths are relative to it.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "understudy-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder");
    path_ = name;
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  void write(const std::string& name, const std::string& text) const { std::ofstream(path_ / name) << text; }
  std::string read(const std::string& name) const {
    std::ifstream file(path_ / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  ScenarioResult play(const std::string& steps, const std::string& more = "") const {
    const auto scenarios =
        parse_scenarios(models::all_models(), scenario_text(steps, more), (path_ / "test.yaml").string());
    return play::run_scenario(scenarios.front()).front();
  }

 private:
  std::filesystem::path path_;
};

TEST(RunnerOutside, InputsReachTheDeviceAtTheNextTick) {
  passing(
      "  - input: { feeder.DIN_10: on, feeder.AIN_A: 2.5V }\n"
      "  - advance: 1ms\n"
      "  - assert: [ feeder.DIN_10 == 1, feeder.AIN_A == 2500mV ]\n"
      "  - expect: { feeder.DIN_10: 1, feeder.DIN_ALL: 0x400, feeder.Analog_A: 500 }\n"
      "  - input: { feeder.DIN_10: off }\n"
      "  - expect: { feeder.DIN_ALL: 0 }\n");
}

TEST(RunnerOutside, FaultsHoldUntilTheyAreCleared) {
  // A stalled motor loses every pulse, but the controller counts them all.
  passing(kServoOn + "  - inject: { stall: feeder.A, name: blocked }\n" + kExampleMove +
          "  - wait: { until: feeder.STATUS.4 == 0, within: 4s }\n"
          "  - assert: [ feeder.A.pulses == 32000, feeder.A.position == 0, feeder.A.lost == 32000 ]\n"
          "  - clear: blocked\n"
          "  - write: { feeder.Aaxis_Move_INC: 1 }\n"
          "  - wait: { until: feeder.STATUS.4 == 0, within: 4s, takes: 3050ms }\n"
          "  - assert: feeder.A.position == 32000\n");
  passing(
      "  - inject: { stuck: feeder.DIN_2, level: on }\n"
      "  - inject: { stuck: feeder.DIN_3, level: on }\n"
      "  - expect: { feeder.DIN_2: 1, feeder.DIN_3: 1 }\n"
      "  - clear: all\n"
      "  - expect: { feeder.DIN_2: 0, feeder.DIN_3: 0 }\n"
      "  - inject: { slip: feeder.A, pulses: -200 }\n"
      "  - advance: 1ms\n"
      "  - assert: feeder.A.position == -200\n");
}

TEST(RunnerOutside, PowerGoesAndComes) {
  passing(kServoOn +
          "  - write: { feeder.Aaxis_Speed: 123 }\n"
          "  - power: { feeder: off }\n"
          "  - assert: [ feeder.power == 0, feeder.STATUS == 0 ]\n"
          "  - send: { bytes: 01 03 00 01 00 01 +crc, reply: nothing, within: 30ms }\n"
          "  - power: { feeder: on }\n"
          "  - expect: { feeder.Aaxis_Speed: 0 }\n"
          "  - write: { feeder.Aaxis_Speed: 123 }\n"
          "  - power: { feeder: cycle }\n"
          "  - expect: { feeder.Aaxis_Speed: 0 }\n");
}

TEST(RunnerOutside, AProgramIsLoadedAndRun) {
  passing(
      "  - program:\n"
      "      feeder: |\n"
      "        Out 4 1\n"
      "        END\n"
      "  - write: { feeder.PROG_MAIN_RunTime_START: 0 }\n"
      "  - wait: { until: feeder.DOUT_4 == 1, within: 1s }\n");
}

TEST(RunnerOutside, AMemoryIsSavedAndComparedWithAFile) {
  const Folder folder;
  // 0xF000 is persistent: its EEPROM is written within a moment.
  ScenarioResult result = folder.play(
      "  - write: { feeder.Aaxis_Home_Speed: 77 }\n"
      "  - wait: { until: feeder.EEPROM_Writing == 0, within: 5s }\n"
      "  - advance: 1s\n"
      "  - save: { feeder: after.json }\n"
      "  - memory: { feeder: after.json }\n");
  EXPECT_TRUE(has_passed(result)) << why(result);
  EXPECT_NE(folder.read("after.json").find("\"Aaxis_Home_Speed\": 77"), std::string::npos)
      << folder.read("after.json");

  result = folder.play("  - memory: { feeder: after.json }\n");
  ASSERT_TRUE(result.failure);
  EXPECT_EQ(result.failure->came, "Aaxis_Home_Speed is the factory value; expected 77");

  result = folder.play(
      "  - write: { feeder.Aaxis_Home_Speed: 78 }\n"
      "  - advance: 2s\n"
      "  - memory: { feeder: after.json }\n");
  ASSERT_TRUE(result.failure);
  EXPECT_EQ(result.failure->came, "Aaxis_Home_Speed is 78; expected 77");

  result = folder.play("  - memory: { feeder: after.json }\n  - expect: { feeder.Aaxis_Home_Speed: 77 }\n",
                       "nv: { feeder: after.json }\n");
  EXPECT_TRUE(has_passed(result)) << why(result);
}

}  // namespace runner_outside_test
}  // namespace understudy::emulator::play
