// Any text as a recording, after a correct or a wrong header, is refused or replayed: one in eight is
// replayed, for half a second of its time.
//
// An input that begins with '{' is a whole recording. Otherwise its lines are events after a header of ours.
#include <cstdint>
#include <sstream>
#include <string>

#include "base/version.h"
#include "emulator/models/models.h"
#include "emulator/world/bench/bench_text.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/recording/recording.h"
#include "emulator/world/recording/replay.h"
#include "tests/fuzz/fuzzing.h"

namespace {

using namespace understudy;
using fuzzing::require;
using namespace std::chrono_literals;

constexpr std::size_t kLongest = 4096;
constexpr SimTime kUntil = 500ms;

const std::string& our_header() {
  static const std::string line = [] {
    emulator::world::RecordingHeader header;
    header.version = std::string(program_version());
    header.bench = emulator::world::to_text(emulator::world::parse_bench(
        emulator::models::all_models(),
        "understudy: 1\n"
        "lines:\n"
        "  rs485: { baud: 115200, timing: instant, stations: [ { name: a, model: simple2-r3 } ] }\n"
        "  serial: { stations: [ { name: b, model: slim } ] }\n"
        "plant: { a.A: { travel: [-900, 900], limits: { lower: -800, upper: 800 } } }\n",
        "bench.yaml", "/nonexistent"));
    return emulator::world::to_line(header);
  }();
  return line;
}

const emulator::world::World& our_world() {
  static const emulator::world::World world(
      emulator::world::parse_bench(emulator::models::all_models(),
                                   emulator::world::parse_header(our_header()).bench, "bench.yaml",
                                   "/nonexistent"),
      emulator::world::WorldOptions{}, {});
  return world;
}

/// Accepted events are written as they are read. Each refused one throws, which is expensive, so only a few
/// lines are read of an input that is not checked completely.
void check_events(std::istringstream text, bool is_checked_wholly) {
  constexpr int kFew = 4;
  const emulator::world::World& world = our_world();
  int looked_at = 0;
  for (std::string line; std::getline(text, line);) {
    if (!is_checked_wholly && looked_at++ == kFew) return;
    try {
      const auto event = emulator::world::parse_event(line, world.known(), world.line_count());
      const std::string written = emulator::world::to_line(event, world.known());
      require(
          emulator::world::to_line(emulator::world::parse_event(written, world.known(), world.line_count()),
                                   world.known()) == written,
          "an event reads as it was written");
    } catch (const emulator::world::RecordingError&) {
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > kLongest) return 0;
  const std::string text(fuzzing::text_of(data, size));
  const bool is_whole = text.starts_with("{");
  const bool is_checked_wholly = fuzzing::is_checked_wholly({data, size});
  if (!is_whole) check_events(std::istringstream(text), is_checked_wholly);
  if (!is_checked_wholly) return 0;
  std::istringstream recording(is_whole ? text : our_header() + "\n" + text);
  try {
    emulator::world::replay(emulator::models::all_models(), recording, "recording", kUntil);
  } catch (const emulator::world::RecordingError& error) {
    require(error.what()[0] != '\0', "an error says something");
  }
  return 0;
}
