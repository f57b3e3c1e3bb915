// SLIM: what its command list leaves open, and what we chose. The list contains the names and meanings of
// commands but says little about the dialogue, so most rows are proposals. docs/fidelity/slim.md is generated
// from these rows, and a bench can override a row with `choices: { ID: OPTION }`.
#pragma once

#include <array>
#include <cstddef>

#include "base/choices.h"
#include "interpreter/slim/choices.h"

namespace understudy::emulator::models::slim {

inline constexpr Confidence kFollows = Confidence::follows;
inline constexpr Confidence kLikely = Confidence::likely;
inline constexpr Confidence kProposal = Confidence::proposal;

inline constexpr ChoiceRow kDialogueChoices[] = {
    // --- the dialogue ---
    {"line_format", "RS232", "What are the speed and format of the line?", "9600_8n1", kProposal,
     "The manual gives none. Use `baud` in the bench for another speed."},
    {"line_end", "RS232", "What ends a command line besides CR?", "lf_of_a_line_that_is_not_empty|cr_alone",
     kProposal,
     "The list says to type ENTER or to send CHAR13. An LF after CR is ignored. With cr_alone, every LF is "
     "ignored."},
    {"echo", "RS232", "Are characters echoed as they are typed?", "off|on", kProposal,
     "A host program reads only replies. With on, the echo suits a terminal, and BS and DEL edit the line."},
    {"prompt", "RS232", "What is sent after each completed line?", "none|greater_than", kProposal,
     "As with echo: a host program reads only replies."},
    {"acknowledgement", "RS232", "What is the reply to a command that succeeds and is not a query?",
     "nothing|ok", kProposal, "The list shows no replies at all."},
    {"query_reply", "RS232", "What is the reply to a query?", "value|name_and_value", kProposal,
     "Other ASCII controllers reply with the bare value."},
    {"error_reply", "RS232", "What is the reply to a command that fails?", "err_number|nothing", kProposal,
     "The list has ?ERR and ?ERC but no codes. The reply is ERR n, with n from docs/slim.md."},
    {"letter_case", "RS232", "Are commands in lower case accepted?", "yes", kFollows,
     "The list itself writes ?t1err and ?time."},
    {"unasked_text", "OUT", "What does the chain send without a request?",
     "out_in_a_program_only|errors_of_a_program_too", kProposal,
     "The errors of a program are stored. If they were sent, they would look like replies to the typed "
     "command."},
    {"flow_control", "RS232", "Does the line use XON and XOFF?", "none|xon_xoff", kProposal,
     "The manual is silent. With xon_xoff, the host can pause the output. The chain never pauses the host."},
    {"output_end", "OUT", "What ends a line of output?", "cr_lf|cr", kLikely,
     "Terminals show it as a new line."},
    {"input_mask", "?IN", "What is the reply to ?IN without a number?", "mask_of_all_eight|error_1",
     kProposal, "Bit 0 is input 1."},
    {"status_bits", "?ST", "What does ?ST show?", "bits_of_docs_slim_md|the_same_in_hexadecimal", kProposal,
     "The manual does not describe its contents."},
    {"mode_codes", "?MD", "What does ?MD show?", "codes_of_docs_slim_md|words", kProposal,
     "The manual does not describe its contents."},
    {"time_format", "?time", "How is ?time formatted?", "h_mm_ss|seconds", kProposal,
     "?TM gives the seconds."},
    // --- when a command may be given ---
    {"ineffective_pause", "TAREDO", "What do TAREDO and TAUPZ do outside a pause?", "silent|error_3", kLikely,
     "The list says that they are valid only in a pause. It does not say that they are errors elsewhere."},
    {"lines_for_a_number", "GETI", "Which lines besides a number are accepted while a program waits for one?",
     "what_steers_the_chain|numbers_only", kLikely,
     "TAPZ, TASTOP and TVM= are marked external without exception. A host that has paused the chain must be "
     "able to resume it."},
    {"get_number_exit", "GETI", "What ends a program that waits for a number?", "exit|nothing", kProposal,
     "The line is not parsed as a command during the wait, but a host that gives up needs a way out."},
    {"get_number_typed", "GETI", "What do GETI and GETR do in a typed line?", "error_3", kLikely,
     "Only a program waits for the number. For a typed line nothing waits."},
    {"busy", "緩衝區", "What happens to commands that arrive during a motion?", "wait_in_the_buffer|error_3",
     kFollows,
     "The list mentions a buffer, and commands that bypass it. With error_3, a program's command waits."},
    // --- programs ---
    {"print_ahead", "OUT", "How far can a program's output run ahead of the line?",
     "1024_characters_then_it_waits|128_characters_then_it_waits", kProposal,
     "Without a limit, a loop with OUT would fill any memory."},
    {"pause_in_program", "TAPZ", "What happens to a program that reaches a motion in a pause?",
     "waits|error_6", kProposal, "Otherwise a pause would end the program."},
};

inline constexpr ChoiceRow kChainChoices[] = {
    // --- motion ---
    {"thrust", "FT", "What does FT do to the position?", "stands|runs_at_vj", kProposal,
     "FT pushes against an object. The list gives no unit and no load."},
    {"thrust_end", "FT", "What ends a thrust?", "jg0_a_jog_or_a_stop|a_move_too", kProposal,
     "A later move waits, as it does after a jog. With a_move_too, it begins at once."},
    {"done", "DN", "What does DN wait for?", "moves_and_all_in_the_buffer|jogs_thrust_and_pulses_too",
     kLikely,
     "Jogs and FT have no end of their own. With jogs_thrust_and_pulses_too, DN waits until JG0 and until "
     "the end of PLS."},
    {"new_speed", "VM, VJ", "When does a new working or jog speed take effect?", "next_motion|at_once",
     kProposal, "The list says only of TVM that it may change during motion."},
    {"sar_height", "SAR", "Is the fz of SAR relative? The sentence in the list breaks off.",
     "relative|absolute", kLikely, "The centre of SAR is relative."},
    {"coordinate_in_motion", "CS", "What does CS do during a motion?", "in_its_turn|error_3", kProposal,
     "Outputs behave like this."},
    {"reset", "RESET", "What does RESET clear?", "error_motion_and_buffer|coordinate_too|pause_too",
     kProposal,
     "The coordinate stays. With pause_too, the RESET of T0 ends a pause and drops everything that it "
     "holds."},
    {"outputs_at_stop", "TASTOP", "What do TASTOP and RESET do to PLS, PWM and P1SET?", "go_on|end",
     kProposal,
     "The list names only axes and motor control. Buffered outputs are dropped in any case, and levels "
     "stay."},
    {"output_order", "OUTP", "Which output is bit 0 of OUTP?", "p1|p4", kLikely, "The manual is silent."},
    {"position_outputs", "P1SET", "When does P1SET act?",
     "once_from_either_side_on_the_commanded_position|each_time_from_either_side_on_the_commanded_position",
     kProposal,
     "The manual is silent. The alternative acts each time until a new P1SET, RESET or power-off."},
    {"pause_and_program", "PZ", "Does PZ also pause the program?", "program_goes_on|program_pauses_too",
     kProposal,
     "In the example ON EV1,$PPZ a routine gives PZ, and it could not reach its REDO otherwise. A line that "
     "moves waits in any case."},
    {"clear_buffer_in_pause", "CLR BUF", "What does CLR BUF drop in a pause?",
     "what_is_half_done_too|what_waits", kProposal,
     "TAUPZ drops the same. During motion the interrupted move is finished. With what_waits, it is also "
     "finished after REDO."},
    {"pauses", "PZ", "Are the pauses of PZ and TAPZ the same pause?", "each_ends_by_its_own|one_pause",
     kProposal,
     "REDO and CLR BUF belong to PZ, and TAREDO and TAUPZ to TAPZ, in two lists. Only the list of TAPZ says "
     "that motions are refused. With one_pause, PZ is TAPZ."},
    {"pause_scope", "PZ", "Which modules does PZ pause?", "all_modules|t0", kProposal,
     "PZ has no prefix. With t0, it pauses T0 and the modules coordinated with it, unless PZ is TAPZ."},
    {"jog_while_moving", "JGF", "What does a jog do while a queued move runs?", "error_3|ends_the_move",
     kProposal, "Jogs are not queued. With ends_the_move, queued commands are dropped too."},
    {"arc", "AA", "What are the three numbers of AA?", "centre_and_angle|end_point_and_radius", kLikely,
     "Part 2 and the examples decide. Part 1 has the end point, a radius, and a left turn of at most half a "
     "circle, or the longer way if the radius is below 0."},
    {"line_speed", "PR4", "Which speed do 2MA and 2MR use? PR4 is printed for the former.",
     "pr3_which_pr4_names_too|pr4_of_its_own", kLikely,
     "PR4 is in no list, all other commands use PR3, and the list says that TVM= changes the speed."},
    {"spiral_centre", "SPI", "Is the centre X, Y of SPI absolute?", "absolute|relative", kProposal,
     "AA uses an absolute centre."},
    {"spiral_r", "SPI", "What is R of SPI?", "sweep|radius_at_its_end", kProposal,
     "As a radius, L is the growth of each turn, whatever `spiral` says, and the spiral turns left. Growth "
     "in the wrong direction is error 2."},
    {"spiral", "SPI", "What are R and L of SPI?",
     "sweep_in_degrees_and_growth_a_turn|sweep_in_degrees_and_growth_in_all", kProposal,
     "The manual does not explain them."},
    {"emergency_stop", "TASTOP", "What state does TASTOP leave?",
     "nothing_queued_not_paused_servo_on|nothing_queued_not_paused_servo_off", kProposal,
     "The manual is silent."},
    {"emergency_stop_program", "TASTOP", "What does TASTOP do to a running program?",
     "ends_unless_it_stops_by_its_own_line|ends_also_by_its_own_line|goes_on", kProposal,
     "DN would let the program continue with its next move at once. A program's own TASTOP may have lines to "
     "run after it: an event's routine runs to its RET, and the interrupted program does not continue."},
    {"acceleration_in_motion", "TVA", "What does TVA or PR2 do for a module on a path?",
     "error_3|next_command", kLikely,
     "The value must not change during motion. Commands that are already issued keep their own."},
    {"path_speed_in_motion", "PR3", "What does PR3= of one module (not TVM=) do while it is on a path?",
     "at_once_for_the_whole_path|at_once_if_x_has_it|next_command", kLikely,
     "The list says that it changes the speed of the one module, and that the path suffers. The amount is "
     "not modelled: the path uses the last value of any of its modules."},
    {"joint", "CM", "Whose CM counts at a joint?", "both_commands_allow_it|second_command_decides", kProposal,
     "The manual is silent."},
    {"late_successor", "CM", "What happens to a command that arrives while the one before it decelerates?",
     "begins_from_rest|speeds_up_again", kProposal, "The manual is silent."},
    {"path_without_length", "2MA", "What does a path of length 0 do?", "is_over_at_once|error_2", kProposal,
     "It is not an error."},
    {"buffer_length", "CLR BUF", "How many commands can wait for a module?", "32|16|8", kProposal,
     "The manual is silent."},
    {"single_axis_profile", "VM", "How do moves of one axis accelerate?",
     "trapezoid_with_va|trapezoid_with_tva", kProposal,
     "The list names no acceleration. VA follows the pattern of TVA and TVM."},
    {"homing", "H", "How does H home?", "at_vj_backwards_to_horg_then_0|at_vj_forwards_to_horg_then_0",
     kProposal, "The list says only \"in horg\"."},
    {"analog_speed_of", "AVM", "Which speeds does AVM scale by AIN / 1000?", "moves_and_jogs|moves",
     kProposal, "The list names the motor's speed. The scale lasts until VM= or RESET."},
    {"working_speed_shown", "?VM", "What does ?VM show while AVM is in force?",
     "as_set|as_the_analog_input_leaves_it", kProposal,
     "It is a parameter, and also the present working speed."},
    {"analog_speed", "AVM", "Does AVM start a motion?", "sets_the_speed_only|starts_a_jog", kProposal,
     "The manual is silent."},
    {"pulses_per_revolution", "VM", "How many pulses make a revolution of the motor?", "10000|4000|2000|1000",
     kProposal, "The manual is silent. Speeds are in revolutions."},
    {"pwm_resolution", "PWM", "What is the resolution of PWM?", "milliseconds", kProposal,
     "Outputs change once a millisecond: 100 Hz at 25 % is on for 3 of 10. Above 500 Hz the output keeps the "
     "level that prevails."},
    {"pwm_units", "PWM", "What are the units of PWM?", "hz_and_percent|khz_and_percent", kProposal,
     "The manual is silent."},
    // --- modules and numbers ---
    {"module_count", "T1H", "How many modules can a chain have?", "8", kFollows,
     "Part 2 names T0 to T7, and PN50 has 8 bits. Part 1 mentions 16 for homing, so T8 and above are error "
     "2."},
    {"linked_from_factory", "PN50", "Which modules are linked from the factory, and after DF?",
     "all_of_the_bench|t0_alone", kProposal,
     "The chain starts as its machine builder would have set it up. The manual prints only T0, and then PN50 "
     "links the others."},
    {"user_unit", "PN45", "Which parameters define the user unit?",
     "pn45_pulses_are_pn46_units|pn44_pulses_are_pn45_units|pn46_pulses_are_pn45_units", kProposal,
     "The commands name PN45 and PN46, while PR2 and PR3 name PN44 and PN45. The manual does not explain "
     "either pair."},
    {"unlinked_module", "PN50", "What is the reply to a command for a module that is not linked?",
     "error_5|silence", kProposal,
     "The manual gives no error code. With silence, no module is there to reply."},
    {"unequal_speeds", "PR2, PR3",
     "What does a coordinated command do while PR2 or PR3 differs between its modules?",
     "error_7|as_t0_has_them", kProposal,
     "The manual says that interpolation goes wrong then, but not in a way that we could compute."},
    {"axis_values", "TX", "What does TX= do with 6 or 7, or with a module that has a letter?",
     "error_2|is_taken_from_its_letter", kProposal,
     "The list gives 0 to 5 and 8. 6 and 7 are error 2 in any case."},
    {"axis_map_kept", "PN37", "Does TX= change PN37?", "no|yes", kProposal, "PN37 is for power-up."},
    {"reserved_module", "TX", "Which commands are refused for a module with a letter, except T0?",
     "moves_jogs_homing_and_thrust_by_number|moves_by_number", kLikely, "The manual names P2P commands."},
    {"factory_values", "PR2, PR3", "What are the factory values that the manual does not give?",
     "of_docs_slim_md", kProposal,
     "They are TVA 1000, TVM 100, VM 1000, VJ 100, VA 10000, PR7 0, PN44 to PN46 1. Use `set` in the bench "
     "for others."},
    {"defaults_kept", "DF", "Are the values that DF sets persistent?", "by_save_c|at_once", kProposal,
     "Any parameter behaves like this."},
    {"error_codes", "?ERR", "What are the error codes?", "of_docs_slim_md|1_for_all", kProposal,
     "The manual gives none."},
    {"error_of", "?ERR", "Which ?ERR and ?ERC show the error of a command for T1?",
     "t0_of_the_line_t1_of_its_motor|t0", kProposal,
     "T0 reads the line, so errors 1, 2 and 13 are its own. Errors that end a program belong to T0 too."},
    {"real_format", "R#", "How is a real number written?", "plain_digits|exponent_of_the_large_and_small",
     kLikely,
     "The list shows 0.01 and -720 and no exponent. An exponent is possible from 1e9 and below 1e-4."},
    {"coordinate_shown", "?PE", "How is a coordinate shown if a 32-bit real cannot hold it?",
     "every_pulse|as_32_bits_hold_it", kLikely,
     "The axis counts every pulse, although the manual says that parameters are 32-bit reals."},
    {"variables_kept", "N#, R#", "When are N# and R# saved?", "by_save_d|when_written", kLikely,
     "The manual says that both are in the flash. SAVE D would have no purpose if each write saved them."},
    {"array_types", "NS", "What does NS() hold?", "whole_numbers", kLikely,
     "The text under NS is a copy of the text under RS, with its range. N is an integer in every other "
     "name."},
    {"arrays_kept", "NS, RS", "When are the arrays saved?", "when_written|by_save_d", kProposal,
     "The manual says that they are in the flash."},
    {"analog_assignment", "AIN", "Which side of AIN=N# receives the value?", "the_variable", kFollows,
     "The text says so. N#=AIN is accepted as well."},
    {"clock_assignment", "TM", "Which side of TM=N# receives the value?", "the_clock|the_variable", kLikely,
     "TM is writable and AIN is not."},
    {"speed_parameters", "FU", "Which of PN10 and PN14 is VM?", "pn10_is_vm|pn14_is_vm", kProposal,
     "The manual is silent."},
    {"power_up_servo", "HON", "Is motor control on at power-up?", "on|off", kProposal,
     "MA 10000 is first in the list, without HON."},
    {"history_length", "?ERC", "How many errors does the history hold?", "16|8|4", kProposal,
     "The manual is silent."},
    {"history_kept", "?ERC", "How long is the history kept?", "until_power_off|for_ever", kProposal,
     "With for_ever, memory files hold it too."},
    {"version_shown", "?VER", "How is the software version written?", "with_a_point|as_a_number", kProposal,
     "The version is 1.00, because the manual names no particular one."},
    {"motor_version", "?MT", "Which motor version is shown?", "1|2", kProposal,
     "The manual is silent, and nothing depends on it."},
    {"voltage", "?AC", "Which input voltage is shown?", "24|36|48", kProposal,
     "The voltage is not modelled."},
    {"temperature", "?TEMP", "Which temperature is shown?", "25|40|60", kProposal,
     "The temperature is not modelled."},
};

inline constexpr auto kChoices = [] {
  namespace language = interpreter::slim;
  std::array<ChoiceRow,
             std::size(kDialogueChoices) + std::size(language::kChoices) + std::size(kChainChoices)>
      all{};
  std::size_t next = 0;
  for (const ChoiceRow& row : kDialogueChoices) all[next++] = row;
  for (const ChoiceRow& row : language::kChoices) all[next++] = row;
  for (const ChoiceRow& row : kChainChoices) all[next++] = row;
  return all;
}();

/// The position of the language's rows in the table.
inline constexpr std::size_t kFirstOfLanguage = std::size(kDialogueChoices);

}  // namespace understudy::emulator::models::slim
