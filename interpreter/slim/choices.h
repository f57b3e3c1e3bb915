// What SLIM's command list leaves open about lines and programs, and what we chose. These rows are part of
// the model's table, so a bench can override them and docs/fidelity/slim.md lists them.
#pragma once

#include <array>

#include "base/choices.h"

namespace understudy::interpreter::slim {

inline constexpr auto kChoices = std::to_array<ChoiceRow>({
    // --- lines ---
    {"longest_line", "RS232", "What happens to a line that is too long?",
     "127_characters_then_error_1|80_characters_then_error_1|255_characters_then_error_1",
     Confidence::proposal, "The limit is longer than every form in the list, with room to spare."},
    {"helix_variables", "SAA", "Which operands does the form of SAA with variables accept?",
     "constants_for_angle_and_height_too|four_variables", Confidence::likely,
     "The manual prints Rx,Ry,fa,fz and explains Rx,Ry,Ra,Rz, so both are accepted."},
    {"functions", "JE", "Which functions can replace a number?", "ain_tm_geti_getr|what_queries_show_too",
     Confidence::proposal,
     "The list says \"constant, variable or function\" and names no function. It applies to assignments, "
     "jumps and events."},
    {"integer_range", "N#", "What is the range of integer variables?", "16_bits|from_minus_32766",
     Confidence::likely, "The manual prints MAX N0=32766."},
    // --- where a command is allowed ---
    {"while_program_runs", "立即/外部", "Which other commands are accepted while a program runs?",
     "queries_and_what_steers_it|external_column_only|reset_too", Confidence::proposal,
     "Read strictly, a host could not resume a program that it has paused, because TAREDO has no mark under "
     "external. RESET would stop a motor and let DN continue with its next move."},
    {"immediate_column", "立即",
     "What happens if you type a form with variables that has no mark under immediate?", "error_3|taken",
     Confidence::follows, "The printed column decides."},
    {"first_list_columns", "程式/立即",
     "Where are commands of the first list allowed? The list prints no columns.",
     "flow_stored_queries_and_editing_typed_others_both|saves_in_programs_too", Confidence::likely,
     "Their kind suggests it. SAVE C, SAVE D, SAVE P and DF might be allowed in a program."},
    // --- how a program is entered ---
    {"program_size", "PG", "How long can a program be?", "1000_lines|256_lines|4000_lines",
     Confidence::proposal, "The manual is silent."},
    {"program_check", "PG", "When is a line of a program checked?", "when_it_is_entered|when_it_runs",
     Confidence::proposal,
     "Addresses and modules are checked when the line runs, because lines arrive one after the other and "
     "PN50 may link a module later."},
    {"same_label", "addr", "What does a second line with the same label do?",
     "error_13_as_it_is_entered|the_first_counts", Confidence::proposal,
     "No jump could reach it. Labels in lower case are the same as in upper case."},
    {"addresses", "addr", "What does a plain number mean as an address?",
     "line_number_from_0|line_number_from_1", Confidence::likely,
     "G without an address starts at address 0."},
    {"edit_end", "PG", "What ends editing?", "empty_line_exit_or_esc|exit_or_esc", Confidence::proposal,
     "EXIT also leaves a running program."},
    {"refused_line", "PE", "What happens after a refused line while PE or PI wait for one?",
     "is_asked_for_again|ends_editing", Confidence::proposal,
     "PG behaves like this. With ends_editing, the next line is a command, and the chain would carry out a "
     "move that was meant for the program."},
    {"listing", "PL", "How does PL print a line?", "number_colon_text|text", Confidence::proposal,
     "Addresses use the same numbers."},
    // --- how a program runs ---
    {"lines_a_tick", "G", "How fast does a program run?",
     "one_a_millisecond|four_a_millisecond|one_in_4_milliseconds", Confidence::proposal,
     "The manual is silent."},
    {"time_unit", "JTI", "What is the unit of tm in JTI and JNTI?", "milliseconds|4_milliseconds",
     Confidence::likely, "WT uses this unit. PLS uses the other."},
    {"call_depth", "CALL", "How deep can subroutines be nested?", "16|8|4", Confidence::proposal,
     "The manual is silent."},
    {"bare_number", "GETI", "Where does the number of GETI or GETR without an assignment go?",
     "nowhere|into_n0_or_r0", Confidence::proposal,
     "N0=GETI says where. Without it, the line only waits for the host."},
    {"failed_line", "G", "What does a refused line do to its program?", "ends_it|is_passed_over",
     Confidence::proposal, "A program that continued without one of its moves could cause a collision."},
    // --- events ---
    {"events", "SET EV", "How many events exist, and which conditions do they take?",
     "8_with_the_conditions_of_jumps|4_with_the_conditions_of_jumps", Confidence::proposal,
     "The manual shows only NZ."},
    {"event_check", "ON EV", "How often are conditions checked?", "each_millisecond|each_4_milliseconds",
     Confidence::proposal, "The manual is silent."},
    {"event_at_arming", "ON EV",
     "What happens to an event whose condition is already true at its definition?",
     "fires|waits_for_a_change", Confidence::proposal, "The manual is silent."},
    {"held_event", "ON EV",
     "What happens to an event that occurs during another one's routine and is false again at its RET?",
     "fires|is_dropped", Confidence::proposal, "The manual is silent."},
    {"interrupted_wait", "ON EV", "What do WT and JTI do after an event interrupts them?",
     "begin_again|have_gone_on", Confidence::proposal, "The program enters the line again."},
    {"events_without_program", "SET EV", "What happens to an event that is defined while no program runs?",
     "waits_for_a_program|run_their_routine", Confidence::proposal,
     "The event is armed, and checked from G on. Its routine is part of a program."},
});

}  // namespace understudy::interpreter::slim
