// SLIM: what its command list leaves open, and what we chose. The list gives names and meanings of commands
// and hardly anything of the dialogue around them, so most rows are proposals. docs/fidelity/slim.md is made
// from these rows; a bench overrides one with `choices: { ID: OPTION }`.
#pragma once

#include "emulator/choices.h"

namespace understudy::emulator::slim {

inline constexpr Confidence kFollows = Confidence::follows;
inline constexpr Confidence kLikely = Confidence::likely;
inline constexpr Confidence kProposal = Confidence::proposal;

inline constexpr ChoiceRow kChoices[] = {
    // --- the dialogue ---
    {"line_format", "RS232", "speed and format of the line", "9600_8n1", kProposal,
     "none is given; a bench sets another speed with `baud`"},
    {"line_end", "RS232", "what ends a command line besides CR", "lf_of_a_line_that_is_not_empty", kProposal,
     "the list types ENTER, or sends CHAR13; LF after CR is ignored"},
    {"longest_line", "RS232", "a line that is too long", "127_characters_then_error_1", kProposal,
     "longer than every form of the list with room to spare"},
    {"echo", "RS232", "whether characters are sent back as they are typed", "off|on", kProposal,
     "a host program reads replies only; on suits a terminal, and lets BS and DEL edit"},
    {"prompt", "RS232", "what is sent after each completed line", "none|greater_than", kProposal, "as echo"},
    {"acknowledgement", "RS232", "what a command that succeeds and is no query is answered", "nothing|ok",
     kProposal, "the list shows no answers at all"},
    {"query_reply", "RS232", "what a query is answered", "value|name_and_value", kProposal,
     "other ASCII controllers answer with the bare value"},
    {"error_reply", "RS232", "what a command that fails is answered", "err_number|nothing", kProposal,
     "the list has ?ERR and ?ERC but no codes; ERR n with n of docs/slim.md"},
    {"letter_case", "RS232", "whether small letters are commands as well", "yes", kFollows,
     "the list itself writes ?t1err and ?time"},
    // --- when a command may be given ---
    {"while_program_runs", "立即/外部", "what else may be typed while a program runs",
     "queries_and_what_steers_it|external_column_only", kProposal,
     "read strictly, a host that has paused a program could not resume it: TAREDO has no mark under "
     "external"},
    {"immediate_column", "立即", "a form with variables that has no mark under immediate, typed",
     "error_3|taken", kFollows, "as printed"},
    {"ineffective_pause", "TAREDO", "TAREDO and TAUPZ outside of a pause", "silent|error_3", kLikely,
     "the list says that they are valid in a pause only, not that they are wrong elsewhere"},
    {"get_number_exit", "GETI", "what ends a program that waits for a number", "exit", kProposal,
     "a line is not parsed as a command then, but a host that gives up needs a way out"},
    // --- programs ---
    {"lines_a_tick", "G", "how fast a program runs", "one_a_millisecond", kProposal, "not said"},
    {"print_ahead", "OUT", "how far a program prints ahead of its line", "1024_characters_then_it_waits",
     kProposal, "a loop with OUT would fill any memory"},
    {"call_depth", "CALL", "how deep subroutines can be nested", "16", kProposal, "not said"},
    {"failed_line", "G", "what a line that is refused does to its program", "ends_it|is_passed_over",
     kProposal, "a program that goes on without one of its moves would hit something"},
    {"event_at_arming", "ON EV", "an event whose condition is true already when it is defined",
     "fires|waits_for_a_change", kProposal, "not said"},
    {"held_event", "ON EV", "an event that came during another one's routine and is false again at its RET",
     "fires|is_dropped", kProposal, "not said"},
    {"interrupted_wait", "ON EV", "WT and JTI that an event has interrupted", "begin_again|have_gone_on",
     kProposal, "the line is entered again"},
    {"addresses", "addr", "what a plain number means as an address", "line_number_from_0", kLikely,
     "G without an address starts at address 0"},
    // --- motion ---
    {"thrust", "FT", "what FT does to the position", "stands|runs_at_vj", kProposal,
     "it pushes against something; the list gives no unit and no load"},
    {"new_speed", "VM, VJ", "when a new working or jog speed counts", "next_motion|at_once", kProposal,
     "only for TVM is it said that it may change in motion"},
    {"sar_height", "SAR", "the fz of SAR, whose sentence breaks off", "relative|absolute", kLikely,
     "its centre is relative"},
    {"buffer_length", "CLR BUF", "how many commands wait for a module", "32", kProposal, "not said"},
    {"single_axis_profile", "VM", "how moves of one axis speed up", "trapezoid_with_va", kProposal,
     "no acceleration is named; VA is by analogy with TVA and TVM"},
    {"homing", "H", "how H homes", "at_vj_backwards_to_horg_then_0", kProposal, "only \"in horg\" is said"},
    {"analog_speed", "AVM", "whether AVM starts a motion", "sets_the_speed_only", kProposal, "not said"},
    {"pulses_per_revolution", "VM", "pulses of a revolution of the motor", "10000|4000|2000|1000", kProposal,
     "not said; speeds are in revolutions"},
    {"pwm_units", "PWM", "units of PWM", "hz_and_percent", kProposal, "not said"},
    // --- modules and numbers ---
    {"unlinked_module", "PN50", "a command for a module that is not linked", "error_5", kProposal,
     "no error code is given"},
    {"unequal_speeds", "PR2, PR3", "a coordinated command while PR2 or PR3 differ between its modules",
     "error_7|as_t0_has_them", kProposal,
     "interpolation goes wrong then, in a way that nothing lets us compute"},
    {"integer_range", "N#", "the range of integer variables", "16_bits", kLikely, "MAX N0=32766"},
    {"arrays_kept", "NS, RS", "when the arrays are kept", "when_written|by_save_d", kProposal,
     "they are said to be in the flash"},
    {"analog_assignment", "AIN", "which side of AIN=N# receives", "the_variable", kFollows,
     "the text says so; N#=AIN is taken as well"},
    {"clock_assignment", "TM", "which side of TM=N# receives", "the_clock", kLikely,
     "TM can be written, AIN cannot"},
    {"speed_parameters", "FU", "which of PN10 and PN14 is VM", "pn10_is_vm", kProposal, "not said"},
    {"power_up_servo", "HON", "motor control at power-up", "on|off", kProposal,
     "MA 10000 stands first in the list, without HON"},
    {"history_length", "?ERC", "how many errors the history holds", "16", kProposal, "not said"},
    {"voltage", "?AC", "the input voltage that is shown", "24", kProposal, "nothing of it is modelled"},
    {"temperature", "?TEMP", "the temperature that is shown", "25", kProposal, "nothing of it is modelled"},
};

}  // namespace understudy::emulator::slim
