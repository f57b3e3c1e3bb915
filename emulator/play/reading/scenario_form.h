// Declares the keys of a scenario file and the forms of their values. step_rows.h has the kinds of steps.
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
    "samples", "How many values are drawn, no two the same; without it one is drawn for each case.",
    &kSamplesForm};
inline constexpr world::KeyRow kSamplesSeedKey{
    "seed", "Where these draws begin (default: the scenario's seed).", &world::kSeedForm};
inline constexpr std::array kRangeKeys{
    world::KeyRow{"from", "The first value: a number, a duration or a voltage.", &world::kText, true},
    world::KeyRow{"to", "No value is beyond it.", &world::kText, true},
    world::KeyRow{"step", "From one value to the next.", &world::kText, true}};
inline constexpr std::array kBetweenKeys{
    world::KeyRow{"between", "The least and the greatest value that is drawn.", &kTwoTexts, true},
    world::KeyRow{"step", "How far values are apart (default: as finely as the ends are written).",
                  &world::kText},
    kSamplesKey, kSamplesSeedKey};
inline constexpr std::array kOneOfKeys{
    world::KeyRow{"one_of", "Values of which one is drawn.", &world::kTextList, true}, kSamplesKey,
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
    world::KeyRow{"vary", "Values of parameters; each combination is a case, with each row of `cases`.",
                  &kVaryForm},
    world::KeyRow{"steps", "What is done and expected, in this order.", &world::kSteps, true}};
inline constexpr world::Form kScenarioForm = world::keys_form(kScenarioKeys);

}  // namespace understudy::emulator::play
