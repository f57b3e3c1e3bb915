// Verbs grouped by the part that executes them. The machine (machine.h) executes all verbs that flow.h and
// editor.h do not.
#pragma once

#include <algorithm>
#include <span>

#include "interpreter/slim/command_row.h"

namespace understudy::interpreter::slim {

/// Verbs that flow.h executes, in a program.
inline constexpr Verb kFlowVerbs[] = {
    Verb::jump,     Verb::jump_if,     Verb::jump_if_within, Verb::call,
    Verb::return_,  Verb::wait_input,  Verb::wait_time,      Verb::set_event,
    Verb::on_event, Verb::get_integer, Verb::get_real,
};

/// Verbs that begin_edit() of editor.h executes, when typed.
inline constexpr Verb kEditingVerbs[] = {
    Verb::program_new,    Verb::program_append, Verb::program_edit,
    Verb::program_insert, Verb::program_delete, Verb::download,
};

/// Verbs that make a decision: a jump is taken or not, or a wait ends at once or not.
inline constexpr Verb kDecidingVerbs[] = {Verb::jump_if, Verb::jump_if_within, Verb::wait_input,
                                          Verb::wait_done};

constexpr bool is_one_of(std::span<const Verb> verbs, Verb verb) {
  return std::ranges::find(verbs, verb) != verbs.end();
}

}  // namespace understudy::interpreter::slim
