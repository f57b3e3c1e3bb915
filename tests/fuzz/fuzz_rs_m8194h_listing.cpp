// Any text as macros and triggers of an RS-M8194H is refused with places, or its contents are the same after
// they are written and read again.
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "interpreter/rs_m8194h/listing.h"
#include "tests/fuzz/fuzzing.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace understudy::interpreter::rs_m8194h;
  using understudy::fuzzing::require;
  const std::string_view text = understudy::fuzzing::text_of(data, size);
  const ParsedListing parsed = parse_listing(text);
  std::pair<int, int> last{0, 0};
  for (const TextError& error : parsed.errors) {
    require(error.line >= 1 && error.column >= 1 && !error.message.empty(), "an error has a place");
    require(last <= std::pair(error.line, error.column), "errors come in the order of the text");
    last = {error.line, error.column};
  }
  if (!parsed.errors.empty()) {
    require(parsed.listing == Listing{}, "what has errors says nothing");
    return 0;
  }
  for (const ListedMacro& listed : parsed.listing.macros) {
    require(lines_used(listed.macro.lines) <= capacity_of(listed.name), "a macro fits its place");
    require(listed.macro.leads_to.size() == listed.macro.size(), "every line leads somewhere");
  }
  const std::string again = text_of(parsed.listing);
  const ParsedListing reread = parse_listing(again);
  require(reread.errors.empty() && reread.listing == parsed.listing,
          "a listing is the same again from its text");
  require(text_of(reread.listing) == again, "its text is the same again");
  return 0;
}
