#include "emulator/models/rs_m8194h/programs/programs.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/program_watch.h"
#include "base/simulated_time.h"
#include "base/state/shared_text.h"
#include "base/state/state_bytes.h"
#include "emulator/device/program_error.h"
#include "emulator/models/rs_m8194h/chip/interrupts.h"
#include "emulator/models/rs_m8194h/programs/language.h"
#include "emulator/models/rs_m8194h/programs/memory.h"
#include "emulator/models/rs_m8194h/programs/status.h"
#include "emulator/models/rs_m8194h/rows/options.h"
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

using lang::Verb;

std::string_view blocks_of(const lang::MacroName& name) { return name.is_isr ? kIsrBlocks : kMpBlocks; }

}  // namespace

// --- download ---------------------------------------------------------------------------------------------

lang::Fault Programs::take_download(const lang::Decoded& decoded) {
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
    lang::refuse(state_.download, code, decoded.fault, language_options().lines);
    const bool shows_later = language_options().lines.chose(lang::option("structure_faults", "at_close")) &&
                             lang::is_download_error(decoded.fault);
    return shows_later ? lang::Fault::none : decoded.fault;
  }
  if (!decoded.command.row().closes())
    return lang::add(state_.download, decoded.command, language_options().lines);
  const lang::MacroName name = state_.download.name;
  const lang::Closed closed = lang::close(state_.download, language_options().lines);
  state_.downloaded = lang::status_of(state_.download, state_.downloaded, language_options().lines);
  state_.rsm = lang::State::ready;
  state_.download = kNoDownload;
  status_.pass(kDownloaded);
  if (closed.macro) {
    lang::replaced(state_.execution, name, acts_on_);
    memory_.state().blocks.put(blocks_of(name), std::to_string(name.number),
                               SharedText(lang::text_of(name, *closed.macro)));
  } else if (chose(option("failed_download", "empties_it"))) {
    lang::replaced(state_.execution, name, acts_on_);
    memory_.state().blocks.erase(blocks_of(name), std::to_string(name.number));
  }
  return closed.fault;
}

bool Programs::has_room_for(int lines) const {
  return lines <= lang::room_of(state_.download, language_options().lines);
}

void Programs::add_line(const lang::Command& line) {
  lang::add(state_.download, line, language_options().lines);
}

// --- store ---------------------------------------------------------------------------------------------

void Programs::compile() const {
  if (compiled_revision_ == memory_.state().blocks.revision()) return;
  compiled_revision_ = memory_.state().blocks.revision();
  std::vector<lang::MacroStore::Stored> stored;
  triggers_ = {};
  for (const auto& [kind, entries] : memory_.state().blocks.all()) {
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

const lang::Macro* Programs::macro(const lang::MacroName& name) const {
  compile();
  const lang::Macro* found = macros_.find(name);
  return found == nullptr || found->lines.empty() ? nullptr : found;
}

const lang::TriggerTable& Programs::triggers() const {
  compile();
  return triggers_;
}

std::vector<int> Programs::load(std::string_view text) {
  const lang::ParsedListing parsed = lang::parse_listing(text, language_options().lines);
  if (!parsed.errors.empty()) throw ProgramError(mistakes_of(parsed.errors));
  for (const lang::ListedMacro& each : parsed.listing.macros) {
    lang::replaced(state_.execution, each.name, acts_on_);
    memory_.state().blocks.put(blocks_of(each.name), std::to_string(each.name.number),
                               SharedText(lang::text_of(each.name, each.macro)));
  }
  std::vector<int> channels;
  for (const lang::ListedTrigger& each : parsed.listing.triggers) {
    channels.push_back(each.channel);
    memory_.state().blocks.put(kTriggerBlocks, lang::text_of_channel(each.channel),
                               SharedText(lang::text_of(each.channel, each.trigger)));
  }
  return channels;
}

std::string Programs::text() const {
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

/// Notifies the observer of the existing macros.
void Programs::notify_watch() const {
  if (acts_on_.watch() == nullptr || !is_alive()) return;
  std::uint64_t mark = hash_of({});
  for (const auto& [kind, entries] : memory_.state().blocks.all()) {
    if (kind != kMpBlocks && kind != kIsrBlocks) continue;
    for (const auto& [name, text] : entries) {
      mark = hash_of(std::as_bytes(std::span(name)), mark ^ text.digest() ^ (kind == kIsrBlocks ? 1U : 0U));
    }
  }
  acts_on_.watch()->program_loaded(mark);
}

void Programs::run_tick(Tick tick) {
  notify_watch();
  const bool ran_isr = isr_runs();
  state_.steps_left = lang::run_tick(state_.execution, tick, language_options().steps_a_tick, state_.paused,
                                     language_options().lines, acts_on_);
  if (ran_isr && !isr_runs()) status_.pass(kIsrFinished);
  if (machine_options().fifo_goes_on_beside_macros) state_.steps_left = language_options().steps_a_tick;
}

void Programs::start_mp(int number) {
  interrupts_.clear(Rint::mp_completed);
  interrupts_.clear(Rint::module);
  if (language_options().lines.chose(lang::option("missing_macro", "execution_error")) &&
      !lang::has_lines({false, number}, acts_on_)) {
    return report({.macro = {false, number},
                   .code = lang::real_time_code(Verb::mp_call),
                   .fault = lang::Fault::undefined_command});
  }
  const bool at_once = chose(option("first_line", "on_receipt"));
  lang::start_mp(state_.execution, number, at_once ? now() : now() + 1, acts_on_);
  if (!at_once || !mp_runs()) return;
  notify_watch();
  state_.steps_left = lang::run_tick(state_.execution, now(), state_.steps_left, state_.paused,
                                     language_options().lines, acts_on_);
}

void Programs::terminate() {
  lang::terminate(state_.execution);
  terminated();
}

void Programs::terminated() {
  interrupts_.forget_marks();
  state_.paused = false;
}

void Programs::mp_ended() {
  interrupts_.raise(Rint::mp_completed);
  status_.pass(kMpFinished);
}

/// Returns the ISR of the next mark. Marks that do not call an ISR are discarded.
int Programs::take_isr() {
  while (interrupts_.is_due()) {
    const IsrMark mark = interrupts_.take_mark();
    const int number = interrupts_.isr_of(mark);
    const bool is_missing = number < 1 || number > lang::kIsrCount || macro({true, number}) == nullptr;
    if (is_missing && language_options().lines.chose(lang::option("missing_macro", "execution_error")) &&
        mark.source == IsrMark::kCalled) {
      report({.macro = {true, number},
              .code = lang::real_time_code(Verb::isr_call),
              .fault = lang::Fault::undefined_command});
    }
    if (is_missing) continue;
    if (machine_options().isrs_raise_user_rint) interrupts_.raise(Rint::user);
    return number;
  }
  return 0;
}

void Programs::report(const lang::ExecutionFault& fault) {
  const auto number = static_cast<std::uint16_t>(fault.macro.number);
  state_.execution_fault = {
      fault.macro.is_isr ? std::uint16_t{0} : number, fault.macro.is_isr ? number : std::uint16_t{0},
      lang::real_time_code(lang::verb_of(fault.code)), fault.line, lang::row_of(fault.fault).download_error};
  interrupts_.raise(Rint::module);
}

void Programs::check_restored() {
  if (!lang::is_sound(state_.execution, acts_on_)) lang::terminate(state_.execution);
}

}  // namespace understudy::emulator::models::rs_m8194h
