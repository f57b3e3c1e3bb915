#include "interpreter/slim/availability.h"

#include <cstddef>

namespace understudy::interpreter::slim {
namespace {

/// For rows without columns: what makes sense in a program only, and what makes sense typed only.
bool is_for_programs(Verb verb) {
  switch (verb) {
    case Verb::jump:
    case Verb::jump_if:
    case Verb::jump_if_within:
    case Verb::call:
    case Verb::return_:
    case Verb::wait_input:
    case Verb::wait_time:
    case Verb::wait_done: return true;
    default: return false;
  }
}

/// What a host does to a memory; some machines have their programs do it, too.
bool is_save(Verb verb) {
  return verb == Verb::save_data || verb == Verb::save_parameters || verb == Verb::save_program ||
         verb == Verb::default_parameters;
}

bool is_for_hosts(const CommandRow& row) {
  switch (row.verb) {
    case Verb::run:
    case Verb::program_new:
    case Verb::program_append:
    case Verb::program_list:
    case Verb::program_edit:
    case Verb::program_insert:
    case Verb::program_delete:
    case Verb::upload:
    case Verb::download:
    case Verb::exit:
    case Verb::list_parameters:
    case Verb::reboot: return true;
    default: return row.is_query() || is_save(row.verb);
  }
}

/// What a host needs although the column 外部 does not print it: to look, and to get out of a pause.
bool is_let_through(const CommandRow& row) {
  switch (row.verb) {
    case Verb::resume_all:
    case Verb::abandon_all:
    case Verb::pause:
    case Verb::redo:
    case Verb::clear_buffer:
    case Verb::set_port_now:
    case Verb::clear_port_now:
    case Verb::servo_on_now:
    case Verb::servo_off_now: return true;
    default: return row.is_query();
  }
}

bool is_variable_form(const CommandRow& row) { return row.slots[0] == Slot::real_variable; }

}  // namespace

bool is_allowed(const Command& command, Place place, const Columns& columns) {
  const CommandRow& row = kCommands[static_cast<std::size_t>(command.row)];
  // What is typed has nobody to wait for a number.
  if (place != Place::program && asks_host(command)) return false;
  switch (place) {
    case Place::program:
      if (row.program != Printed::nothing) return row.program == Printed::yes;
      return !is_for_hosts(row) || (columns.saves == Columns::Saves::stored_too && is_save(row.verb));
    case Place::immediate:
      if (row.immediate == Printed::nothing) return !is_for_programs(row.verb);
      if (row.immediate == Printed::yes) return true;
      return columns.variable_forms == Columns::VariableForms::typed_too && is_variable_form(row);
    case Place::external:
      // It leaves a running program: nowhere else has it a meaning.
      if (row.external == Printed::yes || row.verb == Verb::exit) return true;
      if (row.verb == Verb::reset) return columns.external == Columns::External::with_reset;
      return columns.external != Columns::External::strict && is_let_through(row);
  }
  return false;
}

}  // namespace understudy::interpreter::slim
