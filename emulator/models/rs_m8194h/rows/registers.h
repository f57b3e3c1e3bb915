// RS-M8194H: the four register tables, in the order of the manual's chapter 12, including the registers that
// the chapter omits (inputs 87, 92 to 96, bVAR, MD, U's signals). Addresses count from 0, as on the line.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/rs_m8194h/rows/views.h"

namespace understudy::emulator::models::rs_m8194h {

inline constexpr std::string_view kAxisNames[] = {"X", "Y", "Z", "U"};
inline constexpr std::string_view kFirstThreeAxes[] = {"X", "Y", "Z"};
inline constexpr std::string_view kLastAxis[] = {"U"};

inline constexpr Type u16 = Type::u16;
inline constexpr Type u32 = Type::u32;
inline constexpr Type s32 = Type::s32;
inline constexpr Type f32 = Type::f32;
inline constexpr Access R = Access::read;
inline constexpr Access W = Access::write;
inline constexpr Access RW = Access::read_write;

inline constexpr Value kMaxPosition = 2'000'000'000;
inline constexpr int kWindowWords = 101;
inline constexpr std::uint16_t kWindow = 8000;

// What writes can do. A macro can do everything that its commands can do.
inline constexpr Hazards kValue = Hazards::settings;
inline constexpr Hazards kMotion = Hazards::motion;
inline constexpr Hazards kMacro = Hazards::memory | Hazards::output | Hazards::motion;
inline constexpr Hazards kNetwork = Hazards::memory | Hazards::stops_answering;

/// Returns the rows, after setting their section.
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

inline constexpr BitField kDiAllBits[] = {
    bits(0, "DRIVING"), bits(1, "LIMIT+"), bits(2, "LIMIT-"), bits(3, "EMERGENCY"), bits(4, "ALARM"),
    bits(5, "HOME"),    bits(6, "NHOME"),  bits(7, "IN3"),    bits(8, "INPOS"),     bits(9, "INDEX")};
inline constexpr BitField kErrorBits[] = {
    bits(0, "SOFT_LIMIT+"), bits(1, "SOFT_LIMIT-"), bits(2, "LIMIT+"),
    bits(3, "LIMIT-"),      bits(4, "ALARM"),       bits(5, "EMERGENCY"),
    bits(7, "HOME"),        bits(8, "SOFT_STOP"),   bits(9, "SOFT_EMG")};
inline constexpr BitField kDiSignalBits[] = {bits(0, "NHOME"), bits(1, "HOME"), bits(2, "INDEX"),
                                             bits(3, "IN3"),   bits(4, "EXP+"), bits(5, "EXP-"),
                                             bits(6, "INP"),   bits(7, "ALARM")};
inline constexpr BitField kAxisMaskBits[] = {bits(0, "X"), bits(1, "Y"), bits(2, "Z"), bits(3, "U")};

constexpr RegisterRow with_names(RegisterRow row, std::span<const BitField> names) {
  row.fields = names;
  return row;
}

// clang-format off
inline constexpr auto kInputRows1 = section("12.1.1", {
    input(0,   "FRnet DO group {}", u16).means("outputs of FRnet group {}, one bit each", "讀取 FRnet DO 群組 {}").times(8, 1, 0).shows<do_word, Varies::in_ticks>(),
    input(8,   "FRnet DI group {}", u16).means("inputs of FRnet group {}, one bit each", "讀取 FRnet DI 群組 {}").times(8, 1, 8).shows<di_word, Varies::in_ticks>(),
});
inline constexpr auto kInputRows2 = section("12.1.2", {
    with_names(input(16, "DI_ALL {}", u16).means("inputs of axis {} at the motion chip, one bit each", "{} 軸的所有 DI 狀態").also("DI_ALL_{}").each(kAxisNames, 1).shows<di_all, Varies::in_ticks>(), kDiAllBits),
});
inline constexpr auto kInputRows3 = section("12.1.3", {
    with_names(input(20, "ERROR_CODE {}", u16).means("causes of the stop of axis {}, one bit each", "{} 軸錯誤碼").also("ERROR_CODE_{}").each(kAxisNames, 1).shows<error_code, Varies::in_ticks>(), kErrorBits),
    input(24,  "MP Call number", u16).means("number of the running macro program", "目前正在執行的巨集編號").also("MP_Call_number").shows<running_mp, Varies::in_ticks>(),
    input(25,  "EMERGENCY_STOP state", u16).means("1 after an emergency stop by command", "目前的緊急停止狀態").also("EMERGENCY_STOP").shows<emergency_state, Varies::in_ticks>(),
});
inline constexpr auto kInputRows4 = section("12.1.4", {
    input(26,  "Logic Position {}", s32).means("position of axis {} by the pulses sent", "{} 軸的邏輯位置(LP)").each(kAxisNames, 2).in("pulse").shows<logic_position, Varies::while_moving>(),
    input(34,  "Encoder Position {}", s32).means("position of axis {} by its encoder", "{} 軸的編碼器位置(EP)").each(kAxisNames, 2).in("pulse").shows<encoder_position, Varies::while_moving>(),
    input(42,  "Current velocity {}", s32).means("present speed of axis {}", "{} 軸的當前速度").each(kAxisNames, 2).in("PPS").shows<current_velocity, Varies::while_moving>(),
    input(50,  "Current acceleration {}", s32).means("present acceleration of axis {}", "{} 軸的當前加速度").each(kAxisNames, 2).in("PPS/s").shows<current_acceleration, Varies::while_moving>(),
});
inline constexpr auto kInputRows5 = section("12.1.5", {
    input(58,  "Stop Status {}", u16).means("1: axis {} is at rest", "{} 軸停止狀態").also("STOP_{}").each(kAxisNames, 1).shows<stop_status, Varies::in_ticks>(),
});
inline constexpr auto kInputRows6 = section("12.1.6", {
    input(62,  "Latch {}", s32).means("position of axis {} when it was latched", "{} 軸的位置栓鎖數值").also("LATCH_{}").each(kAxisNames, 2).in("pulse").shows<latch, Varies::in_ticks>(),
});
inline constexpr auto kInputRows7 = section("12.1.7", {
    input(70,  "ERROR_STATE", u16).means("1 after an error", "錯誤狀態").shows<error_state, Varies::in_ticks>(),
    input(71,  "FREE_BUFFER_SIZE", u16).means("free places in the command buffer", "指令緩衝區的剩餘空間").shows<free_blocks, Varies::in_ticks>(),
});
inline constexpr auto kInputRows8 = section("12.1.8", {
    input(72,  "RINT_STATE_ALL", u16).means("interrupts of the module, one bit each", "讀取 RINT 狀態").shows<rint_word, Varies::in_ticks>(),
    input(73,  "Line_Scan_Completed", u16).means("a line scan is complete", "RINT_STATE 的位元 0").shows<rint_bit, Varies::in_ticks>(0),
    input(74,  "MP_Completed", u16).means("a macro program has ended", "RINT_STATE 的位元 1").shows<rint_bit, Varies::in_ticks>(1),
    input(75,  "User-Defined_RINT", u16).means("interrupt that a macro has requested", "RINT_STATE 的位元 2").shows<rint_bit, Varies::in_ticks>(2),
    input(76,  "Continuous_Inp_Interrupt", u16).means("continuous interpolation needs more data", "RINT_STATE 的位元 3").shows<rint_bit, Varies::in_ticks>(3),
    input(79,  "Axes_Error", u16).means("an axis has an error", "RINT_STATE 的位元 6").shows<rint_bit, Varies::in_ticks>(6),
    input(80,  "Module_Error", u16).means("the module has an error", "RINT_STATE 的位元 7").shows<rint_bit, Varies::in_ticks>(7),
});
inline constexpr auto kInputRows9 = section("12.1.9", {
    input(81,  "i-8094H Module ID", u16).means("type of the module", "i-8094H 模組 ID").also("MODULE_ID").shows<module_id, Varies::in_ticks>(),
    input(82,  "RS-M8194H Firmware Version", u32).means("firmware version of the RS-M8194H", "RS-M8194H 韌體版本").also("RSM_FIRMWARE").shows<rsm_firmware, Varies::in_ticks>(),
    input(84,  "i-8094H Firmware Version", u32).means("firmware and board version of the i-8094H", "i-8094H 韌體版本").also("I8094H_FIRMWARE").shows<module_firmware, Varies::in_ticks>(),
});
inline constexpr auto kInputRows10 = section("4.14", {
    input(87,  "InterpolationRdyFlag", u16).means("1: the next interpolation command may be sent", "補間命令傳送允許旗標").shows<interpolation_ready, Varies::in_ticks>(),
});
inline constexpr auto kInputRows11 = section("12.1.10", {
    with_names(input(88, "DI_SIGNAL {}", u16).means("signals of axis {} at the daughter board, one bit each", "{} 軸的所有 DI 訊號").also("DI_SIGNAL_{}").each(kAxisNames, 1).shows<di_signal, Varies::in_ticks>(), kDiSignalBits),
});
inline constexpr auto kInputRows12 = section("4.8", {
    input(92,  "HOME_STATE {}", u16).means("homing state of axis {}", "{} 軸原點復歸狀態").also("HOME_STATE_{}").each(kAxisNames, 1).shows<home_state, Varies::in_ticks>(),
});
inline constexpr auto kInputRows13 = section("4.13", {
    with_names(input(96, "DRIVING_AXIS", u16).means("axes that are driving, one bit each", "正在驅動(移動)的軸號").shows<driving_axes, Varies::in_ticks>(), kAxisMaskBits),
});
inline constexpr auto kInputRows14 = section("12.1.12", {
    input(100, "RS-M8194H state", u16).means("state of the RS-M8194H: ready, or a macro is being downloaded", "RS-M8194H 目前的狀態").also("RSM_STATE").shows<rsm_state, Varies::in_ticks>(),
    input(101, "i-8094H state", u16).means("state of the i-8094H", "i-8094H 模組的當前狀態").also("I8094H_STATE").shows<module_state, Varies::in_ticks>(),
    input(102, "Illegal Modbus function", u16).means("why the last request was refused", "函式操作錯誤時的 Modbus 例外回應").also("IllegalFuncErr").shows<illegal_reason, Varies::in_ticks>(),
});
inline constexpr auto kInputRows15 = section("12.1.13", {
    input(110, "Download: MP number", u16).means("last macro download error: MP number", "巨集程序的下載錯誤訊息: MP 巨集程序編號").also("DOWNLOAD_MP").shows<download_field, Varies::in_ticks>(0),
    input(111, "Download: ISR number", u16).means("last macro download error: ISR number", "巨集程序的下載錯誤訊息: ISR 巨集程序編號").also("DOWNLOAD_ISR").shows<download_field, Varies::in_ticks>(1),
    input(112, "Download: command type", u16).means("last macro download error: code of the command", "巨集程序的下載錯誤訊息: 造成錯誤的指令代碼").also("DOWNLOAD_CMD").shows<download_field, Varies::in_ticks>(2),
    input(113, "Download: line number", u16).means("last macro download error: line", "巨集程序的下載錯誤訊息: 發生錯誤的指令行號").also("DOWNLOAD_LINE").shows<download_field, Varies::in_ticks>(3),
    input(114, "Download: error type", u16).means("last macro download error: kind of error", "巨集程序的下載錯誤訊息: 錯誤類型").also("DOWNLOAD_ERROR").shows<download_field, Varies::in_ticks>(4),
});
inline constexpr auto kInputRows16 = section("12.1.14", {
    input(115, "Execution: MP number", u16).means("last macro execution error: MP number", "巨集程序的執行錯誤訊息: MP 巨集程序編號").also("EXECUTION_MP").shows<execution_field, Varies::in_ticks>(0),
    input(116, "Execution: ISR number", u16).means("last macro execution error: ISR number", "巨集程序的執行錯誤訊息: ISR 巨集程序編號").also("EXECUTION_ISR").shows<execution_field, Varies::in_ticks>(1),
    input(117, "Execution: command type", u16).means("last macro execution error: code of the command", "巨集程序的執行錯誤訊息: 造成錯誤的指令代碼").also("EXECUTION_CMD").shows<execution_field, Varies::in_ticks>(2),
    input(118, "Execution: line number", u16).means("last macro execution error: line", "巨集程序的執行錯誤訊息: 發生錯誤的指令行號").also("EXECUTION_LINE").shows<execution_field, Varies::in_ticks>(3),
    input(119, "Execution: error type", u16).means("last macro execution error: kind of error", "巨集程序的執行錯誤訊息: 錯誤類型").also("EXECUTION_ERROR").shows<execution_field, Varies::in_ticks>(4),
});
inline constexpr auto kInputRows17 = section("12.1.15", {
    with_names(input(130, "INT factor 0 PULSE", u16).means("axes with this interrupt, one bit each: a pulse has risen", "控制脈波上升時").also("INT_PULSE").shows<factor_axes, Varies::in_ticks>(0), kAxisMaskBits),
    with_names(input(131, "INT factor 1 P>=C-", u16).means("axes with this interrupt, one bit each: the position has reached COMP-", "大於或等於比較器 COMP-").also("INT_P_GE_C-").shows<factor_axes, Varies::in_ticks>(1), kAxisMaskBits),
    with_names(input(132, "INT factor 2 P<C-", u16).means("axes with this interrupt, one bit each: the position is below COMP-", "小於比較器 COMP-").also("INT_P_LT_C-").shows<factor_axes, Varies::in_ticks>(2), kAxisMaskBits),
    with_names(input(133, "INT factor 3 P<C+", u16).means("axes with this interrupt, one bit each: the position is below COMP+", "小於比較器 COMP+").also("INT_P_LT_C+").shows<factor_axes, Varies::in_ticks>(3), kAxisMaskBits),
    with_names(input(134, "INT factor 4 P>=C+", u16).means("axes with this interrupt, one bit each: the position has reached COMP+", "P>=C+ 比較器 COMP+").also("INT_P_GE_C+").shows<factor_axes, Varies::in_ticks>(4), kAxisMaskBits),
    with_names(input(135, "INT factor 5 C-END", u16).means("axes with this interrupt, one bit each: the constant speed has ended", "等速度區段結束的時候").also("INT_C-END").shows<factor_axes, Varies::in_ticks>(5), kAxisMaskBits),
    with_names(input(136, "INT factor 6 C-STA", u16).means("axes with this interrupt, one bit each: the constant speed has begun", "等速度區段開始的時候").also("INT_C-STA").shows<factor_axes, Varies::in_ticks>(6), kAxisMaskBits),
    with_names(input(137, "INT factor 7 D-END", u16).means("axes with this interrupt, one bit each: the drive has ended", "驅動結束(移動完成)").also("INT_D-END").shows<factor_axes, Varies::in_ticks>(7), kAxisMaskBits),
    with_names(input(138, "INT factor 8 HMEND", u16).means("axes with this interrupt, one bit each: the homing has ended", "自動原點復歸動作中斷").also("INT_HMEND").shows<factor_axes, Varies::in_ticks>(8), kAxisMaskBits),
    with_names(input(139, "INT factor 9 SYNC", u16).means("axes with this interrupt, one bit each: a synchronous action has been triggered", "同步運動被觸發").also("INT_SYNC").shows<factor_axes, Varies::in_ticks>(9), kAxisMaskBits),
});
inline constexpr auto kInputRows18 = section("12.1.11", {
    input(160, "Absolute Logic Position {}", s32).means("absolute position of axis {} by the pulses sent", "{} 軸的絕對邏輯位置").each(kAxisNames, 2).in("pulse").shows<absolute_position, Varies::while_moving>(),
});

inline constexpr auto kHoldingRows1 = section("12.2.1", Hazards::output, {
    reg(0,    "FRnet DO group {}", u16, RW).means("outputs of FRnet group {}, one bit each", "設定/讀取 FRnet DO 群組 {}").times(8, 1, 0).shows<do_word, Varies::in_ticks>().does<write_do_word>(),
});
inline constexpr auto kHoldingRows2 = section("12.2.2", kMacro, {
    reg(8,    "CALL_MPn", u16, RW).means("calls the macro program with this number", "寫入巨集程序的編號").also("CALL_MP").range(1, 157).reads<call_register, Varies::in_ticks>().does<call_mp>(),
    reg(9,    "FRnet Event", u16, RW).means("1: FRnet inputs trigger macro programs", "FRnet 事件觸發").also("FRNET_EVENT").range(0, 1).persists_at_once().does<enable_triggers>(),
    reg(14,   "WORD Order", u16, RW).means("word order: 0 high word first, 1 low word first", "字組順序").also("WORD_ORDER").range(0, 1).may(kMotion),
});
inline constexpr auto kHoldingRows3 = section("12.2.3", kNetwork, {
    reg(20,   "Lock_IP{}", u16, RW).means("address {} of the only TCP client that has access", "鎖定 TCP Client IP").times(4, 1, 0),
    reg(24,   "UnLock_IP", u16, W).means("unlocks access for all TCP clients", "解開鎖定 TCP Client IP"),
    reg(25,   "RS-M8194H_IP{}", u16, RW).means("IP address, word {}", "設定 RS-M8194H IP").times(2, 1, 0),
    reg(27,   "RS-M8194H_Mask{}", u16, RW).means("network mask, word {}", "設定 RS-M8194H Mask").times(2, 1, 0),
    reg(29,   "RS-M8194H_Gateway{}", u16, RW).means("gateway, word {}", "設定 RS-M8194H Gateway").times(2, 1, 0),
});
inline constexpr auto kHoldingRows4 = section("12.2.4", kMotion, {
    reg(82,   "Absolute Position {}", s32, RW).means("absolute position of axis {}", "{} 軸的絕對位置").also("ABS_{}").each(kAxisNames, 2).in("pulse").range(-kMaxPosition, kMaxPosition).shows<absolute_position, Varies::while_moving>().does<queue_absolute_position>(),
    reg(90,   "Logic Position {}", s32, RW).means("position of axis {} by the pulses sent", "{} 軸的邏輯位置").also("LP_{}").each(kAxisNames, 2).in("pulse").range(-kMaxPosition, kMaxPosition).shows<logic_position, Varies::while_moving>().does<queue_logic_position>(),
    reg(98,   "Encoder Position {}", s32, RW).means("position of axis {} by its encoder", "{} 軸的編碼器位置").also("EP_{}").each(kAxisNames, 2).in("pulse").range(-kMaxPosition, kMaxPosition).shows<encoder_position, Varies::while_moving>().does<queue_encoder_position>(),
    reg(106,  "Current Velocity {}", s32, R).means("present speed of axis {}", "{} 軸目前的速度").also("CV_{}").each(kAxisNames, 2).in("PPS").shows<current_velocity, Varies::while_moving>(),
    reg(114,  "Current Acceleration {}", s32, R).means("present acceleration of axis {}", "{} 軸目前的加速度").also("CA_{}").each(kAxisNames, 2).in("PPS/s").shows<current_acceleration, Varies::while_moving>(),
});
inline constexpr auto kHoldingRows5 = section("3.18.1", kValue, {
    reg(128,  "bVAR{}", u16, RW).means("variable bVAR{} of macros, a byte", "位元組(Byte)變數 bVAR{}").times(128, 1, 0).holding_bits(0xFF),
});
inline constexpr auto kHoldingRows6 = section("12.2.5", kValue, {
    reg(300,  "VAR{}", s32, RW).means("variable VAR{} of macros", "VAR{} 的設定值").times(512, 2, 0),
});
inline constexpr auto kHoldingRows7 = section("3.19.1", Hazards::memory, {
    reg(3000, "MD{}", s32, RW).means("machine data MD{}, persistent", "機器資料 MD{}").times(1024, 2, 0).persists_at_once(),
    reg(5048, "MD{}", f32, RW).means("machine data MD{}, a real number, persistent", "機器資料 MD{}").times(1024, 2, 1024).persists_at_once(),
});
inline constexpr auto kHoldingRows8 = section("12.2.6", Hazards::all, {
    window<take_message>(kWindow, "Reg{}", kWindowWords).means("word {} of a command: its code, then its parameters", "Sub_Function 代碼定義").also("Sub_Function_Code"),
});

inline constexpr auto kCoilRows1 = section("12.4.1", Hazards::output, {
    coil(0,   "FRnet DO group 0 channel {}").means("output {} of FRnet group 0", "FRnet DO 群組 0 通道 {}").times(16, 1, 0).shows<do_bit, Varies::in_ticks>(0).does<write_do_bit>(0),
    coil(16,  "FRnet DO group 1 channel {}").means("output {} of FRnet group 1", "FRnet DO 群組 1 通道 {}").times(16, 1, 0).shows<do_bit, Varies::in_ticks>(1).does<write_do_bit>(1),
    coil(32,  "FRnet DO group 2 channel {}").means("output {} of FRnet group 2", "FRnet DO 群組 2 通道 {}").times(16, 1, 0).shows<do_bit, Varies::in_ticks>(2).does<write_do_bit>(2),
    coil(48,  "FRnet DO group 3 channel {}").means("output {} of FRnet group 3", "FRnet DO 群組 3 通道 {}").times(16, 1, 0).shows<do_bit, Varies::in_ticks>(3).does<write_do_bit>(3),
    coil(64,  "FRnet DO group 4 channel {}").means("output {} of FRnet group 4", "FRnet DO 群組 4 通道 {}").times(16, 1, 0).shows<do_bit, Varies::in_ticks>(4).does<write_do_bit>(4),
    coil(80,  "FRnet DO group 5 channel {}").means("output {} of FRnet group 5", "FRnet DO 群組 5 通道 {}").times(16, 1, 0).shows<do_bit, Varies::in_ticks>(5).does<write_do_bit>(5),
    coil(96,  "FRnet DO group 6 channel {}").means("output {} of FRnet group 6", "FRnet DO 群組 6 通道 {}").times(16, 1, 0).shows<do_bit, Varies::in_ticks>(6).does<write_do_bit>(6),
    coil(112, "FRnet DO group 7 channel {}").means("output {} of FRnet group 7", "FRnet DO 群組 7 通道 {}").times(16, 1, 0).shows<do_bit, Varies::in_ticks>(7).does<write_do_bit>(7),
});
inline constexpr auto kCoilRows2 = section("12.4.2", {
    coil(128, "Servo {}", R).means("1: the servo of axis {} is on", "{} 軸伺服啟動").each(kAxisNames, 1).shows<servo_is_on, Varies::in_ticks>(),
});

inline constexpr auto kDiscreteRows1 = section("12.5.1", {
    discrete(0,   "FRnet DI group 8 channel {}").means("input {} of FRnet group 8", "FRnet DI 群組 8 通道 {}").times(16, 1, 0).shows<di_bit, Varies::in_ticks>(8),
    discrete(16,  "FRnet DI group 9 channel {}").means("input {} of FRnet group 9", "FRnet DI 群組 9 通道 {}").times(16, 1, 0).shows<di_bit, Varies::in_ticks>(9),
    discrete(32,  "FRnet DI group 10 channel {}").means("input {} of FRnet group 10", "FRnet DI 群組 10 通道 {}").times(16, 1, 0).shows<di_bit, Varies::in_ticks>(10),
    discrete(48,  "FRnet DI group 11 channel {}").means("input {} of FRnet group 11", "FRnet DI 群組 11 通道 {}").times(16, 1, 0).shows<di_bit, Varies::in_ticks>(11),
    discrete(64,  "FRnet DI group 12 channel {}").means("input {} of FRnet group 12", "FRnet DI 群組 12 通道 {}").times(16, 1, 0).shows<di_bit, Varies::in_ticks>(12),
    discrete(80,  "FRnet DI group 13 channel {}").means("input {} of FRnet group 13", "FRnet DI 群組 13 通道 {}").times(16, 1, 0).shows<di_bit, Varies::in_ticks>(13),
    discrete(96,  "FRnet DI group 14 channel {}").means("input {} of FRnet group 14", "FRnet DI 群組 14 通道 {}").times(16, 1, 0).shows<di_bit, Varies::in_ticks>(14),
    discrete(112, "FRnet DI group 15 channel {}").means("input {} of FRnet group 15", "FRnet DI 群組 15 通道 {}").times(16, 1, 0).shows<di_bit, Varies::in_ticks>(15),
});
inline constexpr auto kDiscreteRows2 = section("12.5.2", {
    discrete(128, "{} DRIVING").means("axis {} is driving", "{} 軸的驅動狀態").each(kAxisNames, 16).shows<di_all_bit, Varies::in_ticks>(0),
    discrete(129, "{} LIMIT+").means("positive limit switch of axis {}", "{} 軸的正方向硬體極限狀態").each(kAxisNames, 16).shows<di_all_bit, Varies::in_ticks>(1),
    discrete(130, "{} LIMIT-").means("negative limit switch of axis {}", "{} 軸的反方向硬體極限狀態").each(kAxisNames, 16).shows<di_all_bit, Varies::in_ticks>(2),
    discrete(131, "{} EMERGENCY").means("emergency stop of axis {}", "{} 軸的緊急停止狀態").each(kAxisNames, 16).shows<di_all_bit, Varies::in_ticks>(3),
    discrete(132, "{} ALARM").means("alarm of axis {}", "{} 軸的 ALARM 狀態").each(kAxisNames, 16).shows<di_all_bit, Varies::in_ticks>(4),
    discrete(133, "{} HOME (IN1)").means("home switch of axis {}", "{} 軸的 HOME(IN1)狀態").each(kAxisNames, 16).shows<di_all_bit, Varies::in_ticks>(5),
    discrete(134, "{} NHOME (IN0)").means("near-home switch of axis {}", "{} 軸的 NHOME(IN0)狀態").each(kAxisNames, 16).shows<di_all_bit, Varies::in_ticks>(6),
    discrete(135, "{} IN3").means("input IN3 of axis {}", "{} 軸的 IN3 狀態").each(kAxisNames, 16).shows<di_all_bit, Varies::in_ticks>(7),
    discrete(136, "{} INPOS").means("in-position signal of axis {}", "{} 軸的 INPOS 狀態").each(kAxisNames, 16).shows<di_all_bit, Varies::in_ticks>(8),
    discrete(137, "{} INDEX (IN2)").means("index pulse of axis {}", "{} 軸的 Z 相(IN2)狀態").each(kAxisNames, 16).shows<di_all_bit, Varies::in_ticks>(9),
});
// The manual prints LIMIT+, LIMIT-, ALARM and EMERGENCY twice. These are the bits of the error code. Bit 9 of
// the error code is missing from the printed table of discrete inputs.
inline constexpr auto kDiscreteRows3 = section("12.5.3", {
    discrete(192, "{} SOFT LIMIT+").means("the positive soft limit has stopped axis {}", "{} 軸的正方向軟體極限被觸發").each(kAxisNames, 16).shows<error_bit, Varies::in_ticks>(0),
    discrete(193, "{} SOFT LIMIT-").means("the negative soft limit has stopped axis {}", "{} 軸的反方向軟體極限被觸發").each(kAxisNames, 16).shows<error_bit, Varies::in_ticks>(1),
    discrete(194, "{} LIMIT+ error").means("the positive limit switch has stopped axis {}", "{} 軸的正方向硬體極限被觸發").each(kAxisNames, 16).shows<error_bit, Varies::in_ticks>(2),
    discrete(195, "{} LIMIT- error").means("the negative limit switch has stopped axis {}", "{} 軸的反方向硬體極限被觸發").each(kAxisNames, 16).shows<error_bit, Varies::in_ticks>(3),
    discrete(196, "{} ALARM error").means("an alarm has stopped axis {}", "{} 軸的 ALARM 訊號觸發").each(kAxisNames, 16).shows<error_bit, Varies::in_ticks>(4),
    discrete(197, "{} EMERGENCY error").means("the emergency input has stopped axis {}", "{} 軸的緊急停止狀態被觸發").each(kAxisNames, 16).shows<error_bit, Varies::in_ticks>(5),
    discrete(198, "{} Reserved").means("reserved", "未定義").each(kAxisNames, 16).always(0),
    discrete(199, "{} HOME").means("axis {} has stopped at home or at the index pulse", "{} 軸到達 Z 相或 HOME 位置").each(kAxisNames, 16).shows<error_bit, Varies::in_ticks>(7),
    discrete(200, "{} Stop Command").means("a stop command has stopped axis {}", "{} 軸執行停止運動指令").each(kAxisNames, 16).shows<error_bit, Varies::in_ticks>(8),
    discrete(201, "{} SOFT EMG").means("an emergency stop by command has stopped axis {}", "{} 軸停止原因: 軟體緊急停止").each(kAxisNames, 16).shows<error_bit, Varies::in_ticks>(9),
});
// The manual prints U's bits at 380, whereas the pattern of the other axes suggests 280; they are at both
// addresses. The argument distinguishes them: from 8 on it means 280, and from 16 on 380.
inline constexpr auto kDiscreteRows4 = section("12.5.4", {
    discrete(256, "{} Near Home (IN0)").means("near-home switch of axis {}", "{} 軸的 NHOME(IN0)訊號狀態").each(kFirstThreeAxes, 8).shows<di_signal_bit, Varies::in_ticks>(0),
    discrete(257, "{} Home (IN1)").means("home switch of axis {}", "{} 軸的 HOME(IN1)訊號狀態").each(kFirstThreeAxes, 8).shows<di_signal_bit, Varies::in_ticks>(1),
    discrete(258, "{} Index (IN2)").means("index pulse of axis {}", "{} 軸的編碼器索引(IN2)訊號狀態").each(kFirstThreeAxes, 8).shows<di_signal_bit, Varies::in_ticks>(2),
    discrete(259, "{} IN3 signal").means("input IN3 of axis {}", "{} 軸的 IN3 訊號狀態").each(kFirstThreeAxes, 8).shows<di_signal_bit, Varies::in_ticks>(3),
    discrete(260, "{} MPG+ (EXP+)").means("positive hand-wheel input of axis {}", "{} 軸的 EXP+ 訊號狀態").each(kFirstThreeAxes, 8).shows<di_signal_bit, Varies::in_ticks>(4),
    discrete(261, "{} MPG- (EXP-)").means("negative hand-wheel input of axis {}", "{} 軸的 EXP- 訊號狀態").each(kFirstThreeAxes, 8).shows<di_signal_bit, Varies::in_ticks>(5),
    discrete(262, "{} InPos").means("in-position signal of axis {}", "{} 軸的 INP 訊號狀態").each(kFirstThreeAxes, 8).shows<di_signal_bit, Varies::in_ticks>(6),
    discrete(263, "{} Alarm").means("alarm input of axis {}", "{} 軸的 ALARM 訊號狀態").each(kFirstThreeAxes, 8).shows<di_signal_bit, Varies::in_ticks>(7),
    discrete(280, "{} Near Home (IN0) at 280").means("near-home switch of axis {}", "{} 軸的 NHOME(IN0)訊號狀態").each(kLastAxis, 8, 3).shows<di_signal_bit, Varies::in_ticks>(8+0),
    discrete(281, "{} Home (IN1) at 281").means("home switch of axis {}", "{} 軸的 HOME(IN1)訊號狀態").each(kLastAxis, 8, 3).shows<di_signal_bit, Varies::in_ticks>(8+1),
    discrete(282, "{} Index (IN2) at 282").means("index pulse of axis {}", "{} 軸的編碼器索引(IN2)訊號狀態").each(kLastAxis, 8, 3).shows<di_signal_bit, Varies::in_ticks>(8+2),
    discrete(283, "{} IN3 signal at 283").means("input IN3 of axis {}", "{} 軸的 IN3 訊號狀態").each(kLastAxis, 8, 3).shows<di_signal_bit, Varies::in_ticks>(8+3),
    discrete(284, "{} MPG+ (EXP+) at 284").means("positive hand-wheel input of axis {}", "{} 軸的 EXP+ 訊號狀態").each(kLastAxis, 8, 3).shows<di_signal_bit, Varies::in_ticks>(8+4),
    discrete(285, "{} MPG- (EXP-) at 285").means("negative hand-wheel input of axis {}", "{} 軸的 EXP- 訊號狀態").each(kLastAxis, 8, 3).shows<di_signal_bit, Varies::in_ticks>(8+5),
    discrete(286, "{} InPos at 286").means("in-position signal of axis {}", "{} 軸的 INP 訊號狀態").each(kLastAxis, 8, 3).shows<di_signal_bit, Varies::in_ticks>(8+6),
    discrete(287, "{} Alarm at 287").means("alarm input of axis {}", "{} 軸的 ALARM 訊號狀態").each(kLastAxis, 8, 3).shows<di_signal_bit, Varies::in_ticks>(8+7),
    discrete(380, "{} Near Home (IN0)").means("near-home switch of axis {}", "{} 軸的 NHOME(IN0)訊號狀態").each(kLastAxis, 8, 3).shows<di_signal_bit, Varies::in_ticks>(16+0),
    discrete(381, "{} Home (IN1)").means("home switch of axis {}", "{} 軸的 HOME(IN1)訊號狀態").each(kLastAxis, 8, 3).shows<di_signal_bit, Varies::in_ticks>(16+1),
    discrete(382, "{} Index (IN2)").means("index pulse of axis {}", "{} 軸的編碼器索引(IN2)訊號狀態").each(kLastAxis, 8, 3).shows<di_signal_bit, Varies::in_ticks>(16+2),
    discrete(383, "{} IN3 signal").means("input IN3 of axis {}", "{} 軸的 IN3 訊號狀態").each(kLastAxis, 8, 3).shows<di_signal_bit, Varies::in_ticks>(16+3),
    discrete(384, "{} MPG+ (EXP+)").means("positive hand-wheel input of axis {}", "{} 軸的 EXP+ 訊號狀態").each(kLastAxis, 8, 3).shows<di_signal_bit, Varies::in_ticks>(16+4),
    discrete(385, "{} MPG- (EXP-)").means("negative hand-wheel input of axis {}", "{} 軸的 EXP- 訊號狀態").each(kLastAxis, 8, 3).shows<di_signal_bit, Varies::in_ticks>(16+5),
    discrete(386, "{} InPos").means("in-position signal of axis {}", "{} 軸的 INP 訊號狀態").each(kLastAxis, 8, 3).shows<di_signal_bit, Varies::in_ticks>(16+6),
    discrete(387, "{} Alarm").means("alarm input of axis {}", "{} 軸的 ALARM 訊號狀態").each(kLastAxis, 8, 3).shows<di_signal_bit, Varies::in_ticks>(16+7),
});
// clang-format on

inline constexpr auto kRegisters =
    join(kInputRows1, kInputRows2, kInputRows3, kInputRows4, kInputRows5, kInputRows6, kInputRows7,
         kInputRows8, kInputRows9, kInputRows10, kInputRows11, kInputRows12, kInputRows13, kInputRows14,
         kInputRows15, kInputRows16, kInputRows17, kInputRows18, kHoldingRows1, kHoldingRows2, kHoldingRows3,
         kHoldingRows4, kHoldingRows5, kHoldingRows6, kHoldingRows7, kHoldingRows8, kCoilRows1, kCoilRows2,
         kDiscreteRows1, kDiscreteRows2, kDiscreteRows3, kDiscreteRows4);

static_assert(are_marked(kRegisters), "a register does not say what a write can do");

/// Return the number of slots in the image, and the first slot of a row.
consteval std::size_t slot_count() {
  std::size_t count = 0;
  for (const RegisterRow& row : kRegisters) count += row.is_view ? 0 : static_cast<std::size_t>(row.count);
  return count;
}
inline constexpr std::size_t kSlotCount = slot_count();

/// Returns the row with this name in the manual.
consteval const RegisterRow& row_called(Table table, std::string_view name) {
  for (const RegisterRow& row : kRegisters) {
    if (row.table == table && row.name == name) return row;
  }
  throw "no row has this name";
}

consteval std::size_t slot(std::string_view holding_name) {
  std::size_t next = 0;
  for (const RegisterRow& row : kRegisters) {
    if (row.is_view) continue;
    if (&row == &row_called(Table::holding, holding_name)) return next;
    next += static_cast<std::size_t>(row.count);
  }
  throw "no register is stored there";
}

/// Consecutive addresses: those of one row, or from one row to another.
struct Addresses {
  Table table;
  std::size_t first;
  std::size_t end;

  constexpr bool has(Table of, std::size_t address) const {
    return of == table && address >= first && address < end;
  }
};
consteval Addresses addresses_of(Table table, std::string_view first, std::string_view last) {
  const RegisterRow& row = row_called(table, last);
  const int words = is_32_bit(row.type) ? 2 : 1;
  return {.table = table,
          .first = row_called(table, first).address,
          .end = static_cast<std::size_t>(row.address + (row.count - 1) * row.stride + words)};
}
consteval Addresses addresses_of(Table table, std::string_view name) {
  return addresses_of(table, name, name);
}

inline constexpr std::size_t kCallMpSlot = slot("CALL_MPn");
inline constexpr std::size_t kEventSlot = slot("FRnet Event");
inline constexpr std::size_t kWordOrderSlot = slot("WORD Order");
inline constexpr std::size_t kFirstBvarSlot = slot("bVAR{}");
inline constexpr std::size_t kFirstVarSlot = slot("VAR{}");
inline constexpr std::size_t kFirstMdSlot = slot("MD{}");
inline constexpr std::size_t kCallMpAddress = row_called(Table::holding, "CALL_MPn").address;
inline constexpr Addresses kVarAddresses = addresses_of(Table::holding, "VAR{}");
/// The addresses to which writes go through the FIFO as commands.
inline constexpr Addresses kCounterAddresses =
    addresses_of(Table::holding, "Absolute Position {}", "Encoder Position {}");
inline constexpr Addresses kFrnetWords = addresses_of(Table::holding, "FRnet DO group {}");
inline constexpr Addresses kServoCoils = addresses_of(Table::coil, "Servo {}");

inline constexpr int kVars = 512;
inline constexpr int kBvars = 128;

}  // namespace understudy::emulator::models::rs_m8194h
