// Declares the keys of a model file (docs/import.md) and the forms of their values.
#pragma once

#include <array>

#include "emulator/models/imported/description.h"
#include "emulator/world/bench_file/form.h"

namespace understudy::emulator::model_file {

using world::Form;
using world::KeyRow;

inline constexpr Form kVersionForm = world::integer_form(1, 1);

// --- the line ------------------------------------------------------------------------------------
inline constexpr Form kBaudForm = world::integer_form(50, 4'000'000);
inline constexpr Form kBaudsForm = world::list_form(kBaudForm);
inline constexpr std::array<const Form*, 2> kBaudWays{&kBaudForm, &kBaudsForm};
inline constexpr Form kBaudOrBaudsForm = world::either_form(kBaudWays);
inline constexpr std::array<std::string_view, 3> kParities{"none", "even", "odd"};
inline constexpr Form kParityForm = world::words_form(kParities);
inline constexpr Form kStopBitsForm = world::integer_form(1, 2);
inline constexpr Form kStationForm = world::integer_form(1, 247);
inline constexpr Form kStationsForm = world::list_form(kStationForm, 2);
inline constexpr Form kFunctionForm = world::integer_form(1, 127);
inline constexpr Form kFunctionsForm = world::list_form(kFunctionForm);
inline constexpr Form kMaxForm = world::integer_form(1, 2000);
inline constexpr Form kMaxByFunctionForm = world::names_form(kMaxForm);
inline constexpr std::array<std::string_view, 2> kObeysOrIgnores{"obeyed", "ignored"};
inline constexpr Form kBroadcastForm = world::words_form(kObeysOrIgnores);
inline constexpr std::array kLineKeys{
    KeyRow{"baud", "The speeds that it can be set to, the factory's first ([19200, 9600]).",
           &kBaudOrBaudsForm},
    KeyRow{"parity", "none (default), even or odd.", &kParityForm},
    KeyRow{"stop_bits", "1 (default) or 2.", &kStopBitsForm},
    KeyRow{"silence", "The silence that ends a frame (3.5 characters; above 19200 baud 1.75 ms).",
           &world::kDuration},
    KeyRow{"stations", "The lowest and the highest station number ([1, 247]).", &kStationsForm},
    KeyRow{"station_in", "The register that holds the station number.", &world::kText},
    KeyRow{"functions", "The functions that it knows ([1, 2, 3, 4, 5, 6, 15, 16]).", &kFunctionsForm},
    KeyRow{"most", "The most registers or bits in one request, by function: { 3: 32 }.", &kMaxByFunctionForm},
    KeyRow{"broadcast", "Requests to station 0: obeyed (default) or ignored.", &kBroadcastForm}};

// --- the map ---------------------------------------------------------------------------------------
inline constexpr std::array<std::string_view, 2> kRefusedOrZero{"refused", "zero"};
inline constexpr std::array<std::string_view, 3> kOutOfRange{"refused", "clamped", "stored"};
inline constexpr std::array<std::string_view, 2> kRefusedOrIgnored{"refused", "ignored"};
inline constexpr std::array<std::string_view, 2> kZeroOrRefused{"zero", "refused"};
inline constexpr std::array<std::string_view, 2> kAloneOrWhole{"alone", "whole"};
inline constexpr std::array<std::string_view, 2> kHighOrLow{"high", "low"};
inline constexpr Form kRefusedOrZeroForm = world::words_form(kRefusedOrZero);
inline constexpr Form kOutOfRangeForm = world::words_form(kOutOfRange);
inline constexpr Form kRefusedOrIgnoredForm = world::words_form(kRefusedOrIgnored);
inline constexpr Form kZeroOrRefusedForm = world::words_form(kZeroOrRefused);
inline constexpr Form kAloneOrWholeForm = world::words_form(kAloneOrWhole);
inline constexpr Form kHighOrLowForm = world::words_form(kHighOrLow);
inline constexpr std::array kMapKeys{
    KeyRow{"holes", "Addresses without a register: refused (default), or read as zero.", &kRefusedOrZeroForm},
    KeyRow{"out_of_range", "A value beyond min and max: refused (default), clamped or stored.",
           &kOutOfRangeForm},
    KeyRow{"read_only", "A write to such a register: refused (default) or ignored.", &kRefusedOrIgnoredForm},
    KeyRow{"write_only", "A read of such a register: zero (default) or refused.", &kZeroOrRefusedForm},
    KeyRow{"halves", "Half of a 32-bit value: read and written alone (default), or only as a whole.",
           &kAloneOrWholeForm},
    KeyRow{"first_word", "The first word of 32 bits: high (default) or low.", &kHighOrLowForm}};

// --- axes --------------------------------------------------------------------------------------------
inline constexpr std::array<std::string_view, 2> kWays{"minus", "plus"};
inline constexpr Form kWayForm = world::words_form(kWays);
inline constexpr std::array<std::string_view, 3> kWhileBusy{"replace", "ignore", "refuse"};
inline constexpr Form kWhileBusyForm = world::words_form(kWhileBusy);
inline constexpr std::array<std::string_view, 2> kWhileDisabled{"ignore", "refuse"};
inline constexpr Form kWhileDisabledForm = world::words_form(kWhileDisabled);
inline constexpr Form kCountsForm = world::integer_form(INT32_MIN, INT32_MAX);
inline constexpr Form kPerRevolutionForm = world::integer_form(1, 10'000'000);
inline constexpr std::array kAxisInputKeys{
    KeyRow{"upper_limit", "The input of the upper limit switch.", &world::kText},
    KeyRow{"lower_limit", "The input of the lower limit switch.", &world::kText},
    KeyRow{"home", "The input of the home switch.", &world::kText},
    KeyRow{"alarm", "The input of the drive's alarm.", &world::kText}};
inline constexpr Form kAxisInputsForm = world::keys_form(kAxisInputKeys);

/// The keys are in the order of imported::Number, then Command, then View, then the rest.
inline constexpr std::array kAxisKeys{
    KeyRow{"target", "The target of `start`: a register, or a number.", &world::kText},
    KeyRow{"distance", "The distance of `start_relative`.", &world::kText},
    KeyRow{"speed", "The speed of moves.", &world::kText},
    KeyRow{"start_speed", "The speed at which moves begin and end (0).", &world::kText},
    KeyRow{"acceleration_time", "The time from 0 to the speed: a register, or a duration.", &world::kText},
    KeyRow{"deceleration_time", "The same for slowing down (acceleration_time).", &world::kText},
    KeyRow{"acceleration", "Change of speed per second, instead of a time.", &world::kText},
    KeyRow{"deceleration", "The same for slowing down (acceleration).", &world::kText},
    KeyRow{"rated_speed", "The speed that the times refer to (the speed of the move).", &world::kText},
    KeyRow{"home_speed", "The speed of homing (speed).", &world::kText},
    KeyRow{"stop_at_once", "Stops it at once, without deceleration: CONTROL.3, or COMMAND == 9.",
           &world::kText},
    KeyRow{"stop", "Stops it with deceleration.", &world::kText},
    KeyRow{"enable", "Condition that must be true for it to move (always true).", &world::kText},
    KeyRow{"home", "Starts homing.", &world::kText},
    KeyRow{"start", "Starts a move to `target`.", &world::kText},
    KeyRow{"start_relative", "Starts a move by `distance`.", &world::kText},
    KeyRow{"forward", "It runs in the positive direction while this is true.", &world::kText},
    KeyRow{"backward", "It runs in the negative direction while this is true.", &world::kText},
    KeyRow{"position", "The register that shows its position; a write sets the count.", &world::kText},
    KeyRow{"actual_speed", "The register that shows its speed.", &world::kText},
    KeyRow{"encoder", "The register that shows the count of its encoder.", &world::kText},
    KeyRow{"busy", "The bit (or register) that is 1 while it moves.", &world::kText},
    KeyRow{"ready", "1 while it is at rest, enabled, and without an alarm.", &world::kText},
    KeyRow{"arrived", "1 when the last move has reached its target.", &world::kText},
    KeyRow{"homed", "1 when home has been found.", &world::kText},
    KeyRow{"enabled", "1 while it is enabled.", &world::kText},
    KeyRow{"alarm", "1 while its alarm input is on.", &world::kText},
    KeyRow{"at_upper_limit", "1 while its upper limit switch is on.", &world::kText},
    KeyRow{"at_lower_limit", "1 while its lower limit switch is on.", &world::kText},
    KeyRow{"pulses_per_count", "Pulses for each count of a position (1): 10, or 25/4.", &world::kText},
    KeyRow{"pps_per_count", "Pulses a second for each count of a speed (1).", &world::kText},
    KeyRow{"inputs", "The inputs of its switches.", &kAxisInputsForm},
    KeyRow{"home_way", "Direction of homing: minus (default) or plus.", &kWayForm},
    KeyRow{"home_position", "The position at home (0).", &kCountsForm},
    KeyRow{"pulses_per_revolution", "Pulses per motor revolution, for encoders on a bench.",
           &kPerRevolutionForm},
    KeyRow{"while_busy", "What a start does while it moves: replace (default), ignore or refuse.",
           &kWhileBusyForm},
    KeyRow{"while_disabled", "What a start does while it is not enabled: ignore (default) or refuse.",
           &kWhileDisabledForm}};
inline constexpr std::size_t kFirstCommandKey = models::imported::kNumbers;
inline constexpr std::size_t kFirstViewKey = kFirstCommandKey + models::imported::kCommands;
static_assert(kAxisKeys[kFirstCommandKey].key == "stop_at_once" &&
                  kAxisKeys[kFirstViewKey].key == "position" &&
                  kAxisKeys[kFirstViewKey + models::imported::kViews].key == "pulses_per_count",
              "keys stand in the order of Number, Command and View");
constexpr std::string_view key_of(models::imported::Number number) {
  return kAxisKeys[static_cast<std::size_t>(number)].key;
}
constexpr std::string_view key_of(models::imported::Command command) {
  return kAxisKeys[kFirstCommandKey + static_cast<std::size_t>(command)].key;
}
constexpr std::string_view key_of(models::imported::View view) {
  return kAxisKeys[kFirstViewKey + static_cast<std::size_t>(view)].key;
}

// --- the rest ----------------------------------------------------------------------------------------
inline constexpr std::array kFollowKeys{
    KeyRow{"of", "The value that it follows: a register, or a number.", &world::kText, true},
    KeyRow{"while", "Only while this holds: CONTROL.RUN, or MODE == 2 (always).", &world::kText},
    KeyRow{"rest", "The value that it follows otherwise: a register, or a number (its default).",
           &world::kText},
    KeyRow{"time_constant", "The time for 63.2 % of a change: 30s.", &world::kDuration},
    KeyRow{"rate", "The largest change per second, in counts.", &world::kText},
    KeyRow{"every", "The interval of its updates (100ms).", &world::kDuration}};
inline constexpr Form kLineForm = world::keys_form(kLineKeys);
inline constexpr Form kMapForm = world::keys_form(kMapKeys);
inline constexpr Form kAxisForm = world::keys_form(kAxisKeys);
inline constexpr Form kAxesForm = world::names_form(kAxisForm);
inline constexpr Form kFollowForm = world::keys_form(kFollowKeys);
inline constexpr Form kFollowsForm = world::names_form(kFollowForm);
inline constexpr Form kBitNamesForm = world::names_form(world::kTextByName);
inline constexpr std::array kModelKeys{
    KeyRow{"understudy", "The version of the format.", &kVersionForm, true},
    KeyRow{"model", "The model's name: letters, digits, _ and -.", &world::kText, true},
    KeyRow{"title", "A short description.", &world::kText},
    KeyRow{"registers", "The path of the list of its registers (CSV), or the list itself.", &world::kText,
           true},
    KeyRow{"line", "Its settings on the serial line.", &kLineForm},
    KeyRow{"map", "How it answers requests that the list leaves open.", &kMapForm},
    KeyRow{"bits", "Names of bits: { STATUS: { READY: 0, STATE: 4-7 } }.", &kBitNamesForm},
    KeyRow{"inputs", "Its inputs, and where they are shown: { DI1: INPUTS.0, HOME: nowhere }.",
           &world::kTextByName},
    KeyRow{"outputs", "Its outputs, and the registers that switch them: { DO1: OUTPUTS.0 }.",
           &world::kTextByName},
    KeyRow{"axes", "Its motor axes, by name, and the registers that are bound to them.", &kAxesForm},
    KeyRow{"follows", "Registers that follow another value with a lag.", &kFollowsForm},
    KeyRow{"shows", "Bits that are 1 while a relation holds: { STATUS.ALARM: TEMPERATURE > LIMIT }.",
           &world::kTextByName},
    KeyRow{"momentary", "Registers that return to 0 once they have started something.", &world::kTextList}};

}  // namespace understudy::emulator::model_file
