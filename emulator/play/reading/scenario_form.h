// Declares the keys of a scenario file and the forms of their values. step_rows.h has the kinds of steps.
#pragma once

#include <array>

#include "emulator/world/bench_file/bench_form.h"

namespace understudy::emulator::play {

inline constexpr std::array<const world::Form*, 2> kBenchWays{&world::kText, &world::kInlineBenchForm};
inline constexpr world::Form kBenchOrFileForm = world::either_form(kBenchWays);
/// What a play changes of the file's bench need not be a bench by itself.
inline constexpr world::Form kBenchPartForm = world::part_form(world::kInlineBenchForm);
inline constexpr std::array<const world::Form*, 2> kBenchPartWays{&world::kText, &kBenchPartForm};
inline constexpr world::Form kBenchOrPartForm = world::either_form(kBenchPartWays);
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

// --- choice --------------------------------------------------------------------------------------
inline constexpr world::Form kOptionsForm = world::names_form(world::kTextByName);
inline constexpr std::array<const world::Form*, 2> kOptionsWays{&world::kTextList, &kOptionsForm};
inline constexpr world::Form kOptionsOrValuesForm = world::either_form(kOptionsWays);
inline constexpr world::Form kChoiceForm = world::names_form(kOptionsOrValuesForm);

// --- keys of a file, and of each of its plays ----------------------------------------------------
inline constexpr world::KeyRow kNameKey{
    "name", "A sentence that describes the scenario (default: the file's name).", &world::kText};
inline constexpr world::KeyRow kBenchKey{"bench", "The bench, or the path of its file.", &kBenchOrFileForm};
inline constexpr world::KeyRow kNvKey{
    "nv", "Initial contents of the devices' memories: NV image files, by device.", &world::kTextByDevice};
inline constexpr world::KeyRow kFirmwareKey{
    "firmware", "A firmware version to use instead of the bench's: for all devices, or by device.",
    &kFirmwareForm};
inline constexpr world::KeyRow kGapKey{
    "gap", "Time that the host waits between two requests, in addition to t3.5.", &world::kDuration};
inline constexpr world::KeyRow kSeedKey{"seed", "The seed of all random choices.", &world::kSeedForm};
inline constexpr world::KeyRow kParametersKey{"parameters", "Names and values, used as ${name}.",
                                              &world::kTextByName};
inline constexpr world::KeyRow kCasesKey{"cases", "Rows of parameters; each row is a case.", &kCasesForm};
inline constexpr world::KeyRow kChoiceKey{
    "choice",
    "A choice that the manual leaves open, with its options: each option is a case, in which every "
    "device that has the choice has that option. An option may give values to parameters.",
    &kChoiceForm};
inline constexpr world::KeyRow kVaryKey{
    "vary", "Values of parameters; each combination is a case, for each row of `cases`.", &kVaryForm};

/// A play has the keys of a scenario. It may leave out `bench`, and what else the file gives to all of them.
inline constexpr std::array kPlayKeys{
    world::KeyRow{kNameKey.key, "What it is about, as a sentence; no two plays share one.", &world::kText},
    world::KeyRow{kBenchKey.key, "The bench; where the file has one too, what differs from that.",
                  &kBenchOrPartForm},
    kNvKey,
    kFirmwareKey,
    kGapKey,
    kSeedKey,
    kParametersKey,
    kCasesKey,
    kChoiceKey,
    kVaryKey,
    world::KeyRow{"steps", "Actions and expectations, in order.", &world::kSteps}};
inline constexpr world::Form kPlayForm = world::keys_form(kPlayKeys);
inline constexpr world::Form kPlaysForm = world::list_form(kPlayForm);

inline constexpr std::array kScenarioKeys{
    world::kVersionKey,
    kNameKey,
    kBenchKey,
    kNvKey,
    kFirmwareKey,
    kGapKey,
    kSeedKey,
    kParametersKey,
    kCasesKey,
    kChoiceKey,
    kVaryKey,
    world::KeyRow{"steps", "Actions and expectations, in order.", &world::kSteps},
    world::KeyRow{"plays", "Several plays instead of `steps`; they share all other keys of the file.",
                  &kPlaysForm}};

}  // namespace understudy::emulator::play
