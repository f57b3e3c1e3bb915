// RS-M8194H's choices about macros, their downloads, and the interrupts that call them.
#pragma once

#include "emulator/models/rs_m8194h/rows/choice_words.h"

namespace understudy::emulator::models::rs_m8194h {

inline constexpr ChoiceRow kMacroChoices[] = {
    {"steps_a_tick", "1.2", "How many macro lines and FIFO commands run in 1 ms in total?", "8|1|32|1000",
     kProposal, "The manual gives no times at all."},
    {"isr_delay", "7.3.12", "When does the first line of an ISR run?", "next_tick|same_tick", kProposal,
     "The manual gives no latency."},
    {"isr_requests", "7.3.12", "What happens to a factor that fires again before its ISR begins?",
     "lost|counted", kLikely, "Such chips have one flag for each factor."},
    {"isr_binding", "7.3.12", "Which ISR runs if the binding changes before it begins?",
     "at_its_begin|at_the_event", kProposal, "The manual is silent."},
    {"first_line", "9.1.3", "When does the first line of a called MP run?", "next_tick|on_receipt", kProposal,
     "The manual gives no time."},
    {"calls_while_an_mp_runs", "12.1.12",
     "What do MP_CALL, MP_ISR_CALL and LOAD_INITIAL do while an MP runs?",
     "exception_6|exception_3|wait_their_turn", kProposal,
     "The manual prints a reason for it, but not the commands."},
    {"download_beside_macro", "4.16.1", "What do MP_CREATE and MP_ISR_CREATE do while a macro runs?",
     "refused_beside_an_mp|refused_beside_an_isr_too|taken", kProposal,
     "The printed reason names a running macro. An ISR ends soon."},
    {"fifo_while_macro", "12.1.12", "What does the FIFO do while a macro runs?", "held|goes_on", kFollows,
     "The box has one processor. One printed reason for a refusal is a running macro."},
    {"isr_order", "7.3.12", "In which order do interrupts of the same tick run?",
     "by_axis|by_factor|by_isr_number|by_order_of_enabling", kProposal,
     "The manual does not mention priorities."},
    {"failed_download", "9.12", "What happens to the existing macro after a download with an error?",
     "stays|empties_it", kProposal, "A macro that worked before should still work."},
    {"macro_errors", "9.12",
     "What is the reply to a line, or CLOSE, with an error of macro memory or structure?",
     "exception_3|an_echo", kLikely, "Input 102 has reasons for them, and it describes exceptions."},
};

}  // namespace understudy::emulator::models::rs_m8194h
