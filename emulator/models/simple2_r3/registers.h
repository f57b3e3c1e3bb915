// Simple2-R3: every register, in the manual's order and spelling ("Resoultion", and the axis names without
// their letter, are the manual's). Section names are those of the manual.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/simple2_r3/effects.h"

namespace understudy::emulator::models::simple2_r3 {

inline constexpr Type u16 = Type::u16;
inline constexpr Type s16 = Type::s16;
inline constexpr Type u32 = Type::u32;
inline constexpr Type s32 = Type::s32;
inline constexpr Access R = Access::read;
inline constexpr Access W = Access::write;
inline constexpr Access RW = Access::read_write;

inline constexpr Value kS32Min = INT32_MIN;
inline constexpr Value kS32Max = INT32_MAX;
inline constexpr Value k2To15 = 32768;
inline constexpr Value k2To31 = 2147483648;

// What writes can do. Names of hazards are those of the table, in short.
inline constexpr Hazards kValue = Hazards::settings;
inline constexpr Hazards kMemory = Hazards::memory;
inline constexpr Hazards kOutput = Hazards::output;
inline constexpr Hazards kMotion = Hazards::motion;
// A program can do all that its instructions do.
inline constexpr Hazards kProgram = kMemory | kOutput | kMotion;

template <std::size_t N>
constexpr std::array<RegisterRow, N> section(std::string_view name, Hazards hazards,
                                             const RegisterRow (&rows)[N]) {
  std::array<RegisterRow, N> named{};
  for (std::size_t i = 0; i < N; ++i) {
    named[i] = marked(rows[i], hazards);
    named[i].section = name;
  }
  return named;
}
/// A section whose registers are only read, or have marks of their own.
template <std::size_t N>
consteval std::array<RegisterRow, N> section(std::string_view name, const RegisterRow (&rows)[N]) {
  return section(name, Hazards::unmarked, rows);
}

template <std::size_t... N>
consteval auto join(const std::array<RegisterRow, N>&... sections) {
  std::array<RegisterRow, (N + ...)> all{};
  std::size_t next = 0;
  const auto add = [&](const auto& rows) {
    for (const RegisterRow& row : rows) all[next++] = row;
  };
  (add(sections), ...);
  return all;
}

/// The bits of STATUS: those of A are even, those of B odd.
inline constexpr BitField kStatusBits[] = {
    bits(0, "A_alarm"),        bits(1, "B_alarm"),        bits(2, "A_ready"),
    bits(3, "B_ready"),        bits(4, "A_moving"),       bits(5, "B_moving"),
    bits(6, "A_homing"),       bits(7, "B_homing"),       bits(8, "A_home_reached"),
    bits(9, "B_home_reached"), bits(10, "A_servo"),       bits(11, "B_servo"),
    bits(12, "A_upper_limit"), bits(13, "B_upper_limit"), bits(14, "A_lower_limit"),
    bits(15, "B_lower_limit")};

// clang-format off
inline constexpr auto kStatusRows = section("狀態相關", {
    reg(0x0000, "STATUS",         u16, R).reads<read_status, Varies::in_ticks>().with_bits(kStatusBits),
    reg(0x0001, "HW_Code",        u16, R).from_factory(0xC001),
    reg(0x0002, "Version",        u16, R).from_factory(152).reads<read_version, Varies::in_ticks>(),
    reg(0x0004, "Aaxis_Mode",     u16, R).range(0, 3).reads<read_mode, Varies::in_ticks>(kAxisA),
    reg(0x0005, "Baxis_Mode",     u16, R).range(0, 3).reads<read_mode, Varies::in_ticks>(kAxisB),
    reg(0x000F, "EEPROM_Writing", u16, R).range(0, 1).reads<read_eeprom_busy, Varies::in_ticks>(),
});

inline constexpr auto kAssignmentRows = section("輸入輸出功能指配相關", kOutput | kMotion, {
    reg(0x0A00, "DOUT0_Aaxis_SVON",    u16, RW).range(0, 1).kept(),
    reg(0x0A01, "DOUT1_Aaxis_ACLR",    u16, RW).range(0, 1).kept(),
    reg(0x0A02, "DOUT2_Baxis_SVON",    u16, RW).range(0, 1).kept(),
    reg(0x0A03, "DOUT3_Baxis_ACLR",    u16, RW).range(0, 1).kept(),
    reg(0x0A04, "DIN0_Aaxis_Alarm",    u16, RW).range(0, 1).kept(),
    reg(0x0A05, "DIN1_Aaxis_Ready",    u16, RW).range(0, 1).kept(),
    reg(0x0A06, "DIN2_Aaxis_UP_Limit", u16, RW).range(0, 1).kept(),
    reg(0x0A07, "DIN3_Aaxis_DN_Limit", u16, RW).range(0, 1).kept(),
    reg(0x0A08, "DIN4_Aaxis_Home",     u16, RW).range(0, 1).kept(),
    reg(0x0A09, "DIN5_Baxis_Alarm",    u16, RW).range(0, 1).kept(),
    reg(0x0A0A, "DIN6_Baxis_Ready",    u16, RW).range(0, 1).kept(),
    reg(0x0A0B, "DIN7_Baxis_UP_Limit", u16, RW).range(0, 1).kept(),
    reg(0x0A0C, "DIN8_Baxis_DN_Limit", u16, RW).range(0, 1).kept(),
    reg(0x0A0D, "DIN9_Baxis_Home",     u16, RW).range(0, 1).kept(),
});

inline constexpr auto kIoRows = section("輸入輸出相關", kOutput, {
    reg(0x0D00, "DOUT_{}",  u16, RW).range(0, 1).times(7, 1, 0).reads<read_output, Varies::in_ticks>().does<write_output>(),
    reg(0x0D10, "DIN_{}",   u16, R).range(0, 1).times(11, 1, 0).reads<read_input, Varies::in_ticks>(),
    reg(0x0DF0, "DOUT_ALL", u16, RW).range(0, 0x7F).reads<read_all_outputs, Varies::in_ticks>().does<write_all_outputs>(),
    reg(0x0DF1, "DIN_ALL",  u16, R).range(0, 0x7FF).reads<read_all_inputs, Varies::in_ticks>(),
});

inline constexpr auto kPositionRows = section("編碼器，座標，類比輸入相關", kMotion, {
    reg(0x0E00, "ENCA",     s32, RW).range(kS32Min, kS32Max).in("Pulse").reads<read_encoder, Varies::while_moving>(kAxisA).does<preset_encoder>(kAxisA),
    reg(0x0E02, "ENCB",     s32, RW).range(kS32Min, kS32Max).in("Pulse").reads<read_encoder, Varies::while_moving>(kAxisB).does<preset_encoder>(kAxisB),
    reg(0x0E04, "Cord_A",   s32, RW).range(kS32Min, kS32Max).in("Pulse").reads<read_coordinate, Varies::while_moving>(kAxisA).does<preset_coordinate>(kAxisA),
    reg(0x0E06, "Cord_B",   s32, RW).range(kS32Min, kS32Max).in("Pulse").reads<read_coordinate, Varies::while_moving>(kAxisB).does<preset_coordinate>(kAxisB),
    reg(0x0E08, "Analog_A", u16, R).range(0, 65535).reads<read_analog, Varies::in_ticks>(0),
    reg(0x0E09, "Analog_B", u16, R).range(0, 65535).reads<read_analog, Varies::in_ticks>(1),
    reg(0x0E0A, "ENCA_Resoultion", u32, RW).range(1, k2To31).in("Pulse").from_factory(3200).kept().may(kMemory | kMotion),
    reg(0x0E0C, "ENCB_Resoultion", u32, RW).range(1, k2To31).in("Pulse").from_factory(3200).kept().may(kMemory | kMotion),
    reg(0x0E0E, "ENCA_RPM", s16, R).range(-32768, 32767).in("RPM").reads<read_encoder_speed, Varies::with_time>(kAxisA).changes_at<every_tick>(),
    reg(0x0E0F, "ENCB_RPM", s16, R).range(-32768, 32767).in("RPM").reads<read_encoder_speed, Varies::with_time>(kAxisB).changes_at<every_tick>(),
});

// The manual prints a minimum of 1 for speeds, but the factory value is 0 and appendix A describes it.
inline constexpr auto kMotionRows = section("運動相關", kMotion, {
    reg(0x1000, "Aaxis_Pulse",     s32, RW).range(kS32Min, kS32Max).in("Pulse").may(kValue),
    reg(0x1002, "Aaxis_Speed",     u16, RW).range(0, k2To15).in("RPM").does<change_speed>(kAxisA),
    reg(0x1003, "Aaxis_AccTime",   u16, RW).range(0, 3000).in("10ms").does<change_speed>(kAxisA),
    reg(0x1004, "Aaxis_DecTime",   u16, RW).range(0, 3000).in("10ms").does<change_speed>(kAxisA),
    reg(0x1005, "Aaxis_Move_INC",  u16, RW).range(0, 1).in("ON/OFF").reads<read_incremental_trigger, Varies::in_ticks>(kAxisA).triggers<start_incremental>(kAxisA),
    reg(0x1006, "Baxis_Pulse",     s32, RW).range(kS32Min, kS32Max).in("Pulse").may(kValue),
    reg(0x1008, "Baxis_Speed",     u16, RW).range(0, k2To15).in("RPM").does<change_speed>(kAxisB),
    reg(0x1009, "Baxis_AccTime",   u16, RW).range(0, 3000).in("10ms").does<change_speed>(kAxisB),
    reg(0x100A, "Baxis_DecTime",   u16, RW).range(0, 3000).in("10ms").does<change_speed>(kAxisB),
    reg(0x100B, "Baxis_Move_INC",  u16, RW).range(0, 1).in("ON/OFF").reads<read_incremental_trigger, Varies::in_ticks>(kAxisB).triggers<start_incremental>(kAxisB),
    reg(0x100C, "ALL_Move_INC",    u16, W).range(0, 1).in("ON/OFF").triggers<start_incremental>(kAllAxes),
    reg(0x100D, "ALL_STOP",        u16, W).range(0, 1).in("ON/OFF").triggers<stop_motion>(kAllAxes),
    reg(0x100E, "Aaxis_STOP",      u16, RW).range(0, 1).in("ON/OFF").reads<read_zero, Varies::in_ticks>().triggers<stop_motion>(kAxisA),
    reg(0x100F, "Baxis_STOP",      u16, RW).range(0, 1).in("ON/OFF").reads<read_zero, Varies::in_ticks>().triggers<stop_motion>(kAxisB),
    reg(0x1010, "ALL_GoHome",      u16, W).range(0, 1).in("ON/OFF").triggers<go_home>(kAllAxes),
    reg(0x1011, "Aaxis_GoHome",    u16, RW).range(0, 1).in("ON/OFF").reads<read_homing_trigger, Varies::in_ticks>(kAxisA).triggers<go_home>(kAxisA),
    reg(0x1012, "Baxis_GoHome",    u16, RW).range(0, 1).in("ON/OFF").reads<read_homing_trigger, Varies::in_ticks>(kAxisB).triggers<go_home>(kAxisB),
    reg(0x1013, "ALL_SVON",        u16, W).range(0, 1).in("ON/OFF").does<switch_servo>(kAllAxes).may(kOutput | kMotion),
    reg(0x1014, "Aaxis_SVON",      u16, RW).range(0, 1).in("ON/OFF").reads<read_servo, Varies::in_ticks>(kAxisA).does<switch_servo>(kAxisA).may(kOutput | kMotion),
    reg(0x1015, "Baxis_SVON",      u16, RW).range(0, 1).in("ON/OFF").reads<read_servo, Varies::in_ticks>(kAxisB).does<switch_servo>(kAxisB).may(kOutput | kMotion),
    reg(0x1016, "ALL_ACLR",        u16, W).range(0, 1).in("ON/OFF").triggers<clear_alarm>(kAllAxes).may(kOutput | kMotion),
    reg(0x1017, "Aaxis_ACLR",      u16, RW).range(0, 1).in("ON/OFF").reads<read_alarm_clear, Varies::in_ticks>(kAxisA).triggers<clear_alarm>(kAxisA).may(kOutput | kMotion),
    reg(0x1018, "Baxis_ACLR",      u16, RW).range(0, 1).in("ON/OFF").reads<read_alarm_clear, Varies::in_ticks>(kAxisB).triggers<clear_alarm>(kAxisB).may(kOutput | kMotion),
    reg(0x1019, "Aaxis_DirectPWM", u16, RW).range(0, 100).does<command_pwm>(kAxisA),
    reg(0x101A, "Baxis_DirectPWM", u16, RW).range(0, 100).does<command_pwm>(kAxisB),
    reg(0x101B, "ALL_Move_ABS",    u16, W).range(0, 1).in("ON/OFF").triggers<start_absolute>(kAllAxes),
    reg(0x101C, "Aaxis_Move_ABS",  u16, RW).range(0, 1).in("ON/OFF").reads<read_absolute_trigger, Varies::in_ticks>(kAxisA).triggers<start_absolute>(kAxisA),
    reg(0x101D, "Baxis_Move_ABS",  u16, RW).range(0, 1).in("ON/OFF").reads<read_absolute_trigger, Varies::in_ticks>(kAxisB).triggers<start_absolute>(kAxisB),
});

inline constexpr auto kPositionSetRows = section("預存位置表", kMemory, {
    reg(0x2000, "Parms_Pulse{}",   s32, RW).range(kS32Min, kS32Max).in("Pulse").kept().times(16, 5, 1),
    reg(0x2002, "Parms_Speed{}",   u16, RW).range(0, k2To15).in("RPM").kept().times(16, 5, 1),
    reg(0x2003, "Parms_AccTime{}", u16, RW).range(0, 3000).in("10ms").kept().times(16, 5, 1),
    reg(0x2004, "Parms_DecTime{}", u16, RW).range(0, 3000).in("10ms").kept().times(16, 5, 1),
});

inline constexpr auto kSpeedSetRows = section("預存速度表", kMemory, {
    reg(0x20A0, "Parms_mRPM{}", s32, RW).range(kS32Min, kS32Max).in("mRPM").kept().times(16, 2, 1),
});

inline constexpr auto kIncrementalBySetRows = section("預存位置表相關運動指令(增量位置移動)", kMotion, {
    reg(0x2100, "ALL_ParmsMove_INC",     u16, W).range(0, 16).triggers<start_incremental_by_set>(kAllAxes),
    reg(0x2101, "Aaxis_ParmsMove_INC",   u16, W).range(0, 16).triggers<start_incremental_by_set>(kAxisA),
    reg(0x2102, "Baxis_ParmsMove_INC",   u16, W).range(0, 16).triggers<start_incremental_by_set>(kAxisB),
});

inline constexpr auto kVelocityBySetRows = section("預存速度表相關運動指令", kMotion, {
    reg(0x2103, "ALL_ParmsDirectmRPM",   u16, W).range(0, 16).triggers<run_velocity_by_set>(kAllAxes),
    reg(0x2104, "Aaxis_ParmsDirectmRPM", u16, W).range(0, 16).triggers<run_velocity_by_set>(kAxisA),
    reg(0x2105, "Baxis_ParmsDirectmRPM", u16, W).range(0, 16).triggers<run_velocity_by_set>(kAxisB),
});

inline constexpr auto kAbsoluteBySetRows = section("預存位置表相關運動指令(絕對位置移動)", kMotion, {
    reg(0x2106, "ALL_ParmsMove_ABS",     u16, W).range(0, 16).triggers<start_absolute_by_set>(kAllAxes),
    reg(0x2107, "Aaxis_ParmsMove_ABS",   u16, W).range(0, 16).triggers<start_absolute_by_set>(kAxisA),
    reg(0x2108, "Baxis_ParmsMove_ABS",   u16, W).range(0, 16).triggers<start_absolute_by_set>(kAxisB),
});

// A program cell travels as 16 bits but holds 8.
inline constexpr auto kProgramRows = section("程式控制", kProgram, {
    reg(0x3000, "PROG_MAIN_RunTime_START",  u16, W).range(0, 255).in("line").does<start_program>(),
    reg(0x3001, "PROG_MAIN_RunTime_END",    u16, W).range(0, 1).triggers<stop_program>().may(kMotion),
    reg(0x3004, "PROG_MAIN_Erase_ALL",      u16, W).range(0, 1).triggers<erase_program>().may(kMemory),
    reg(0x3010, "PROG_MAIN_NowLine",        u16, R).range(0, 255).in("line").reads<read_now_line, Varies::in_ticks>(),
    reg(0x3012, "PROG_MAIN_RunTime_Status", u16, R).range(0, 1).reads<read_program_runs, Varies::in_ticks>(),
    reg(0x4000, "MAIN_LINE{}_CMD",   u16, RW).kept().holding_bits(0xFF).times(256, 4, 0).reads<read_cell, Varies::in_ticks>(0).does<write_cell>(0),
    reg(0x4001, "MAIN_LINE{}_DATA1", u16, RW).kept().holding_bits(0xFF).times(256, 4, 0).reads<read_cell, Varies::in_ticks>(1).does<write_cell>(1),
    reg(0x4002, "MAIN_LINE{}_DATA2", u16, RW).kept().holding_bits(0xFF).times(256, 4, 0).reads<read_cell, Varies::in_ticks>(2).does<write_cell>(2),
    reg(0x4003, "MAIN_LINE{}_JMP",   u16, RW).kept().holding_bits(0xFF).times(256, 4, 0).reads<read_cell, Varies::in_ticks>(3).does<write_cell>(3),
    reg(0x8000, "PROG_MEM{}", s32, RW).kept().times(32, 2, 0).halves("_RegL", "_RegH").may(kMemory),
    reg(0x8100, "PROG_VAR{}", s32, RW).times(32, 2, 0).halves("_RegL", "_RegH").may(kValue),
});

// The manual prints EncSync up to 2^16, which 16 bits cannot hold. It gives 0xF02A the same entry as 0xF029.
inline constexpr auto kSystemRows = section("系統參數相關", kMemory, {
    reg(0xF000, "Aaxis_Home_Speed",    u16, RW).also("Axis_Home_Speed").range(0, k2To15).in("RPM").kept(),
    reg(0xF001, "Baxis_Home_Speed",    u16, RW).range(0, k2To15).in("RPM").kept(),
    reg(0xF002, "Aaxis_Resoultion",    u32, RW).also("Axis_Resoultion").range(1, k2To31).in("Pulse").from_factory(3200).kept().does<change_speed>(kAxisA).may(kMemory | kMotion),
    reg(0xF004, "Baxis_Resoultion",    u32, RW).range(1, k2To31).in("Pulse").from_factory(3200).kept().does<change_speed>(kAxisB).may(kMemory | kMotion),
    reg(0xF006, "Aaxis_DirectmRPM",    s32, RW).range(kS32Min, kS32Max).in("mRPM").does<command_velocity>(kAxisA).may(kMotion),
    reg(0xF008, "Baxis_DirectmRPM",    s32, RW).range(kS32Min, kS32Max).in("mRPM").does<command_velocity>(kAxisB).may(kMotion),
    reg(0xF010, "Aaxis_Home_AccTime",  u16, RW).also("Axis_Home_AccTime").range(0, 3000).in("10ms").kept(),
    reg(0xF011, "Baxis_Home_AccTime",  u16, RW).range(0, 3000).in("10ms").kept(),
    reg(0xF012, "Aaxis_SVON_Polarity", u16, RW).range(0, 1).from_factory(1).kept().may(kMemory | kOutput | kMotion),
    reg(0xF013, "Baxis_SVON_Polarity", u16, RW).range(0, 1).from_factory(1).kept().may(kMemory | kOutput | kMotion),
    reg(0xF014, "Aaxis_ALM_Polarity",  u16, RW).range(0, 1).kept().may(kMemory | kMotion),
    reg(0xF015, "Baxis_ALM_Polarity",  u16, RW).range(0, 1).kept().may(kMemory | kMotion),
    reg(0xF016, "Aaxis_DIR_Polarity",  u16, RW).range(0, 1).kept().may(kMemory | kMotion),
    reg(0xF017, "Baxis_DIR_Polarity",  u16, RW).range(0, 1).kept().may(kMemory | kMotion),
    reg(0xF018, "Axis_ENC_Polarity",   u16, RW).also("Aaxis_ENC_Polarity").range(0, 1).kept().may(kMemory | kMotion),
    reg(0xF019, "Baxis_ENC_Polarity",  u16, RW).range(0, 1).kept().may(kMemory | kMotion),
    reg(0xF01A, "Axis_GoHome_DIR",     u16, RW).also("Aaxis_GoHome_DIR").range(0, 1).kept(),
    reg(0xF01B, "Baxis_GoHome_DIR",    u16, RW).range(0, 1).kept(),
    reg(0xF01C, "Axis_VelMode_ACC",    u16, RW).also("Aaxis_VelMode_ACC").range(1, k2To15).in("2mRPM/s").from_factory(1000).kept(),
    reg(0xF01D, "Baxis_VelMode_ACC",   u16, RW).range(1, k2To15).in("2mRPM/s").from_factory(1000).kept(),
    reg(0xF01E, "AutoStart_MainProg",  u16, RW).range(0, 1).kept().may(kProgram),
    reg(0xF020, "Axis_EncSync_NUM",    u16, RW).also("Aaxis_EncSync_NUM").range(0, 65535).from_factory(1).kept().does<change_sync>(kAxisA).may(kMemory | kMotion),
    reg(0xF021, "Axis_EncSync_DEN",    u16, RW).also("Aaxis_EncSync_DEN").range(1, 65535).from_factory(1).kept().does<change_sync>(kAxisA).may(kMemory | kMotion),
    reg(0xF022, "Baxis_EncSync_NUM",   u16, RW).range(0, 65535).from_factory(1).kept().does<change_sync>(kAxisB).may(kMemory | kMotion),
    reg(0xF023, "Baxis_EncSync_DEN",   u16, RW).range(1, 65535).from_factory(1).kept().does<change_sync>(kAxisB).may(kMemory | kMotion),
    reg(0xF024, "ALL_SyncMode",        u16, W).range(0, 1).triggers<command_following>(kAllAxes).may(kMotion),
    reg(0xF025, "Aaxis_SyncMode",      u16, W).range(0, 1).triggers<command_following>(kAxisA).may(kMotion),
    reg(0xF026, "Baxis_SyncMode",      u16, W).range(0, 1).triggers<command_following>(kAxisB).may(kMotion),
    reg(0xF027, "Axis_SyncSlope",      u16, RW).also("Aaxis_SyncSlope").range(0, 255).kept().does<change_sync>(kAxisA).may(kMemory | kMotion),
    reg(0xF028, "Baxis_SyncSlope",     u16, RW).range(0, 255).kept().does<change_sync>(kAxisB).may(kMemory | kMotion),
    reg(0xF029, "Axis_SyncRPM",        u16, RW).also("Aaxis_SyncRPM").range(1, 3000).in("RPM").from_factory(3000).kept().does<change_sync>(kAxisA).may(kMemory | kMotion),
    reg(0xF02A, "Baxis_SyncRPM",       u16, RW).range(1, 3000).in("RPM").from_factory(3000).kept().does<change_sync>(kAxisB).may(kMemory | kMotion),
});

inline constexpr auto kApplicationRows = section("程式應用相關", kValue, {
    reg(0xF100, "CalcREG",        s32, RW),
    reg(0xF122, "Counter1_Value", u16, RW).range(0, 65535),
    reg(0xF123, "Counter2_Value", u16, RW).range(0, 65535),
    reg(0xF126, "Timer1_Value",   u32, RW).range(0, 4294967295).reads<read_timer, Varies::with_time>(0).changes_at<next_count_of_timer>().does<preset_timer>(0),
    reg(0xF128, "Timer2_Value",   u32, RW).range(0, 4294967295).reads<read_timer, Varies::with_time>(1).changes_at<next_count_of_timer>().does<preset_timer>(1),
});

inline constexpr auto kFactoryRows = section("附錄 C", kMemory, {
    reg(0xFF00, "ADC_A",         u16, R).reads<read_adc, Varies::in_ticks>(0),
    reg(0xFF01, "ADC_B",         u16, R).reads<read_adc, Varies::in_ticks>(1),
    reg(0xFF02, "ADC_10V_A",     u16, RW).from_factory(4000).kept(),
    reg(0xFF03, "ADC_10V_B",     u16, RW).from_factory(4000).kept(),
    reg(0xFF04, "ADC_1V_A",      u16, RW).from_factory(400).kept(),
    reg(0xFF05, "ADC_1V_B",      u16, RW).from_factory(400).kept(),
    reg(0xFF06, "Factory_Reset", u16, W).range(0, 1).triggers<reset_to_factory>().may(Hazards::all),
    reg(0xFF07, "PWD_Input",     u16, RW).also("PWD_INPUT").range(0, 65535).does<enter_password>().since_firmware(151).may(kValue),
    reg(0xFF08, "PROG_UNLOCK",   u16, R).range(0, 1).from_factory(1).reads<read_unlocked, Varies::in_ticks>().since_firmware(151),
    reg(0xFF09, "NEW_PWD",       u16, RW).range(0, 65535).reads<read_password, Varies::in_ticks>().does<change_password>().since_firmware(151),
});
// clang-format on

inline constexpr auto kRegisters =
    join(kStatusRows, kAssignmentRows, kIoRows, kPositionRows, kMotionRows, kPositionSetRows, kSpeedSetRows,
         kIncrementalBySetRows, kVelocityBySetRows, kAbsoluteBySetRows, kProgramRows, kSystemRows,
         kApplicationRows, kFactoryRows);

static_assert(are_marked(kRegisters), "a register does not say what a write can do");

inline constexpr std::size_t kSlotCount = [] {
  std::size_t count = 0;
  for (const RegisterRow& row : kRegisters) count += static_cast<std::size_t>(row.count);
  return count;
}();

/// Returns the slot of a register in the image; an unknown name is a compile error.
consteval std::size_t slot(std::string_view name) {
  std::size_t next = 0;
  for (const RegisterRow& row : kRegisters) {
    if (row.name == name) return next;
    next += static_cast<std::size_t>(row.count);
  }
  throw "no such register";
}

/// Returns the factory value of the register in a slot.
constexpr Value factory_value(std::size_t number) {
  std::size_t next = 0;
  for (const RegisterRow& row : kRegisters) {
    next += static_cast<std::size_t>(row.count);
    if (number < next) return row.factory;
  }
  return 0;
}

}  // namespace understudy::emulator::models::simple2_r3
