// A world of two Simple2-R3 whose machines have switches, an encoder and a drive.
#pragma once

#include "emulator/models/models.h"
#include "tests/emulator/world/two_devices.h"

namespace understudy::emulator::world {

inline const std::string kFaultyBench =
    "understudy: 1\n"
    "lines:\n"
    "  rs485:\n"
    "    timing: instant\n"
    "    stations:\n"
    "      - { name: feeder, model: simple2-r3, address: 1 }\n"
    "      - { name: turner, model: simple2-r3, address: 2 }\n"
    "plant:\n"
    "  feeder.A: { home: { at: 100, width: 20, hysteresis: 4 }, limits: { lower: -200, upper: 800 },\n"
    "              encoder: { per_revolution: 6000, motor_pulses_per_revolution: 3000, reversed: true } }\n"
    "  turner.B: { travel: [-5000, 5000], encoder: { per_revolution: 3000 },\n"
    "              drive: { ready_after: 30ms, enabled_by: off, alarm_contact: opens } }\n"
    "wires: [ feeder.DOUT_4 -> turner.DIN_10, turner.DOUT_5 -> feeder.DIN_4 ]\n";

inline World make_faulty_world(const std::string& more = "") {
  return World(parse_bench(models::all_models(), kFaultyBench + more, "faulty.yaml", "."), {}, {});
}

inline Fault fault(const World& world, const std::string& kind, const std::string& place,
                   const std::vector<std::pair<std::string, std::int64_t>>& amounts = {}) {
  FaultText text{.kind = kind, .place = place, .fields = {}};
  for (const auto& [name, amount] : amounts) text.fields.emplace_back(name, std::to_string(amount));
  return find_fault(world.known(), text);
}
inline std::size_t inject(World& world, const std::string& kind, const std::string& place,
                          const std::vector<std::pair<std::string, std::int64_t>>& amounts = {}) {
  return world.inject(fault(world, kind, place, amounts));
}

inline void run(World& world, Tick ticks) { world.advance_to(time_of(tick_at(world.now()) + ticks)); }

}  // namespace understudy::emulator::world
