// Any text as the program of a SLIM is refused with its line, or the resulting program is accepted again; and
// it runs for a while.
#include <cstdint>
#include <memory>
#include <string>

#include "emulator/device/user_program.h"
#include "emulator/models/models.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/snapshot.h"
#include "tests/fuzz/fuzzing.h"

namespace {

using namespace understudy;
using fuzzing::require;
using namespace std::chrono_literals;

constexpr std::size_t kLongest = 4096;
constexpr SimTime kRun = 100ms;

struct Chain {
  Chain()
      : world(emulator::world::parse_bench(
                  emulator::models::all_models(),
                  "understudy: 1\n"
                  "lines: { serial: { timing: instant, stations: [ { name: t, model: slim, "
                  "modules: 3 } ] } }\n",
                  "bench.yaml", "/nonexistent"),
              emulator::world::WorldOptions{}, {}),
        as_made(save(world)) {}
  emulator::world::World world;
  emulator::world::WorldState as_made;
  bool is_as_made = true;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Chain chain;
  if (size > kLongest) return 0;
  const bool is_checked_wholly = fuzzing::is_checked_wholly({data, size});
  if (!chain.is_as_made || is_checked_wholly) restore(chain.world, chain.as_made);
  chain.is_as_made = true;
  try {
    chain.world.load_program(0, fuzzing::text_of(data, size));
  } catch (const emulator::ProgramError& error) {
    require(error.what()[0] != '\0', "an error says something");
    if (is_checked_wholly) {
      require(save(chain.world) == chain.as_made, "a program that is refused changes nothing");
    }
    return 0;
  }
  chain.is_as_made = false;
  const std::string text = chain.world.device(0).user_program()->program_text();
  chain.world.load_program(0, text);
  require(chain.world.device(0).user_program()->program_text() == text,
          "a program that it has is one that it takes");
  if (!is_checked_wholly) return 0;
  const std::string_view start = "G\r";
  chain.world.receive(0, {reinterpret_cast<const std::uint8_t*>(start.data()), start.size()});
  chain.world.advance_to(chain.world.now() + kRun);
  return 0;
}
