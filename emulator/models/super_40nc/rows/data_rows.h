// SUPER-40NC: data registers D, present values of T and C, and special registers D8, in the manual's order.
#pragma once

#include <cstdint>

#include "emulator/models/super_40nc/rows/contact_rows.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/row_words.h"

namespace understudy::emulator::models::super_40nc {

// Addresses on the wire.
inline constexpr std::uint16_t kFirstTimerValue = 2000;
inline constexpr std::uint16_t kFirstCounterValue = 2500;
// The buffer of user programs: 200 steps of 10 registers.
inline constexpr std::uint16_t kFirstUserAddress = 3000;
inline constexpr int kUserRegisters = 2000;

// clang-format off
inline constexpr auto kDataRows = section("暫存器元件編號一覽表", kValue, {
    data(0, 499).means("data register", "一般暫存器"),
    data(500, 799).means("data register, persistent", "停電保持暫存器").persists_at_once(),
    data(800, 999).means("data register of the recipe, persistent", "停電保持配方暫存器").persists_at_once(),
    reg(kFirstTimerValue, "T{}", s32, RW).means("present time of timer {}", "計時暫存器").times(kTimers, 2, 0).in("ms").may(kPlc),
    reg(kFirstTimerValue + 2 * kTimers, "T{}", s32, RW).means("present time of timer {}, persistent", "停電保持計時暫存器").times(8, 2, kTimers).in("ms").persists_at_once().may(kPlc),
    reg(kFirstCounterValue, "C{}", s32, RW).means("present count of counter {}", "計數暫存器").times(16, 2, 0).in("count").may(kPlc),
    reg(kFirstCounterValue + 32, "C{}", s32, RW).means("present count of counter {}, persistent", "停電保持計數暫存器").times(16, 2, 16).in("count").persists_at_once().may(kPlc),
    reg(kFirstUserAddress, "USER{}", s32, RW).means("user program buffer, 10 words per step", "USER 程式執行緩衝區").times(kUserRegisters, 2, 0),
});

inline constexpr auto kGeneralSpecialRows = section("D8 特殊暫存器的功用(一般用途)", kPlc, {
    data(8000).means("next step of the path program C", "目前預備執行的程式序號").in("step").shows<read_pointer, Varies::in_ticks>().does<write_pointer>(0),
    data(8001).means("no function in the manual, plain storage"),
    data(8002).means("selects the file of the path program").does<select_file_by_alias>().may(kProgram),
    data(d8::kVout1).means("analog output Vout1; 1000 is 3.3 V", "Vout1 輸出 port").range(0, 1000).does<limit_voltage>(0).may(Hazards::output),
    data(d8::kVout2).means("analog output Vout2; 1000 is 3.3 V", "Vout2 輸出 port").range(0, 1000).does<limit_voltage>(1).may(Hazards::output),
    data(d8::kFeedPercentage).means("feed override", "程式進給速率百分比").range(0, 200).in("%").from_factory(100).does<change_override>(),
    data(d8::kFeed).means("feed rate, written by the instruction F", "程式進給速率暫存器").in("0.001 mm/s"),
    data(d8::kPlane).means("plane of arcs: 0 XY, 1 XZ, 2 YZ", "程式作弧平面暫存器").range(0, 2),
    data(8008).means("no function in the manual, plain storage"),
    data(8009, 8018).means("no function in the manual, plain storage"),
    data(8019).means("line of the user table that is being executed", "User Table 程式目前執行的行號").shows<read_table_line, Varies::in_ticks>().does<write_nothing>(),
    data(d8::kUserCommand).means("user command, or the hand wheel's axis", "User Command").range(0, 4).does<select_wheel_or_command>().may(kProgram),
    data(d8::kUserData1).means("data 1 of the user command, or the hand wheel's rate", "User Data1").range(0, 2).does<select_wheel>(),
    data(d8::kUserData2).means("data 2 of the user command, or the jog speed", "User Data2").range(0, 2).does<select_jog_speed>(),
    data(8023, 8029).means("data of the user command", "User Data3 ~ User Data9"),
    data(8030, 8089).means("no function in the manual, plain storage"),
    data(8090).means("no function in the manual, plain storage"),
    data(8091, 8093, R).means("potentiometer VR1 to VR3, 0 to 1023", "VR1 ~ VR3 目前輸入值").shows<read_analog, Varies::in_ticks>(),
    data(8094, R).means("error code", "異常碼").shows<read_error, Varies::in_ticks>(0),
    data(8095, R).means("step with the error", "錯誤的步序").shows<read_error, Varies::in_ticks>(1),
    data(8096, R).means("step with a label that appears twice", "重覆 LAB 的步序").shows<read_error, Varies::in_ticks>(2),
    data(8097, R).means("receive errors of RS232", "RS232 接收錯誤的次數").in("count").shows<read_receive_errors, Varies::in_ticks>(0),
    data(8098, R).means("receive errors of RS485", "RS485 接收錯誤的次數").in("count").shows<read_receive_errors, Varies::in_ticks>(1),
    data(8099, R).means("firmware version", "監督程式版本").from_factory(100),
});

// D8x20 to D8x63 are named after the chip's registers: PRCMD, PRMV ... RCI.
inline constexpr auto kAxisSpecialRows = section("D8x 特殊暫存器的功用(XYZU 軸用)", kMotion, {
    axis_data(8100).means("next step of the step program", "目前預備執行的程式序號").in("step").shows<read_pointer, Varies::in_ticks>(1).does<write_pointer>(1),
    axis_data(8101, 8116, 0).means("reserved", "保留"), axis_data(8101, 8116, 1).means("reserved", "保留"), axis_data(8101, 8116, 2).means("reserved", "保留"), axis_data(8101, 8116, 3).means("reserved", "保留"),
    axis_data(8117).means("present position in work coordinates", "現在位置").in("0.001 mm").shows<read_work_position, Varies::while_moving>().does<set_work_position>(),
    axis_data(d8x::kPlusLimitPort).means("positive limit switch in effect: 0 none, 1 NO, 2 NC", "正極限控制 port").range(0, 2).from_factory(1).does<change_axis>(),
    axis_data(d8x::kMinusLimitPort).means("negative limit switch in effect: 0 none, 1 NO, 2 NC", "負極限控制 port").range(0, 2).from_factory(1).does<change_axis>(),
    axis_data(d8x::kPrcmd).means("chip register PRCMD: command of the next operation", "系統暫存器 PRCMD"),
    axis_data(8121).means("chip register PRMV: target of the next operation", "系統暫存器 PRMV"),
    axis_data(8122).means("chip register PRFL: start speed of the next operation", "系統暫存器 PRFL"),
    axis_data(8123).means("chip register PRFH: speed of the next operation", "系統暫存器 PRFH"),
    axis_data(8124).means("chip register PRUR: acceleration rate of the next operation", "系統暫存器 PRUR"),
    axis_data(8125).means("chip register PRDR: deceleration rate of the next operation", "系統暫存器 PRDR"),
    axis_data(8126).means("chip register PRMG: speed multiplier of the next operation", "系統暫存器 PRMG"),
    axis_data(8127).means("chip register PRDP: slow-down point of the next operation", "系統暫存器 PRDP"),
    axis_data(8128).means("chip register PRMD: mode of the next operation", "系統暫存器 PRMD"),
    axis_data(8129).means("chip register PRIP: centre of the next arc, or main axis", "系統暫存器 PRIP"),
    axis_data(8130).means("chip register PRUS: S-curve of the next acceleration", "系統暫存器 PRUS"),
    axis_data(8131).means("chip register PRDS: S-curve of the next deceleration", "系統暫存器 PRDS"),
    axis_data(d8x::kRfa).means("chip register RFA: speed of corrections", "系統暫存器 RFA"),
    axis_data(8133).means("chip register RENV1: environment 1", "系統暫存器 RENV1").not_modelled("RENV1"),
    axis_data(8134).means("chip register RENV2: environment 2", "系統暫存器 RENV2").not_modelled("RENV2"),
    axis_data(8135).means("chip register RENV3: environment 3", "系統暫存器 RENV3").not_modelled("RENV3"),
    axis_data(8136).means("chip register RENV4: environment 4", "系統暫存器 RENV4").not_modelled("RENV4"),
    axis_data(8137).means("chip register RENV5: environment 5", "系統暫存器 RENV5").not_modelled("RENV5"),
    axis_data(8138).means("chip register RENV6: environment 6", "系統暫存器 RENV6").not_modelled("RENV6"),
    axis_data(8139).means("chip register RENV7: environment 7", "系統暫存器 RENV7").not_modelled("RENV7"),
    axis_data(8140).means("chip register RCUN1: counter 1, pulses sent", "系統暫存器 RCUN1").in("pulse").shows<read_counter, Varies::while_moving>(0).does<set_counter>(0),
    axis_data(8141).means("chip register RCUN2: counter 2, encoder", "系統暫存器 RCUN2").in("pulse").shows<read_counter, Varies::while_moving>(1).does<set_counter>(1),
    axis_data(8142).means("chip register RCUN3: counter 3, deviation", "系統暫存器 RCUN3").in("pulse").shows<read_counter, Varies::while_moving>(2).does<set_counter>(2),
    axis_data(8143).means("chip register RCUN4: counter 4, free use", "系統暫存器 RCUN4").in("pulse").shows<read_counter, Varies::while_moving>(3).does<set_counter>(3),
    axis_data(d8x::kRcmp1).means("chip register RCMP1: comparator 1: positive soft limit in effect", "系統暫存器 RCMP1").in("pulse").does<change_axis>(),
    axis_data(d8x::kRcmp2).means("chip register RCMP2: comparator 2: negative soft limit in effect", "系統暫存器 RCMP2").in("pulse").does<change_axis>(),
    axis_data(d8x::kRcmp3).means("chip register RCMP3: comparator 3", "系統暫存器 RCMP3").does<change_axis>(),
    axis_data(d8x::kRcmp4).means("chip register RCMP4: comparator 4", "系統暫存器 RCMP4").does<change_axis>(),
    axis_data(d8x::kPrcmp5).means("chip register PRCMP5: comparator 5, preregister", "系統暫存器 PRCMP5").does<change_axis>(),
    axis_data(8149).means("chip register RIRQ: event interrupts", "系統暫存器 RIRQ").not_modelled("event interrupts (RIRQ)"),
    axis_data(d8x::kPrci).means("chip register PRCI: steps of the next arc", "系統暫存器 PRCI"),
    axis_data(d8x::kRmv).means("chip register RMV: target of the present operation", "系統暫存器 RMV"),
    axis_data(8152).means("chip register RFL: start speed of the present operation", "系統暫存器 RFL"),
    axis_data(8153).means("chip register RFH: speed of the present operation", "系統暫存器 RFH"),
    axis_data(8154).means("chip register RUR: acceleration rate of the present operation", "系統暫存器 RUR"),
    axis_data(8155).means("chip register RDR: deceleration rate of the present operation", "系統暫存器 RDR"),
    axis_data(8156).means("chip register RMG: speed multiplier of the present operation", "系統暫存器 RMG"),
    axis_data(8157).means("chip register RDP: slow-down point of the present operation", "系統暫存器 RDP"),
    axis_data(8158).means("chip register RMD: mode of the present operation", "系統暫存器 RMD"),
    axis_data(8159).means("chip register RIP: centre of the present arc, or main axis", "系統暫存器 RIP"),
    axis_data(8160).means("chip register RUS: S-curve of the present acceleration", "系統暫存器 RUS"),
    axis_data(8161).means("chip register RDS: S-curve of the present deceleration", "系統暫存器 RDS"),
    axis_data(d8x::kRcmp5).means("chip register RCMP5: comparator 5", "系統暫存器 RCMP5"),
    axis_data(d8x::kRci).means("chip register RCI: steps of the present arc", "系統暫存器 RCI"),
    axis_data(8164, R).means("state of the operation, 0 to 15: 0 stopped, 11 accelerating, 12 at speed, 13 decelerating, 14 waits for INP", "操作狀態報告").shows<read_operation, Varies::while_moving>(),
    axis_data(8165, R).means("latched value of counter 1", "COUNTER 鎖存數據 RLTC1").in("pulse").shows<read_latch, Varies::in_ticks>(0),
    axis_data(8166, R).means("latched value of counter 2", "COUNTER 鎖存數據 RLTC2").in("pulse").shows<read_latch, Varies::in_ticks>(1),
    axis_data(8167, R).means("latched value of counter 3", "COUNTER 鎖存數據 RLTC3").in("pulse").shows<read_latch, Varies::in_ticks>(2),
    axis_data(8168, R).means("latched value of counter 4", "COUNTER 鎖存數據 RLTC4").in("pulse").shows<read_latch, Varies::in_ticks>(3),
    axis_data(8169, R).means("remaining pulses of the move", "定位計數器剩餘值 RPLS").in("pulse").shows<read_remainder, Varies::while_moving>(),
    axis_data(8170, R).means("present speed, in the chip's unit", "當前速度").shows<read_chip_speed, Varies::while_moving>(),
    axis_data(8171, R).means("index pulses counted in homing", "回原點的 EZ 計數值").in("count").shows<read_index_count, Varies::in_ticks>(),
    axis_data(8172, R).means("idle pulses", "空轉計數值").always(0),
    axis_data(8173, R).means("slow-down point that the chip has computed", "自動計算減速點 RSDC").in("pulse").shows<read_braking_distance, Varies::while_moving>(),
    axis_data(8174, R).means("steps of arcs", "圓弧插補步數計數器 RCIC").always(0),
    axis_data(8175, R).means("interpolation state", "插補狀態 RIPS").always(0),
    axis_data(8176, 8199, 0).means("reserved", "保留"), axis_data(8176, 8199, 1).means("reserved", "保留"), axis_data(8176, 8199, 2).means("reserved", "保留"), axis_data(8176, 8199, 3).means("reserved", "保留"),
    data(8500, 8599).means("no function in the manual, plain storage"),
});
// clang-format on

}  // namespace understudy::emulator::models::super_40nc
