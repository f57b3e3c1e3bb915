// Choices reach the interpreter. docs/fidelity/proofs/simple2-r3/ shows each one alone; choices_*_test.cpp
// test how they interact with the rest of the device.
#include "emulator/models/simple2_r3/choices.h"

#include <set>

#include "emulator/models/simple2_r3/device.h"
#include "tests/emulator/models/simple2_r3/choice_cases.h"

namespace understudy::emulator::models::simple2_r3 {
namespace choices_test {

TEST(Choices, EveryProposalCanBeChosenOtherwise) {
  // But for the framing, which is the line's, and its silence rule has a switch of its own; and for the tick.
  const std::set<std::string_view> only_ours = {"end_time_counts", "input_sampling"};
  std::set<std::string_view> single;
  for (const ChoiceRow& row : kChoices) {
    if (row.confidence == Confidence::proposal && options_of(row).size() == 1) single.insert(row.id);
  }
  EXPECT_EQ(single, only_ours);
}

TEST(Choices, ThoseOfTheLanguageReachTheInterpreter) {
  // What they do there is tested with the interpreter.
  using interpreter::simple2::Dialect;
  const auto dialect = [](const std::string& choice, const std::string& option, Firmware firmware = 152) {
    Given given = with(choice, option);
    given.firmware = firmware;
    OneSimple2 feeder(given);
    return static_cast<const Simple2R3&>(feeder.device()).setup().dialect;
  };
  const auto with_field = [](auto member, auto value) {
    Dialect changed;
    changed.*member = value;
    return changed;
  };
  for (const auto& [option, quirk] :
       each_option<bool>("wait_move_b_139", {{"as_move_inc_b_wait", true}, {"waits", false}})) {
    EXPECT_EQ(dialect("wait_move_b_139", option, 139).quirk_wait_move_b_is_move_inc_b_wait, quirk);
  }
  const std::pair<std::string, OptionCases<Dialect>> fields[] = {
      {"loop_count",
       {{"passes", {}},
        {"further_passes", with_field(&Dialect::loop_count, Dialect::LoopCount::further_passes)}}},
      {"loop_left",
       {{"forgotten", {}}, {"remembered", with_field(&Dialect::loop_left, Dialect::LoopLeft::remembered)}}},
      {"loop_nesting",
       {{"when_met", {}},
        {"when_outer_starts", with_field(&Dialect::loop_nesting, Dialect::LoopNesting::when_outer_starts)}}},
      {"unknown_command",
       {{"does_nothing", {}},
        {"ends", with_field(&Dialect::unknown_command, Dialect::UnknownCommand::ends)}}},
      {"after_last_line",
       {{"ends", {}},
        {"goes_on_at_0", with_field(&Dialect::after_last_line, Dialect::AfterLastLine::goes_on_at_0)}}},
      {"undefined_flag",
       {{"line_0", {}},
        {"line_void", with_field(&Dialect::undefined_flag, Dialect::UndefinedFlag::line_void)}}},
      {"timer_compare",
       {{"without_sign", {}},
        {"with_sign", with_field(&Dialect::timer_compare, Dialect::TimerCompare::with_sign)}}},
      {"delay_counts",
       {{"to_next_line", {}},
        {"before_next_slot", with_field(&Dialect::delay_counts, Dialect::DelayCounts::before_next_slot)}}},
  };
  for (const auto& [choice, cases] : fields) {
    for (const auto& [option, expected] : each_option<Dialect>(choice, cases)) {
      EXPECT_EQ(dialect(choice, option), expected) << choice << ": " << option;
    }
  }
}

}  // namespace choices_test
}  // namespace understudy::emulator::models::simple2_r3
