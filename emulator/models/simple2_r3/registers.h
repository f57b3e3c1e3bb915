// Simple2-R3: every register, in the manual's order and spelling ("Resoultion" and axis names without their
// letter come from the manual). The section names are those of the manual.
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

// What writes can do. These are short forms of the hazards' names.
inline constexpr Hazards kValue = Hazards::settings;
inline constexpr Hazards kMemory = Hazards::memory;
inline constexpr Hazards kOutput = Hazards::output;
inline constexpr Hazards kMotion = Hazards::motion;
// A program can do everything that its instructions can do.
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
/// A section whose registers are read-only or have individual marks.
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

/// The bits of STATUS. Those of axis A are even, those of axis B odd.
inline constexpr BitField kStatusBits[] = {
    bits(0, "A_alarm"),        bits(1, "B_alarm"),        bits(2, "A_ready"),
    bits(3, "B_ready"),        bits(4, "A_moving"),       bits(5, "B_moving"),
    bits(6, "A_homing"),       bits(7, "B_homing"),       bits(8, "A_home_reached"),
    bits(9, "B_home_reached"), bits(10, "A_servo"),       bits(11, "B_servo"),
    bits(12, "A_upper_limit"), bits(13, "B_upper_limit"), bits(14, "A_lower_limit"),
    bits(15, "B_lower_limit")};

// clang-format off
inline constexpr auto kStatusRows = section("狀態相關", {
    reg(0x0000, "STATUS",         u16, R).means("state of both axes, one bit per item", "狀態").reads<read_status, Varies::in_ticks>().with_bits(kStatusBits),
    reg(0x0001, "HW_Code",        u16, R).means("hardware code", "硬體識別碼").from_factory(0xC001),
    reg(0x0002, "Version",        u16, R).means("firmware version, in hundredths", "控制器版次").from_factory(152).reads<read_version, Varies::in_ticks>(),
    reg(0x0004, "Aaxis_Mode",     u16, R).means("mode of axis A: 0 position, 1 velocity, 2 PWM, 3 encoder following", "A 軸目前模式").range(0, 3).reads<read_mode, Varies::in_ticks>(kAxisA),
    reg(0x0005, "Baxis_Mode",     u16, R).means("mode of axis B: 0 position, 1 velocity, 2 PWM, 3 encoder following", "B 軸目前模式").range(0, 3).reads<read_mode, Varies::in_ticks>(kAxisB),
    reg(0x000F, "EEPROM_Writing", u16, R).means("1 while the EEPROM is being written", "EEPROM 是否正在寫入").range(0, 1).reads<read_eeprom_busy, Varies::in_ticks>(),
});

inline constexpr auto kAssignmentRows = section("輸入輸出功能指配相關", kOutput | kMotion, {
    reg(0x0A00, "DOUT0_Aaxis_SVON",    u16, RW).means("1: DOUT0 is the servo-on output of axis A", "將 DOUT0 指配給 A 軸 SVON 輸出").range(0, 1).persists(),
    reg(0x0A01, "DOUT1_Aaxis_ACLR",    u16, RW).means("1: DOUT1 is the alarm-clear output of axis A", "將 DOUT1 指配給 A 軸 ACLR 輸出").range(0, 1).persists(),
    reg(0x0A02, "DOUT2_Baxis_SVON",    u16, RW).means("1: DOUT2 is the servo-on output of axis B", "將 DOUT2 指配給 B 軸 SVON 輸出").range(0, 1).persists(),
    reg(0x0A03, "DOUT3_Baxis_ACLR",    u16, RW).means("1: DOUT3 is the alarm-clear output of axis B", "將 DOUT3 指配給 B 軸 ACLR 輸出").range(0, 1).persists(),
    reg(0x0A04, "DIN0_Aaxis_Alarm",    u16, RW).means("1: DIN0 is the alarm input of axis A", "將 DIN0 指配為接收 A 軸 Alarm 輸入").range(0, 1).persists(),
    reg(0x0A05, "DIN1_Aaxis_Ready",    u16, RW).means("1: DIN1 is the ready input of axis A", "將 DIN1 指配為接收 A 軸 Ready 輸入").range(0, 1).persists(),
    reg(0x0A06, "DIN2_Aaxis_UP_Limit", u16, RW).means("1: DIN2 is the upper limit input of axis A", "將 DIN2 指配為接收 A 軸 UP_Limit 輸入").range(0, 1).persists(),
    reg(0x0A07, "DIN3_Aaxis_DN_Limit", u16, RW).means("1: DIN3 is the lower limit input of axis A", "將 DIN3 指配為接收 A 軸 DN_Limit 輸入").range(0, 1).persists(),
    reg(0x0A08, "DIN4_Aaxis_Home",     u16, RW).means("1: DIN4 is the home input of axis A", "將 DIN4 指配為接收 A 軸 原點訊號 Home 輸入").range(0, 1).persists(),
    reg(0x0A09, "DIN5_Baxis_Alarm",    u16, RW).means("1: DIN5 is the alarm input of axis B", "將 DIN5 指配為接收 B 軸 Alarm 輸入").range(0, 1).persists(),
    reg(0x0A0A, "DIN6_Baxis_Ready",    u16, RW).means("1: DIN6 is the ready input of axis B", "將 DIN6 指配為接收 B 軸 Ready 輸入").range(0, 1).persists(),
    reg(0x0A0B, "DIN7_Baxis_UP_Limit", u16, RW).means("1: DIN7 is the upper limit input of axis B", "將 DIN7 指配為接收 B 軸 UP_Limit 輸入").range(0, 1).persists(),
    reg(0x0A0C, "DIN8_Baxis_DN_Limit", u16, RW).means("1: DIN8 is the lower limit input of axis B", "將 DIN8 指配為接收 B 軸 DN_Limit 輸入").range(0, 1).persists(),
    reg(0x0A0D, "DIN9_Baxis_Home",     u16, RW).means("1: DIN9 is the home input of axis B", "將 DIN9 指配為接收 B 軸 原點訊號 Home 輸入").range(0, 1).persists(),
});

inline constexpr auto kIoRows = section("輸入輸出相關", kOutput, {
    reg(0x0D00, "DOUT_{}",  u16, RW).means("digital output {}", "{} 號輸出點").range(0, 1).times(7, 1, 0).reads<read_output, Varies::in_ticks>().does<write_output>(),
    reg(0x0D10, "DIN_{}",   u16, R).means("digital input {}", "{} 號輸入點").range(0, 1).times(11, 1, 0).reads<read_input, Varies::in_ticks>(),
    reg(0x0DF0, "DOUT_ALL", u16, RW).means("all digital outputs, one bit each", "所有輸出點").range(0, 0x7F).reads<read_all_outputs, Varies::in_ticks>().does<write_all_outputs>(),
    reg(0x0DF1, "DIN_ALL",  u16, R).means("all digital inputs, one bit each", "所有輸入點").range(0, 0x7FF).reads<read_all_inputs, Varies::in_ticks>(),
});

inline constexpr auto kPositionRows = section("編碼器，座標，類比輸入相關", kMotion, {
    reg(0x0E00, "ENCA",     s32, RW).means("encoder count A", "編碼器 A 讀回值").range(kS32Min, kS32Max).in("Pulse").reads<read_encoder, Varies::while_moving>(kAxisA).does<preset_encoder>(kAxisA),
    reg(0x0E02, "ENCB",     s32, RW).means("encoder count B", "編碼器 B 讀回值").range(kS32Min, kS32Max).in("Pulse").reads<read_encoder, Varies::while_moving>(kAxisB).does<preset_encoder>(kAxisB),
    reg(0x0E04, "Cord_A",   s32, RW).means("coordinate of axis A: position in pulses sent", "A 軸座標值").range(kS32Min, kS32Max).in("Pulse").reads<read_coordinate, Varies::while_moving>(kAxisA).does<preset_coordinate>(kAxisA),
    reg(0x0E06, "Cord_B",   s32, RW).means("coordinate of axis B: position in pulses sent", "B 軸座標值").range(kS32Min, kS32Max).in("Pulse").reads<read_coordinate, Varies::while_moving>(kAxisB).does<preset_coordinate>(kAxisB),
    reg(0x0E08, "Analog_A", u16, R).means("analog input A; 2000 is 10 V", "類比輸入 A 讀回值").range(0, 65535).reads<read_analog, Varies::in_ticks>(0),
    reg(0x0E09, "Analog_B", u16, R).means("analog input B; 2000 is 10 V", "類比輸入 B 讀回值").range(0, 65535).reads<read_analog, Varies::in_ticks>(1),
    reg(0x0E0A, "ENCA_Resoultion", u32, RW).means("counts of encoder A per revolution", "編碼器 A 一圈脈衝").range(1, k2To31).in("Pulse").from_factory(3200).persists().may(kMemory | kMotion),
    reg(0x0E0C, "ENCB_Resoultion", u32, RW).means("counts of encoder B per revolution", "編碼器 B 一圈脈衝").range(1, k2To31).in("Pulse").from_factory(3200).persists().may(kMemory | kMotion),
    reg(0x0E0E, "ENCA_RPM", s16, R).means("speed of encoder A", "編碼器 A 轉速讀回值").range(-32768, 32767).in("RPM").reads<read_encoder_speed, Varies::with_time>(kAxisA).changes_at<every_tick>(),
    reg(0x0E0F, "ENCB_RPM", s16, R).means("speed of encoder B", "編碼器 B 轉速讀回值").range(-32768, 32767).in("RPM").reads<read_encoder_speed, Varies::with_time>(kAxisB).changes_at<every_tick>(),
});

// The manual prints a minimum of 1 for speeds, but the factory value is 0, and appendix A describes that
// value.
inline constexpr auto kMotionRows = section("運動相關", kMotion, {
    reg(0x1000, "Aaxis_Pulse",     s32, RW).means("distance or target of the next move of axis A", "A 軸位移值").range(kS32Min, kS32Max).in("Pulse").may(kValue),
    reg(0x1002, "Aaxis_Speed",     u16, RW).means("move speed of axis A", "最大 A 軸速度").range(0, k2To15).in("RPM").does<change_speed>(kAxisA),
    reg(0x1003, "Aaxis_AccTime",   u16, RW).means("acceleration time of axis A", "A 軸加速時間").range(0, 3000).in("10ms").does<change_speed>(kAxisA),
    reg(0x1004, "Aaxis_DecTime",   u16, RW).means("deceleration time of axis A", "A 軸減速時間").range(0, 3000).in("10ms").does<change_speed>(kAxisA),
    reg(0x1005, "Aaxis_Move_INC",  u16, RW).means("1 starts an incremental move of axis A", "A 軸開始增量移動").range(0, 1).in("ON/OFF").reads<read_incremental_trigger, Varies::in_ticks>(kAxisA).triggers<start_incremental>(kAxisA),
    reg(0x1006, "Baxis_Pulse",     s32, RW).means("distance or target of the next move of axis B", "B 軸位移值").range(kS32Min, kS32Max).in("Pulse").may(kValue),
    reg(0x1008, "Baxis_Speed",     u16, RW).means("move speed of axis B", "最大 B 軸速度").range(0, k2To15).in("RPM").does<change_speed>(kAxisB),
    reg(0x1009, "Baxis_AccTime",   u16, RW).means("acceleration time of axis B", "B 軸加速時間").range(0, 3000).in("10ms").does<change_speed>(kAxisB),
    reg(0x100A, "Baxis_DecTime",   u16, RW).means("deceleration time of axis B", "B 軸減速時間").range(0, 3000).in("10ms").does<change_speed>(kAxisB),
    reg(0x100B, "Baxis_Move_INC",  u16, RW).means("1 starts an incremental move of axis B", "B 軸開始增量移動").range(0, 1).in("ON/OFF").reads<read_incremental_trigger, Varies::in_ticks>(kAxisB).triggers<start_incremental>(kAxisB),
    reg(0x100C, "ALL_Move_INC",    u16, W).means("1 starts an incremental move of all axes", "所有軸開始運動").range(0, 1).in("ON/OFF").triggers<start_incremental>(kAllAxes),
    reg(0x100D, "ALL_STOP",        u16, W).means("1 stops all axes", "所有軸停止運動").range(0, 1).in("ON/OFF").triggers<stop_motion>(kAllAxes),
    reg(0x100E, "Aaxis_STOP",      u16, RW).means("1 stops axis A", "A 軸停止運動").range(0, 1).in("ON/OFF").reads<read_zero, Varies::in_ticks>().triggers<stop_motion>(kAxisA),
    reg(0x100F, "Baxis_STOP",      u16, RW).means("1 stops axis B", "B 軸停止運動").range(0, 1).in("ON/OFF").reads<read_zero, Varies::in_ticks>().triggers<stop_motion>(kAxisB),
    reg(0x1010, "ALL_GoHome",      u16, W).means("1 starts homing all axes", "所有軸返回原點").range(0, 1).in("ON/OFF").triggers<go_home>(kAllAxes),
    reg(0x1011, "Aaxis_GoHome",    u16, RW).means("1 starts homing axis A", "A 軸返回原點").range(0, 1).in("ON/OFF").reads<read_homing_trigger, Varies::in_ticks>(kAxisA).triggers<go_home>(kAxisA),
    reg(0x1012, "Baxis_GoHome",    u16, RW).means("1 starts homing axis B", "B 軸返回原點").range(0, 1).in("ON/OFF").reads<read_homing_trigger, Varies::in_ticks>(kAxisB).triggers<go_home>(kAxisB),
    reg(0x1013, "ALL_SVON",        u16, W).means("switches the servos of all axes on or off", "所有軸伺服啟動").range(0, 1).in("ON/OFF").does<switch_servo>(kAllAxes).may(kOutput | kMotion),
    reg(0x1014, "Aaxis_SVON",      u16, RW).means("switches the servo of axis A on or off", "A 軸伺服啟動").range(0, 1).in("ON/OFF").reads<read_servo, Varies::in_ticks>(kAxisA).does<switch_servo>(kAxisA).may(kOutput | kMotion),
    reg(0x1015, "Baxis_SVON",      u16, RW).means("switches the servo of axis B on or off", "B 軸伺服啟動").range(0, 1).in("ON/OFF").reads<read_servo, Varies::in_ticks>(kAxisB).does<switch_servo>(kAxisB).may(kOutput | kMotion),
    reg(0x1016, "ALL_ACLR",        u16, W).means("1 clears the alarms of all axes", "所有軸警報清除").range(0, 1).in("ON/OFF").triggers<clear_alarm>(kAllAxes).may(kOutput | kMotion),
    reg(0x1017, "Aaxis_ACLR",      u16, RW).means("1 clears the alarm of axis A", "A 軸警報清除").range(0, 1).in("ON/OFF").reads<read_alarm_clear, Varies::in_ticks>(kAxisA).triggers<clear_alarm>(kAxisA).may(kOutput | kMotion),
    reg(0x1018, "Baxis_ACLR",      u16, RW).means("1 clears the alarm of axis B", "B 軸警報清除").range(0, 1).in("ON/OFF").reads<read_alarm_clear, Varies::in_ticks>(kAxisB).triggers<clear_alarm>(kAxisB).may(kOutput | kMotion),
    reg(0x1019, "Aaxis_DirectPWM", u16, RW).means("PWM duty of axis A; a write enters PWM mode", "A 軸 PWM 模式輸出值").range(0, 100).does<command_pwm>(kAxisA),
    reg(0x101A, "Baxis_DirectPWM", u16, RW).means("PWM duty of axis B; a write enters PWM mode", "B 軸 PWM 模式輸出值").range(0, 100).does<command_pwm>(kAxisB),
    reg(0x101B, "ALL_Move_ABS",    u16, W).means("1 starts an absolute move of all axes", "所有軸開始絕對位置運動").range(0, 1).in("ON/OFF").triggers<start_absolute>(kAllAxes),
    reg(0x101C, "Aaxis_Move_ABS",  u16, RW).means("1 starts an absolute move of axis A", "A 軸開始絕對位置移動").range(0, 1).in("ON/OFF").reads<read_absolute_trigger, Varies::in_ticks>(kAxisA).triggers<start_absolute>(kAxisA),
    reg(0x101D, "Baxis_Move_ABS",  u16, RW).means("1 starts an absolute move of axis B", "B 軸開始絕對位置移動").range(0, 1).in("ON/OFF").reads<read_absolute_trigger, Varies::in_ticks>(kAxisB).triggers<start_absolute>(kAxisB),
});

inline constexpr auto kPositionSetRows = section("預存位置表", kMemory, {
    reg(0x2000, "Parms_Pulse{}",   s32, RW).means("distance or target of position set {}", "預存位置表組 {} 位移值").range(kS32Min, kS32Max).in("Pulse").persists().times(16, 5, 1),
    reg(0x2002, "Parms_Speed{}",   u16, RW).means("speed of position set {}", "預存位置表組 {} 移動速度").range(0, k2To15).in("RPM").persists().times(16, 5, 1),
    reg(0x2003, "Parms_AccTime{}", u16, RW).means("acceleration time of position set {}", "預存位置表組 {} 加速時間").range(0, 3000).in("10ms").persists().times(16, 5, 1),
    reg(0x2004, "Parms_DecTime{}", u16, RW).means("deceleration time of position set {}", "預存位置表組 {} 減速時間").range(0, 3000).in("10ms").persists().times(16, 5, 1),
});

inline constexpr auto kSpeedSetRows = section("預存速度表", kMemory, {
    reg(0x20A0, "Parms_mRPM{}", s32, RW).means("speed of speed set {}", "預存速度表組 {}").range(kS32Min, kS32Max).in("mRPM").persists().times(16, 2, 1),
});

inline constexpr auto kIncrementalBySetRows = section("預存位置表相關運動指令(增量位置移動)", kMotion, {
    reg(0x2100, "ALL_ParmsMove_INC",     u16, W).means("starts an incremental move of all axes, using the position set with this number", "所有軸使用寫入的預存位置表號碼開始增量位置移動").range(0, 16).triggers<start_incremental_by_set>(kAllAxes),
    reg(0x2101, "Aaxis_ParmsMove_INC",   u16, W).means("starts an incremental move of axis A, using the position set with this number", "A 軸使用寫入的預存位置表號碼開始增量位置移動").range(0, 16).triggers<start_incremental_by_set>(kAxisA),
    reg(0x2102, "Baxis_ParmsMove_INC",   u16, W).means("starts an incremental move of axis B, using the position set with this number", "B 軸使用寫入的預存位置表號碼開始增量位置移動").range(0, 16).triggers<start_incremental_by_set>(kAxisB),
});

inline constexpr auto kVelocityBySetRows = section("預存速度表相關運動指令", kMotion, {
    reg(0x2103, "ALL_ParmsDirectmRPM",   u16, W).means("runs all axes, using the speed set with this number", "所有軸使用寫入的預存速度號碼開始運動").range(0, 16).triggers<run_velocity_by_set>(kAllAxes),
    reg(0x2104, "Aaxis_ParmsDirectmRPM", u16, W).means("runs axis A, using the speed set with this number", "A 軸使用寫入的預存速度號碼開始運動").range(0, 16).triggers<run_velocity_by_set>(kAxisA),
    reg(0x2105, "Baxis_ParmsDirectmRPM", u16, W).means("runs axis B, using the speed set with this number", "B 軸使用寫入的預存速度號碼開始運動").range(0, 16).triggers<run_velocity_by_set>(kAxisB),
});

inline constexpr auto kAbsoluteBySetRows = section("預存位置表相關運動指令(絕對位置移動)", kMotion, {
    reg(0x2106, "ALL_ParmsMove_ABS",     u16, W).means("starts an absolute move of all axes, using the position set with this number", "所有軸使用寫入的預存位置表號碼開始絕對位置移動").range(0, 16).triggers<start_absolute_by_set>(kAllAxes),
    reg(0x2107, "Aaxis_ParmsMove_ABS",   u16, W).means("starts an absolute move of axis A, using the position set with this number", "A 軸使用寫入的預存位置表號碼開始絕對位置移動").range(0, 16).triggers<start_absolute_by_set>(kAxisA),
    reg(0x2108, "Baxis_ParmsMove_ABS",   u16, W).means("starts an absolute move of axis B, using the position set with this number", "B 軸使用寫入的預存位置表號碼開始絕對位置移動").range(0, 16).triggers<start_absolute_by_set>(kAxisB),
});

// A program cell is sent as 16 bits but contains 8 bits.
inline constexpr auto kProgramRows = section("程式控制", kProgram, {
    reg(0x3000, "PROG_MAIN_RunTime_START",  u16, W).means("starts the program at this line", "主程式由哪一行執行").range(0, 255).in("line").does<start_program>(),
    reg(0x3001, "PROG_MAIN_RunTime_END",    u16, W).means("1 stops the program", "主程式強制停止").range(0, 1).triggers<stop_program>().may(kMotion),
    reg(0x3004, "PROG_MAIN_Erase_ALL",      u16, W).means("1 erases the program", "清除所有主程式").range(0, 1).triggers<erase_program>().may(kMemory),
    reg(0x3010, "PROG_MAIN_NowLine",        u16, R).means("line that the program is executing", "查詢主程式目前在第幾行").range(0, 255).in("line").reads<read_now_line, Varies::in_ticks>(),
    reg(0x3012, "PROG_MAIN_RunTime_Status", u16, R).means("1 while the program runs", "查詢主程式目前是否在執行中").range(0, 1).reads<read_program_runs, Varies::in_ticks>(),
    reg(0x4000, "MAIN_LINE{}_CMD",   u16, RW).means("program line {}: instruction", "主程式行 {} 指令").persists().holding_bits(0xFF).times(256, 4, 0).reads<read_cell, Varies::in_ticks>(0).does<write_cell>(0),
    reg(0x4001, "MAIN_LINE{}_DATA1", u16, RW).means("program line {}: first operand", "主程式行 {} 資料 1").persists().holding_bits(0xFF).times(256, 4, 0).reads<read_cell, Varies::in_ticks>(1).does<write_cell>(1),
    reg(0x4002, "MAIN_LINE{}_DATA2", u16, RW).means("program line {}: second operand", "主程式行 {} 資料 2").persists().holding_bits(0xFF).times(256, 4, 0).reads<read_cell, Varies::in_ticks>(2).does<write_cell>(2),
    reg(0x4003, "MAIN_LINE{}_JMP",   u16, RW).means("program line {}: flag that jumps refer to", "主程式行 {} 旗標").persists().holding_bits(0xFF).times(256, 4, 0).reads<read_cell, Varies::in_ticks>(3).does<write_cell>(3),
    reg(0x8000, "PROG_MEM{}", s32, RW).means("program variable MEM {}, persistent", "記憶表行 {}").persists().times(32, 2, 0).halves("_RegL", "_RegH").may(kMemory),
    reg(0x8100, "PROG_VAR{}", s32, RW).means("program variable VAR {}", "變數表行 {}").times(32, 2, 0).halves("_RegL", "_RegH").may(kValue),
});

// The manual prints EncSync up to 2^16, which does not fit in 16 bits. It prints 0xF02A with the name of
// 0xF029.
inline constexpr auto kSystemRows = section("系統參數相關", kMemory, {
    reg(0xF000, "Aaxis_Home_Speed",    u16, RW).means("homing speed of axis A", "最大回原點 A 軸速度").also("Axis_Home_Speed").range(0, k2To15).in("RPM").persists(),
    reg(0xF001, "Baxis_Home_Speed",    u16, RW).means("homing speed of axis B", "最大回原點 B 軸速度").range(0, k2To15).in("RPM").persists(),
    reg(0xF002, "Aaxis_Resoultion",    u32, RW).means("pulses of axis A per revolution", "A 軸一圈脈衝").also("Axis_Resoultion").range(1, k2To31).in("Pulse").from_factory(3200).persists().does<change_speed>(kAxisA).may(kMemory | kMotion),
    reg(0xF004, "Baxis_Resoultion",    u32, RW).means("pulses of axis B per revolution", "B 軸一圈脈衝").range(1, k2To31).in("Pulse").from_factory(3200).persists().does<change_speed>(kAxisB).may(kMemory | kMotion),
    reg(0xF006, "Aaxis_DirectmRPM",    s32, RW).means("speed of axis A in velocity mode; a write enters this mode", "A 軸速度模式下輸出速度").range(kS32Min, kS32Max).in("mRPM").does<command_velocity>(kAxisA).may(kMotion),
    reg(0xF008, "Baxis_DirectmRPM",    s32, RW).means("speed of axis B in velocity mode; a write enters this mode", "B 軸速度模式下輸出速度").range(kS32Min, kS32Max).in("mRPM").does<command_velocity>(kAxisB).may(kMotion),
    reg(0xF010, "Aaxis_Home_AccTime",  u16, RW).means("homing acceleration and deceleration time of axis A", "A 軸回原點加減速時間").also("Axis_Home_AccTime").range(0, 3000).in("10ms").persists(),
    reg(0xF011, "Baxis_Home_AccTime",  u16, RW).means("homing acceleration and deceleration time of axis B", "B 軸回原點加減速時間").range(0, 3000).in("10ms").persists(),
    reg(0xF012, "Aaxis_SVON_Polarity", u16, RW).means("polarity of the servo-on output of axis A: 1 means that the output conducts while the servo is on", "A 軸伺服啟動 SVON 輸出極性").range(0, 1).from_factory(1).persists().may(kMemory | kOutput | kMotion),
    reg(0xF013, "Baxis_SVON_Polarity", u16, RW).means("polarity of the servo-on output of axis B: 1 means that the output conducts while the servo is on", "B 軸伺服啟動 SVON 輸出極性").range(0, 1).from_factory(1).persists().may(kMemory | kOutput | kMotion),
    reg(0xF014, "Aaxis_ALM_Polarity",  u16, RW).means("polarity of the alarm input of axis A: 0 means that the input conducts during an alarm", "A 軸警報 ALM 輸入極性").range(0, 1).persists().may(kMemory | kMotion),
    reg(0xF015, "Baxis_ALM_Polarity",  u16, RW).means("polarity of the alarm input of axis B: 0 means that the input conducts during an alarm", "B 軸警報 ALM 輸入極性").range(0, 1).persists().may(kMemory | kMotion),
    reg(0xF016, "Aaxis_DIR_Polarity",  u16, RW).means("1 reverses the direction output of axis A", "A 軸運動方向腳 DIR 極性").range(0, 1).persists().may(kMemory | kMotion),
    reg(0xF017, "Baxis_DIR_Polarity",  u16, RW).means("1 reverses the direction output of axis B", "B 軸運動方向腳 DIR 極性").range(0, 1).persists().may(kMemory | kMotion),
    reg(0xF018, "Axis_ENC_Polarity",   u16, RW).means("1 reverses the counting direction of encoder A", "A 軸編碼信號 AB 相序").also("Aaxis_ENC_Polarity").range(0, 1).persists().may(kMemory | kMotion),
    reg(0xF019, "Baxis_ENC_Polarity",  u16, RW).means("1 reverses the counting direction of encoder B", "B 軸編碼信號 AB 相序").range(0, 1).persists().may(kMemory | kMotion),
    reg(0xF01A, "Axis_GoHome_DIR",     u16, RW).means("direction in which axis A first searches for home: 1 positive", "A 軸回原點方向").also("Aaxis_GoHome_DIR").range(0, 1).persists(),
    reg(0xF01B, "Baxis_GoHome_DIR",    u16, RW).means("direction in which axis B first searches for home: 1 positive", "B 軸回原點方向").range(0, 1).persists(),
    reg(0xF01C, "Axis_VelMode_ACC",    u16, RW).means("acceleration of axis A in velocity mode", "A 軸速度模式速度漸變加速度").also("Aaxis_VelMode_ACC").range(1, k2To15).in("2mRPM/s").from_factory(1000).persists(),
    reg(0xF01D, "Baxis_VelMode_ACC",   u16, RW).means("acceleration of axis B in velocity mode", "B 軸速度模式速度漸變加速度").range(1, k2To15).in("2mRPM/s").from_factory(1000).persists(),
    reg(0xF01E, "AutoStart_MainProg",  u16, RW).means("1: the program starts at power-up", "開機後自動執行主程式").range(0, 1).persists().may(kProgram),
    reg(0xF020, "Axis_EncSync_NUM",    u16, RW).means("encoder following of axis A: numerator of the ratio", "A 軸編碼器同步比例分子").also("Aaxis_EncSync_NUM").range(0, 65535).from_factory(1).persists().does<change_sync>(kAxisA).may(kMemory | kMotion),
    reg(0xF021, "Axis_EncSync_DEN",    u16, RW).means("encoder following of axis A: denominator of the ratio", "A 軸編碼器同步比例分母").also("Aaxis_EncSync_DEN").range(1, 65535).from_factory(1).persists().does<change_sync>(kAxisA).may(kMemory | kMotion),
    reg(0xF022, "Baxis_EncSync_NUM",   u16, RW).means("encoder following of axis B: numerator of the ratio", "B 軸編碼器同步比例分子").range(0, 65535).from_factory(1).persists().does<change_sync>(kAxisB).may(kMemory | kMotion),
    reg(0xF023, "Baxis_EncSync_DEN",   u16, RW).means("encoder following of axis B: denominator of the ratio", "B 軸編碼器同步比例分母").range(1, 65535).from_factory(1).persists().does<change_sync>(kAxisB).may(kMemory | kMotion),
    reg(0xF024, "ALL_SyncMode",        u16, W).means("1: both axes follow their encoders", "AB 軸皆執行編碼器同步模式").range(0, 1).triggers<command_following>(kAllAxes).may(kMotion),
    reg(0xF025, "Aaxis_SyncMode",      u16, W).means("1: axis A follows its encoder", "執行 A 軸編碼器同步模式").range(0, 1).triggers<command_following>(kAxisA).may(kMotion),
    reg(0xF026, "Baxis_SyncMode",      u16, W).means("1: axis B follows its encoder", "執行 B 軸編碼器同步模式").range(0, 1).triggers<command_following>(kAxisB).may(kMotion),
    reg(0xF027, "Axis_SyncSlope",      u16, RW).means("encoder following of axis A: slope; 0 is unlimited", "A 軸編碼器同步斜率").also("Aaxis_SyncSlope").range(0, 255).persists().does<change_sync>(kAxisA).may(kMemory | kMotion),
    reg(0xF028, "Baxis_SyncSlope",     u16, RW).means("encoder following of axis B: slope; 0 is unlimited", "B 軸編碼器同步斜率").range(0, 255).persists().does<change_sync>(kAxisB).may(kMemory | kMotion),
    reg(0xF029, "Axis_SyncRPM",        u16, RW).means("encoder following of axis A: maximum speed", "A 軸編碼器同步最高轉速").also("Aaxis_SyncRPM").range(1, 3000).in("RPM").from_factory(3000).persists().does<change_sync>(kAxisA).may(kMemory | kMotion),
    reg(0xF02A, "Baxis_SyncRPM",       u16, RW).means("encoder following of axis B: maximum speed", "B 軸編碼器同步最高轉速").range(1, 3000).in("RPM").from_factory(3000).persists().does<change_sync>(kAxisB).may(kMemory | kMotion),
});

inline constexpr auto kApplicationRows = section("程式應用相關", kValue, {
    reg(0xF100, "CalcREG",        s32, RW).means("working register for calculations in programs", "計算暫存器"),
    reg(0xF122, "Counter1_Value", u16, RW).means("count of the program's counter 1", "1 號計數器目前值").range(0, 65535),
    reg(0xF123, "Counter2_Value", u16, RW).means("count of the program's counter 2", "2 號計數器目前值").range(0, 65535),
    reg(0xF126, "Timer1_Value",   u32, RW).means("time of the program's timer 1", "1 號計時器目前值").range(0, 4294967295).reads<read_timer, Varies::with_time>(0).changes_at<next_count_of_timer>().does<preset_timer>(0),
    reg(0xF128, "Timer2_Value",   u32, RW).means("time of the program's timer 2", "2 號計時器目前值").range(0, 4294967295).reads<read_timer, Varies::with_time>(1).changes_at<next_count_of_timer>().does<preset_timer>(1),
});

inline constexpr auto kFactoryRows = section("附錄 C", kMemory, {
    reg(0xFF00, "ADC_A",         u16, R).means("raw ADC value of analog input A", "類比輸入 A 原始值").reads<read_adc, Varies::in_ticks>(0),
    reg(0xFF01, "ADC_B",         u16, R).means("raw ADC value of analog input B", "類比輸入 B 原始值").reads<read_adc, Varies::in_ticks>(1),
    reg(0xFF02, "ADC_10V_A",     u16, RW).means("calibration of analog input A at 10 V", "類比輸入 A 在 10V 的校正值").from_factory(4000).persists(),
    reg(0xFF03, "ADC_10V_B",     u16, RW).means("calibration of analog input B at 10 V", "類比輸入 B 在 10V 的校正值").from_factory(4000).persists(),
    reg(0xFF04, "ADC_1V_A",      u16, RW).means("calibration of analog input A at 1 V", "類比輸入 A 在 1V 的校正值").from_factory(400).persists(),
    reg(0xFF05, "ADC_1V_B",      u16, RW).means("calibration of analog input B at 1 V", "類比輸入 B 在 1V 的校正值").from_factory(400).persists(),
    reg(0xFF06, "Factory_Reset", u16, W).means("1 restores all factory values except the calibration", "全部重置為出廠值").range(0, 1).triggers<reset_to_factory>().may(Hazards::all),
    reg(0xFF07, "PWD_Input",     u16, RW).means("password that unlocks the program", "程式碼解鎖密碼輸入").also("PWD_INPUT").range(0, 65535).does<enter_password>().since_firmware(151).may(kValue),
    reg(0xFF08, "PROG_UNLOCK",   u16, R).means("1: the program may be read", "程式碼是否可讀取").range(0, 1).from_factory(1).reads<read_unlocked, Varies::in_ticks>().since_firmware(151),
    reg(0xFF09, "NEW_PWD",       u16, RW).means("new password of the program", "程式碼新解鎖密碼輸入").range(0, 65535).reads<read_password, Varies::in_ticks>().does<change_password>().since_firmware(151),
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

/// Returns the image slot of a register. An unknown name is a compile error.
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
