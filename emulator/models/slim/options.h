// SLIM: the options of choices.h as the code asks for them, `chose(option("thrust", "runs_at_vj"))`. An
// unknown row or option is a compile error. Our option, the first of each row, does not need a name; for
// options that are numbers, ask for the row. Those that the device itself asks for have names below.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "emulator/models/slim/choices.h"

namespace understudy::emulator::models::slim {

consteval Option option(std::string_view id, std::string_view name) { return option_of(kChoices, id, name); }

/// The number that one of a row's options begins with: 256 of "256_lines".
constexpr int number_of(const ChoiceRow& row, std::size_t option_number) {
  std::string_view rest = row.options;
  for (; option_number > 0; --option_number) rest.remove_prefix(rest.find('|') + 1);
  if (rest.empty() || rest.front() < '0' || rest.front() > '9') throw "the option has no number";
  int number = 0;
  for (const char c : rest) {
    if (c < '0' || c > '9') break;
    number = 10 * number + (c - '0');
  }
  return number;
}

/// A row whose options are numbers; a compile error if one of them is not.
consteval std::size_t numbers(std::string_view id) {
  const std::size_t row = choice_number(kChoices, id);
  const auto bars = std::ranges::count(kChoices[row].options, '|');
  for (std::size_t i = 0; i <= static_cast<std::size_t>(bars); ++i) (void)number_of(kChoices[row], i);
  return row;
}

// --- the dialogue, modules and numbers ---
inline constexpr std::size_t kLongestLine = numbers("longest_line");
inline constexpr std::size_t kHistoryLength = numbers("history_length");
inline constexpr std::size_t kVoltage = numbers("voltage");
inline constexpr std::size_t kTemperature = numbers("temperature");
inline constexpr Option kEcho = option("echo", "on");
inline constexpr Option kPrompt = option("prompt", "greater_than");
inline constexpr Option kAcknowledges = option("acknowledgement", "ok");
inline constexpr Option kNamesValues = option("query_reply", "name_and_value");
inline constexpr Option kErrorsNotAnswered = option("error_reply", "nothing");
inline constexpr Option kArraysBySaveD = option("arrays_kept", "by_save_d");
inline constexpr Option kCrAloneEnds = option("line_end", "cr_alone");
inline constexpr Option kProgramErrorsSaid = option("unasked_text", "errors_of_a_program_too");
inline constexpr Option kXonXoff = option("flow_control", "xon_xoff");
inline constexpr Option kSaidLinesEndWithCr = option("output_end", "cr");
inline constexpr Option kInputsByNumberOnly = option("input_mask", "error_1");
inline constexpr Option kStatusInHexadecimal = option("status_bits", "the_same_in_hexadecimal");
inline constexpr Option kModeInWords = option("mode_codes", "words");
inline constexpr Option kTimeInSeconds = option("time_format", "seconds");
inline constexpr Option kOneErrorCode = option("error_codes", "1_for_all");
inline constexpr Option kRealsWithExponent = option("real_format", "exponent_of_the_large_and_small");
inline constexpr Option kCoordinateOf32Bits = option("coordinate_shown", "as_32_bits_hold_it");
inline constexpr Option kVariablesWhenWritten = option("variables_kept", "when_written");
inline constexpr Option kT0AloneIsLinked = option("linked_from_factory", "t0_alone");
inline constexpr Option kUnitOfPn44AndPn45 = option("user_unit", "pn44_pulses_are_pn45_units");
inline constexpr Option kUnitOfPn46AndPn45 = option("user_unit", "pn46_pulses_are_pn45_units");
inline constexpr Option kVersionIsNumber = option("version_shown", "as_a_number");
inline constexpr std::size_t kMotorVersion = numbers("motor_version");
inline constexpr Option kHistoryIsKept = option("history_kept", "for_ever");
inline constexpr Option kShownSpeedIsAnalog = option("working_speed_shown", "as_the_analog_input_leaves_it");
inline constexpr Option kErrorsAreT0s = option("error_of", "t0");
inline constexpr Option kIntegersFromMinus32766 = option("integer_range", "from_minus_32766");
inline constexpr Option kModuleTakenFromLetter = option("axis_values", "is_taken_from_its_letter");
inline constexpr Option kMapIsPn37 = option("axis_map_kept", "yes");
inline constexpr Option kUnlinkedSilent = option("unlinked_module", "silence");
inline constexpr Option kDefaultsKeptAtOnce = option("defaults_kept", "at_once");
inline constexpr Option kPn14IsVm = option("speed_parameters", "pn14_is_vm");
inline constexpr Option kVariableReceivesClock = option("clock_assignment", "the_variable");

// --- programs, and when a command may be given ---
inline constexpr std::size_t kPrintAhead = numbers("print_ahead");
inline constexpr std::size_t kEvents = numbers("events");
inline constexpr std::size_t kProgramSize = numbers("program_size");
inline constexpr std::size_t kCallDepth = numbers("call_depth");
inline constexpr Option kExternalColumnOnly = option("while_program_runs", "external_column_only");
inline constexpr Option kResetWhileRunning = option("while_program_runs", "reset_too");
inline constexpr Option kImmediateColumnIgnored = option("immediate_column", "taken");
inline constexpr Option kExitIsNoNumber = option("get_number_exit", "nothing");
inline constexpr Option kSavesInPrograms = option("first_list_columns", "saves_in_programs_too");
inline constexpr Option kFourLinesATick = option("lines_a_tick", "four_a_millisecond");
inline constexpr Option kLineIn4Ticks = option("lines_a_tick", "one_in_4_milliseconds");
inline constexpr Option kTimeUnitOf4Ms = option("time_unit", "4_milliseconds");
inline constexpr Option kEventsEach4Ms = option("event_check", "each_4_milliseconds");
inline constexpr Option kCheckedAsItRuns = option("program_check", "when_it_runs");
inline constexpr Option kFirstLabelCounts = option("same_label", "the_first_counts");
inline constexpr Option kNumbersOnly = option("lines_for_a_number", "numbers_only");
inline constexpr Option kPauseHoldsProgram = option("pause_and_program", "program_pauses_too");
inline constexpr Option kHelixOfVariablesOnly = option("helix_variables", "four_variables");
inline constexpr Option kQueriesAreFunctions = option("functions", "what_queries_show_too");
inline constexpr Option kBareNumberInN0 = option("bare_number", "into_n0_or_r0");
inline constexpr Option kEventsRunAlone = option("events_without_program", "run_their_routine");
inline constexpr Option kEmptyLinesIgnored = option("edit_end", "exit_or_esc");
inline constexpr Option kRefusedLineEndsEditing = option("refused_line", "ends_editing");
inline constexpr Option kListsTextOnly = option("listing", "text");
inline constexpr Option kPauseFailsMotion = option("pause_in_program", "error_6");
inline constexpr Option kLinesFrom1 = option("addresses", "line_number_from_1");
inline constexpr Option kFailedLinePassed = option("failed_line", "is_passed_over");
inline constexpr Option kEventsWaitForChange = option("event_at_arming", "waits_for_a_change");
inline constexpr Option kHeldEventDropped = option("held_event", "is_dropped");
inline constexpr Option kWaitsHaveGoneOn = option("interrupted_wait", "have_gone_on");

// --- motion ---
inline constexpr std::size_t kPulsesPerRevolution = numbers("pulses_per_revolution");
inline constexpr std::size_t kBufferLength = numbers("buffer_length");
inline constexpr Option kBusyRefused = option("busy", "error_3");
inline constexpr Option kStopEndsAnyProgram = option("emergency_stop_program", "ends_also_by_its_own_line");
inline constexpr Option kStopLeavesProgram = option("emergency_stop_program", "goes_on");
inline constexpr Option kPwmInKilohertz = option("pwm_units", "khz_and_percent");

}  // namespace understudy::emulator::models::slim
