// What a scenario file may say, but for the kinds of its steps (step_rows.h): its keys, and the forms of
// their values.
#pragma once

#include <array>

#include "emulator/world/bench_file/bench_form.h"

namespace understudy::emulator::play {

inline constexpr std::array<const world::Form*, 2> kBenchWays{&world::kText, &world::kInlineBenchForm};
inline constexpr world::Form kBenchOrFileForm = world::either_form(kBenchWays);
inline constexpr std::array<const world::Form*, 2> kFirmwareWays{&world::kText, &world::kTextByDevice};
inline constexpr world::Form kFirmwareForm = world::either_form(kFirmwareWays);
inline constexpr world::Form kCasesForm = world::list_form(world::kTextByName);

inline constexpr std::array kScenarioKeys{
    world::kVersionKey,
    world::KeyRow{"name", "What it is about, as a sentence; by default the file's name.", &world::kText},
    world::KeyRow{"bench", "The bench, or the path of its file.", &kBenchOrFileForm, true},
    world::KeyRow{"nv", "What the devices' memories hold at first: files of NV images, by device.",
                  &world::kTextByDevice},
    world::KeyRow{"firmware", "Another firmware than the bench's: for all devices, or by device.",
                  &kFirmwareForm},
    world::KeyRow{"gap", "Time that the host leaves between two requests, beyond t3.5.", &world::kDuration},
    world::KeyRow{"seed", "Where randomness begins.", &world::kSeedForm},
    world::KeyRow{"parameters", "Names and values, used as ${name}.", &world::kTextByName},
    world::KeyRow{"cases", "Rows of parameters; each is a scenario of its own.", &kCasesForm},
    world::KeyRow{"steps", "What is done and expected, in this order.", &world::kSteps, true}};
inline constexpr world::Form kScenarioForm = world::keys_form(kScenarioKeys);

}  // namespace understudy::emulator::play
