// Writes to the tables that a choice treats as one message: two words as one number for a group of FRnet
// outputs (5.2.4), and coils that switch servos although they are of type R (12.4.2).
#include <cstddef>
#include <cstdint>

#include "emulator/device/register_map/refusal.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/rs_m8194h/answers.h"
#include "emulator/models/rs_m8194h/requests.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/options.h"
#include "emulator/models/rs_m8194h/rows/registers.h"
#include "emulator/models/rs_m8194h/rows/terminals.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/commands.h"
#include "interpreter/rs_m8194h/download.h"
#include "interpreter/rs_m8194h/faults.h"
#include "interpreter/rs_m8194h/verbs.h"
#include "interpreter/rs_m8194h/window.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

bool is_group_number(const RegisterRequest& request) {
  return request.is_write() && request.table == Table::holding && request.count == 2 &&
         kFrnetWords.has(request.table, request.first);
}

bool is_of_servos(const RegisterRequest& request) {
  return request.is_write() && kServoCoils.has(request.table, request.first + request.count - 1);
}

std::uint32_t number_in(const RegisterRequest& request, bool low_word_first) {
  const std::uint32_t high = request.words[low_word_first ? 1 : 0];
  return high << 16U | request.words[low_word_first ? 0 : 1];
}

lang::Command group_line(std::size_t group, std::uint32_t number) {
  lang::Command line{.code = lang::macro_code(lang::Verb::frnet_out)};
  line.values[0] = static_cast<std::uint32_t>(group);
  line.values[1] = number;
  return line;
}

}  // namespace

bool Requests::takes_whole(const RegisterRequest& request) const {
  if (is_group_number(request)) return chose(option("frnet_group_write", "one_number_for_the_first"));
  return is_of_servos(request) && chose(option("servo_coils", "switch_the_servos"));
}

DeviceAnswer Requests::admits_whole(const RegisterRequest& request, Checked checked) const {
  if (request.table == Table::coil || checked != Checked::everything) return Refusal::none;
  const std::uint32_t number = number_in(request, module_.memory.low_word_first());
  if (number > UINT16_MAX && !lang::is_variable(number)) return answer_of(*this, lang::Fault::parameter);
  if (!module_.programs.is_downloading() || !machine_options().table_writes_become_lines)
    return Refusal::none;
  const lang::Command line = group_line(request.first, number);
  const lang::Fault not_here = lang::why_not_now(line.code, module_.programs.state().rsm);
  if (not_here != lang::Fault::none) return answer_of(*this, not_here);
  const bool fits = module_.programs.has_room_for(line.row().macro_lines());
  return fits ? DeviceAnswer(Refusal::none) : answer_of(*this, lang::Fault::macro_memory);
}

DeviceAnswer Requests::take_whole(const RegisterRequest& request) {
  if (is_group_number(request)) {
    write_group(request.first, number_in(request, module_.memory.low_word_first()));
    return Refusal::none;
  }
  for (std::size_t i = 0; i < request.count; ++i) {
    const std::size_t coil = request.first + i;
    const bool is_on = request.words[i] != 0;
    if (coil < kServoCoils.first) {
      module_.frnet.write_bit(coil / kFrnetChannels, coil % kFrnetChannels, is_on);
      continue;
    }
    lang::Command command{.code = lang::real_time_code(is_on ? lang::Verb::servo_on : lang::Verb::servo_off)};
    command.values[0] = mask_of(coil - kServoCoils.first);
    module_.carry_out(command);
  }
  return Refusal::none;
}

/// Writes a number, or the value of the variable to which the number refers, to a group of outputs.
void Requests::write_group(std::size_t group, std::uint32_t number) {
  if (module_.programs.is_downloading() && machine_options().table_writes_become_lines) {
    module_.programs.add_line(group_line(group, number));
    return;
  }
  const bool is_variable = lang::is_variable(number);
  const std::uint32_t bits =
      is_variable ? static_cast<std::uint32_t>(module_.memory.variable(lang::variable_number(number)))
                  : number;
  module_.frnet.write(group, static_cast<std::uint16_t>(bits));
}

}  // namespace understudy::emulator::models::rs_m8194h
