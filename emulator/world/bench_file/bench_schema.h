// The keys of a bench file (docs/bench.md), and the schemas of their values.
#pragma once

#include <array>

#include "emulator/world/bench_file/fault_schema.h"
#include "emulator/world/bench_file/schema.h"

namespace understudy::emulator::world {

inline constexpr std::int64_t kFarthestPulse = 1'000'000'000'000;  // beyond any counter

inline constexpr Schema kVersionSchema = integer_schema(1, 1);
inline constexpr Key kVersionKey{"understudy", "The version of the format.", &kVersionSchema, true};

// --- devices -------------------------------------------------------------------------------------
inline constexpr Schema kRegisterValueSchema = integer_schema(INT32_MIN, UINT32_MAX);
// A text is a real number or the program. A map contains text blocks of one kind, by name.
inline constexpr std::array<const Schema*, 3> kNvValueAlternatives{&kRegisterValueSchema, &kText,
                                                                   &kTextByName};
inline constexpr Schema kNvValueSchema = any_of_schemas(kNvValueAlternatives);
inline constexpr Schema kNvValuesSchema = names_schema(kNvValueSchema);
inline constexpr std::array<const Schema*, 2> kNvAlternatives{&kText, &kNvValuesSchema};
inline constexpr Schema kNvSchema = any_of_schemas(kNvAlternatives);
inline constexpr Schema kAddressSchema = integer_schema(0, 255);

inline constexpr Key kNameKey{"name", "The device's name: letters, digits, _ and -.", &kText, true};
inline constexpr Key kModelKey{
    "model", "The name of a model (`understudy models` lists them), or the path of a model file.", &kText,
    true};
inline constexpr Key kAddressKey{"address", "The station number (default: 1, or the one in its memory).",
                                 &kAddressSchema};
inline constexpr Key kPortKey{"port", "The port of the device on this line (default: its first).", &kText};
inline constexpr Key kFirmwareKey{"firmware", "Its firmware version (default: the newest).", &kText};
inline constexpr Schema kModulesSchema = integer_schema(1, 255);
inline constexpr Key kModulesKey{"modules", "Number of modules, if it is a chain.", &kModulesSchema};
inline constexpr std::array<const Schema*, 2> kSetValueAlternatives{&kRegisterValueSchema, &kText};
inline constexpr Schema kSetValueSchema = any_of_schemas(kSetValueAlternatives);  // text: a real number
inline constexpr Schema kSetSchema = names_schema(kSetValueSchema);
inline constexpr Key kSetKey{"set", "Registers (or values, by name) written at power-up, in this order.",
                             &kSetSchema};
inline constexpr Key kChoicesKey{"choices", "Options for questions that the manual leaves open.",
                                 &kTextByName};
inline constexpr Key kDipKey{"dip", "Settings of the switches on its housing.", &kLevelByName};
inline constexpr Key kProgramKey{"program", "The path of a listing, or the listing itself.", &kText};
inline constexpr Key kNvKey{"nv", "The file of its non-volatile memory, or its initial contents.",
                            &kNvSchema};

inline constexpr std::array kDeviceKeys{kModelKey,   kFirmwareKey, kModulesKey, kSetKey,
                                        kChoicesKey, kDipKey,      kProgramKey, kNvKey};
inline constexpr std::array kStationKeys{kNameKey,     kModelKey,   kAddressKey, kPortKey,
                                         kFirmwareKey, kModulesKey, kSetKey,     kChoicesKey,
                                         kDipKey,      kProgramKey, kNvKey};
inline constexpr std::array kPlacedStationKeys{
    Key{"device", "The name of a device declared under `devices`, or on an earlier line.", &kText, true},
    kAddressKey, kPortKey};

// --- lines ---------------------------------------------------------------------------------------
inline constexpr Schema kStationSchema = keys_schema(kStationKeys);
inline constexpr Schema kPlacedStationSchema = keys_schema(kPlacedStationKeys);
inline constexpr std::array<const Schema*, 2> kStationAlternatives{&kStationSchema, &kPlacedStationSchema};
inline constexpr Schema kAnyStationSchema = any_of_schemas(kStationAlternatives);
inline constexpr Schema kStationsSchema = list_schema(kAnyStationSchema);
inline constexpr Schema kBaudSchema = integer_schema(1, 4'000'000);
inline constexpr std::array<std::string_view, 2> kTimings{"wire", "instant"};
inline constexpr Schema kTimingSchema = words_schema(kTimings);
inline constexpr Schema kListenListSchema = list_schema(kText);
inline constexpr std::array<const Schema*, 2> kListenAlternatives{&kText, &kListenListSchema};
inline constexpr Schema kListenSchema = any_of_schemas(kListenAlternatives);
inline constexpr std::array<std::string_view, 2> kTrueOrFalse{"true", "false"};
inline constexpr Schema kTrueOrFalseSchema = words_schema(kTrueOrFalse);
inline constexpr std::array<std::string_view, 2> kOnOrOff{"on", "off"};
inline constexpr Schema kOnOrOffSchema = words_schema(kOnOrOff);
inline constexpr std::array kLineKeys{
    Key{"link", "The path that hosts open; relative to this file.", &kText},
    Key{"listen", "The address at which it accepts TCP clients, such as rfc2217://127.0.0.1:5020.",
        &kListenSchema},
    Key{"pty", "Whether it has a pseudo-terminal (default: true), or accepts only TCP clients.",
        &kTrueOrFalseSchema},
    Key{"baud", "The speed of the devices (default: the factory setting).", &kBaudSchema},
    Key{"baud_tolerance", "How much a host's speed may differ from the line's (default: 2%).", &kText},
    Key{"byte_timeout", "How long to wait for the rest of a frame (default: 200ms).", &kText},
    Key{"timing", "Whether bytes take as long as on a real line.", &kTimingSchema},
    Key{"echo", "Whether hosts receive their own bytes, as with some RS485 adapters (default: off).",
        &kOnOrOffSchema},
    Key{"stations", "The devices on the line.", &kStationsSchema, true}};

// --- the machine ---------------------------------------------------------------------------------
inline constexpr Schema kPositionSchema = integer_schema(-kFarthestPulse, kFarthestPulse);
inline constexpr Schema kTravelSchema = list_schema(kPositionSchema, 2);
inline constexpr Schema kWidthSchema = integer_schema(1, kFarthestPulse);
inline constexpr Schema kHysteresisSchema = integer_schema(0, kFarthestPulse);
inline constexpr Schema kPerRevolutionSchema = integer_schema(1, 10'000'000);
inline constexpr Key kHysteresisKey{"hysteresis", "Pulses between on and off.", &kHysteresisSchema};
inline constexpr std::array<std::string_view, 2> kContacts{"opens", "closes"};
inline constexpr Schema kContactSchema = words_schema(kContacts);
inline constexpr Key kContactKey{"contact", "What its contact does when on: closes (default), or opens.",
                                 &kContactSchema};
inline constexpr std::array kHomeKeys{
    Key{"at", "The first position where the switch is on.", &kPositionSchema, true},
    Key{"width", "The number of positions for which it is on.", &kWidthSchema, true}, kHysteresisKey,
    kContactKey, Key{"input", "The input that it is wired to; by default the controller's own.", &kText}};
inline constexpr std::array kLimitKeys{
    Key{"lower", "The lower switch is on at this position and below.", &kPositionSchema},
    Key{"upper", "The upper switch is on at this position and above.", &kPositionSchema},
    kHysteresisKey,
    kContactKey,
    Key{"lower_input", "The input of the lower switch; by default the controller's own.", &kText},
    Key{"upper_input", "The input of the upper switch; by default the controller's own.", &kText}};
inline constexpr std::array kIndexKeys{
    Key{"at", "The first position at which it is on (default: 0).", &kPositionSchema},
    Key{"width", "The number of positions for which it is on (default: 1).", &kWidthSchema},
    Key{"period", "The distance between pulses (default: a revolution of the motor).", &kWidthSchema},
    Key{"input", "The input that it is wired to; by default the controller's own.", &kText}};
inline constexpr Schema kIndexSchema = keys_schema(kIndexKeys);
inline constexpr std::array<std::string_view, 2> kEncoderPlaces{"wheel", "machine"};
inline constexpr Schema kEncoderPlaceSchema = words_schema(kEncoderPlaces);
inline constexpr std::array kEncoderKeys{
    Key{"per_revolution", "The encoder's counts per revolution.", &kPerRevolutionSchema, true},
    Key{"motor_pulses_per_revolution", "The motor's pulses per revolution.", &kPerRevolutionSchema},
    Key{"reversed", "Whether it counts in the opposite direction.", &kTrueOrFalseSchema},
    Key{"on", "What turns it: the machine (default), or a hand wheel.", &kEncoderPlaceSchema},
    Key{"index", "Its index pulse, once a revolution.", &kIndexSchema}};
inline constexpr std::array kDriveKeys{
    Key{"ready_after", "The time from being enabled to `ready`.", &kDuration},
    Key{"enabled_by", "The servo output's level that enables it.", &kOnOrOffSchema},
    Key{"alarm_contact", "What its alarm contact does in an alarm.", &kContactSchema}};
inline constexpr Schema kHomeSchema = keys_schema(kHomeKeys);
inline constexpr Schema kLimitsSchema = keys_schema(kLimitKeys);
inline constexpr Schema kEncoderSchema = keys_schema(kEncoderKeys);
inline constexpr Schema kDriveSchema = keys_schema(kDriveKeys);
inline constexpr std::array kMachineKeys{
    Key{"position", "The machine's initial position (default: 0).", &kPositionSchema},
    Key{"travel", "The hard stops; pulses beyond are lost.", &kTravelSchema},
    Key{"home", "The home switch.", &kHomeSchema},
    Key{"near_home", "The near-home switch.", &kHomeSchema},
    Key{"mark", "The mark, or the sensor that detects it.", &kHomeSchema},
    Key{"limits", "The limit switches.", &kLimitsSchema},
    Key{"encoder", "The encoder.", &kEncoderSchema},
    Key{"drive", "The servo drive.", &kDriveSchema}};

// --- the whole -----------------------------------------------------------------------------------
inline constexpr Schema kLineSchema = keys_schema(kLineKeys);
inline constexpr Schema kLinesSchema = names_schema(kLineSchema);
inline constexpr Schema kDeviceSchema = keys_schema(kDeviceKeys);
inline constexpr Schema kDevicesSchema = names_schema(kDeviceSchema);
inline constexpr Schema kMachineSchema = keys_schema(kMachineKeys);
inline constexpr Schema kPlantSchema = names_schema(kMachineSchema);
inline constexpr Schema kFaultSchema = keys_schema(kFaultKeys);
inline constexpr Schema kFaultsSchema = list_schema(kFaultSchema);
inline constexpr Schema kSeedSchema = integer_schema(0, INT64_MAX);

inline constexpr Key kLinesKey{"lines", "The serial lines, by names that you choose.", &kLinesSchema, true};
inline constexpr Key kDevicesKey{"devices", "Devices with more settings, by names that you choose.",
                                 &kDevicesSchema};
inline constexpr Key kPlantKey{
    "plant", "The machine on each axis, by the name of the axis, such as feeder.A.", &kPlantSchema};
inline constexpr Key kWiresKey{
    "wires",
    "From an output, or a machine's switch, to an input of a device or drive (servo, alarm_clear): "
    "feeder.DOUT_4 -> turner.DIN_10.",
    &kTextList};
inline constexpr Key kInputsKey{"inputs", "Initial levels of inputs.", &kTextByName};
inline constexpr Key kFaultsKey{"faults", "Initial faults: { stall: feeder.A }.", &kFaultsSchema};

inline constexpr Key kSeedKey{"seed", "The seed of all random choices.", &kSeedSchema};

inline constexpr std::array kBenchKeys{kVersionKey, kLinesKey,  kDevicesKey, kPlantKey,
                                       kWiresKey,   kInputsKey, kFaultsKey,  kSeedKey};
/// A bench within another file does not need a version.
inline constexpr std::array kInlineBenchKeys{kLinesKey,  kDevicesKey, kPlantKey, kWiresKey,
                                             kInputsKey, kFaultsKey,  kSeedKey};
inline constexpr Schema kBenchSchema = keys_schema(kBenchKeys);
inline constexpr Schema kInlineBenchSchema = keys_schema(kInlineBenchKeys);

}  // namespace understudy::emulator::world
