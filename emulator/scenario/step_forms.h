// What the values of steps look like.
#pragma once

#include <array>

#include "emulator/faults/fault_form.h"
#include "emulator/forms/form.h"

namespace understudy::emulator {

inline constexpr Form kExceptionForm = integer_form(1, 255);
inline constexpr std::array<std::string_view, 1> kNothing{"nothing"};
inline constexpr Form kNothingForm = words_form(kNothing);
inline constexpr std::array kAnswerKeys{
    KeyRow{"exception", "The Modbus exception that the device is to answer with.", &kExceptionForm},
    KeyRow{"reply", "`nothing`, where no answer may come.", &kNothingForm},
    KeyRow{"within", "For how long none may come (500ms).", &kDuration}};

inline constexpr std::array kWaitKeys{
    KeyRow{"until", "The condition, looked at in every tick without the line.", &kText, true},
    KeyRow{"within", "It fails if this long is not enough.", &kDuration, true},
    KeyRow{"takes", "How long it takes from the last write: 3050ms +- 2ms, 1s..2s.", &kText},
    KeyRow{"poll", "Reads the registers over the line this often instead.", &kDuration}};
inline constexpr Form kWaitForm = keys_form(kWaitKeys);

inline constexpr std::array<const Form*, 2> kAssertWays{&kText, &kTextList};
inline constexpr Form kAssertForm = either_form(kAssertWays);

inline constexpr std::array kSpanKeys{KeyRow{"what", "The condition, looked at in every tick.", &kText, true},
                                      KeyRow{"name", "For `end`; the condition itself without it.", &kText}};
inline constexpr Form kSpanKeysForm = keys_form(kSpanKeys);
inline constexpr std::array<const Form*, 2> kSpanWays{&kText, &kSpanKeysForm};
inline constexpr Form kSpanForm = either_form(kSpanWays);

inline constexpr Form kInjectForm = keys_form(kInjectKeys);

inline constexpr std::array<std::string_view, 3> kPowerWords{"on", "off", "cycle"};
inline constexpr Form kPowerWordsForm = words_form(kPowerWords);
inline constexpr Form kPowerForm = names_form(kPowerWordsForm);

inline constexpr std::array<const Form*, 2> kReplyLinesWays{&kText, &kTextList};
inline constexpr Form kReplyLinesForm = either_form(kReplyLinesWays);
inline constexpr std::array kSendKeys{
    KeyRow{"line", "On which line; the only one without it.", &kText},
    KeyRow{"bytes", "In hexadecimal; +crc at the end adds the checksum.", &kText, true},
    KeyRow{"reply", "The bytes that must come, or `nothing`.", &kText},
    KeyRow{"within", "How long to wait for them (500ms).", &kDuration}};
inline constexpr std::array kSendTextKeys{
    KeyRow{"line", "On which line; the only one without it.", &kText},
    KeyRow{"text", "A line of text, without its end.", &kText, true},
    KeyRow{"reply", "The line or the lines that must come, or `nothing`.", &kReplyLinesForm},
    KeyRow{"within", "How long to wait for them (500ms).", &kDuration}};
inline constexpr Form kSendBytesForm = keys_form(kSendKeys);
inline constexpr Form kSendTextForm = keys_form(kSendTextKeys);
inline constexpr std::array<const Form*, 2> kSendWays{&kSendBytesForm, &kSendTextForm};
inline constexpr Form kSendForm = either_form(kSendWays);
inline constexpr std::array kHearKeys{
    KeyRow{"line", "On which line; the only one without it.", &kText},
    KeyRow{"text", "The line or the lines that must come, or `nothing`.", &kReplyLinesForm, true},
    KeyRow{"within", "How long to wait for them (500ms).", &kDuration}};
inline constexpr Form kHearForm = keys_form(kHearKeys);

inline constexpr Form kForkForm = names_form(kSteps);

inline constexpr std::array<std::string_view, 1> kResetWords{"peaks"};
inline constexpr Form kResetForm = words_form(kResetWords);

inline constexpr Form kTimesForm = integer_form(1, 100'000);
inline constexpr std::array kRepeatKeys{KeyRow{"times", "How often.", &kTimesForm, true},
                                        KeyRow{"as", "A name for the number of the round, from 1.", &kText},
                                        KeyRow{"steps", "What is repeated.", &kSteps, true}};
inline constexpr Form kRepeatForm = keys_form(kRepeatKeys);

inline constexpr std::array<const Form*, 2> kRowWays{&kText, &kTextByName};
inline constexpr Form kRowForm = either_form(kRowWays);
inline constexpr Form kRowsForm = list_form(kRowForm);
inline constexpr std::array kForKeys{
    KeyRow{"each", "The values, or rows of several: [ { n: 1, speed: 200 }, { n: 2, speed: 400 } ].",
           &kRowsForm, true},
    KeyRow{"as", "A name for the value (rows have names already).", &kText},
    KeyRow{"steps", "What is done for each.", &kSteps, true}};
inline constexpr Form kForForm = keys_form(kForKeys);

}  // namespace understudy::emulator
