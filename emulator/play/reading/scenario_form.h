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

// --- vary ----------------------------------------------------------------------------------------
inline constexpr world::Form kSamplesForm = world::integer_form(1, 1'000'000'000'000);
inline constexpr world::Form kTwoTexts = world::list_form(world::kText, 2);
inline constexpr world::KeyRow kSamplesKey{
    "samples", "Number of distinct values to draw; without it, one is drawn for each case.", &kSamplesForm};
inline constexpr world::KeyRow kSamplesSeedKey{"seed", "Seed of these draws (default: the scenario's seed).",
                                               &world::kSeedForm};
inline constexpr std::array kRangeKeys{
    world::KeyRow{"from", "The first value: a number, a duration or a voltage.", &world::kText, true},
    world::KeyRow{"to", "The limit; no value goes beyond it.", &world::kText, true},
    world::KeyRow{"step", "The step from one value to the next.", &world::kText, true}};
inline constexpr std::array kBetweenKeys{
    world::KeyRow{"between", "The smallest and the largest value to draw.", &kTwoTexts, true},
    world::KeyRow{"step", "The distance between values (default: the precision of the ends).", &world::kText},
    kSamplesKey, kSamplesSeedKey};
inline constexpr std::array kOneOfKeys{
    world::KeyRow{"one_of", "Values to choose from at random.", &world::kTextList, true}, kSamplesKey,
    kSamplesSeedKey};
inline constexpr world::Form kRangeForm = world::keys_form(kRangeKeys);
inline constexpr world::Form kBetweenForm = world::keys_form(kBetweenKeys);
inline constexpr world::Form kOneOfForm = world::keys_form(kOneOfKeys);
inline constexpr std::array<const world::Form*, 4> kVariationWays{&world::kTextList, &kRangeForm,
                                                                  &kBetweenForm, &kOneOfForm};
inline constexpr world::Form kVariationForm = world::either_form(kVariationWays);
inline constexpr world::Form kVaryForm = world::names_form(kVariationForm);

inline constexpr std::array kScenarioKeys{
    world::kVersionKey,
    world::KeyRow{"name", "A sentence that describes the scenario (default: the file's name).",
                  &world::kText},
    world::KeyRow{"bench", "The bench, or the path of its file.", &kBenchOrFileForm, true},
    world::KeyRow{"nv", "Initial contents of the devices' memories: NV image files, by device.",
                  &world::kTextByDevice},
    world::KeyRow{"firmware",
                  "A firmware version to use instead of the bench's: for all devices, or by device.",
                  &kFirmwareForm},
    world::KeyRow{"gap", "Time that the host waits between two requests, in addition to t3.5.",
                  &world::kDuration},
    world::KeyRow{"seed", "The seed of all random choices.", &world::kSeedForm},
    world::KeyRow{"parameters", "Names and values, used as ${name}.", &world::kTextByName},
    world::KeyRow{"cases", "Rows of parameters; each row is a case.", &kCasesForm},
    world::KeyRow{"vary", "Values of parameters; each combination is a case, for each row of `cases`.",
                  &kVaryForm},
    world::KeyRow{"steps", "Actions and expectations, in order.", &world::kSteps, true}};
inline constexpr world::Form kScenarioForm = world::keys_form(kScenarioKeys);

}  // namespace understudy::emulator::play
