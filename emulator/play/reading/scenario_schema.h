// The keys of a scenario file and the schemas of their values. The kinds of steps are in step_rows.h.
#pragma once

#include <array>

#include "emulator/play/reading/hunt_schema.h"
#include "emulator/world/bench_file/bench_schema.h"

namespace understudy::emulator::play {

inline constexpr std::array<const world::Schema*, 2> kBenchAlternatives{&world::kText,
                                                                        &world::kInlineBenchSchema};
inline constexpr world::Schema kBenchOrFileSchema = world::any_of_schemas(kBenchAlternatives);
/// The changes of a play to the bench of the file need not be a complete bench.
inline constexpr world::Schema kBenchPartSchema = world::part_schema(world::kInlineBenchSchema);
inline constexpr std::array<const world::Schema*, 2> kBenchPartAlternatives{&world::kText, &kBenchPartSchema};
inline constexpr world::Schema kBenchOrPartSchema = world::any_of_schemas(kBenchPartAlternatives);
inline constexpr std::array<const world::Schema*, 2> kFirmwareAlternatives{&world::kText,
                                                                           &world::kTextByDevice};
inline constexpr world::Schema kFirmwareSchema = world::any_of_schemas(kFirmwareAlternatives);
inline constexpr world::Schema kCasesSchema = world::list_schema(world::kTextByName);

// --- vary ----------------------------------------------------------------------------------------
inline constexpr world::Schema kSamplesSchema = world::integer_schema(1, 1'000'000'000'000);
inline constexpr world::Schema kTwoTexts = world::list_schema(world::kText, 2);
inline constexpr world::Key kSamplesKey{
    "samples", "Number of distinct values to draw; without it, one value is drawn for each case.",
    &kSamplesSchema};
inline constexpr world::Key kSamplesSeedKey{"seed", "Seed of these draws (default: the scenario's seed).",
                                            &world::kSeedSchema};
inline constexpr std::array kRangeKeys{
    world::Key{"from", "The first value: a number, a duration or a voltage.", &world::kText, true},
    world::Key{"to", "The limit; no value goes beyond it.", &world::kText, true},
    world::Key{"step", "The step from one value to the next.", &world::kText, true}};
inline constexpr std::array kBetweenKeys{
    world::Key{"between", "The smallest and the largest value to draw.", &kTwoTexts, true},
    world::Key{"step", "The distance between values (default: the precision of the ends).", &world::kText},
    kSamplesKey, kSamplesSeedKey};
inline constexpr std::array kOneOfKeys{
    world::Key{"one_of", "Values to choose from at random.", &world::kTextList, true}, kSamplesKey,
    kSamplesSeedKey};
inline constexpr world::Schema kRangeSchema = world::keys_schema(kRangeKeys);
inline constexpr world::Schema kBetweenSchema = world::keys_schema(kBetweenKeys);
inline constexpr world::Schema kOneOfSchema = world::keys_schema(kOneOfKeys);
inline constexpr std::array<const world::Schema*, 4> kVariationAlternatives{&world::kTextList, &kRangeSchema,
                                                                            &kBetweenSchema, &kOneOfSchema};
inline constexpr world::Schema kVariationSchema = world::any_of_schemas(kVariationAlternatives);
inline constexpr world::Schema kVarySchema = world::names_schema(kVariationSchema);

// --- choice --------------------------------------------------------------------------------------
inline constexpr world::Schema kOptionsSchema = world::names_schema(world::kTextByName);
inline constexpr std::array<const world::Schema*, 2> kOptionsAlternatives{&world::kTextList, &kOptionsSchema};
inline constexpr world::Schema kOptionsOrValuesSchema = world::any_of_schemas(kOptionsAlternatives);
inline constexpr world::Schema kChoiceSchema = world::names_schema(kOptionsOrValuesSchema);

// --- keys of a file, and of each of its plays ----------------------------------------------------
inline constexpr world::Key kNameKey{
    "name", "A sentence that describes the scenario (default: the file's name).", &world::kText};
inline constexpr world::Key kBenchKey{"bench", "The bench, or the path of its file.", &kBenchOrFileSchema};
inline constexpr world::Key kNvKey{
    "nv", "Initial contents of the devices' memories: NV image files, by device.", &world::kTextByDevice};
inline constexpr world::Key kFirmwareKey{
    "firmware", "A firmware version to use instead of the bench's: for all devices, or by device.",
    &kFirmwareSchema};
inline constexpr world::Key kGapKey{
    "gap", "Time that the host waits between two requests, in addition to t3.5.", &world::kDuration};
inline constexpr world::Key kSeedKey{"seed", "The seed of all random choices.", &world::kSeedSchema};
inline constexpr world::Key kParametersKey{"parameters", "Names and values, used as ${name}.",
                                           &world::kTextByName};
inline constexpr world::Key kEnvironmentKey{"environment", "Environment variables for the command of `exec`.",
                                            &world::kTextByName};
inline constexpr world::Key kCasesKey{"cases", "Rows of parameters; each row is a case.", &kCasesSchema};
inline constexpr world::Key kChoiceKey{
    "choice",
    "A choice that the manual leaves open, with its options: each option is a case, in which every "
    "device with this choice uses that option. An option can set parameters.",
    &kChoiceSchema};
inline constexpr world::Key kVaryKey{
    "vary", "Values of parameters; each combination with a row of `cases` is a case.", &kVarySchema};

inline constexpr world::Key kHuntKey{"hunt", "The disturbances that `hunt` tries, and what must hold.",
                                     &kHuntSchema};

/// A play has the keys of a scenario. It may omit `bench` and all other keys that the file specifies for all
/// plays.
inline constexpr std::array kPlayKeys{
    world::Key{kNameKey.key, "A sentence that describes the play, different in each play.", &world::kText},
    world::Key{kBenchKey.key, "The bench, or its differences from the bench of the file.",
               &kBenchOrPartSchema},
    kNvKey,
    kFirmwareKey,
    kGapKey,
    kSeedKey,
    kParametersKey,
    kEnvironmentKey,
    kCasesKey,
    kChoiceKey,
    kVaryKey,
    kHuntKey,
    world::Key{"steps", "Actions and expectations, in order.", &world::kSteps}};
inline constexpr world::Schema kPlaySchema = world::keys_schema(kPlayKeys);
inline constexpr world::Schema kPlaysSchema = world::list_schema(kPlaySchema);

inline constexpr std::array kScenarioKeys{
    world::kVersionKey,
    kNameKey,
    kBenchKey,
    kNvKey,
    kFirmwareKey,
    kGapKey,
    kSeedKey,
    kParametersKey,
    kEnvironmentKey,
    kCasesKey,
    kChoiceKey,
    kVaryKey,
    kHuntKey,
    world::Key{"steps", "Actions and expectations, in order.", &world::kSteps},
    world::Key{"plays", "Several plays instead of `steps`; they share all other keys of the file.",
               &kPlaysSchema}};

}  // namespace understudy::emulator::play
