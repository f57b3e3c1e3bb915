// Any text as a bench file is refused with an error of one line, or it is a bench that, written as text,
// reads back as the same bench.
#include <cstdint>
#include <string>

#include "emulator/models/models.h"
#include "emulator/world/bench/bench_text.h"
#include "emulator/world/bench_file/bench_file.h"
#include "tests/fuzz/fuzzing.h"

namespace {

using namespace understudy;
using fuzzing::require;

constexpr std::size_t kLongest = 4096;
const std::string kFolder = "/nonexistent";  // files that it names by path do not exist

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > kLongest) return 0;
  std::string written;
  try {
    written = emulator::world::to_text(emulator::world::parse_bench(
        emulator::models::all_models(), std::string(fuzzing::text_of(data, size)), "bench.yaml", kFolder));
  } catch (const FileError& error) {
    require(error.what()[0] != '\0', "an error says something");
    return 0;
  }
  const emulator::world::Bench again =
      emulator::world::parse_bench(emulator::models::all_models(), written, "again.yaml", kFolder);
  require(emulator::world::to_text(again) == written, "a bench as text is the same bench");
  return 0;
}
