// What a scenario file may say, but for the kinds of its steps (step_rows.h): its keys, and the forms of
// their values.
#pragma once

#include <array>

#include "emulator/bench/bench_form.h"

namespace understudy::emulator {

inline constexpr std::array<const Form*, 2> kBenchWays{&kText, &kInlineBenchForm};
inline constexpr Form kBenchOrFileForm = either_form(kBenchWays);
inline constexpr std::array<const Form*, 2> kFirmwareWays{&kText, &kTextByName};
inline constexpr Form kFirmwareForm = either_form(kFirmwareWays);
inline constexpr Form kCasesForm = list_form(kTextByName);

inline constexpr std::array kScenarioKeys{
    kVersionKey,
    KeyRow{"name", "What it is about, as a sentence; the file's name without it.", &kText},
    KeyRow{"bench", "The bench, or the path of its file.", &kBenchOrFileForm, true},
    KeyRow{"nv", "What the devices' memories hold at first: files of NV images, by device.", &kTextByName},
    KeyRow{"firmware", "Another firmware than the bench's: for all devices, or by device.", &kFirmwareForm},
    KeyRow{"gap", "Time that the host leaves between two requests, beyond t3.5.", &kDuration},
    KeyRow{"seed", "Where randomness begins.", &kSeedForm},
    KeyRow{"parameters", "Names and values, used as ${name}.", &kTextByName},
    KeyRow{"cases", "Rows of parameters; each is a scenario of its own.", &kCasesForm},
    KeyRow{"steps", "What is done and expected, in this order.", &kSteps, true}};
inline constexpr Form kScenarioForm = keys_form(kScenarioKeys);

}  // namespace understudy::emulator
