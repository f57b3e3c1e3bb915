// Every choice that has more than one option shows its effect: here those of the wire, and of the program
// language as far as the interpreter's own tests show it; the others in choices_*_test.cpp.
#include "emulator/models/simple2_r3/choices.h"

#include <set>

#include "emulator/models/simple2_r3/device.h"
#include "tests/emulator/models/simple2_r3/choice_cases.h"

namespace understudy::emulator::models::simple2_r3 {
namespace choices_test {

// Aaxis_SVON = 1 to station 1, and the same to station 0.
const std::vector<std::uint8_t> kServoOnTo1{0x01, 0x06, 0x10, 0x14, 0x00, 0x01, 0x0C, 0xCE};
const std::vector<std::uint8_t> kServoOnTo0{0x00, 0x06, 0x10, 0x14, 0x00, 0x01, 0x0D, 0x1F};
const std::vector<std::uint8_t> kNothing;

TEST(Choices, ThereIsACaseForEveryOneThatCanBeChosen) {
  const std::set<std::string_view> cases = {
      // choices_test.cpp
      "station_0_request", "switch_0_broadcast", "wait_move_b_139", "loop_count", "loop_left", "loop_nesting",
      "unknown_command", "after_last_line", "delay_counts",
      // choices_requests_test.cpp
      "exceptions", "request_effects", "unmapped_addresses", "write_to_read_only", "write_out_of_range",
      "read_of_write_only", "half_writes",
      // choices_io_test.cpp
      "version_encoding", "trigger_read_back", "command_values", "set_move", "factory_values",
      "assignment_effect", "write_under_function", "output_read_back", "aclr_again",
      "unassigned_input_status", "analog_scaling", "adc_width", "encoder_speed_overflow",
      // choices_memory_test.cpp
      "factory_reset_of_volatile", "factory_reset_motion", "eeprom_time", "eeprom_same_value",
      "eeprom_erasure", "write_while_saving", "power_cut", "switches_sampled", "password_kept",
      "first_password", "password_read_back", "lock_judged", "locked_writes", "locked_start",
      // choices_motion_test.cpp
      "servo_at_power_up", "command_while_moving", "incremental_while_moving", "mode_change_while_moving",
      "speed_while_moving", "move_begins", "tick_order", "pulse_rate_cap", "limit_reaction", "limit_sense",
      "alarm_reaction", "alarm_latch", "ready_gates", "coordinate_overflow", "preset_while_moving",
      // choices_modes_test.cpp
      "homing_sequence", "home_unassigned", "home_coordinate", "home_bit", "moving_bit", "velocity_unit",
      "velocity_commit", "velocity_step", "mode_after_stop", "values_after_stop", "dropped_value",
      "pwm_servo", "sync_ratio", "sync_slope", "sync_lost_pulses", "sync_period", "encoder_speed",
      // reactions_test.cpp, and docs/fidelity/proofs/simple2-r3/
      "after_limit", "command_into_limit", "pwm_at_limit", "after_alarm", "sync_after_alarm",
      "move_in_other_mode", "command_while_servo_off", "stop",
      // docs/fidelity/proofs/simple2-r3/
      "sync_encoder", "sync_settings", "sync_slope_end", "velocity_settings", "wait_cut_short",
      "wait_move_homing", "undefined_flag", "timer_compare", "timer_overflow", "request_with_bad_value",
      "least_ramp", "homing_bits", "triggers_shown", "servo_unassigned", "locked_reset",
      "program_value_of_32_bits", "counter_by_var", "boot_time", "rewritten_line",
      // choices_operands_test.cpp, choices_program_test.cpp, choices_program_run_test.cpp
      "logic_operand", "read_only_parameter", "timers_at_power_up", "timer1_defect", "undefined_operand",
      "undefined_parameter", "value_out_of_range", "program_speed", "program_pulse", "wait_slot",
      "flags_found", "flags_after_end", "same_flag_twice", "arithmetic", "division", "counter_overflow",
      "timer_unit", "program_start", "start_while_running", "program_end", "timers_at_end", "line_after_end",
      "erase_while_running"};
  std::set<std::string_view> selectable;
  for (const ChoiceRow& row : kChoices) {
    if (options_of(row).size() > 1) selectable.insert(row.id);
  }
  EXPECT_EQ(selectable, cases);
}

TEST(Choices, EveryProposalCanBeChosenOtherwise) {
  // But for the framing, which is the line's, and its silence rule has a switch of its own; and for the tick.
  const std::set<std::string_view> only_ours = {"end_time_counts", "input_sampling"};
  std::set<std::string_view> single;
  for (const ChoiceRow& row : kChoices) {
    if (row.confidence == Confidence::proposal && options_of(row).size() == 1) single.insert(row.id);
  }
  EXPECT_EQ(single, only_ours);
}

TEST(Choices, Station0RequestIsObeyedSilentlyOrIgnored) {
  for (const auto& [option, obeyed] :
       each_option<bool>("station_0_request", {{"broadcast", true}, {"ignored", false}})) {
    OneSimple2 feeder(with("station_0_request", option));
    EXPECT_EQ(ask(feeder, kServoOnTo0), kNothing) << option;
    EXPECT_EQ(feeder.bit("Aaxis_SVON"), obeyed) << option;
    EXPECT_EQ(ask(feeder, kServoOnTo1), kServoOnTo1) << option;
  }
}

TEST(Choices, Switch0BroadcastIsAnsweredOrObeyedSilently) {
  for (const auto& [option, answered] :
       each_option<bool>("switch_0_broadcast", {{"answered", true}, {"silent", false}})) {
    Given given = with("switch_0_broadcast", option);
    given.address = 0;
    OneSimple2 feeder(given);
    EXPECT_EQ(ask(feeder, kServoOnTo0), answered ? kServoOnTo0 : kNothing) << option;
    EXPECT_TRUE(feeder.bit("Aaxis_SVON")) << option;
    EXPECT_EQ(ask(feeder, kServoOnTo1), kServoOnTo1) << "every other station number is answered";
  }
}

TEST(Choices, ThoseOfTheLanguageReachTheInterpreter) {
  // What they do there is tested with the interpreter.
  using interpreter::simple2::Dialect;
  const auto dialect = [](const std::string& choice, const std::string& option, Firmware firmware = 152) {
    Given given = with(choice, option);
    given.firmware = firmware;
    OneSimple2 feeder(given);
    return static_cast<const Simple2R3&>(feeder.device()).dialect();
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
