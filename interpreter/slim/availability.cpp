#include "interpreter/slim/availability.h"

#include <cstddef>

#include "interpreter/slim/command.h"
#include "interpreter/slim/command_row.h"
#include "interpreter/slim/commands.h"
#include "interpreter/slim/options.h"
#include "interpreter/slim/verbs.h"

namespace understudy::interpreter::slim {
namespace {

// For rows that have no columns: commands that make sense only in a program, and commands that make sense
// only if typed.
constexpr Verb kForPrograms[] = {
    Verb::jump,    Verb::jump_if,    Verb::jump_if_within, Verb::call,
    Verb::return_, Verb::wait_input, Verb::wait_time,      Verb::wait_done,
};
constexpr Verb kForHosts[] = {
    Verb::run,          Verb::program_new,    Verb::program_append,  Verb::program_list,
    Verb::program_edit, Verb::program_insert, Verb::program_delete,  Verb::upload,
    Verb::download,     Verb::exit,           Verb::list_parameters, Verb::reboot,
};

/// Commands with which a host changes the memory. On some machines, programs can also use them.
constexpr Verb kSaves[] = {Verb::save_data, Verb::save_parameters, Verb::save_program,
                           Verb::default_parameters};

/// Commands that a host needs although they are not in the column 外部, such as those that end a pause.
constexpr Verb kLetThrough[] = {
    Verb::resume_all,   Verb::abandon_all,    Verb::pause,        Verb::redo,          Verb::clear_buffer,
    Verb::set_port_now, Verb::clear_port_now, Verb::servo_on_now, Verb::servo_off_now,
};

bool is_save(Verb verb) { return is_one_of(kSaves, verb); }
bool is_for_hosts(const CommandRow& row) {
  return is_one_of(kForHosts, row.verb) || row.is_query() || is_save(row.verb);
}
bool is_let_through(const CommandRow& row) { return is_one_of(kLetThrough, row.verb) || row.is_query(); }

bool takes_real_variable(const CommandRow& row) { return row.slots[0] == Slot::real_variable; }

}  // namespace

bool is_allowed(const Command& command, Place place, const Options& options) {
  const CommandRow& row = kCommands[static_cast<std::size_t>(command.row)];
  // A typed command cannot wait for a number.
  if (place != Place::program && asks_host(command)) return false;
  switch (place) {
    case Place::program:
      if (row.program != Printed::nothing) return row.program == Printed::yes;
      return !is_for_hosts(row) ||
             (is_save(row.verb) && options.chose(option("first_list_columns", "saves_in_programs_too")));
    case Place::immediate:
      if (row.immediate == Printed::nothing) return !is_one_of(kForPrograms, row.verb);
      if (row.immediate == Printed::yes) return true;
      return takes_real_variable(row) && options.chose(option("immediate_column", "taken"));
    case Place::external:
      // EXIT leaves a running program. Elsewhere, it has no meaning.
      if (row.external == Printed::yes || row.verb == Verb::exit) return true;
      if (row.verb == Verb::reset) return options.chose(option("while_program_runs", "reset_too"));
      return is_let_through(row) && !options.chose(option("while_program_runs", "external_column_only"));
  }
  return false;
}

}  // namespace understudy::interpreter::slim
