// The keys of `hunt`: what may happen to a scenario, and which conditions must then remain true.
#pragma once

#include <array>
#include <cstddef>

#include "emulator/play/reading/step_schemas.h"
#include "emulator/world/bench_file/bench_schema.h"
#include "emulator/world/bench_file/fault_schema.h"
#include "emulator/world/bench_file/schema.h"

namespace understudy::emulator::play {

// --- values that are drawn -----------------------------------------------------------------------
inline constexpr world::Schema kTwoEnds = world::list_schema(world::kText, 2);
inline constexpr std::array kDrawBetweenKeys{
    world::Key{"between", "The smallest and the largest value to draw.", &kTwoEnds, true},
    world::Key{"step", "The distance between values (default: the precision of the ends).", &world::kText}};
inline constexpr std::array kDrawOneOfKeys{
    world::Key{"one_of", "Values to choose from at random.", &world::kTextList, true}};
inline constexpr world::Schema kDrawBetweenSchema = world::keys_schema(kDrawBetweenKeys);
inline constexpr world::Schema kDrawOneOfSchema = world::keys_schema(kDrawOneOfKeys);
inline constexpr std::array<const world::Schema*, 3> kDrawnAlternatives{&world::kText, &kDrawBetweenSchema,
                                                                        &kDrawOneOfSchema};
inline constexpr world::Schema kDrawn = world::any_of_schemas(kDrawnAlternatives);
inline constexpr world::Schema kDrawnByName = world::names_schema(kDrawn);
inline constexpr world::Schema kDrawnByDevice = world::names_schema(kDrawn, world::Schema::Of::devices);
inline constexpr world::Schema kDrawnByInput = world::names_schema(kDrawn, world::Schema::Of::inputs);
inline constexpr world::Schema kDrawnByTurned = world::names_schema(kDrawn, world::Schema::Of::turned);
inline constexpr world::Schema kDrawnByRegister = world::names_schema(kDrawn, world::Schema::Of::registers);

namespace hunt_schema {
/// The keys of a fault. Its place and its fields may be drawn.
constexpr auto drawn_fault() {
  auto keys = world::kFaultKeys;
  for (world::Key& key : keys) {
    if (key.schema == &world::kText) key.schema = &kDrawn;
  }
  return keys;
}
}  // namespace hunt_schema
inline constexpr auto kDrawnFaultKeys = hunt_schema::drawn_fault();
inline constexpr world::Schema kDrawnFaultSchema = world::keys_schema(kDrawnFaultKeys);

// --- may -----------------------------------------------------------------------------------------
inline constexpr world::Schema kMaxTimesSchema = world::integer_schema(1, 100);
/// The steps that may occur, and the keys that may accompany them.
inline constexpr std::size_t kDisturbingSteps = 9;
inline constexpr std::array kMayKeys{
    world::Key{"inject", "A fault. It is injected at any time, unless its fields say when.",
               &kDrawnFaultSchema},
    world::Key{"input", "Inputs that somebody or something else switches.", &kDrawnByInput},
    world::Key{"turn", "Hand wheels that are turned.", &kDrawnByTurned},
    world::Key{"power", "Devices that are switched on or off.", &kDrawnByDevice},
    world::Key{"write", "A request from another host.", &kDrawnByRegister},
    world::Key{"command", "A command from another host.", &kDrawnByDevice},
    world::Key{"send", "Bytes or a line of text from another host.", &kDrawnByName},
    world::Key{"program", "A program that somebody loads.", &kDrawnByDevice},
    world::Key{"advance", "A delay of the host.", &kDrawn},
    world::Key{"times", "The maximum number of times that it may happen in a course (default: 1).",
               &kMaxTimesSchema},
    world::Key{"within", "All repetitions happen within this time, as when a contact bounces.",
               &world::kDuration},
    world::Key{"from", "The text of the `say` step before which it does not happen.", &world::kText},
    world::Key{"to", "The text of the `say` step after which it does not happen.", &world::kText}};
inline constexpr world::Schema kMaySchema = world::keys_schema(kMayKeys);
inline constexpr world::Schema kMayListSchema = world::list_schema(kMaySchema);

// --- what must hold ------------------------------------------------------------------------------
inline constexpr world::Schema kSpanListSchema = world::list_schema(kSpanSchema);
inline constexpr std::array<const world::Schema*, 3> kSpansAlternatives{&world::kText, &kSpanKeysSchema,
                                                                        &kSpanListSchema};
inline constexpr world::Schema kSpansSchema = world::any_of_schemas(kSpansAlternatives);
inline constexpr std::array kHuntKeys{
    world::Key{"may", "The steps that may happen; their values may be drawn at random.", &kMayListSchema,
               true},
    world::Key{"from", "The text of the `say` step before which nothing happens.", &world::kText},
    world::Key{"to", "The text of the `say` step after which nothing happens.", &world::kText},
    world::Key{"never", "Conditions that must not be true at any tick of any course.", &kSpansSchema},
    world::Key{"always", "Conditions that must be true at every tick of every course.", &kSpansSchema},
    world::Key{"within", "The simulated time after which every course must be over.", &world::kDuration}};
inline constexpr world::Schema kHuntSchema = world::keys_schema(kHuntKeys);

}  // namespace understudy::emulator::play
