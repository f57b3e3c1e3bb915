// RS-M8194H: what its manual leaves open, and what we do. docs/fidelity/rs-m8194h.md is made from these rows.
#pragma once

#include "emulator/device/choices.h"

namespace understudy::emulator::models::rs_m8194h {

inline constexpr Confidence kFollows = Confidence::follows;
inline constexpr Confidence kLikely = Confidence::likely;
inline constexpr Confidence kProposal = Confidence::proposal;

inline constexpr ChoiceRow kChoices[] = {
    // --- macros, their downloads and interrupts ---
    {"steps_a_tick", "1.2", "lines of macros and commands of the FIFO together in 1 ms", "8|1|32", kProposal,
     "the manual gives no time at all"},
    {"close_line", "9.12", "what CLOSE takes of a macro's room", "nothing|one_line", kFollows,
     "the printed program of MP59 fills 16 lines of 16 without it"},
    {"download_command", "9.12", "the code in input 112", "as_0a_code|as_sent", kFollows,
     "the worked example shows 0AD6 for NEXT, which is sent as 0CD6"},
    {"refused_lines", "9.12", "download lines that are refused for their class, count or a parameter",
     "are_left_out|spoil_the_download", kFollows, "the download's errors have no code for them"},
    {"rectangle_radius", "7.4.1", "corners of a rectangle that are longer than half a side",
     "exception_3|drawn_shorter", kProposal, "Rp has a range of its own only"},
    {"mp_during_isr", "9", "an MP while an ISR runs", "suspended|goes_on_while_it_waits", kFollows,
     "it is an interrupt"},
    {"isr_nesting", "9", "an ISR while another one runs", "comes_after_it|nested", kProposal,
     "nothing is said of priorities"},
    {"isr_waits", "5.3", "lines of an ISR that have to wait", "wait|are_passed_over", kProposal,
     "FRNET_WAIT is allowed there"},
    {"isr_delay", "7.3.12", "when the first line of an ISR runs", "next_tick|same_tick", kProposal,
     "no latency is given"},
    {"isr_requests", "7.3.12", "a factor that fires again before its ISR has begun", "lost|counted", kLikely,
     "such chips have a flag for each"},
    {"isr_binding", "7.3.12", "whose ISR runs when it is bound anew meanwhile", "at_its_begin|at_the_event",
     kProposal, "not said"},
    {"return_registers", "9.3.2", "the return value of GET in MP and ISR", "one_each|one_for_both", kProposal,
     "with one for both an ISR spoils what an MP has read"},
    {"return_register_keeps", "9.3.2", "SET_RVAR without a GET since the last one",
     "stores_the_same_again|execution_error", kProposal, "it is to stand directly behind the GET"},
    {"timer_negative", "9.8", "a negative time from a variable", "is_0|execution_error", kProposal,
     "constants begin at 0"},
    {"call_too_deep", "9.1.3", "behind a call of the eighth level, which is not carried out",
     "next_line|ends_the_macro", kProposal, "at most to the seventh level"},
    {"frnet_wait_level", "5.3", "FRNET_WAIT for a level that is there already", "passes|waits_for_the_change",
     kProposal, "it waits for the input to trigger"},
    // --- the line and the tables ---
    {"broadcast", "2.1.3", "a request to address 0", "obeyed_silently", kLikely,
     "Modbus broadcast; the manual knows stations 1 to 247 only"},
    {"silent_time", "14.1", "the silence that ends a frame", "3ms", kFollows,
     "Silent Time of the settings' screen; User Silent Time is 0 there"},
    {"response_delay", "14.1", "when a reply begins", "after_silent_time", kProposal,
     "the manual gives no time of its own"},
    {"holes", "12.1", "words between the printed rows", "read_zero", kFollows,
     "two of them are printed as undefined and 0"},
};

}  // namespace understudy::emulator::models::rs_m8194h
