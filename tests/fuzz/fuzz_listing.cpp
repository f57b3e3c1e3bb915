// Any text as a listing of a Simple2-R3 program is refused with places, or it is a program: then the listing
// made from it gives the same program.
#include <cstdint>
#include <string>

#include "interpreter/simple2/listing.h"
#include "tests/fuzz/fuzzing.h"

namespace {

using namespace understudy;
using fuzzing::require;

constexpr std::size_t kLongest = 8192;

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > kLongest) return 0;
  const auto assembly = interpreter::simple2::assemble(fuzzing::text_of(data, size));
  require(assembly.lines.has_value() == assembly.errors.empty(), "a program or errors");
  for (const auto& error : assembly.errors) {
    require(error.line >= 1 && error.column >= 1, "an error has its place");
  }
  if (!assembly.lines) return 0;
  const auto again = interpreter::simple2::assemble(interpreter::simple2::disassemble(*assembly.lines));
  require(again.lines == assembly.lines, "a listing made from a program is that program");
  return 0;
}
