// Verbs by who carries them out. What is in none of these lists is the machine's (machine.h).
#pragma once

#include <algorithm>
#include <span>

#include "interpreter/slim/command_row.h"

namespace understudy::interpreter::slim {

/// By flow.h, in a program.
inline constexpr Verb kFlowVerbs[] = {
    Verb::jump,     Verb::jump_if,     Verb::jump_if_within, Verb::call,
    Verb::return_,  Verb::wait_input,  Verb::wait_time,      Verb::set_event,
    Verb::on_event, Verb::get_integer, Verb::get_real,
};

/// By begin_edit() of editor.h, when typed.
inline constexpr Verb kEditingVerbs[] = {
    Verb::program_new,    Verb::program_append, Verb::program_edit,
    Verb::program_insert, Verb::program_delete, Verb::download,
};

constexpr bool is_one_of(std::span<const Verb> verbs, Verb verb) {
  return std::ranges::find(verbs, verb) != verbs.end();
}

}  // namespace understudy::interpreter::slim
