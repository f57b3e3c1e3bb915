// The keys of a model file (docs/import.md), and the schemas of their values.
#pragma once

#include <array>

#include "emulator/model_file/list_reading.h"
#include "emulator/model_file/list_text.h"
#include "emulator/models/imported/description.h"
#include "emulator/world/bench_file/schema.h"

namespace understudy::emulator::model_file {

using world::Key;
using world::Schema;

inline constexpr Schema kVersionSchema = world::integer_schema(1, 1);

// --- the line ------------------------------------------------------------------------------------
inline constexpr Schema kBaudSchema = world::integer_schema(50, 4'000'000);
inline constexpr Schema kBaudsSchema = world::list_schema(kBaudSchema);
inline constexpr std::array<const Schema*, 2> kBaudAlternatives{&kBaudSchema, &kBaudsSchema};
inline constexpr Schema kBaudOrBaudsSchema = world::any_of_schemas(kBaudAlternatives);
inline constexpr std::array<std::string_view, 3> kParities{"none", "even", "odd"};
inline constexpr Schema kParitySchema = world::words_schema(kParities);
inline constexpr Schema kStopBitsSchema = world::integer_schema(1, 2);
inline constexpr Schema kStationSchema = world::integer_schema(1, 247);
inline constexpr Schema kStationsSchema = world::list_schema(kStationSchema, 2);
inline constexpr Schema kFunctionSchema = world::integer_schema(1, 127);
inline constexpr Schema kFunctionsSchema = world::list_schema(kFunctionSchema);
inline constexpr Schema kMaxSchema = world::integer_schema(1, 2000);
inline constexpr Schema kMaxByFunctionSchema = world::names_schema(kMaxSchema);
inline constexpr std::array<std::string_view, 2> kObeysOrIgnores{"obeyed", "ignored"};
inline constexpr Schema kBroadcastSchema = world::words_schema(kObeysOrIgnores);
/// The names of the objects of function 43/14, beginning with object 0.
inline constexpr std::array kIdentityKeys{
    Key{"vendor", "Object 0, the vendor's name.", &world::kText},
    Key{"product", "Object 1, the product code.", &world::kText},
    Key{"revision", "Object 2, the revision.", &world::kText},
    Key{"url", "Object 3, the vendor's URL.", &world::kText},
    Key{"product_name", "Object 4.", &world::kText},
    Key{"model_name", "Object 5.", &world::kText},
    Key{"application", "Object 6, the user application.", &world::kText}};
inline constexpr Schema kIdentitySchema = world::keys_schema(kIdentityKeys);
inline constexpr std::array<std::string_view, 2> kFramings{"rtu", "ascii"};
inline constexpr Schema kFramingSchema = world::words_schema(kFramings);
inline constexpr Schema kDataBitsSchema = world::integer_schema(7, 8);
inline constexpr std::array kLineKeys{
    Key{"framing", "rtu (default), or ascii: frames of hexadecimal digits that begin with ':'.",
        &kFramingSchema},
    Key{"baud", "The possible speeds, with the factory setting first ([19200, 9600]).", &kBaudOrBaudsSchema},
    Key{"data_bits", "8 (default), or 7 with `framing: ascii` (its default).", &kDataBitsSchema},
    Key{"parity", "none (default), even (default with `framing: ascii`) or odd.", &kParitySchema},
    Key{"stop_bits", "1 (default) or 2.", &kStopBitsSchema},
    Key{"silence", "The silence that ends a frame (3.5 characters; above 19200 baud 1.75 ms).",
        &world::kDuration},
    Key{"stations", "The lowest and the highest station number ([1, 247]).", &kStationsSchema},
    Key{"station_in", "The register that holds the station number.", &world::kText},
    Key{"functions",
        "The supported functions ([1, 2, 3, 4, 5, 6, 15, 16]); 8, 17, 22, 23 and 43 are also possible.",
        &kFunctionsSchema},
    Key{"most", "The maximum number of registers or bits in one request, by function: { 3: 32 }.",
        &kMaxByFunctionSchema},
    Key{"identity", "The replies to function 43 (read device identification).", &kIdentitySchema},
    Key{"server_id", "The reply to function 17 (the model's name).", &world::kText},
    Key{"broadcast", "Requests to station 0: obeyed (default) or ignored.", &kBroadcastSchema}};

// --- the map ---------------------------------------------------------------------------------------
inline constexpr std::array<std::string_view, 2> kRefusedOrZero{"refused", "zero"};
inline constexpr std::array<std::string_view, 3> kOutOfRange{"refused", "clamped", "stored"};
inline constexpr std::array<std::string_view, 2> kRefusedOrIgnored{"refused", "ignored"};
inline constexpr std::array<std::string_view, 2> kZeroOrRefused{"zero", "refused"};
inline constexpr std::array<std::string_view, 3> kHalves{"alone", "judged", "whole"};
inline constexpr std::array<std::string_view, 2> kHighOrLow{"high", "low"};
inline constexpr Schema kRefusedOrZeroSchema = world::words_schema(kRefusedOrZero);
inline constexpr Schema kOutOfRangeSchema = world::words_schema(kOutOfRange);
inline constexpr Schema kRefusedOrIgnoredSchema = world::words_schema(kRefusedOrIgnored);
inline constexpr Schema kZeroOrRefusedSchema = world::words_schema(kZeroOrRefused);
inline constexpr Schema kHalvesSchema = world::words_schema(kHalves);
inline constexpr Schema kHighOrLowSchema = world::words_schema(kHighOrLow);
inline constexpr std::array kMapKeys{
    Key{"holes", "Addresses without a register: refused (default), or read as zero.", &kRefusedOrZeroSchema},
    Key{"out_of_range", "A value outside min and max: refused (default), clamped or stored.",
        &kOutOfRangeSchema},
    Key{"read_only", "A write to a read-only register: refused (default) or ignored.",
        &kRefusedOrIgnoredSchema},
    Key{"write_only", "A read of a write-only register: zero (default) or refused.", &kZeroOrRefusedSchema},
    Key{"halves",
        "Half of a 32-bit value: read and written alone (default), judged with the other half, or only as a "
        "whole.",
        &kHalvesSchema},
    Key{"first_word", "The first word of a 32-bit value: high (default) or low.", &kHighOrLowSchema}};

// --- the list --------------------------------------------------------------------------------------
inline constexpr Schema kAddressesSchema = world::words_schema(kAddressReadings);
inline constexpr std::array<std::string_view, 4> kTables{"holding", "input", "coil", "discrete"};
inline constexpr Schema kTableSchema = world::words_schema(kTables);
inline constexpr Schema kEncodingSchema = world::words_schema(kEncodings);
inline constexpr std::array kListKeys{
    Key{"columns", "The column headings, by column name: { address: Reg, name: Tag }.", &world::kTextByName},
    Key{"addresses", "How the addresses are numbered: wire (default), from_one or modicon (40001).",
        &kAddressesSchema},
    Key{"table", "The table of rows that do not name one: holding (default), input, coil or discrete.",
        &kTableSchema},
    Key{"encoding", "The encoding (guessed): utf-8, utf-16, latin-1, big5 or gbk.", &kEncodingSchema}};

// --- axes --------------------------------------------------------------------------------------------
inline constexpr std::array<std::string_view, 2> kDirections{"minus", "plus"};
inline constexpr Schema kDirectionSchema = world::words_schema(kDirections);
inline constexpr std::array<std::string_view, 3> kWhileBusy{"replace", "ignore", "refuse"};
inline constexpr Schema kWhileBusySchema = world::words_schema(kWhileBusy);
inline constexpr std::array<std::string_view, 2> kWhileDisabled{"ignore", "refuse"};
inline constexpr Schema kWhileDisabledSchema = world::words_schema(kWhileDisabled);
inline constexpr Schema kCountsSchema = world::integer_schema(INT32_MIN, INT32_MAX);
inline constexpr Schema kPerRevolutionSchema = world::integer_schema(1, 10'000'000);
inline constexpr std::array kAxisInputKeys{
    Key{"upper_limit", "The input of the upper limit switch.", &world::kText},
    Key{"lower_limit", "The input of the lower limit switch.", &world::kText},
    Key{"home", "The input of the home switch.", &world::kText},
    Key{"alarm", "The input of the drive's alarm.", &world::kText}};
inline constexpr Schema kAxisInputsSchema = world::keys_schema(kAxisInputKeys);

/// The keys are in the order of imported::Number, then Command, then View, followed by the others.
inline constexpr std::array kAxisKeys{
    Key{"target", "The target of `start`: a register, or a number.", &world::kText},
    Key{"distance", "The distance of `start_relative`.", &world::kText},
    Key{"speed", "The speed of moves.", &world::kText},
    Key{"start_speed", "The speed at which moves begin and end (0).", &world::kText},
    Key{"acceleration_time", "The time from 0 to the speed: a register, or a duration.", &world::kText},
    Key{"deceleration_time", "The time from the speed to 0 (acceleration_time).", &world::kText},
    Key{"acceleration", "Change of speed per second, instead of a time.", &world::kText},
    Key{"deceleration", "Change of speed per second when the axis slows down (acceleration).", &world::kText},
    Key{"rated_speed", "The speed that the times refer to (the speed of the move).", &world::kText},
    Key{"home_speed", "The speed of homing (speed).", &world::kText},
    Key{"stop_at_once", "Stops the axis at once, without deceleration: CONTROL.3, or COMMAND == 9.",
        &world::kText},
    Key{"stop", "Stops the axis with deceleration.", &world::kText},
    Key{"enable", "Condition that must be true for the axis to move (always true).", &world::kText},
    Key{"home", "Starts homing.", &world::kText},
    Key{"start", "Starts a move to `target`.", &world::kText},
    Key{"start_relative", "Starts a move by `distance`.", &world::kText},
    Key{"forward", "The axis runs in the positive direction while this is true.", &world::kText},
    Key{"backward", "The axis runs in the negative direction while this is true.", &world::kText},
    Key{"position", "The register that shows the position; a write sets the count.", &world::kText},
    Key{"actual_speed", "The register that shows the speed.", &world::kText},
    Key{"encoder", "The register that shows the encoder count.", &world::kText},
    Key{"busy", "The bit (or register) that is 1 while the axis moves.", &world::kText},
    Key{"ready", "1 while the axis is at rest, enabled and without an alarm.", &world::kText},
    Key{"arrived", "1 after the last move has reached its target.", &world::kText},
    Key{"homed", "1 after home has been found.", &world::kText},
    Key{"enabled", "1 while the axis is enabled.", &world::kText},
    Key{"alarm", "1 while the alarm input is on.", &world::kText},
    Key{"at_upper_limit", "1 while the upper limit switch is on.", &world::kText},
    Key{"at_lower_limit", "1 while the lower limit switch is on.", &world::kText},
    Key{"pulses_per_count", "Pulses per position count (1): 10, or 25/4.", &world::kText},
    Key{"pps_per_count", "Pulses per second for each speed count (1).", &world::kText},
    Key{"inputs", "The inputs of the axis's switches.", &kAxisInputsSchema},
    Key{"home_way", "Direction of homing: minus (default) or plus.", &kDirectionSchema},
    Key{"home_position", "The position at home (0).", &kCountsSchema},
    Key{"pulses_per_revolution", "Pulses per motor revolution, for encoders on a bench.",
        &kPerRevolutionSchema},
    Key{"while_busy", "What a start does while the axis moves: replace (default), ignore or refuse.",
        &kWhileBusySchema},
    Key{"while_disabled", "What a start does while the axis is not enabled: ignore (default) or refuse.",
        &kWhileDisabledSchema}};
inline constexpr std::size_t kFirstCommandKey = models::imported::kNumbers;
inline constexpr std::size_t kFirstViewKey = kFirstCommandKey + models::imported::kCommands;
static_assert(kAxisKeys[kFirstCommandKey].key == "stop_at_once" &&
                  kAxisKeys[kFirstViewKey].key == "position" &&
                  kAxisKeys[kFirstViewKey + models::imported::kViews].key == "pulses_per_count",
              "keys must be in the order of Number, Command and View");
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
    Key{"of", "The value to follow: a register, or a number.", &world::kText, true},
    Key{"while", "Follows only while this is true: CONTROL.RUN, or MODE == 2 (always).", &world::kText},
    Key{"rest", "The value to follow otherwise: a register, or a number (the register's default).",
        &world::kText},
    Key{"time_constant", "The time for 63.2 % of a change: 30s.", &world::kDuration},
    Key{"rate", "The maximum change per second, in counts.", &world::kText},
    Key{"every", "The interval between updates (100ms).", &world::kDuration}};
inline constexpr Schema kLineSchema = world::keys_schema(kLineKeys);
inline constexpr Schema kListSchema = world::keys_schema(kListKeys);
inline constexpr Schema kMapSchema = world::keys_schema(kMapKeys);
inline constexpr Schema kAxisSchema = world::keys_schema(kAxisKeys);
inline constexpr Schema kAxesSchema = world::names_schema(kAxisSchema);
inline constexpr Schema kFollowSchema = world::keys_schema(kFollowKeys);
inline constexpr Schema kFollowsSchema = world::names_schema(kFollowSchema);
inline constexpr Schema kBitNamesSchema = world::names_schema(world::kTextByName);
inline constexpr std::array kModelKeys{
    Key{"understudy", "The version of the format.", &kVersionSchema, true},
    Key{"model", "The model's name: letters, digits, _ and -.", &world::kText, true},
    Key{"title", "A short description.", &world::kText},
    Key{"firmware", "The firmware versions, oldest first: [ \"1.00\", \"1.52\" ].", &world::kTextList},
    Key{"registers", "The path of the register list (CSV), or the list itself.", &world::kText, true},
    Key{"list", "How to read that list, if it differs from the defaults of `import`.", &kListSchema},
    Key{"line", "The settings of the serial line.", &kLineSchema},
    Key{"map", "How the controller answers requests that the list leaves open.", &kMapSchema},
    Key{"bits", "Names of bits: { STATUS: { READY: 0, STATE: 4-7 } }.", &kBitNamesSchema},
    Key{"inputs", "The inputs, and the bits that show them: { DI1: INPUTS.0, HOME: nowhere }.",
        &world::kTextByName},
    Key{"outputs", "The outputs, and the registers that switch them: { DO1: OUTPUTS.0 }.",
        &world::kTextByName},
    Key{"axes", "The motor axes, by name, and the registers that are bound to them.", &kAxesSchema},
    Key{"follows", "Registers that follow another value with a lag.", &kFollowsSchema},
    Key{"shows", "Bits that are 1 while a comparison is true: { STATUS.ALARM: TEMPERATURE > LIMIT }.",
        &world::kTextByName},
    Key{"momentary", "Registers that return to 0 after they have started something.", &world::kTextList}};

}  // namespace understudy::emulator::model_file
