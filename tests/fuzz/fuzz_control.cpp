// Any lines on the control socket: each reply is one line of JSON, and a refusal leaves the daemon unchanged.
// Lines that would write or read a file are left out, because a search must not touch the machine that it
// runs on.
#include <cstdint>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>

#include "emulator/models/models.h"
#include "emulator/serve/control/messages.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/snapshot.h"
#include "tests/fuzz/fuzzing.h"

namespace {

using namespace understudy;
using fuzzing::require;

constexpr std::size_t kLongest = 4096;

emulator::serve::DaemonOptions options() {
  emulator::serve::DaemonOptions made;
  made.speed = {.kind = emulator::serve::Speed::Kind::manual};
  made.watch_signals = false;
  return made;
}

/// One daemon for all inputs, restored to its initial state.
struct Rig {
  Rig()
      : daemon(emulator::world::parse_bench(
                   emulator::models::all_models(),
                   "understudy: 1\n"
                   "lines:\n"
                   "  rs485: { stations: [ { name: a, model: simple2-r3 } ] }\n"
                   "  serial: { stations: [ { name: b, model: slim } ] }\n"
                   "plant: { a.A: { travel: [-900, 900], limits: { lower: -800, upper: 800 } } }\n",
                   "bench.yaml", "/nonexistent"),
               options(), [](const std::string&) {}),
        as_made(save(daemon.world())) {}
  emulator::serve::Daemon daemon;
  emulator::world::WorldState as_made;
  bool is_as_made = true;
};

bool names_a_file(const std::string& line) {
  return line.find("file") != std::string::npos || line.find("\\u") != std::string::npos;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Rig rig;
  if (size > kLongest) return 0;
  const bool is_checked_wholly = fuzzing::is_checked_wholly({data, size}, 32);
  rig.daemon.pause();
  if (!rig.is_as_made || is_checked_wholly) {
    rig.daemon.observers().debugger.remove_all();
    rig.daemon.restore(rig.as_made);
  }
  rig.is_as_made = true;
  emulator::world::WorldState before;
  if (is_checked_wholly) before = save(rig.daemon.world());
  std::istringstream text{std::string(fuzzing::text_of(data, size))};
  for (std::string line; std::getline(text, line);) {
    if (names_a_file(line)) continue;
    int replies = 0;
    bool is_refused = false;
    emulator::serve::handle_message(rig.daemon, line, [&](const std::string& reply) {
      ++replies;
      require(reply.find('\n') == std::string::npos, "a reply is one line");
      const auto json = nlohmann::json::parse(reply, nullptr, false);
      require(json.is_object() && json.contains("ok"), "a reply says whether it was obeyed");
      is_refused = json["ok"] == false;
    });
    require(replies <= 1, "a message gets one reply");
    rig.is_as_made = rig.is_as_made && is_refused;
    rig.daemon.pause();  // an advance in progress ends
    if (!is_checked_wholly) continue;
    emulator::world::WorldState after = save(rig.daemon.world());
    if (is_refused) require(after == before, "a message that is refused changes nothing");
    before = std::move(after);
  }
  return 0;
}
