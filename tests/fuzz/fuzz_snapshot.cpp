// Any text as a snapshot is refused or read. A state with a correct checksum but wrong bytes is refused
// without changes, or it is a state: saved again it is the same, and the world continues.
//
// An input that begins with '{' is the text of a snapshot. Otherwise it changes a state of a busy world:
// groups of four bytes are a part, two bytes of a position in it, and the value that is written there.
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "emulator/models/models.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/snapshot_file.h"
#include "tests/fuzz/fuzzing.h"

namespace {

using namespace understudy;
using fuzzing::require;
using namespace std::chrono_literals;

constexpr std::size_t kLongest = 4096;

/// Both models in motion, with a program each, on a machine with stops.
struct Busy {
  Busy() : bench(make_bench()), world(bench, emulator::world::WorldOptions{}, {}) {
    world.advance_to(180ms);
    state = save(world);
    hash = emulator::world::bench_hash(bench);
  }
  static emulator::world::Bench make_bench() {
    return emulator::world::parse_bench(
        emulator::models::all_models(),
        "understudy: 1\n"
        "lines:\n"
        "  rs485:\n"
        "    stations:\n"
        "      - name: a\n"
        "        model: simple2-r3\n"
        "        set: { Aaxis_SVON: 1, Aaxis_Pulse: 9000, Aaxis_Speed: 60, Aaxis_Move_INC: 1, "
        "DIN2_Aaxis_UP_Limit: 1, PROG_MAIN_RunTime_START: 1 }\n"
        "        program: |\n"
        "          again: Out DOUT_5 ON\n"
        "                 Delay_mSec 50\n"
        "                 Jump again\n"
        "  serial: { stations: [ { name: b, model: slim, modules: 2 } ] }\n"
        "plant: { a.A: { travel: [-900, 900], limits: { upper: 800 }, encoder: { per_revolution: 4000 } } }\n"
        "faults: [ { lost_steps: a.A, one_in: 50 } ]\n",
        "bench.yaml", "/nonexistent");
  }
  emulator::world::Bench bench;
  emulator::world::World world;
  emulator::world::WorldState state;
  std::uint64_t hash = 0;
  bool is_as_made = true;  // its world has this state
};

Busy& busy() {
  static Busy one;
  return one;
}

void check_state(const emulator::world::WorldState& state, bool is_checked_wholly) {
  emulator::world::World& world = busy().world;
  if (!busy().is_as_made || is_checked_wholly) restore(world, busy().state);
  busy().is_as_made = true;
  try {
    restore(world, state);
  } catch (const StateError&) {
    if (is_checked_wholly) require(save(world) == busy().state, "a state that is refused changes nothing");
    return;
  }
  busy().is_as_made = false;
  if (is_checked_wholly) {
    const emulator::world::WorldState taken = save(world);
    restore(world, taken);
    require(save(world) == taken, "a state that was saved is taken back");
  }
  try {
    world.advance_to(world.now() + 20ms);
  } catch (const std::exception&) {
    // A plausible state that no world reaches is reported, and the world is not used any more.
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0 || size > kLongest) return 0;
  const bool is_checked_wholly = fuzzing::is_checked_wholly({data, size});
  if (data[0] == '{') {
    try {
      check_state(emulator::world::parse_snapshot(std::string(fuzzing::text_of(data, size)), busy().hash),
                  is_checked_wholly);
    } catch (const emulator::world::SnapshotError& error) {
      require(error.what()[0] != '\0', "an error says something");
    }
    return 0;
  }
  emulator::world::WorldState state = busy().state;
  for (std::span<const std::uint8_t> rest(data, size); rest.size() >= 4; rest = rest.subspan(4)) {
    auto& bytes = state.parts[rest[0] % state.parts.size()].bytes;
    if (bytes.empty()) continue;
    const std::size_t place = (std::size_t{rest[1]} << 8 | rest[2]) % bytes.size();
    bytes[place] = std::byte{rest[3]};
  }
  check_state(state, is_checked_wholly);
  return 0;
}
