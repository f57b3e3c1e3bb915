// Implements lang::Machine: the effects of macro lines and commands on the module.
#include <cstddef>
#include <cstdint>

#include "base/complete_table.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/rs_m8194h/commands.h"
#include "emulator/models/rs_m8194h/module.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/not_implemented.h"
#include "emulator/models/rs_m8194h/rows/terminals.h"
#include "emulator/models/rs_m8194h/rows/views.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/commands.h"
#include "interpreter/rs_m8194h/machine.h"
#include "interpreter/rs_m8194h/verbs.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

using lang::Command;
using lang::Verb;

/// Returns the lowest axis of a mask, because a read refers to a single axis.
Cell cell_of_axes(const Command& command) {
  for (int a = 0; a < static_cast<int>(kAxes); ++a) {
    if (has(static_cast<AxisMask>(command.values[0]), static_cast<std::size_t>(a)))
      return {.index = a, .axis = a};
  }
  return {};
}

template <Value (*shows)(const Module&, Cell)>
std::int32_t read_axis(const Module& it, const Command& command) {
  return static_cast<std::int32_t>(shows(it, cell_of_axes(command)));
}
/// Reads one bit, which the second parameter selects.
template <Value (*shows)(const Module&, Cell)>
std::int32_t read_bit(const Module& it, const Command& command) {
  return static_cast<std::int32_t>(shows(it, cell_of_axes(command)) >> command.values[1] & 1);
}
std::int32_t read_group(const Module& it, const Command& command) { return it.frnet.word(command.values[0]); }
std::int32_t read_channel(const Module& it, const Command& command) {
  return it.frnet.word(command.values[0]) >> (command.values[1] % kFrnetChannels) & 1;
}

using Reads = std::int32_t (*)(const Module& it, const Command& command);
constexpr HandlerRow<Verb, Reads> kReads[] = {
    {Verb::get_lp, read_axis<logic_position>},
    {Verb::get_ep, read_axis<encoder_position>},
    {Verb::abs_get_position, read_axis<absolute_position>},
    {Verb::get_di, read_bit<di_all>},
    {Verb::get_di_all, read_axis<di_all>},
    {Verb::get_di_signal, read_bit<di_signal>},
    {Verb::get_di_signal_all, read_axis<di_signal>},
    {Verb::get_home_search_state, read_axis<home_state>},
    {Verb::get_error, read_axis<error_state>},
    {Verb::get_error_code, read_axis<error_code>},
    {Verb::frnet_in, read_group},
    {Verb::frnet_read, read_channel},
    {Verb::get_latch, read_axis<latch>},
};
constexpr CompleteTable<Verb, Reads> kReadTable(lang::kReadVerbs, kReads);

}  // namespace

std::int32_t Module::read(const Command& command) const { return kReadTable[command.verb()](*this, command); }

bool Module::frnet_input(std::uint32_t group, std::uint32_t channel) const {
  return (frnet.word(group) >> (channel % kFrnetChannels) & 1) != 0;
}

Took Module::carry_out(const lang::Command& command) {
  for (const NotImplementedRow& row : kNotImplementedRows) {
    if (is_meant(row, command)) warn_not_implemented(row.what, row.why);
  }
  return action_of(command.verb())(*this, command);
}

}  // namespace understudy::emulator::models::rs_m8194h
