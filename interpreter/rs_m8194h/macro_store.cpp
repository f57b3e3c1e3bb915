#include "interpreter/rs_m8194h/macro_store.h"

#include <bitset>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "interpreter/rs_m8194h/check.h"
#include "interpreter/rs_m8194h/command_row.h"
#include "interpreter/rs_m8194h/listing.h"
#include "interpreter/rs_m8194h/macro.h"

namespace understudy::interpreter::rs_m8194h {

std::optional<Macro> macro_of(const MacroName& name, std::string_view text) {
  Listing listing = parse_listing(text, kAnyChoice).listing;
  const bool is_alone =
      listing.triggers.empty() && listing.macros.size() == 1 && listing.macros[0].name == name;
  return is_alone ? std::optional(std::move(listing.macros[0].macro)) : std::nullopt;
}

std::size_t MacroStore::place_of(const MacroName& name) {
  return static_cast<std::size_t>((name.is_isr ? kMpCount : 0) + name.number - 1);
}

void MacroStore::update(std::span<const Stored> stored) {
  std::bitset<kMpCount + kIsrCount> is_stored;
  for (const Stored& one : stored) {
    if (!exists(one.name)) continue;
    Entry& entry = entries_[place_of(one.name)];
    is_stored.set(place_of(one.name));
    if (entry.is_stored && entry.text == one.text) continue;
    entry = {.is_stored = true, .text = one.text, .macro = macro_of(one.name, one.text.text())};
  }
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (!is_stored[i] && entries_[i].is_stored) entries_[i] = {};
  }
}

const Macro* MacroStore::find(const MacroName& name) const {
  if (!exists(name)) return nullptr;
  const std::optional<Macro>& macro = entries_[place_of(name)].macro;
  return macro ? &*macro : nullptr;
}

}  // namespace understudy::interpreter::rs_m8194h
