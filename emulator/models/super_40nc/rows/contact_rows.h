// SUPER-40NC: inputs X and contacts Y, S, T, C, M, in the manual's order.
#pragma once

#include <cstdint>

#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/row_words.h"

namespace understudy::emulator::models::super_40nc {

inline constexpr int kInputCount = 48;
inline constexpr int kOutputCount = 32;
inline constexpr int kTimers = 56;  // those that are not latched; 8 others follow
// Addresses on the wire.
inline constexpr std::uint16_t kFirstTimerContact = 600;
inline constexpr std::uint16_t kFirstCounterContact = 800;

// clang-format off
inline constexpr auto kElementRows = section("接點元件編號一覽表", kPlc, {
    discrete(0, "X{}").times(kInputCount, 1, 0),
    coil(0, "Y{}").times(kOutputCount, 1, 0).may(Hazards::output),
    coil(200, "S{}").times(80, 1, 0),
    coil(280, "S{}").times(48, 1, 80).kept_at_once(),
    coil(kFirstTimerContact, "T{}").times(kTimers, 1, 0),
    coil(kFirstTimerContact + kTimers, "T{}").times(8, 1, kTimers).kept_at_once(),
    coil(kFirstCounterContact, "C{}").times(16, 1, 0),
    coil(kFirstCounterContact + 16, "C{}").times(16, 1, 16).kept_at_once(),
    relays(0, 399),
    relays(400, 511).kept_at_once(),
});

inline constexpr auto kGeneralContactRows = section("M8 特殊接點的功用(一般用途)", kPlc, {
    relay(m8::kStartOfC).does<write_command>(m8::kStartOfC),  // C: 1 START, 0 PAUSE
    relay(m8::kSingleStep).does<write_command>(m8::kSingleStep),  // C: single step
    relay(m8::kEmergencyStop).does<write_command>(m8::kEmergencyStop),  // emergency stop
    relay(8003, R).always(1),               // ON
    relay(m8::kMotionInhibit).does<write_command>(m8::kMotionInhibit),  // motion inhibited
    relay(m8::kMCodeFinished).does<write_command>(m8::kMCodeFinished),  // M code finished
    relay(m8::kPause).does<write_command>(m8::kPause),  // C: pause
    relay(8007),                            // C: single, continuous
    relay(m8::kFactoryParameters).does<write_command>(m8::kFactoryParameters).may(Hazards::all),  // D9 to factory values
    relays(8009, 8011),
    relays(8012, 8019),
    relays(8020, 8021),
    relay(8022).shows<read_pausing, Varies::in_ticks>().does<write_nothing>(),
    relay(8023).shows<read_file_changed, Varies::in_ticks>().does<write_nothing>(),
    relays(8024, 8099),
});

// The names of the chip's signals are the manual's (M8x20 SSCM to M8x58 PFM0).
inline constexpr auto kAxisContactRows = section("M8x 特殊接點的功用(XYZU 軸用)", kPlc, {
    axis_relay(m8x::kStart).does<write_command>(m8x::kStart),  // START, PAUSE
    axis_relay(m8x::kSingleStep).does<write_command>(m8x::kSingleStep),  // single step
    axis_relay(m8x::kReset).does<write_command>(m8x::kReset),  // RESET
    axis_relay(m8x::kJogPlus).does<write_command>(m8x::kJogPlus),  // +JOG
    axis_relay(m8x::kJogMinus).does<write_command>(m8x::kJogMinus),  // -JOG
    axis_relay(m8x::kHome).does<write_command>(m8x::kHome),  // HOME
    axis_relay(m8x::kZero).does<write_command>(m8x::kZero),  // ZERO
    axis_relay(m8x::kZeroSet).does<write_command>(m8x::kZeroSet),  // ZERO SET
    axis_relay(m8x::kMpg1).does<write_command>(m8x::kMpg1),  // MPG*1
    axis_relay(m8x::kMpg10).does<write_command>(m8x::kMpg10),  // MPG*10
    axis_relay(m8x::kMpg100).does<write_command>(m8x::kMpg100),  // MPG*100
    axis_relays(8111, 8119, 0), axis_relays(8111, 8119, 1), axis_relays(8111, 8119, 2), axis_relays(8111, 8119, 3),
    axis_relay(8120, R).shows<read_status, Varies::in_ticks>(SSCM),
    axis_relay(8121, R).shows<read_status, Varies::while_moving>(SRUN),
    axis_relay(8122, R).shows<read_status, Varies::in_ticks>(SENI),
    axis_relay(8123, R).from_factory(1).shows<read_status, Varies::in_ticks>(SEND),
    axis_relay(8124, R).shows<read_status, Varies::in_ticks>(SERR),
    axis_relay(8125, R).always(0),  // SINT
    axis_relay(8126, R).always(0),  // SSC0
    axis_relay(8127, R).always(0),  // SSC1
    axis_relay(8128, R).shows<read_status, Varies::while_moving>(SCP1),
    axis_relay(8129, R).shows<read_status, Varies::while_moving>(SCP2),
    axis_relay(8130, R).shows<read_status, Varies::while_moving>(SCP3),
    axis_relay(8131, R).shows<read_status, Varies::while_moving>(SCP4),
    axis_relay(8132, R).shows<read_status, Varies::while_moving>(SCP5),
    axis_relay(8133, R).always(0),  // SEOR
    axis_relay(8134, R).always(0),  // SPRF
    axis_relay(8135, R).always(0),  // SPDF
    axis_relay(8136, R).shows<read_status, Varies::while_moving>(SFU),
    axis_relay(8137, R).shows<read_status, Varies::while_moving>(SFD),
    axis_relay(8138, R).shows<read_status, Varies::while_moving>(SFC),
    axis_relay(8139, R).shows<read_status, Varies::in_ticks>(SALM),
    axis_relay(8140, R).shows<read_status, Varies::in_ticks>(SPEL),
    axis_relay(8141, R).shows<read_status, Varies::in_ticks>(SMEL),
    axis_relay(8142, R).shows<read_status, Varies::in_ticks>(SORG),
    axis_relay(8143, R).always(0),  // SSD
    axis_relay(8144, R).shows<read_status, Varies::while_moving>(SDIR),
    axis_relay(8145, R).always(0),  // SSTA
    axis_relay(8146, R).always(0),  // SSTP
    axis_relay(8147, R).shows<read_status, Varies::in_ticks>(SEMG),
    axis_relay(8148, R).always(0),  // SPCS
    axis_relay(8149, R).shows<read_status, Varies::in_ticks>(SERC),
    axis_relay(8150, R).shows<read_status, Varies::in_ticks>(SEZ),
    axis_relay(8151, R).always(0),  // SDRP
    axis_relay(8152, R).shows<read_status, Varies::in_ticks>(SCLR),
    axis_relay(8153, R).shows<read_status, Varies::in_ticks>(SLTC),
    axis_relay(8154, R).always(0),  // SDIN
    axis_relay(8155, R).shows<read_status, Varies::in_ticks>(SINP),
    axis_relay(8156, R).always(0),  // PFC0
    axis_relay(8157, R).always(0),  // PFC1
    axis_relay(8158, R).always(0),  // PFM0
    axis_relays(8159, 8191, 0), axis_relays(8159, 8191, 1), axis_relays(8159, 8191, 2), axis_relays(8159, 8191, 3),
    axis_relay(8192, R).shows<read_status, Varies::in_ticks>(SRDY),
    axis_relays(8193, 8194, 0), axis_relays(8193, 8194, 1), axis_relays(8193, 8194, 2), axis_relays(8193, 8194, 3),
    axis_relay(8195, R).shows<read_status, Varies::in_ticks>(HOME_DONE),
    axis_relay(8196, R).shows<read_status, Varies::in_ticks>(ZERO_DONE),
    axis_relay(8197, R).shows<read_status, Varies::in_ticks>(HOME_RUNS),
    axis_relay(8198, R).shows<read_status, Varies::in_ticks>(ZERO_RUNS),
    axis_relay(8199, R).shows<read_status, Varies::in_ticks>(WHEEL_RUNS),
});

inline constexpr auto kPanelContactRows = section("M85x 人機對應接點", kProgram, {
    relays(8500, 8501).does<write_command>(m85::kParameterPageLeft),
    relay(m85::kLogoOver),
    relays(8503, 8506),
    relay(m85::kEditPageEntered).does<write_command>(m85::kEditPageEntered),
    relays(8508, 8510).does<write_command>(8508),
    relays(8511, 8512),
    relays(8513, 8514).does<write_command>(8513),
    relays(8515, 8518),
    relays(8519, 8524).does<write_command>(8519),
    relays(8525, 8559),
    relays(8560, 8597).does<write_command>(8560),
    relays(8598, 8599),
});

inline constexpr auto kKeptPanelContactRows = section("M86x 人機對應接點", kPlc, {
    relay(8600).kept_at_once(),  // single, continuous
    relays(8601, 8699).kept_at_once(),
});
// clang-format on

}  // namespace understudy::emulator::models::super_40nc
