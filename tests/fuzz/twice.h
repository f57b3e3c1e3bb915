// Runs one course twice: in bulk, and tick by tick with a state that is saved and restored on the way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>
#include <string>

#include "emulator/device/device.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/stations/server.h"
#include "emulator/world/world.h"
#include "tests/fuzz/fuzzing.h"

namespace understudy::fuzzing {

inline void require_no_difference(emulator::world::World& world, const emulator::world::WorldState& a,
                                  const emulator::world::WorldState& b, const char* what) {
  const std::string difference = emulator::world::difference(world, a, b);
  if (difference.empty()) return;
  std::fprintf(stderr, "%s\n", difference.c_str());
  require(false, what);
}

/// `Executor` can restart, apply acts and run for ticks, and has a world.
template <class Executor, class Act>
void play(Executor& stage, std::span<const Act> acts, Tick ticks_after) {
  stage.restart();
  for (const Act& act : acts) stage.execute(act);
  stage.run(ticks_after);
}

/// `stepped` runs by single ticks; `in_bulk` has run the acts already.
template <class Executor, class Act>
void require_same_by_single_ticks(Executor& stepped, Executor& in_bulk, std::span<const Act> acts,
                                  Tick ticks_after) {
  namespace world = emulator::world;
  stepped.restart();
  const std::size_t half = acts.size() / 2;
  for (const Act& act : acts.first(half)) stepped.execute(act);
  const world::WorldState midst = world::save(stepped.world());
  world::restore(stepped.world(), midst);
  require_no_difference(stepped.world(), midst, world::save(stepped.world()),
                        "a state that is restored is the one that was saved");
  for (const Act& act : acts.subspan(half)) stepped.execute(act);
  stepped.run(ticks_after);
  if (world::hash(stepped.world()) == world::hash(in_bulk.world())) return;
  require_no_difference(stepped.world(), world::save(stepped.world()), world::save(in_bulk.world()),
                        "many ticks in one step are the same as one by one");
}

/// Requires that a refused request changes nothing.
inline void require_refused_changes_nothing(emulator::Device& device, std::span<const std::uint8_t> pdu,
                                            bool may_change = false) {
  namespace world = emulator::world;
  const auto before = device.save_state();
  const world::ModbusReply reply = world::serve(device, pdu);
  require(reply.size >= 2 && reply.size <= world::kModbusMaxPdu, "a reply has a size");
  if ((reply.pdu[0] & 0x80) == 0 || may_change) return;
  require(device.state_difference(before, device.save_state()).empty(), "a refused request changes nothing");
}

}  // namespace understudy::fuzzing
