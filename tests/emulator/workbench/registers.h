// The registers of a made-up controller: four tables with every kind of row, names in two tables, holes, a
// window with a FIFO behind it.
#pragma once

#include "emulator/device/register_map/row.h"

namespace understudy::emulator::workbench {

class Workbench;

inline constexpr std::string_view kAxes[] = {"X", "Y", "Z"};
inline constexpr int kAxisCount = 3;
inline constexpr std::string_view kPortNames[] = {"PC", "HMI"};
inline constexpr int kOutputs = 80;
inline constexpr int kRelays = 2000;
inline constexpr std::uint16_t kWindow = 0x1F40;
inline constexpr int kWindowWords = 20;
inline constexpr std::uint16_t kBlockWindow = 0x1E00;
inline constexpr int kBlockWords = 100;
inline constexpr std::size_t kFifo = 3;
inline constexpr std::uint16_t kMove = 0x0A01;  // axis, target (two words)
inline constexpr std::uint16_t kStop = 0x0A02;

// The effects of rows, besides storing (workbench.h).
Value position_of(const Workbench& bench, Cell cell);
void set_position(Workbench& bench, Cell cell, Value value);
Value is_driving(const Workbench& bench, Cell cell);
Value is_any_driving(const Workbench& bench, Cell cell);
Value fifo_length(const Workbench& bench, Cell cell);
Value last_cause(const Workbench& bench, Cell cell);
Value last_reason(const Workbench& bench, Cell cell);
Value program_refused(const Workbench& bench, Cell cell);
Value commands_done(const Workbench& bench, Cell cell);
Value temperature(const Workbench& bench, Cell cell);
Value input_level(const Workbench& bench, Cell cell);
DeviceAnswer take_block(Workbench& bench, Cell cell, std::span<const std::uint16_t> words);
Value receive_errors(const Workbench& bench, Cell cell);
DeviceAnswer take_command(Workbench& bench, Cell cell, std::span<const std::uint16_t> words);

// The controller's own error numbers.
inline constexpr int kUnknownCommand = 2;
inline constexpr int kWrongWords = 3;
inline constexpr int kFifoFull = 0xC1;
inline constexpr int kModuleAbsent = 0xC2;

inline constexpr BitField kModeBits[] = {bits(0, "AUTO"), bits(1, "HOLD"), bits(4, "PROGRAM", 4)};
inline constexpr BitField kStateBits[] = {bits(0, "DRIVING").reads<is_any_driving, Varies::in_ticks>(),
                                          bits(4, "WAITING", 2).reads<fifo_length, Varies::in_ticks>()};

inline constexpr RegisterRow kRows[] = {
    reg(0x0000, "Speed_{}", Type::u16, Access::read_write)
        .means("speed of axis {}")
        .each(kAxes, 1)
        .range(1, 4000)
        .from_factory(100)
        .persists(),
    reg(0x0008, "Offset", Type::s16, Access::read_write).range(-500, 500),
    reg(0x0010, "Position_{}", Type::s32, Access::read_write)
        .each(kAxes, 2)
        .shows<position_of, Varies::while_moving>()
        .does<set_position>(),
    reg(0x0020, "Gain_{}", Type::f32, Access::read_write)
        .each(kAxes, 2)
        .real_range(0, 10)
        .from_factory(value_of_real(1.5F))
        .persists(),
    reg(0x0030, "Mode", Type::u16, Access::read_write).with_bits(kModeBits),
    reg(0x0031, "Word_Order", Type::u16, Access::read_write).range(0, 1),
    reg(0x0032, "Key", Type::u16, Access::write),
    reg(0x0033, "Station", Type::u16, Access::read_write).range(0, 247).from_factory(1).persists(),
    reg(0x0040, "Done", Type::u32, Access::read).shows<commands_done, Varies::in_ticks>(),
    reg(0x0064, "D{}", Type::u16, Access::read_write).times(125, 1, 0),
    reg(0x0200, "Step{}", Type::u16, Access::read_write).times(3, 0x10, 8101).numbered_by(100),
    reg(0x0300, "Volts", Type::u16, Access::read_write).range(0, 5000),
    reg(0x0310, "DO_Word_{}", Type::u16, Access::read_write).times(8, 1, 0),
    reg(0x0320, "Total", Type::u32, Access::read_write).persists_at_once(),
    window<take_command>(kWindow, "Command{}", kWindowWords, 1),
    window<take_block>(kBlockWindow, "Block{}", kBlockWords, 1),

    input(0, "STATE", Type::u16).shows_bits(kStateBits),
    input(2, "Position_{}", Type::s32).each(kAxes, 2).shows<position_of, Varies::while_moving>(),
    input(8, "Temperature", Type::f32).shows<temperature, Varies::in_ticks>(),
    input(15, "Program_Refused", Type::u16).shows<program_refused, Varies::in_ticks>(),
    input(16, "Cause", Type::u16).shows<last_cause, Varies::in_ticks>(),
    input(17, "Reason", Type::u16).shows<last_reason, Varies::in_ticks>(),
    input(18, "Receive_Errors_{}", Type::u16).each(kPortNames, 1).shows<receive_errors, Varies::in_ticks>(),
    input(20, "Module_ID", Type::u16).always(0x44),

    coil(0, "Output_{}").times(kOutputs, 1, 0),
    coil(100, "Servo_{}", Access::read).each(kAxes, 1).shows<is_driving, Varies::in_ticks>(),
    coil(110, "Run"),
    coil(111, "Absent"),
    coil(0x1000, "Relay_{}").times(kRelays, 1, 0),

    discrete(0, "Input_{}").times(16, 1, 0).shows<input_level, Varies::in_ticks>(),
    discrete(16, "DRIVING_{}").each(kAxes, 16).shows<is_driving, Varies::in_ticks>(),
    discrete(17, "Always_On_{}").each(kAxes, 16).always(1),
};

inline constexpr MapPolicy kPolicy{.unmapped = MapPolicy::Unmapped::holes_read_zero,
                                   .write_only = MapPolicy::WriteOnly::refused,
                                   .halves = MapPolicy::Halves::come_whole,
                                   .read_halves = MapPolicy::ReadHalves::come_whole,
                                   .low_word_first = false,
                                   .word_order_in = "Word_Order"};

}  // namespace understudy::emulator::workbench
