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
    data(0, 499),
    data(500, 799).kept_at_once(),
    data(800, 999).kept_at_once(),  // recipe
    reg(kFirstTimerValue, "T{}", s32, RW).times(kTimers, 2, 0).in("ms").may(kPlc),
    reg(kFirstTimerValue + 2 * kTimers, "T{}", s32, RW).times(8, 2, kTimers).in("ms").kept_at_once().may(kPlc),
    reg(kFirstCounterValue, "C{}", s32, RW).times(16, 2, 0).in("count").may(kPlc),
    reg(kFirstCounterValue + 32, "C{}", s32, RW).times(16, 2, 16).in("count").kept_at_once().may(kPlc),
    reg(kFirstUserAddress, "USER{}", s32, RW).times(kUserRegisters, 2, 0),
});

inline constexpr auto kGeneralSpecialRows = section("D8 特殊暫存器的功用(一般用途)", kPlc, {
    data(8000).in("step").shows<read_pointer, Varies::in_ticks>().does<write_pointer>(0),  // C
    data(8001),
    data(8002).does<select_file_by_alias>().may(kProgram),
    data(d8::kVout1).range(0, 1000).does<limit_voltage>(0).may(Hazards::output),  // Vout1; 1000 are 3.3 V
    data(d8::kVout2).range(0, 1000).does<limit_voltage>(1).may(Hazards::output),  // Vout2
    data(d8::kFeedPercentage).range(0, 200).in("%").from_factory(100).does<change_override>(),
    data(d8::kFeed).in("0.001 mm/s"),  // current F
    data(d8::kPlane).range(0, 2),       // current plane
    data(8008),
    data(8009, 8018),
    data(8019).shows<read_table_line, Varies::in_ticks>().does<write_nothing>(),  // line of the user table
    data(d8::kUserCommand).range(0, 4).does<select_wheel_or_command>().may(kProgram),
    data(d8::kUserData1).range(0, 2).does<select_wheel>(),
    data(d8::kUserData2).range(0, 2).does<select_jog_speed>(),
    data(8023, 8029),
    data(8030, 8089),
    data(8090),
    data(8091, 8093, R).shows<read_analog, Varies::in_ticks>(),
    data(8094, R).shows<read_error, Varies::in_ticks>(0),
    data(8095, R).shows<read_error, Varies::in_ticks>(1),
    data(8096, R).shows<read_error, Varies::in_ticks>(2),
    data(8097, R).in("count").shows<read_receive_errors, Varies::in_ticks>(0),  // RS232
    data(8098, R).in("count").shows<read_receive_errors, Varies::in_ticks>(1),  // RS485
    data(8099, R).from_factory(100),
});

// D8x20 to D8x63 bear the names of the chip's registers: PRCMD, PRMV ... RCI.
inline constexpr auto kAxisSpecialRows = section("D8x 特殊暫存器的功用(XYZU 軸用)", kMotion, {
    axis_data(8100).in("step").shows<read_pointer, Varies::in_ticks>(1).does<write_pointer>(1),
    axis_data(8101, 8116, 0), axis_data(8101, 8116, 1), axis_data(8101, 8116, 2), axis_data(8101, 8116, 3),
    axis_data(8117).in("0.001 mm").shows<read_work_position, Varies::while_moving>().does<set_work_position>(),
    axis_data(d8x::kPlusLimitPort).range(0, 2).from_factory(1).does<change_axis>(),  // +EL setting in effect
    axis_data(d8x::kMinusLimitPort).range(0, 2).from_factory(1).does<change_axis>(),  // -EL setting in effect
    axis_data(d8x::kPrcmd),  // PRCMD
    axis_data(8121),  // PRMV
    axis_data(8122),  // PRFL
    axis_data(8123),  // PRFH
    axis_data(8124),  // PRUR
    axis_data(8125),  // PRDR
    axis_data(8126),  // PRMG
    axis_data(8127),  // PRDP
    axis_data(8128),  // PRMD
    axis_data(8129),  // PRIP
    axis_data(8130),  // PRUS
    axis_data(8131),  // PRDS
    axis_data(d8x::kRfa),  // RFA
    axis_data(8133).not_modelled("RENV1"),
    axis_data(8134).not_modelled("RENV2"),
    axis_data(8135).not_modelled("RENV3"),
    axis_data(8136).not_modelled("RENV4"),
    axis_data(8137).not_modelled("RENV5"),
    axis_data(8138).not_modelled("RENV6"),
    axis_data(8139).not_modelled("RENV7"),
    axis_data(8140).in("pulse").shows<read_counter, Varies::while_moving>(0).does<set_counter>(0),  // RCUN1
    axis_data(8141).in("pulse").shows<read_counter, Varies::while_moving>(1).does<set_counter>(1),  // RCUN2
    axis_data(8142).in("pulse").shows<read_counter, Varies::while_moving>(2).does<set_counter>(2),  // RCUN3
    axis_data(8143).in("pulse").shows<read_counter, Varies::while_moving>(3).does<set_counter>(3),  // RCUN4
    axis_data(d8x::kRcmp1).in("pulse").does<change_axis>(),  // RCMP1: +soft limit in effect
    axis_data(d8x::kRcmp2).in("pulse").does<change_axis>(),  // RCMP2: -soft limit in effect
    axis_data(d8x::kRcmp3).does<change_axis>(),              // RCMP3
    axis_data(d8x::kRcmp4).does<change_axis>(),              // RCMP4
    axis_data(d8x::kPrcmp5).does<change_axis>(),              // PRCMP5
    axis_data(8149).not_modelled("event interrupts (RIRQ)"),
    axis_data(d8x::kPrci),  // PRCI
    axis_data(d8x::kRmv),  // RMV
    axis_data(8152),  // RFL
    axis_data(8153),  // RFH
    axis_data(8154),  // RUR
    axis_data(8155),  // RDR
    axis_data(8156),  // RMG
    axis_data(8157),  // RDP
    axis_data(8158),  // RMD
    axis_data(8159),  // RIP
    axis_data(8160),  // RUS
    axis_data(8161),  // RDS
    axis_data(d8x::kRcmp5),  // RCMP5
    axis_data(d8x::kRci),  // RCI
    axis_data(8164, R).shows<read_operation, Varies::while_moving>(),  // CND
    axis_data(8165, R).in("pulse").shows<read_latch, Varies::in_ticks>(0),  // RLTC1
    axis_data(8166, R).in("pulse").shows<read_latch, Varies::in_ticks>(1),  // RLTC2
    axis_data(8167, R).in("pulse").shows<read_latch, Varies::in_ticks>(2),  // RLTC3
    axis_data(8168, R).in("pulse").shows<read_latch, Varies::in_ticks>(3),  // RLTC4
    axis_data(8169, R).in("pulse").shows<read_remainder, Varies::while_moving>(),       // RPLS
    axis_data(8170, R).shows<read_chip_speed, Varies::while_moving>(),                  // RSPD
    axis_data(8171, R).in("count").shows<read_index_count, Varies::in_ticks>(),     // EZ
    axis_data(8172, R).always(0),                                 // idle pulses
    axis_data(8173, R).in("pulse").shows<read_braking_distance, Varies::while_moving>(),  // RSDC
    axis_data(8174, R).always(0),                                 // RCIC
    axis_data(8175, R).always(0),                                 // RIPS
    axis_data(8176, 8199, 0), axis_data(8176, 8199, 1), axis_data(8176, 8199, 2), axis_data(8176, 8199, 3),
    data(8500, 8599),
});
// clang-format on

}  // namespace understudy::emulator::models::super_40nc
