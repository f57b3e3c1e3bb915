// What is wrong in `hunt` is reported with its place, before anything runs.
#include <gtest/gtest.h>

#include <string>

#include "base/files/file_error.h"
#include "emulator/models/models.h"
#include "emulator/play/reading/scenario_file.h"
#include "tests/emulator/hunt/hunted.h"

namespace understudy::emulator::hunt {
namespace plan_errors_test {

std::string diagnostic_of(const std::string& hunt) {
  try {
    play::parse_scenarios(models::all_models(), kPresses + "hunt:" + hunt, "s.yaml");
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

TEST(HuntPlanErrors, EachIsOneLineWithItsPlace) {
  const struct {
    std::string hunt;
    std::string diagnostic;
  } kCases[] = {
      {" {}\n", "s.yaml:20:7: hunt: 'may' is missing; expected it here"},
      {" { may: [] }\n",
       "s.yaml:20:14: hunt.may: is empty; expected an entry such as `- inject: { drop: feeder }`"},
      {" { may: [ times: 2 ] }\n",
       "s.yaml:20:16: hunt.may[0]: has no step; expected one such as `inject: { drop: feeder }`"},
      {" { may: [ inject: { drop: feder } ] }\n",
       "s.yaml:20:24: hunt.may[0].inject: no device is called 'feder'; the nearest is 'feeder'"},
      {" { may: [ advance: { between: [ 1ms ] } ] }\n",
       "s.yaml:20:36: hunt.may[0].advance.between: expected two values, as in `[ 1, 9 ]`"},
      {" { may: [ write: { Aaxis_AccTime: { between: [ 1, 9000 ] } } ] }\n",
       "s.yaml:20:40: hunt.may[0].write.Aaxis_AccTime: 9000 is out of range for Aaxis_AccTime; expected 0 to "
       "3000"},
      {" { may: [ { input: { DIN_10: on }, advance: 1ms } ] }\n",
       "s.yaml:20:50: hunt.may[0].advance: is a second step in one entry; expected `- ` before it"},
      {" { may: [ { input: { DIN_10: on }, from: the press } ] }\n",
       "s.yaml:20:47: hunt.may[0].from: 'the press' is not the text of a `say` step; expected one of the "
       "operator presses, the contact rests"},
      {" { may: [ advance: 1ms ], from: the contact rests, to: the operator presses }\n",
       "s.yaml:20:61: hunt.to: leaves no step between `from` and `to`; expected `from` before `to`"},
      {" { may: [ inject: { drop: feeder, name: d } ] }\n",
       "s.yaml:20:46: hunt.may[0].inject.name: cannot be used, because the fault may occur several times; "
       "expected no name"},
      {" { may: [ advance: 1ms ], never: feeder.Cuonter1_Value == 4 }\n",
       "s.yaml:20:39: hunt.never: column 1 of 'feeder.Cuonter1_Value == 4': feeder: no register is called "
       "'Cuonter1_Value'; the nearest is 'Counter1_Value'"},
      {" { may: [ { advance: 1ms, within: 5ms } ] }\n",
       "s.yaml:20:40: hunt.may[0].within: needs a fault that waits for a time; expected an `inject` without "
       "`nth`, "
       "`at` and so on"},
      {" { may: [ wait: 1ms ] }\n", "s.yaml:20:22: hunt.may[0].wait: is not a key here"},
  };
  for (const auto& one : kCases) {
    EXPECT_EQ(diagnostic_of(one.hunt).substr(0, one.diagnostic.size()), one.diagnostic) << one.hunt;
  }
}

TEST(HuntPlanErrors, ParametersCanBeUsed) {
  const std::string text =
      kPresses + "hunt: { may: [ advance: { between: [ 1ms, \"${most}\" ] } ] }\nparameters: ";
  EXPECT_NO_THROW(play::parse_scenarios(models::all_models(), text + "{ most: 1s }\n", "s.yaml"));
  EXPECT_THROW(play::parse_scenarios(models::all_models(), text + "{ most: 0.1ms }\n", "s.yaml"), FileError);
}

}  // namespace plan_errors_test
}  // namespace understudy::emulator::hunt
