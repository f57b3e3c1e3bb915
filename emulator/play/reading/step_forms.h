// Declares the forms of the values of steps.
#pragma once

#include <array>

#include "emulator/world/bench_file/fault_form.h"
#include "emulator/world/bench_file/form.h"

namespace understudy::emulator::play {

inline constexpr world::Form kExceptionForm = world::integer_form(1, 255);
inline constexpr std::array<std::string_view, 1> kNothing{"nothing"};
inline constexpr world::Form kNothingForm = world::words_form(kNothing);
inline constexpr world::KeyRow kViaKey{"via", "The line, if the device is on several (default: the first).",
                                       &world::kLineName};
inline constexpr std::array kAnswerKeys{
    world::KeyRow{"exception", "The Modbus exception that the device must return.", &kExceptionForm},
    world::KeyRow{"reply", "`nothing`: no reply may arrive.", &kNothingForm},
    world::KeyRow{"within", "How long no reply may arrive (500ms).", &world::kDuration}, kViaKey};

inline constexpr std::array kProgramBesideKeys{world::KeyRow{
    "refused", "The device must refuse it: `true`, or a part of the message about its first mistake.",
    &world::kText}};

inline constexpr std::array kWaitKeys{
    world::KeyRow{"until", "The condition, checked at every tick without using the line.", &world::kText,
                  true},
    world::KeyRow{"within", "The step fails after this time.", &world::kDuration, true},
    world::KeyRow{"takes", "Expected time since the last write: 3050ms +- 2ms, 1s..2s.", &world::kText},
    world::KeyRow{"poll", "Reads the registers over the line at this interval instead.", &world::kDuration},
    kViaKey};
inline constexpr world::Form kWaitForm = world::keys_form(kWaitKeys);

inline constexpr std::array<const world::Form*, 2> kAssertWays{&world::kText, &world::kTextList};
inline constexpr world::Form kAssertForm = world::either_form(kAssertWays);

inline constexpr std::array kSpanKeys{
    world::KeyRow{"what", "The condition, checked at every tick.", &world::kText, true},
    world::KeyRow{"name", "A name for `end` (default: the condition itself).", &world::kText}};
inline constexpr world::Form kSpanKeysForm = world::keys_form(kSpanKeys);
inline constexpr std::array<const world::Form*, 2> kSpanWays{&world::kText, &kSpanKeysForm};
inline constexpr world::Form kSpanForm = world::either_form(kSpanWays);

inline constexpr world::Form kInjectForm = world::keys_form(world::kInjectKeys);

inline constexpr std::array<std::string_view, 3> kPowerWords{"on", "off", "cycle"};
inline constexpr world::Form kPowerWordsForm = world::words_form(kPowerWords);
inline constexpr world::Form kPowerForm = world::names_form(kPowerWordsForm, world::Form::Of::devices);

inline constexpr std::array<const world::Form*, 2> kReplyLinesWays{&world::kText, &world::kTextList};
inline constexpr world::Form kReplyLinesForm = world::either_form(kReplyLinesWays);
inline constexpr std::array kSendKeys{
    world::KeyRow{"line", "The line (default: the only one).", &world::kLineName},
    world::KeyRow{"bytes", "In hexadecimal; +crc at the end adds the checksum.", &world::kText, true},
    world::KeyRow{"reply", "The expected bytes, or `nothing`.", &world::kText},
    world::KeyRow{"within", "How long to wait for them (500ms).", &world::kDuration}};
inline constexpr std::array kSendTextKeys{
    world::KeyRow{"line", "The line (default: the only one).", &world::kLineName},
    world::KeyRow{"text", "A line of text, without its line ending.", &world::kText, true},
    world::KeyRow{"reply", "The expected line or lines, or `nothing`.", &kReplyLinesForm},
    world::KeyRow{"within", "How long to wait for them (500ms).", &world::kDuration}};
inline constexpr world::Form kSendBytesForm = world::keys_form(kSendKeys);
inline constexpr world::Form kSendTextForm = world::keys_form(kSendTextKeys);
inline constexpr std::array<const world::Form*, 2> kSendWays{&kSendBytesForm, &kSendTextForm};
inline constexpr world::Form kSendForm = world::either_form(kSendWays);
inline constexpr std::array kHearKeys{
    world::KeyRow{"line", "The line (default: the only one).", &world::kLineName},
    world::KeyRow{"text", "The expected line or lines, or `nothing`.", &kReplyLinesForm, true},
    world::KeyRow{"within", "How long to wait for them (500ms).", &world::kDuration}};
inline constexpr world::Form kHearForm = world::keys_form(kHearKeys);

inline constexpr world::Form kForkForm = world::names_form(world::kSteps);

inline constexpr std::array<std::string_view, 1> kResetWords{"peaks"};
inline constexpr world::Form kResetForm = world::words_form(kResetWords);

inline constexpr world::Form kTimesForm = world::integer_form(1, 100'000);
inline constexpr std::array kRepeatKeys{
    world::KeyRow{"times", "The number of rounds.", &kTimesForm, true},
    world::KeyRow{"as", "A name for the number of the round, from 1.", &world::kText},
    world::KeyRow{"steps", "The steps to repeat.", &world::kSteps, true}};
inline constexpr world::Form kRepeatForm = world::keys_form(kRepeatKeys);

inline constexpr std::array<const world::Form*, 2> kRowWays{&world::kText, &world::kTextByName};
inline constexpr world::Form kRowForm = world::either_form(kRowWays);
inline constexpr world::Form kRowsForm = world::list_form(kRowForm);
inline constexpr std::array kForKeys{
    world::KeyRow{"each", "The values, or rows of several: [ { n: 1, speed: 200 }, { n: 2, speed: 400 } ].",
                  &kRowsForm, true},
    world::KeyRow{"as", "A name for the value (rows have names already).", &world::kText},
    world::KeyRow{"steps", "The steps to run for each value.", &world::kSteps, true}};
inline constexpr world::Form kForForm = world::keys_form(kForKeys);

}  // namespace understudy::emulator::play
