// Macros and triggers as text and back, without loss:
//
//   MP 21
//     RSM_MACRO_SET_VAR VAR1 10
//     RSM_MACRO_FOR VAR1              ; blocks may be indented
//       RSM_MACRO_FIXED_MOVE XYZU 1000
//     RSM_MACRO_NEXT
//   END
//
//   ISR 3
//     RSM_MACRO_GET_LP X
//     RSM_MACRO_SET_RVAR VAR5
//   END
//
//   TRIGGER 8.0 off_to_on MP21        ; group 8, channel 0
//   TRIGGER 8.1 on hold X
//   TRIGGER 15.15 change abort_macro  ; abort_command, abort_macro, pause, clear_stop
//   TRIGGER 8.2 none                  ; the input no longer starts anything
//
// Each macro passes the checks of a download.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/tokens.h"
#include "interpreter/rs_m8194h/check.h"
#include "interpreter/rs_m8194h/download.h"
#include "interpreter/rs_m8194h/macro.h"
#include "interpreter/rs_m8194h/options.h"
#include "interpreter/rs_m8194h/text_error.h"
#include "interpreter/rs_m8194h/triggers.h"

namespace understudy::interpreter::rs_m8194h {

struct ListedMacro {
  MacroName name;
  Macro macro;

  bool operator==(const ListedMacro&) const = default;
};
struct ListedTrigger {
  int channel = 0;  // 0 to 127; 0 is group 8, channel 0
  Trigger trigger = {};

  bool operator==(const ListedTrigger&) const = default;
};

/// The macros and triggers in a text, in their order.
struct Listing {
  std::vector<ListedMacro> macros = {};
  std::vector<ListedTrigger> triggers = {};

  bool operator==(const Listing&) const = default;
};

struct ParsedListing {
  Listing listing = {};                           // empty if there is an error
  std::vector<std::vector<int>> text_lines = {};  // for each macro, the text line of each of its lines
  std::vector<TextError> errors = {};             // the first kMaxMistakes, in the order of the text
  std::optional<Token> first_trigger = {};        // first word of the first trigger in the text
};
ParsedListing parse_listing(std::string_view text, const Options& options = {});

std::string text_of(const Listing& listing);
std::string text_of(const MacroName& name, const Macro& macro);
/// Returns "TRIGGER 8.0 off_to_on MP21".
std::string text_of(int channel, const Trigger& trigger);
/// Returns "8.0".
std::string text_of_channel(int channel);

}  // namespace understudy::interpreter::rs_m8194h
