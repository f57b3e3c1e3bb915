// Declares the schemas of the values of steps.
#pragma once

#include <array>

#include "emulator/world/bench_file/fault_schema.h"
#include "emulator/world/bench_file/schema.h"

namespace understudy::emulator::play {

inline constexpr world::Schema kExceptionSchema = world::integer_schema(1, 255);
inline constexpr std::array<std::string_view, 1> kNothing{"nothing"};
inline constexpr world::Schema kNothingSchema = world::words_schema(kNothing);
inline constexpr world::Key kViaKey{"via", "The line, if the device is on several (default: the first).",
                                    &world::kLineName};
inline constexpr std::array kAnswerKeys{
    world::Key{"exception", "The Modbus exception that the device must return.", &kExceptionSchema},
    world::Key{"reply", "`nothing`: there must be no reply.", &kNothingSchema},
    world::Key{"within", "How long there must be no reply (default: 500ms).", &world::kDuration}, kViaKey};

inline constexpr std::array kProgramBesideKeys{world::Key{
    "refused", "The device must refuse it: `true`, or a part of the message about its first mistake.",
    &world::kText}};

inline constexpr std::array kWaitKeys{
    world::Key{"until", "The condition, checked at every tick without using the line.", &world::kText, true},
    world::Key{"within", "The step fails after this time.", &world::kDuration, true},
    world::Key{"takes", "Expected time since the last write: 3050ms +- 2ms, 1s..2s.", &world::kText},
    world::Key{"poll", "Reads the registers over the line at this interval instead.", &world::kDuration},
    kViaKey};
inline constexpr world::Schema kWaitSchema = world::keys_schema(kWaitKeys);

inline constexpr std::array<const world::Schema*, 2> kAssertAlternatives{&world::kText, &world::kTextList};
inline constexpr world::Schema kAssertSchema = world::any_of_schemas(kAssertAlternatives);

inline constexpr std::array kSpanKeys{
    world::Key{"what", "The condition, checked at every tick.", &world::kText, true},
    world::Key{"name", "A name for `end` (default: the condition itself).", &world::kText}};
inline constexpr world::Schema kSpanKeysSchema = world::keys_schema(kSpanKeys);
inline constexpr std::array<const world::Schema*, 2> kSpanAlternatives{&world::kText, &kSpanKeysSchema};
inline constexpr world::Schema kSpanSchema = world::any_of_schemas(kSpanAlternatives);

inline constexpr world::Schema kInjectSchema = world::keys_schema(world::kInjectKeys);

inline constexpr std::array<std::string_view, 3> kPowerWords{"on", "off", "cycle"};
inline constexpr world::Schema kPowerWordsSchema = world::words_schema(kPowerWords);
inline constexpr world::Schema kPowerSchema =
    world::names_schema(kPowerWordsSchema, world::Schema::Of::devices);

inline constexpr std::array<const world::Schema*, 2> kReplyLinesAlternatives{&world::kText,
                                                                             &world::kTextList};
inline constexpr world::Schema kReplyLinesSchema = world::any_of_schemas(kReplyLinesAlternatives);
inline constexpr std::array kSendKeys{
    world::Key{"line", "The line (default: the only one).", &world::kLineName},
    world::Key{"bytes", "The bytes in hexadecimal; +crc at the end adds the checksum.", &world::kText, true},
    world::Key{"reply", "The expected bytes, or `nothing`.", &world::kText},
    world::Key{"within", "How long to wait for them (default: 500ms).", &world::kDuration}};
inline constexpr std::array kSendTextKeys{
    world::Key{"line", "The line (default: the only one).", &world::kLineName},
    world::Key{"text", "A line of text, without its line ending.", &world::kText, true},
    world::Key{"reply", "The expected line or lines, or `nothing`.", &kReplyLinesSchema},
    world::Key{"within", "How long to wait for them (default: 500ms).", &world::kDuration}};
inline constexpr world::Schema kSendBytesSchema = world::keys_schema(kSendKeys);
inline constexpr world::Schema kSendTextSchema = world::keys_schema(kSendTextKeys);
inline constexpr std::array<const world::Schema*, 2> kSendAlternatives{&kSendBytesSchema, &kSendTextSchema};
inline constexpr world::Schema kSendSchema = world::any_of_schemas(kSendAlternatives);
inline constexpr std::array kHearKeys{
    world::Key{"line", "The line (default: the only one).", &world::kLineName},
    world::Key{"text", "The expected line or lines, or `nothing`.", &kReplyLinesSchema, true},
    world::Key{"within", "How long to wait for them (default: 500ms).", &world::kDuration}};
inline constexpr world::Schema kHearSchema = world::keys_schema(kHearKeys);

inline constexpr world::Schema kExitCodeSchema = world::integer_schema(0, 255);
inline constexpr std::array kHostKeys{
    world::Key{"exits", "The expected exit code (default: 0).", &kExitCodeSchema},
    world::Key{"within", "The step fails after this time.", &world::kDuration, true}};
inline constexpr world::Schema kHostKeysSchema = world::keys_schema(kHostKeys);
inline constexpr std::array<std::string_view, 1> kHostWords{"stop"};
inline constexpr world::Schema kHostWordsSchema = world::words_schema(kHostWords);
inline constexpr std::array<const world::Schema*, 2> kHostAlternatives{&kHostWordsSchema, &kHostKeysSchema};
inline constexpr world::Schema kHostSchema = world::any_of_schemas(kHostAlternatives);

inline constexpr world::Schema kForkSchema = world::names_schema(world::kSteps);

inline constexpr std::array<std::string_view, 1> kResetWords{"peaks"};
inline constexpr world::Schema kResetSchema = world::words_schema(kResetWords);

inline constexpr world::Schema kTimesSchema = world::integer_schema(1, 100'000);
inline constexpr std::array kRepeatKeys{
    world::Key{"times", "The number of rounds.", &kTimesSchema, true},
    world::Key{"as", "A name for the number of the round, from 1.", &world::kText},
    world::Key{"steps", "The steps to repeat.", &world::kSteps, true}};
inline constexpr world::Schema kRepeatSchema = world::keys_schema(kRepeatKeys);

inline constexpr std::array<const world::Schema*, 2> kRowAlternatives{&world::kText, &world::kTextByName};
inline constexpr world::Schema kRowSchema = world::any_of_schemas(kRowAlternatives);
inline constexpr world::Schema kRowsSchema = world::list_schema(kRowSchema);
inline constexpr std::array kForKeys{
    world::Key{"each", "The values, or rows of several: [ { n: 1, speed: 200 }, { n: 2, speed: 400 } ].",
               &kRowsSchema, true},
    world::Key{"as", "A name for the value (rows already have names).", &world::kText},
    world::Key{"steps", "The steps to run for each value.", &world::kSteps, true}};
inline constexpr world::Schema kForSchema = world::keys_schema(kForKeys);

}  // namespace understudy::emulator::play
