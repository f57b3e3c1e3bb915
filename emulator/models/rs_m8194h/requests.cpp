#include "emulator/models/rs_m8194h/requests.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "emulator/device/register_map/refusal.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/rs_m8194h/answers.h"
#include "emulator/models/rs_m8194h/chip/axis_unit.h"
#include "emulator/models/rs_m8194h/module.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/options.h"
#include "emulator/models/rs_m8194h/rows/registers.h"
#include "emulator/models/rs_m8194h/rows/terminals.h"
#include "emulator/models/rs_m8194h/rows/views.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/command_row.h"
#include "interpreter/rs_m8194h/commands.h"
#include "interpreter/rs_m8194h/download.h"
#include "interpreter/rs_m8194h/faults.h"
#include "interpreter/rs_m8194h/verbs.h"
#include "interpreter/rs_m8194h/window.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

lang::Fault fault_of(Cause cause) {
  switch (cause) {
    case Cause::none: return lang::Fault::none;
    case Cause::unknown_function: return lang::Fault::function_code;
    case Cause::cut_pair: return lang::Fault::half_of_pair;
    case Cause::bad_count:
    case Cause::bad_length: return lang::Fault::register_count;
    case Cause::no_register:
    case Cause::read_only:
    case Cause::write_only:
    case Cause::cut_message: return lang::Fault::address;
    case Cause::out_of_range:
    case Cause::bad_bit:
    case Cause::bad_message: return lang::Fault::parameter;
    case Cause::busy: return lang::Fault::fifo_full;
    case Cause::failure: return lang::Fault::no_module;
  }
  return lang::Fault::none;
}

/// The registers of the RS-M8194H itself; all others need the module.
constexpr Addresses kOwn[] = {
    addresses_of(Table::input, "i-8094H Module ID", "InterpolationRdyFlag"),
    addresses_of(Table::input, "RS-M8194H state"),
    addresses_of(Table::input, "Illegal Modbus function"),
    addresses_of(Table::input, "Download: MP number", "Execution: error type"),
    {Table::holding, addresses_of(Table::holding, "FRnet Event").end, kCounterAddresses.first},
    {Table::holding, addresses_of(Table::holding, "Current Acceleration {}").end,
     addresses_of(Table::holding, "bVAR{}").first}};

/// The settings of the Ethernet box (12.2.3).
constexpr Addresses kIpSettings = addresses_of(Table::holding, "Lock_IP{}", "RS-M8194H_Gateway{}");

/// Inputs that reading may clear: RINT as a word and as bits, then the factors.
constexpr Addresses kRintWord = addresses_of(Table::input, "RINT_STATE_ALL");
constexpr Addresses kRintBits = addresses_of(Table::input, "Line_Scan_Completed", "Module_Error");
constexpr Addresses kFactorWords = addresses_of(Table::input, "INT factor 0 PULSE", "INT factor 9 SYNC");
constexpr Addresses kReasonWord = addresses_of(Table::input, "Illegal Modbus function");

bool touches(const RegisterRequest& request, const Addresses& some) {
  return request.table == some.table && request.first < some.end &&
         request.first + request.count > some.first;
}

bool is_own(Table table, std::size_t address) {
  return std::any_of(std::begin(kOwn), std::end(kOwn),
                     [&](const Addresses& own) { return own.has(table, address); });
}

/// Returns true if a counter or a variable, which occupies two words, begins there.
bool begins_in(const Addresses& pairs, Table table, std::size_t address) {
  return pairs.has(table, address) && (address - pairs.first) % 2 == 0;
}

/// Returns how many commands a valid write to the tables corresponds to.
int commands_of(const RegisterRequest& request) {
  if (!request.is_write() || request.table != Table::holding || request.first >= kWindow) return 0;
  int commands = 0;
  for (std::size_t i = 0; i < request.count; ++i) {
    const std::size_t address = request.first + i;
    commands += begins_in(kCounterAddresses, request.table, address) || address == kCallMpAddress ? 1 : 0;
  }
  return commands;
}

/// Returns the macro line that corresponds to a write to the tables, if any.
std::optional<lang::Command> line_at(Table table, std::size_t address, std::uint32_t value) {
  if (table != Table::holding) return std::nullopt;
  const auto line = [](lang::Verb verb, std::uint32_t first, std::uint32_t second) {
    lang::Command made{.code = lang::macro_code(verb)};
    made.values[0] = first;
    made.values[1] = second;
    return made;
  };
  if (kFrnetWords.has(table, address)) {
    return line(lang::Verb::frnet_out, static_cast<std::uint32_t>(address), value);
  }
  if (address == kCallMpAddress) return line(lang::Verb::mp_call, value, 0);
  if (begins_in(kCounterAddresses, table, address)) {
    constexpr lang::Verb kCounters[] = {lang::Verb::abs_set_position, lang::Verb::set_lp, lang::Verb::set_ep};
    const std::size_t number = (address - kCounterAddresses.first) / 2;
    return line(kCounters[number / kAxes], mask_of(number % kAxes), value);
  }
  if (begins_in(kVarAddresses, table, address)) {
    const auto variable = static_cast<std::uint32_t>(lang::kVariable0) +
                          static_cast<std::uint32_t>((address - kVarAddresses.first) / 2);
    return line(lang::Verb::set_var, variable, value);
  }
  return std::nullopt;
}

/// Returns true if the request writes a value to a variable that is outside the range of positions.
bool writes_beyond(const RegisterRequest& request, bool low_word_first) {
  if (!request.is_write() || request.table != Table::holding) return false;
  for (std::size_t i = 0; i + 1 < request.count; i += 2) {
    const std::size_t address = request.first + i;
    if (!kVarAddresses.has(request.table, address)) continue;
    const std::uint32_t high = request.words[low_word_first ? i + 1 : i];
    const std::uint32_t low = request.words[low_word_first ? i : i + 1];
    const auto value = static_cast<std::int32_t>(high << 16U | low);
    if (value < lang::kMin || value > lang::kMax) return true;
  }
  return false;
}

bool calls_mp(const RegisterRequest& request) {
  return request.first <= kCallMpAddress && kCallMpAddress < request.first + request.count;
}

}  // namespace

DeviceAnswer Requests::admits(const RegisterRequest& request, Checked checked,
                              const RegisterBank& bank) const {
  const bool is_window = request.table == Table::holding && request.first >= kWindow;
  if (request.is_single && is_window && chose(option("sub_function_by_fc6", "exception_2"))) {
    return answer_of(*this, lang::Fault::address);
  }
  if (chose(option("holes", "exception_2"))) {
    for (std::size_t i = 0; i < request.count; ++i) {
      if (!bank.at(request.table, static_cast<std::uint16_t>(request.first + i)))
        return answer_of(*this, lang::Fault::address);
    }
  }
  if (touches(request, kIpSettings) && chose(option("ip_settings", "exception_2"))) {
    return answer_of(*this, lang::Fault::address);
  }
  if (module_.is_absent()) {
    const bool is_mute = chose(option("absent_module", "nothing"));
    for (std::size_t i = 0; i < request.count; ++i) {
      if (is_mute || !is_own(request.table, request.first + i))
        return answer_of(*this, lang::Fault::no_module);
    }
  }
  if (checked == Checked::everything &&
      language_options().lines.chose(lang::option("variable_range", "exception_3")) &&
      writes_beyond(request, module_.memory.low_word_first())) {
    return answer_of(*this, lang::Fault::parameter);
  }
  const bool is_downloading = module_.programs.is_downloading();
  const bool is_table = request.is_write() && !is_window;
  if (is_downloading && is_table && chose(option("table_writes", "all_refused"))) {
    return answer_of(*this, lang::Fault::real_time_in_macro);
  }
  if (takes_whole(request)) return admits_whole(request, checked);
  if (is_downloading && is_table && machine_options().table_writes_become_lines) return admits_lines(request);
  const int commands = commands_of(request);
  if (commands == 0) return Refusal::none;
  if (is_downloading && !chose(option("table_writes", "all_allowed"))) {
    return answer_of(*this, lang::Fault::real_time_in_macro);
  }
  if (checked != Checked::everything) return Refusal::none;
  if (calls_mp(request) && module_.programs.are_calls_refused())
    return answer_of(*this, lang::Fault::macro_runs);
  return commands > module_.queue.free_blocks() ? answer_of(*this, lang::Fault::fifo_full) : Refusal::none;
}

DeviceAnswer Requests::admits_lines(const RegisterRequest& request) const {
  int lines = 0;
  for (std::size_t i = 0; i < request.count; ++i) {
    const auto line = line_at(request.table, request.first + i, 0);
    if (!line) continue;
    const lang::Fault not_here = lang::why_not_now(line->code, module_.programs.state().rsm);
    if (not_here != lang::Fault::none) return answer_of(*this, not_here);
    lines += line->row().macro_lines();
  }
  const bool fits = module_.programs.has_room_for(lines);
  return fits ? DeviceAnswer(Refusal::none) : answer_of(*this, lang::Fault::macro_memory);
}

bool Requests::diverts(const Place& place, std::uint32_t bits) {
  if (!module_.programs.is_downloading() || !machine_options().table_writes_become_lines) return false;
  const auto line = line_at(place.row->table, place.address(), bits);
  if (!line) return false;
  module_.programs.add_line(*line);
  return true;
}

/// Clears the data that were read, if a choice requires this; by default, reading clears nothing.
void Requests::read_answered(const RegisterRequest& request) {
  if (request.table != Table::input) return;
  InterruptState& interrupts = module_.interrupts.state();
  for (std::size_t i = 0; i < request.count; ++i) {
    const std::size_t address = request.first + i;
    const auto is_in = [&](const Addresses& some) { return some.has(request.table, address); };
    if (is_in(kReasonWord) && chose(option("reason_lasts", "until_it_is_read"))) state_.illegal_reason = 0;
    if (is_in(kFactorWords) && machine_options().factors_clear_by_reading) {
      interrupts.factor_axes[address - kFactorWords.first] = 0;
    }
    if (!machine_options().rint_clears_by_reading) continue;
    if (is_in(kRintWord)) interrupts.rint = 0;
    if (is_in(kRintBits)) interrupts.rint &= static_cast<std::uint8_t>(~(1U << (address - kRintBits.first)));
  }
}

void Requests::exception_answered(const RefusedRequest& request) {
  const Objection& objection = request.objection;
  state_.illegal_reason =
      objection.reason != 0 ? objection.reason : reason_of(*this, fault_of(objection.cause));
}

}  // namespace understudy::emulator::models::rs_m8194h
