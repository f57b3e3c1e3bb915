// Declares the keys of a bench file (docs/bench.md) and the forms of their values.
#pragma once

#include <array>

#include "emulator/world/bench_file/fault_form.h"
#include "emulator/world/bench_file/form.h"

namespace understudy::emulator::world {

inline constexpr std::int64_t kFarthestPulse = 1'000'000'000'000;  // farther than any counter

inline constexpr Form kVersionForm = integer_form(1, 1);
inline constexpr KeyRow kVersionKey{"understudy", "The version of the format.", &kVersionForm, true};

// --- devices -------------------------------------------------------------------------------------
inline constexpr Form kRegisterValueForm = integer_form(INT32_MIN, UINT32_MAX);
// A text is a real number or the program; a map has blocks of text of one kind, by name.
inline constexpr std::array<const Form*, 3> kNvValueWays{&kRegisterValueForm, &kText, &kTextByName};
inline constexpr Form kNvValueForm = either_form(kNvValueWays);
inline constexpr Form kNvValuesForm = names_form(kNvValueForm);
inline constexpr std::array<const Form*, 2> kNvWays{&kText, &kNvValuesForm};
inline constexpr Form kNvForm = either_form(kNvWays);
inline constexpr Form kAddressForm = integer_form(0, 255);

inline constexpr KeyRow kNameKey{"name", "The device's name: letters, digits, _ and -.", &kText, true};
inline constexpr KeyRow kModelKey{
    "model", "A model, as `understudy models` lists them, or the path of a model file.", &kText, true};
inline constexpr KeyRow kAddressKey{"address", "The station number (default: 1, or the one in its memory).",
                                    &kAddressForm};
inline constexpr KeyRow kPortKey{"port", "The port of the device on this line (default: its first).", &kText};
inline constexpr KeyRow kFirmwareKey{"firmware", "Its firmware version (default: the newest).", &kText};
inline constexpr Form kModulesForm = integer_form(1, 255);
inline constexpr KeyRow kModulesKey{"modules", "Number of modules, if it is a chain.", &kModulesForm};
inline constexpr std::array<const Form*, 2> kSetValueWays{&kRegisterValueForm, &kText};
inline constexpr Form kSetValueForm = either_form(kSetValueWays);  // text: a real number
inline constexpr Form kSetForm = names_form(kSetValueForm);
inline constexpr KeyRow kSetKey{"set", "Registers (or values, by name) written at power-up, in this order.",
                                &kSetForm};
inline constexpr KeyRow kChoicesKey{"choices", "Options for questions that the manual leaves open.",
                                    &kTextByName};
inline constexpr KeyRow kDipKey{"dip", "Settings of the switches on its housing.", &kLevelByName};
inline constexpr KeyRow kProgramKey{"program", "The path of a listing, or the listing itself.", &kText};
inline constexpr KeyRow kNvKey{"nv", "The file of its non-volatile memory, or its initial contents.",
                               &kNvForm};

inline constexpr std::array kDeviceKeys{kModelKey,   kFirmwareKey, kModulesKey, kSetKey,
                                        kChoicesKey, kDipKey,      kProgramKey, kNvKey};
inline constexpr std::array kStationKeys{kNameKey,     kModelKey,   kAddressKey, kPortKey,
                                         kFirmwareKey, kModulesKey, kSetKey,     kChoicesKey,
                                         kDipKey,      kProgramKey, kNvKey};
inline constexpr std::array kPlacedStationKeys{
    KeyRow{"device", "The name of a device declared under `devices`, or on a line before.", &kText, true},
    kAddressKey, kPortKey};

// --- lines ---------------------------------------------------------------------------------------
inline constexpr Form kStationForm = keys_form(kStationKeys);
inline constexpr Form kPlacedStationForm = keys_form(kPlacedStationKeys);
inline constexpr std::array<const Form*, 2> kStationWays{&kStationForm, &kPlacedStationForm};
inline constexpr Form kAnyStationForm = either_form(kStationWays);
inline constexpr Form kStationsForm = list_form(kAnyStationForm);
inline constexpr Form kBaudForm = integer_form(1, 4'000'000);
inline constexpr std::array<std::string_view, 2> kTimings{"wire", "instant"};
inline constexpr Form kTimingForm = words_form(kTimings);
inline constexpr Form kListenListForm = list_form(kText);
inline constexpr std::array<const Form*, 2> kListenWays{&kText, &kListenListForm};
inline constexpr Form kListenForm = either_form(kListenWays);
inline constexpr std::array<std::string_view, 2> kTrueOrFalse{"true", "false"};
inline constexpr Form kTrueOrFalseForm = words_form(kTrueOrFalse);
inline constexpr std::array<std::string_view, 2> kOnOrOff{"on", "off"};
inline constexpr Form kOnOrOffForm = words_form(kOnOrOff);
inline constexpr std::array kLineKeys{
    KeyRow{"link", "The path that hosts open; relative to this file.", &kText},
    KeyRow{"listen", "The address where it accepts TCP clients, such as rfc2217://127.0.0.1:5020.",
           &kListenForm},
    KeyRow{"pty", "Whether it has a pseudo-terminal (true), or accepts only TCP clients.", &kTrueOrFalseForm},
    KeyRow{"baud", "The speed of the devices (default: the factory setting).", &kBaudForm},
    KeyRow{"baud_tolerance", "How much a host's speed may differ from the line's (default: 2%).", &kText},
    KeyRow{"byte_timeout", "How long to wait for the rest of a frame (default: 200ms).", &kText},
    KeyRow{"timing", "Whether bytes take as long as on a real line.", &kTimingForm},
    KeyRow{"echo", "Whether hosts receive their own bytes (off), as with some RS485 adapters.",
           &kOnOrOffForm},
    KeyRow{"stations", "The devices on the line.", &kStationsForm, true}};

// --- the machine ---------------------------------------------------------------------------------
inline constexpr Form kPositionForm = integer_form(-kFarthestPulse, kFarthestPulse);
inline constexpr Form kTravelForm = list_form(kPositionForm, 2);
inline constexpr Form kWidthForm = integer_form(1, kFarthestPulse);
inline constexpr Form kHysteresisForm = integer_form(0, kFarthestPulse);
inline constexpr Form kPerRevolutionForm = integer_form(1, 10'000'000);
inline constexpr KeyRow kHysteresisKey{"hysteresis", "Pulses between on and off.", &kHysteresisForm};
inline constexpr std::array<std::string_view, 2> kContacts{"opens", "closes"};
inline constexpr Form kContactForm = words_form(kContacts);
inline constexpr KeyRow kContactKey{"contact", "What its contact does when on: closes (default), or opens.",
                                    &kContactForm};
inline constexpr std::array kHomeKeys{
    KeyRow{"at", "The first position where the switch is on.", &kPositionForm, true},
    KeyRow{"width", "For how many positions it is on.", &kWidthForm, true}, kHysteresisKey, kContactKey,
    KeyRow{"input", "The input that it is wired to; by default the controller's own.", &kText}};
inline constexpr std::array kLimitKeys{
    KeyRow{"lower", "The lower switch is on there and below.", &kPositionForm},
    KeyRow{"upper", "The upper switch is on there and above.", &kPositionForm},
    kHysteresisKey,
    kContactKey,
    KeyRow{"lower_input", "The input that the lower one is wired to; by default the controller's own.",
           &kText},
    KeyRow{"upper_input", "The input that the upper one is wired to; by default the controller's own.",
           &kText}};
inline constexpr std::array kIndexKeys{
    KeyRow{"at", "The first position of one (0).", &kPositionForm},
    KeyRow{"width", "For how many positions it is on (1).", &kWidthForm},
    KeyRow{"period", "The distance from one to the next (default: a revolution of the motor).", &kWidthForm},
    KeyRow{"input", "The input that it is wired to; by default the controller's own.", &kText}};
inline constexpr Form kIndexForm = keys_form(kIndexKeys);
inline constexpr std::array<std::string_view, 2> kEncoderPlaces{"wheel", "machine"};
inline constexpr Form kEncoderPlaceForm = words_form(kEncoderPlaces);
inline constexpr std::array kEncoderKeys{
    KeyRow{"per_revolution", "Its counts per revolution.", &kPerRevolutionForm, true},
    KeyRow{"motor_pulses_per_revolution", "The motor's pulses per revolution.", &kPerRevolutionForm},
    KeyRow{"reversed", "Whether it counts in the opposite direction.", &kTrueOrFalseForm},
    KeyRow{"on", "What turns it: the machine (default), or a hand wheel.", &kEncoderPlaceForm},
    KeyRow{"index", "Its index pulse, once a revolution.", &kIndexForm}};
inline constexpr std::array kDriveKeys{
    KeyRow{"ready_after", "The time from being enabled to `ready`.", &kDuration},
    KeyRow{"enabled_by", "The servo output's level that enables it.", &kOnOrOffForm},
    KeyRow{"alarm_contact", "What its alarm contact does in an alarm.", &kContactForm}};
inline constexpr Form kHomeForm = keys_form(kHomeKeys);
inline constexpr Form kLimitsForm = keys_form(kLimitKeys);
inline constexpr Form kEncoderForm = keys_form(kEncoderKeys);
inline constexpr Form kDriveForm = keys_form(kDriveKeys);
inline constexpr std::array kMachineKeys{
    KeyRow{"position", "The machine's initial position (0).", &kPositionForm},
    KeyRow{"travel", "The hard stops; pulses beyond are lost.", &kTravelForm},
    KeyRow{"home", "The home switch.", &kHomeForm},
    KeyRow{"near_home", "The near-home switch.", &kHomeForm},
    KeyRow{"mark", "A mark, or a sensor for one.", &kHomeForm},
    KeyRow{"limits", "The limit switches.", &kLimitsForm},
    KeyRow{"encoder", "The encoder.", &kEncoderForm},
    KeyRow{"drive", "The servo drive.", &kDriveForm}};

// --- the whole -----------------------------------------------------------------------------------
inline constexpr Form kLineForm = keys_form(kLineKeys);
inline constexpr Form kLinesForm = names_form(kLineForm);
inline constexpr Form kDeviceForm = keys_form(kDeviceKeys);
inline constexpr Form kDevicesForm = names_form(kDeviceForm);
inline constexpr Form kMachineForm = keys_form(kMachineKeys);
inline constexpr Form kPlantForm = names_form(kMachineForm);
inline constexpr Form kFaultForm = keys_form(kFaultKeys);
inline constexpr Form kFaultsForm = list_form(kFaultForm);
inline constexpr Form kSeedForm = integer_form(0, INT64_MAX);

inline constexpr KeyRow kLinesKey{"lines", "The serial lines, by names that you choose.", &kLinesForm, true};
inline constexpr KeyRow kDevicesKey{"devices", "Devices with more settings, by names that you choose.",
                                    &kDevicesForm};
inline constexpr KeyRow kPlantKey{"plant", "The machine on each axis, by the axis, such as feeder.A.",
                                  &kPlantForm};
inline constexpr KeyRow kWiresKey{
    "wires",
    "From an output, or a machine's switch, to an input, or one of a drive (servo, alarm_clear): "
    "feeder.DOUT_4 -> turner.DIN_10.",
    &kTextList};
inline constexpr KeyRow kInputsKey{"inputs", "Initial levels of inputs.", &kTextByName};
inline constexpr KeyRow kFaultsKey{"faults", "Initial faults: { stall: feeder.A }.", &kFaultsForm};

inline constexpr KeyRow kSeedKey{"seed", "The seed of all random choices.", &kSeedForm};

inline constexpr std::array kBenchKeys{kVersionKey, kLinesKey,  kDevicesKey, kPlantKey,
                                       kWiresKey,   kInputsKey, kFaultsKey,  kSeedKey};
/// A bench inside another file needs no version.
inline constexpr std::array kInlineBenchKeys{kLinesKey,  kDevicesKey, kPlantKey, kWiresKey,
                                             kInputsKey, kFaultsKey,  kSeedKey};
inline constexpr Form kBenchForm = keys_form(kBenchKeys);
inline constexpr Form kInlineBenchForm = keys_form(kInlineBenchKeys);

}  // namespace understudy::emulator::world
