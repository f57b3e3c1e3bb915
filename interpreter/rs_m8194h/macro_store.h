// Keeps compiled forms of the macros that a memory stores as text. A macro is compiled again only if its text
// changes.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "base/state/shared_text.h"
#include "interpreter/rs_m8194h/macro.h"

namespace understudy::interpreter::rs_m8194h {

/// Compiles a text that consists of exactly one macro. Returns nothing for any other text.
std::optional<Macro> macro_of(const MacroName& name, std::string_view text);

class MacroStore {
 public:
  struct Stored {
    MacroName name;
    SharedText text;
  };

  /// Replaces the stored macros with these. Each macro may appear only once. If a text is not a listing of
  /// its macro, find() returns null for that macro.
  void update(std::span<const Stored> stored);

  /// Returns null if there is no such macro. The pointer is valid until the next update().
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
