// The macros that a memory holds as texts, ready to run: none is read again while its text stays the same.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "base/state/shared_text.h"
#include "interpreter/rs_m8194h/macro.h"

namespace understudy::interpreter::rs_m8194h {

/// The macro that a text is the listing of, with nothing beside it; nothing if it is not that.
std::optional<Macro> macro_of(const MacroName& name, std::string_view text);

class MacroStore {
 public:
  struct Stored {
    MacroName name;
    SharedText text;
  };

  /// From now on these, each at most once, and no others. A text that is not its macro's listing counts as
  /// none.
  void update(std::span<const Stored> stored);

  /// Null: there is not one. Valid until the next update().
  const Macro* find(const MacroName& name) const;

 private:
  struct Entry {
    bool is_stored = false;
    SharedText text;
    std::optional<Macro> macro = {};
  };
  static std::size_t place_of(const MacroName& name);

  std::array<Entry, kMpCount + kIsrCount> entries_;
};

}  // namespace understudy::interpreter::rs_m8194h
