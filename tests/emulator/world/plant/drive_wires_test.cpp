// Wires that lead to a drive, and how its alarm is cleared if the controller has no output for that: on every
// model.
#include <gtest/gtest.h>

#include "emulator/models/models.h"
#include "tests/emulator/model_file/described.h"
#include "tests/emulator/play/performing/played.h"
#include "tests/emulator/world/bench_file/bench_texts.h"

namespace understudy::emulator::world {
namespace drive_wires_test {

/// A controller d, and a Simple2-R3 h whose outputs the test can switch. The machine on an axis of d has a
/// drive.
std::string text_of(const std::string& model, const std::string& axis, const std::string& drive,
                    const std::string& wires, const std::string& steps) {
  return "understudy: 1\n"
         "name: test\n"
         "bench:\n"
         "  lines:\n"
         "    a: { timing: instant, stations: [ { name: d, model: " +
         model + (model == "slim" ? "" : ", address: 1") +
         " } ] }\n"
         "    b: { timing: instant, stations: [ { name: h, model: simple2-r3 } ] }\n"
         "  plant: { d." +
         axis + ": { drive: { ready_after: 10ms, " + drive + " } } }\n  wires: [ " + wires +
         " ]\nsteps:\n  - advance: 20ms\n" + steps;
}

void expect_passes(const std::string& text) {
  const play::ScenarioResult result =
      play::run_scenario(play::parse_scenarios(model_file::with_described(), text, "test.yaml").front(), {})
          .front();
  EXPECT_TRUE(play::has_passed(result)) << text << play::why(result);
}

std::string diagnostic_of(const std::string& wires) {
  const std::string text = text_of("rs-m8194h", "X", "enabled_by: on", wires, "  - advance: 1ms\n");
  try {
    play::parse_scenarios(model_file::with_described(), text, "test.yaml");
    return "";
  } catch (const FileError& error) {
    const std::string what = without_columns(error.what());
    return what.substr(what.find(": ") + 2);
  }
}

/// An alarm that comes and clears; after that it is latched.
std::string an_alarm(const std::string& axis) {
  return "  - inject: { alarm: d." + axis +
         ", name: a }\n  - advance: 50ms\n  - clear: a\n  - advance: 50ms\n" + "  - assert: d." + axis +
         ".alarm == 1\n";
}

struct Controller {
  const char* model;
  const char* axis;
  std::string on, off;  // steps that switch its servo on and off; none if it has no servo
};
const std::vector<Controller>& controllers() {
  static const std::vector<Controller> all{
      {"simple2-r3", "A", "", ""},
      {"super-40nc", "X", "", ""},
      {"rs-m8194h", "X", "  - command: { d: RSM_SERVO_ON X }\n", "  - command: { d: RSM_SERVO_OFF X }\n"},
      {"slim", "T0", "  - send: { line: a, text: HON }\n", "  - send: { line: a, text: HOFF }\n"},
      {PROJECT_FOLDER "/examples/import/drive.yaml", "X", "", ""},
  };
  return all;
}

TEST(DriveWires, ThereIsAControllerOfEveryModel) {
  for (const Model* model : models::all_models()) {
    EXPECT_TRUE(std::ranges::any_of(controllers(), [&](const Controller& controller) {
      return std::string_view(controller.model) == model->name;
    })) << model->name;
  }
}

TEST(DriveWires, ClearAnAlarmOnEveryModel) {
  for (const Controller& controller : controllers()) {
    const std::string axis = std::string("d.") + controller.axis;
    expect_passes(text_of(
        controller.model, controller.axis, "enabled_by: on",
        "h.DOUT_4 -> " + axis + ".servo, h.DOUT_5 -> " + axis + ".alarm_clear",
        controller.off + "  - advance: 5ms\n  - assert: " + axis +
            ".ready == 0\n  - write: { h.DOUT_ALL: 0x10 }\n" + "  - advance: 12ms\n  - assert: " + axis +
            ".ready == 1\n" + an_alarm(controller.axis) + "  - assert: " + axis + ".ready == 0\n" +
            // Disabling it is not enough if a wire leads to the input.
            "  - write: { h.DOUT_ALL: 0 }\n  - advance: 50ms\n  - assert: " + axis +
            ".alarm == 1\n  - write: { h.DOUT_ALL: 0x20 }\n  - advance: 2ms\n  - assert: " + axis +
            ".alarm == 0\n  - write: { h.DOUT_ALL: 0x10 }\n  - advance: 13ms\n  - assert: " + axis +
            ".ready == 1\n"));
  }
}

TEST(DriveWires, AreNotNeededWhereDisablingClearsIt) {
  for (const Controller& controller : controllers()) {
    if (controller.model == std::string_view("simple2-r3")) continue;  // it has ACLR
    const std::string axis = std::string("d.") + controller.axis;
    expect_passes(text_of(
        controller.model, controller.axis, "enabled_by: on", "h.DOUT_4 -> " + axis + ".servo",
        controller.off + "  - write: { h.DOUT_ALL: 0x10 }\n  - advance: 12ms\n" + an_alarm(controller.axis) +
            "  - write: { h.DOUT_ALL: 0 }\n  - advance: 2ms\n  - assert: " + axis + ".alarm == 0\n"));
    if (controller.on.empty()) continue;
    expect_passes(text_of(controller.model, controller.axis, "enabled_by: on", "",
                          controller.on + "  - advance: 15ms\n  - assert: " + axis + ".ready == 1\n" +
                              an_alarm(controller.axis) + controller.off +
                              "  - advance: 3ms\n  - assert: " + axis + ".alarm == 0\n" + controller.on +
                              "  - advance: 15ms\n  - assert: " + axis + ".ready == 1\n"));
  }
}

TEST(DriveWires, OfASimple2AreBesideItsOwnOutputs) {
  expect_passes(text_of(
      "simple2-r3", "A", "enabled_by: on", "",
      an_alarm("A") + "  - write: { d.Aaxis_SVON: 0 }\n  - advance: 50ms\n  - assert: d.A.alarm == 1\n"));
}

TEST(DriveWires, ThatCannotBeAreRefused) {
  EXPECT_EQ(diagnostic_of("d.DO_0_0 -> d.X.alarm_clear"), "");
  EXPECT_EQ(diagnostic_of("d.DO_0_0 -> d.Y.alarm_clear"),
            "bench.wires[0]: the machine on d.Y has no drive; expected it in `plant`");
  EXPECT_EQ(diagnostic_of("d.DO_0_0 -> d.X.alarm_claer"),
            "bench.wires[0]: 'alarm_claer' is not an input of a drive; the nearest is 'alarm_clear'");
}

}  // namespace drive_wires_test
}  // namespace understudy::emulator::world
