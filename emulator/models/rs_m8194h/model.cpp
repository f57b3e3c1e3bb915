#include "emulator/models/rs_m8194h/model.h"

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string_view>

#include "emulator/device/device.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/rs_m8194h/command_hazards.h"
#include "emulator/models/rs_m8194h/command_names.h"
#include "emulator/models/rs_m8194h/device.h"
#include "emulator/models/rs_m8194h/drives/transition_tables.h"
#include "emulator/models/rs_m8194h/first_files.h"
#include "emulator/models/rs_m8194h/programs/language.h"
#include "emulator/models/rs_m8194h/rows/choices.h"
#include "emulator/models/rs_m8194h/rows/registers.h"
#include "emulator/models/rs_m8194h/rows/terminals.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

// 2.0 and 3.0: the versions of the manual's replies and of the manual itself.
constexpr std::array<Firmware, 2> kFirmwares{200, 300};

constexpr std::string_view kKnownLimitations[] = {
    ("Noise filters below 1.024 ms cause no delay or, by choice (`filter_delay`), a delay of one tick, "
     "because inputs that a bench sets change at ticks, and the machine's edges are at pulses."),
    ("Pulses below 1 ms at OUT_X and OUT_Y are counted but have no length, because levels exist only "
     "at ticks."),
    ("The pulse modes of SET_PULSE_MODE are shown as a number (`rsm.pulse_format`), because the pulse "
     "terminals have no levels."),
    ("A helix of more than 159,154 turns, or with a rise of more than 1,000,000,000,000 pulses, is "
     "void, with the module's error (RINT bit 7)."),
    ("The manual does not document the communication at the switch position Init, so the box does not "
     "answer there."),
    "The IP settings from holding register 20 on are stored but have no effect.",
};

constexpr int kBauds[] = {115200, 57600, 38400, 19200, 9600, 4800, 2400, 1200};
constexpr std::array<PortRow, 1> kPorts{
    PortRow{.kind = PortRow::Kind::rs485,
            .name = "COM",
            .bauds = kBauds,
            .settings = {.data_bits = 8, .parity = pty::Parity::none, .stop_bits = 1}}};
constexpr std::uint8_t kServedFunctions[] = {0x01, 0x02, 0x03, 0x04, 0x05, 0x06, 0x0F, 0x10};

constexpr std::string_view kStateRegisters[] = {
    "DRIVING_AXIS",     "LP_X",           "LP_Y",      "LP_Z",        "LP_U", "ERROR_STATE",
    "FREE_BUFFER_SIZE", "MP_Call_number", "RSM_STATE", "I8094H_STATE"};

// The manual's section numbers, and their subjects.
constexpr SectionRow kSections[] = {
    {"3.18.1", "variables bVAR, bytes"},
    {"3.19.1", "machine data MD"},
    {"4.8", "state of homing"},
    {"4.13", "driving axes"},
    {"4.14", "readiness for interpolation"},
    {"12.1.1", "FRnet DI and DO"},
    {"12.1.2", "inputs of the motion chip"},
    {"12.1.3", "error codes"},
    {"12.1.4", "positions, velocities, accelerations"},
    {"12.1.5", "stopped axes"},
    {"12.1.6", "latched positions"},
    {"12.1.7", "error state, free buffer"},
    {"12.1.8", "interrupts of the i-8094H"},
    {"12.1.9", "versions of the firmware"},
    {"12.1.10", "inputs of the daughter board"},
    {"12.1.11", "absolute logic positions"},
    {"12.1.12", "state of RS-M8194H and i-8094H"},
    {"12.1.13", "errors during macro downloads"},
    {"12.1.14", "errors in running macros"},
    {"12.1.15", "triggered interrupts of the motion chip"},
    {"12.2.1", "FRnet DO"},
    {"12.2.2", "macro calls, FRnet events, word order"},
    {"12.2.3", "IP settings"},
    {"12.2.4", "positions, velocities, accelerations"},
    {"12.2.5", "variables VAR"},
    {"12.2.6", "window of the Sub_Functions"},
    {"12.4.1", "FRnet DO"},
    {"12.4.2", "servo on and off"},
    {"12.5.1", "FRnet DI"},
    {"12.5.2", "inputs of the motion chip"},
    {"12.5.3", "causes of unexpected stops"},
    {"12.5.4", "signals of motion control"},
};

constexpr ProofRow kProofs[] = {
    {"wire", "1|2|14"},
    {"counters_and_variables", "3.15|3.17|3.18"},
    {"settings", "3"},
    {"interrupts", "4.15|4.16"},
    {"state", "4"},
    {"frnet_and_homing", "5|6"},
    {"moves", "7.1|7.2"},
    {"synchronous_actions", "7.3"},
    {"paths", "7.4"},
    {"stops", "7.5"},
    {"macro_download", "9.12|10"},
    {"macros", "8|9"},
    {"tables", "12"},
};

// While a macro is being entered, the module refuses the stop. Then the macro is closed first.
constexpr StopStep kStop[] = {
    {"RSM_EMERGENCY_STOP 0"}, {"RSM_MACRO_MP_CLOSE"}, {"RSM_MACRO_MP_ISR_CLOSE"}, {"RSM_EMERGENCY_STOP 0"}};

}  // namespace

const Model& model() {
  static const RegisterMap registers(kRegisters, MapPolicy{.unmapped = MapPolicy::Unmapped::holes_read_zero,
                                                           .write_only = MapPolicy::WriteOnly::refused,
                                                           .halves = MapPolicy::Halves::come_whole,
                                                           .read_halves = MapPolicy::ReadHalves::come_whole,
                                                           .low_word_first = false,
                                                           .word_order_in = "WORD_ORDER"});
  static const Model model{
      .name = kName,
      .title = "4-axis motion controller with macros, Modbus RTU",
      .firmwares = kFirmwares,
      .registers = &registers,
      .window = &command_names(),
      .language = &language(),
      .choices = kChoices,
      .sections = kSections,
      .proofs = kProofs,
      .transitions = transition_tables(),
      .terminals = terminal_tables().rows,
      .terminal_groups = terminal_tables().groups,
      .axes = terminal_tables().axes,
      .state_registers = kStateRegisters,
      .known_limitations = kKnownLimitations,
      .line = {.protocol = kModbusRtu, .ports = kPorts, .station_numbers = StationNumbers{1, 247}},
      .rtu = RtuRules{.end_silence = std::chrono::milliseconds(3), .functions = kServedFunctions},
      .first_files = &kFirstFiles,
      .stop = kStop,
      .hazards_of_command = hazards_of_command,
      .numbers_of_command = numbers_of_command,
      .make = [](const DeviceSettings& settings) -> std::unique_ptr<Device> {
        return std::make_unique<RsM8194h>(settings);
      },
  };
  return model;
}

}  // namespace understudy::emulator::models::rs_m8194h
