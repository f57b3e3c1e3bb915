// Macros: their download, their store, and what a running one asks of the device.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/complete_table.h"
#include "base/state/shared_text.h"
#include "emulator/device/program_error.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/rs_m8194h/axis_settings.h"
#include "emulator/models/rs_m8194h/axis_unit.h"
#include "emulator/models/rs_m8194h/language.h"
#include "emulator/models/rs_m8194h/memory.h"
#include "emulator/models/rs_m8194h/module.h"
#include "emulator/models/rs_m8194h/options.h"
#include "emulator/models/rs_m8194h/registers.h"
#include "emulator/models/rs_m8194h/state.h"
#include "emulator/models/rs_m8194h/terminals.h"
#include "emulator/models/rs_m8194h/views.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/command_row.h"
#include "interpreter/rs_m8194h/commands.h"
#include "interpreter/rs_m8194h/download.h"
#include "interpreter/rs_m8194h/faults.h"
#include "interpreter/rs_m8194h/listing.h"
#include "interpreter/rs_m8194h/machine.h"
#include "interpreter/rs_m8194h/macro.h"
#include "interpreter/rs_m8194h/macro_store.h"
#include "interpreter/rs_m8194h/run.h"
#include "interpreter/rs_m8194h/triggers.h"
#include "interpreter/rs_m8194h/verbs.h"
#include "interpreter/rs_m8194h/window.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

using lang::Command;
using lang::Verb;

std::string_view blocks_of(const lang::MacroName& name) { return name.is_isr ? kIsrBlocks : kMpBlocks; }

/// The lowest axis of a mask: a read names one.
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
/// One bit, by the second parameter.
template <Value (*shows)(const Module&, Cell)>
std::int32_t read_bit(const Module& it, const Command& command) {
  return static_cast<std::int32_t>(shows(it, cell_of_axes(command)) >> command.values[1] & 1);
}
std::uint16_t frnet_word(const Module& it, std::uint32_t group) {
  const auto number = static_cast<std::size_t>(group % kFrnetGroups);
  return group < kFrnetGroups ? it.state().outputs[number] : it.state().inputs[number];
}
std::int32_t read_group(const Module& it, const Command& command) {
  return frnet_word(it, command.values[0]);
}
std::int32_t read_channel(const Module& it, const Command& command) {
  return frnet_word(it, command.values[0]) >> (command.values[1] % kFrnetChannels) & 1;
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

// --- download ---------------------------------------------------------------------------------------------

lang::Fault Module::take_download(const lang::Decoded& decoded) {
  const std::uint16_t code = decoded.command.code;
  if (state_.rsm == lang::State::ready) {
    const bool is_busy =
        mp_runs() || (isr_runs() && chose(option("download_beside_macro", "refused_beside_an_isr_too")));
    if (is_busy && !chose(option("download_beside_macro", "taken"))) return lang::Fault::macro_runs;
    const bool is_isr = decoded.command.verb() == Verb::isr_create;
    state_.download = {.name = {is_isr, static_cast<int>(decoded.command.values[0])}};
    state_.rsm = is_isr ? lang::State::isr_download : lang::State::mp_download;
    return lang::Fault::none;
  }
  if (decoded.fault != lang::Fault::none) {
    lang::refuse(state_.download, code, decoded.fault, options_.download);
    const bool shows_later = options_.download.faults_show_at_close && lang::is_download_error(decoded.fault);
    return shows_later ? lang::Fault::none : decoded.fault;
  }
  if (!decoded.command.row().closes()) return lang::add(state_.download, decoded.command, options_.download);
  const lang::MacroName name = state_.download.name;
  const lang::Closed closed = lang::close(state_.download, options_.download);
  state_.downloaded = lang::status_of(state_.download, state_.downloaded, options_.download);
  state_.rsm = lang::State::ready;
  state_.download = kNoDownload;
  pass_state(kDownloaded);
  if (closed.macro) {
    lang::replaced(state_.execution, name, *this);
    state_.blocks.put(blocks_of(name), std::to_string(name.number),
                      SharedText(lang::text_of(name, *closed.macro)));
  } else if (chose(option("failed_download", "empties_it"))) {
    lang::replaced(state_.execution, name, *this);
    state_.blocks.erase(blocks_of(name), std::to_string(name.number));
  }
  return closed.fault;
}

// --- store ---------------------------------------------------------------------------------------------

void Module::compile() const {
  if (compiled_revision_ == state_.blocks.revision()) return;
  compiled_revision_ = state_.blocks.revision();
  std::vector<lang::MacroStore::Stored> stored;
  triggers_ = {};
  for (const auto& [kind, entries] : state_.blocks.all()) {
    for (const auto& [name, text] : entries) {
      if (kind == kMpBlocks || kind == kIsrBlocks) {
        stored.push_back({{kind == kIsrBlocks, std::stoi(name)}, text});
      } else if (kind == kTriggerBlocks) {
        for (const lang::ListedTrigger& each : lang::parse_listing(text.text()).listing.triggers) {
          triggers_[static_cast<std::size_t>(each.channel)] = each.trigger;
        }
      }
    }
  }
  macros_.update(stored);
}

const lang::Macro* Module::macro(const lang::MacroName& name) const {
  compile();
  const lang::Macro* found = macros_.find(name);
  return found == nullptr || found->lines.empty() ? nullptr : found;
}

const lang::TriggerTable& Module::triggers() const {
  compile();
  return triggers_;
}

void Module::load_program(std::string_view text) {
  const lang::ParsedListing parsed = lang::parse_listing(text, options_.command, options_.download);
  if (!parsed.errors.empty()) throw ProgramError(mistakes_of(parsed.errors));
  for (const lang::ListedMacro& each : parsed.listing.macros) {
    lang::replaced(state_.execution, each.name, *this);
    state_.blocks.put(blocks_of(each.name), std::to_string(each.name.number),
                      SharedText(lang::text_of(each.name, each.macro)));
  }
  for (const lang::ListedTrigger& each : parsed.listing.triggers) {
    state_.trigger_holds[static_cast<std::size_t>(each.channel)] = 0;
    state_.blocks.put(kTriggerBlocks, lang::text_of_channel(each.channel),
                      SharedText(lang::text_of(each.channel, each.trigger)));
  }
  if (!parsed.listing.triggers.empty()) check_triggers(state_.inputs, true);
}

std::string Module::program_text() const {
  compile();
  lang::Listing listing;
  for (const bool is_isr : {false, true}) {
    for (int number = 1; number <= lang::count_of(is_isr); ++number) {
      const lang::MacroName name{is_isr, number};
      if (const lang::Macro* found = macro(name)) listing.macros.push_back({name, *found});
    }
  }
  for (int channel = 0; channel < lang::kTriggerCount; ++channel) {
    const lang::Trigger& trigger = triggers_[static_cast<std::size_t>(channel)];
    if (trigger.condition != lang::TriggerCondition::none) listing.triggers.push_back({channel, trigger});
  }
  return lang::text_of(listing);
}

// --- running ---------------------------------------------------------------------------------------------

void Module::start_mp(int number) {
  state_.rint &= static_cast<std::uint8_t>(~(bit_of(Rint::mp_completed) | bit_of(Rint::module)));
  if (options_.run.missing_macro_is_error && !lang::has_lines({false, number}, *this)) {
    return report({.macro = {false, number},
                   .code = lang::real_time_code(Verb::mp_call),
                   .fault = lang::Fault::undefined_command});
  }
  const bool at_once = chose(option("first_line", "on_receipt"));
  lang::start_mp(state_.execution, number, at_once ? now() : now() + 1, *this);
  if (!at_once || !mp_runs()) return;
  state_.steps_left =
      lang::run_tick(state_.execution, now(), state_.steps_left, state_.paused, options_.run, *this);
}

void Module::start_isr(int number) {
  state_.marks.push_back({.tick = now(),
                          .axis = kAxes - 1,
                          .source = IsrMark::kCalled,
                          .number = static_cast<std::uint8_t>(number)});
}

void Module::terminate() {
  lang::terminate(state_.execution);
  terminated();
}

void Module::terminated() {
  state_.marks.clear();
  state_.paused = false;
}

void Module::mp_ended() {
  state_.rint |= bit_of(Rint::mp_completed);
  pass_state(kMpFinished);
}

std::int32_t Module::variable(std::size_t number) const {
  return static_cast<std::int32_t>(state_.image[kFirstVarSlot + number]);
}
void Module::set_variable(std::size_t number, std::int32_t value) {
  put(kFirstVarSlot + number, static_cast<std::uint32_t>(value));
}
std::uint8_t Module::byte_variable(std::size_t number) const {
  return static_cast<std::uint8_t>(state_.image[kFirstBvarSlot + number]);
}
std::int32_t Module::read(const Command& command) const { return kReadTable[command.verb()](*this, command); }
bool Module::stand(std::uint32_t axes) const { return (driving() & axes) == 0; }
bool Module::frnet_input(std::uint32_t group, std::uint32_t channel) const {
  return (frnet_word(*this, group) >> (channel % kFrnetChannels) & 1) != 0;
}

/// What a mark calls, by what is bound and enabled now; 0: nothing.
int Module::isr_of(const IsrMark& mark) const {
  const AxisUnit& unit = state_.units[mark.axis];
  if (mark.source == IsrMark::kCalled) return mark.number;
  if (!state_.interrupts) return 0;
  if (mark.source == IsrMark::kSynchronous) {
    return state_.sync.actions[mark.axis].interrupt ? unit.action_isr : 0;
  }
  return (unit.factors >> mark.source & 1) != 0 ? unit.isr_of[mark.source] : 0;
}

/// Marks that call nothing are spent.
int Module::take_isr() {
  while (!state_.marks.empty() && state_.marks.front().tick + options_.isr_delay_ticks <= now()) {
    const IsrMark mark = state_.marks.front();
    state_.marks.erase(state_.marks.begin());
    const int number = options_.isrs_are_bound_at_the_event ? mark.number : isr_of(mark);
    const bool is_missing = number < 1 || number > lang::kIsrCount || macro({true, number}) == nullptr;
    if (is_missing && options_.run.missing_macro_is_error && mark.source == IsrMark::kCalled) {
      report({.macro = {true, number},
              .code = lang::real_time_code(Verb::isr_call),
              .fault = lang::Fault::undefined_command});
    }
    if (is_missing) continue;
    if (machine_.isrs_raise_user_rint) state_.rint |= bit_of(Rint::user);
    return number;
  }
  return 0;
}

void Module::report(const lang::ExecutionFault& fault) {
  const auto number = static_cast<std::uint16_t>(fault.macro.number);
  state_.execution_fault = {
      fault.macro.is_isr ? std::uint16_t{0} : number, fault.macro.is_isr ? number : std::uint16_t{0},
      lang::real_time_code(lang::verb_of(fault.code)), fault.line, lang::row_of(fault.fault).download_error};
  module_error();
}

}  // namespace understudy::emulator::models::rs_m8194h
