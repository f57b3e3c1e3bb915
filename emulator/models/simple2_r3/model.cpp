#include "emulator/models/simple2_r3/model.h"

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
#include "emulator/models/simple2_r3/axis_slots.h"
#include "emulator/models/simple2_r3/choices.h"
#include "emulator/models/simple2_r3/device.h"
#include "emulator/models/simple2_r3/effects.h"
#include "emulator/models/simple2_r3/first_files.h"
#include "emulator/models/simple2_r3/language.h"
#include "emulator/models/simple2_r3/parameters.h"
#include "emulator/models/simple2_r3/registers.h"
#include "emulator/models/simple2_r3/transition_tables.h"

namespace understudy::emulator::models::simple2_r3 {

namespace {

// Every version for which the manual mentions a difference. The manual itself is for 1.52.
constexpr std::array<Firmware, 7> kFirmwares{139, 140, 141, 142, 150, 151, 152};

constexpr std::array<std::string_view, 2> kKnownLimitations{
    ("PWM is modelled as its duty (`feeder.A.pwm`), and the form of the pulses as a number "
     "(`feeder.pulse_format`), because the pulse terminals have no levels. A duty does not move a "
     "machine."),
    ("Lines A and B of an encoder are not terminals: the encoder is modelled as a count of its "
     "edges."),
};

constexpr std::array<int, 2> kBauds{19200, 115200};  // DIP1 off, on
constexpr std::array<PortRow, 1> kPorts{
    PortRow{.kind = PortRow::Kind::rs485,
            .name = "RS485",
            .bauds = kBauds,
            .settings = {.data_bits = 8, .parity = pty::Parity::even, .stop_bits = 1}}};
constexpr std::array<std::uint8_t, 4> kFunctions{0x03, 0x04, 0x06, 0x10};

using Kind = TerminalRow::Kind;
constexpr std::array<TerminalRow, kTerminalCount> kTerminals{{
    {Kind::digital_in, "DIN_0"},
    {Kind::digital_in, "DIN_1"},
    {Kind::digital_in, "DIN_2"},
    {Kind::digital_in, "DIN_3"},
    {Kind::digital_in, "DIN_4"},
    {Kind::digital_in, "DIN_5"},
    {Kind::digital_in, "DIN_6"},
    {Kind::digital_in, "DIN_7"},
    {Kind::digital_in, "DIN_8"},
    {Kind::digital_in, "DIN_9"},
    {Kind::digital_in, "DIN_10"},
    {Kind::digital_out, "DOUT_0"},
    {Kind::digital_out, "DOUT_1"},
    {Kind::digital_out, "DOUT_2"},
    {Kind::digital_out, "DOUT_3"},
    {Kind::digital_out, "DOUT_4"},
    {Kind::digital_out, "DOUT_5"},
    {Kind::digital_out, "DOUT_6"},
    {Kind::analog_in, "AIN_A", 0, 12'000},
    {Kind::analog_in, "AIN_B", 0, 12'000},
    {Kind::dip_switch, "DIP1"},
    {Kind::dip_switch, "DIP2"},
}};

constexpr AxisRow axis_row(std::string_view name, const AxisSlots& slots) {
  return {.name = name,
          .upper_limit_input = slots.upper_input,
          .lower_limit_input = slots.lower_input,
          .home_input = slots.home_input,
          .alarm_input = slots.alarm_input,
          .ready_input = slots.ready_input,
          .servo_output = kFirstOutput + slots.servo_output,
          .alarm_clear_output = kFirstOutput + slots.alarm_clear_output,
          .pulses_per_revolution = static_cast<int>(factory_value(slots.resolution))};
}
constexpr std::array<AxisRow, 2> kAxes{axis_row("A", kAxisSlots[kAxisA]), axis_row("B", kAxisSlots[kAxisB])};

constexpr std::array<std::string_view, 8> kStateRegisters{"STATUS",
                                                          "Aaxis_Mode",
                                                          "Baxis_Mode",
                                                          "Cord_A",
                                                          "Cord_B",
                                                          "PROG_MAIN_RunTime_Status",
                                                          "PROG_MAIN_NowLine",
                                                          "EEPROM_Writing"};

constexpr SectionRow kSections[] = {
    {"狀態相關", "status"},
    {"輸入輸出功能指配相關", "functions of inputs and outputs"},
    {"輸入輸出相關", "inputs and outputs"},
    {"編碼器，座標，類比輸入相關", "encoders, coordinates, analog inputs"},
    {"運動相關", "motion"},
    {"預存位置表", "position sets"},
    {"預存速度表", "speed sets"},
    {"預存位置表相關運動指令(增量位置移動)", "incremental moves by position sets"},
    {"預存速度表相關運動指令", "velocity by speed sets"},
    {"預存位置表相關運動指令(絕對位置移動)", "absolute moves by position sets"},
    {"程式控制", "program control"},
    {"程式指令列表", "program instructions"},
    {"旗標", "flags"},
    {"程式碼通訊位址相關", "addresses of the program"},
    {"系統參數相關", "system parameters"},
    {"程式應用相關", "what programs use"},
    {"位址列表", "list of addresses"},
    {"附錄 A", "appendix A"},
    {"附錄 B", "appendix B"},
    {"附錄 C", "appendix C"},
    {"1.40 以前", "up to 1.40"},
};

constexpr ProofRow kProofs[] = {
    {"wire", "RS485"},
    {"addresses", "位址列表"},
    {"status", "狀態相關"},
    {"inputs_and_outputs", "輸入輸出功能指配相關|輸入輸出相關|編碼器，座標，類比輸入相關"},
    {"motion", "運動相關|預存位置表"},
    {"system_parameters", "系統參數相關"},
    {"appendices", "附錄 A|附錄 B|附錄 C"},
    {"program_control", "程式控制|程式應用相關|旗標|程式碼通訊位址相關"},
    {"program_instructions", "程式指令列表"},
};

constexpr StopStep kStop[] = {{"ALL_STOP"}, {"PROG_MAIN_RunTime_END"}, {"ALL_STOP"}};

}  // namespace

const Model& model() {
  static const RegisterMap registers(kRegisters, MapPolicy{});
  static const Model model{
      .name = kName,
      .title = "2-axis pulse controller, Modbus RTU on RS485",
      .firmwares = kFirmwares,
      .registers = &registers,
      .parameters = kParameters,
      .language = &language(),
      .choices = kChoices,
      .sections = kSections,
      .proofs = kProofs,
      .transitions = transition_tables(),
      .csv_has_bits = false,
      .terminals = kTerminals,
      .axes = kAxes,
      .state_registers = kStateRegisters,
      .known_limitations = kKnownLimitations,
      .line = {.protocol = kModbusRtu,
               .ports = kPorts,
               .station_numbers = StationNumbers{0, 15}},             // rotary switch 0: all station numbers
      .rtu = RtuRules{.end_silence = std::chrono::microseconds(750),  // END time, at both speeds
                      .functions = kFunctions},
      .first_files = &kFirstFiles,
      .stop = kStop,
      .make = [](const DeviceSettings& settings) -> std::unique_ptr<Device> {
        return std::make_unique<Simple2R3>(settings);
      },
  };
  return model;
}

}  // namespace understudy::emulator::models::simple2_r3
