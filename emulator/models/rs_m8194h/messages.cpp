// Converts messages to the window, and to registers that represent commands, into commands.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "emulator/device/register_map/refusal.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/rs_m8194h/answers.h"
#include "emulator/models/rs_m8194h/module.h"
#include "emulator/models/rs_m8194h/rows/options.h"
#include "emulator/models/rs_m8194h/rows/registers.h"
#include "emulator/models/rs_m8194h/rows/views.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/command_row.h"
#include "interpreter/rs_m8194h/commands.h"
#include "interpreter/rs_m8194h/download.h"
#include "interpreter/rs_m8194h/faults.h"
#include "interpreter/rs_m8194h/verbs.h"
#include "interpreter/rs_m8194h/window.h"

namespace understudy::emulator::models::rs_m8194h {

DeviceAnswer take_message(Module& it, Cell cell, std::span<const std::uint16_t> words) {
  if (it.chose(option("window_parts", "kept_for_the_command"))) {
    // Parameters may have arrived before their command.
    auto& all = it.state().parameters;
    std::copy(words.begin(), words.end(), all.begin() + cell.index);
    if (cell.index != 0) return Refusal::none;
    const lang::CommandRow* const row = lang::find_code(words[0]);
    const auto wanted = row == nullptr ? std::size_t{0} : static_cast<std::size_t>(row->registers());
    if (words.size() < wanted) words = std::span(all).first(wanted);
  }
  const bool is_low_first = it.memory.low_word_first() && !it.chose(option("word_order_scope", "tables"));
  const auto order = is_low_first ? lang::WordOrder::low_first : lang::WordOrder::high_first;
  lang::Decoded decoded = lang::decode(words, it.programs.state().rsm, order, it.language_options().lines);
  // A choice can check the room before the parameters.
  if (decoded.fault == lang::Fault::parameter && it.language_options().room_before_parameters) {
    const lang::Fault none_left = it.queue.why_no_room(decoded.command);
    if (none_left != lang::Fault::none) decoded.fault = none_left;
  }
  if (it.programs.is_downloading() ||
      (decoded.fault == lang::Fault::none && lang::is_one_of(decoded.command.verb(), lang::kDownloadVerbs))) {
    const lang::Fault fault = it.programs.take_download(decoded);
    const bool shows_elsewhere = lang::is_download_error(fault) && fault != lang::Fault::undefined_command;
    if (shows_elsewhere && it.chose(option("macro_errors", "an_echo"))) return Refusal::none;
    return answer_of(it, fault);
  }
  const lang::Fault fault =
      decoded.fault != lang::Fault::none ? decoded.fault : it.queue.take(decoded.command);
  return fault == lang::Fault::none ? DeviceAnswer(Refusal::none) : answer_of(it, fault);
}

Value call_register(const Module& it, Cell) {
  if (it.chose(option("call_register", "0"))) return 0;
  if (it.chose(option("call_register", "the_macro_that_runs"))) return it.programs.running_mp();
  return it.memory.value(kCallMpSlot);
}

void call_mp(Module& it, Cell, Value value) {
  lang::Command command{.code = lang::real_time_code(lang::Verb::mp_call)};
  command.values[0] = static_cast<std::uint32_t>(value);
  it.queue.queue(command);
}

void enable_triggers(Module& it, Cell, Value value) { it.triggers.enable(value != 0); }

}  // namespace understudy::emulator::models::rs_m8194h
