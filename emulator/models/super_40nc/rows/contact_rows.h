// SUPER-40NC: inputs X and contacts Y, S, T, C, M, in the manual's order.
#pragma once

#include <cstdint>

#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/panel_meanings.h"
#include "emulator/models/super_40nc/rows/row_words.h"

namespace understudy::emulator::models::super_40nc {

inline constexpr int kInputCount = 48;
inline constexpr int kOutputCount = 32;
inline constexpr int kTimers = 56;  // timers that are not latched; 8 latched ones follow
// Addresses on the wire.
inline constexpr std::uint16_t kFirstTimerContact = 600;
inline constexpr std::uint16_t kFirstCounterContact = 800;

// clang-format off
inline constexpr auto kElementRows = section("接點元件編號一覽表", kPlc, {
    discrete(0, "X{}").means("input {}", "輸入繼電器").times(kInputCount, 1, 0),
    coil(0, "Y{}").means("output {}", "輸出繼電器").times(kOutputCount, 1, 0).may(Hazards::output),
    coil(200, "S{}").means("step contact {}", "步進繼電器").times(80, 1, 0),
    coil(280, "S{}").means("step contact {}, persistent", "停電保持步進繼電器").times(48, 1, 80).persists_at_once(),
    coil(kFirstTimerContact, "T{}").means("contact of timer {}", "計時器").times(kTimers, 1, 0),
    coil(kFirstTimerContact + kTimers, "T{}").means("contact of timer {}, persistent", "計時器").times(8, 1, kTimers).persists_at_once(),
    coil(kFirstCounterContact, "C{}").means("contact of counter {}", "計數器").times(16, 1, 0),
    coil(kFirstCounterContact + 16, "C{}").means("contact of counter {}, persistent", "計數器").times(16, 1, 16).persists_at_once(),
    relays(0, 399).means("auxiliary contact", "一般輔助接點"),
    relays(400, 511).means("auxiliary contact, persistent", "停電保持輔助接點").persists_at_once(),
});

inline constexpr auto kGeneralContactRows = section("M8 特殊接點的功用(一般用途)", kPlc, {
    relay(m8::kStartOfC).means("1 starts the path program C, 0 pauses it", "1 起動/0 暫停運動路徑程式執行").does<write_command>(m8::kStartOfC),
    relay(m8::kSingleStep).means("path program C: stops after each motion", "單步模式").does<write_command>(m8::kSingleStep),
    relay(m8::kEmergencyStop).means("emergency stop of all motion", "緊急停止").does<write_command>(m8::kEmergencyStop),
    relay(8003, R).means("always 1", "Plc 常 on").always(1),
    relay(m8::kMotionInhibit).means("inhibits motion", "移行禁止").does<write_command>(m8::kMotionInhibit),
    relay(m8::kMCodeFinished).means("the M code is finished", "M CODE 完成命令").does<write_command>(m8::kMCodeFinished),
    relay(m8::kPause).means("pauses the path program C on its rising edge", "暫停路徑程式執行").does<write_command>(m8::kPause),
    relay(8007).means("path program C: 0 once, 1 repeatedly", "路徑程式 0 單動 1 連動"),
    relay(m8::kFactoryParameters).means("restores the factory values of D9", "復歸 D9 參數成出廠值").does<write_command>(m8::kFactoryParameters).may(Hazards::all),
    relays(8009, 8011).means("reserved", "保留"),
    relays(8012, 8019).means("no function in the manual, plain storage"),
    relays(8020, 8021).means("system message without a meaning in the manual", "系統訊息"),
    relay(8022).means("the path program pauses", "暫停中").shows<read_pausing, Varies::in_ticks>().does<write_nothing>(),
    relay(8023).means("on for one scan after another file has been selected", "檔案號碼改變").shows<read_file_changed, Varies::in_ticks>().does<write_nothing>(),
    relays(8024, 8099).means("reserved", "保留"),
});

inline constexpr auto kAxisContactRows = section("M8x 特殊接點的功用(XYZU 軸用)", kPlc, {
    axis_relay(m8x::kStart).means("1 starts the step program, 0 stops it", "1 起動/0 停止步階程式").does<write_command>(m8x::kStart),
    axis_relay(m8x::kSingleStep).means("step program: single steps", "單步模式命令").does<write_command>(m8x::kSingleStep),
    axis_relay(m8x::kReset).means("stops the axis and resets its step program", "重置步階程式").does<write_command>(m8x::kReset),
    axis_relay(m8x::kJogPlus).means("jogs in the positive direction while on", "+JOG").does<write_command>(m8x::kJogPlus),
    axis_relay(m8x::kJogMinus).means("jogs in the negative direction while on", "-JOG").does<write_command>(m8x::kJogMinus),
    axis_relay(m8x::kHome).means("starts homing on its rising edge", "HOME 起動找原點運動").does<write_command>(m8x::kHome),
    axis_relay(m8x::kZero).means("starts the return to zero on its rising edge", "ZERO 起動回零點運動").does<write_command>(m8x::kZero),
    axis_relay(m8x::kZeroSet).means("sets the present position to 0 on its rising edge", "ZERO SET 座標清除為 0").does<write_command>(m8x::kZeroSet),
    axis_relay(m8x::kMpg1).means("follows the hand wheel at the rate MPG*1 while on", "MPG*1 手搖輪跟隨運動").does<write_command>(m8x::kMpg1),
    axis_relay(m8x::kMpg10).means("follows the hand wheel at the rate MPG*10 while on", "MPG*10 手搖輪跟隨運動").does<write_command>(m8x::kMpg10),
    axis_relay(m8x::kMpg100).means("follows the hand wheel at the rate MPG*100 while on", "MPG*100 手搖輪跟隨運動").does<write_command>(m8x::kMpg100),
    axis_relays(8111, 8119, 0).means("reserved", "預留"), axis_relays(8111, 8119, 1).means("reserved", "預留"), axis_relays(8111, 8119, 2).means("reserved", "預留"), axis_relays(8111, 8119, 3).means("reserved", "預留"),
    axis_relay(8120, R).means("a command of the chip is in progress", "Ic 指令起動中 SSCM").shows<read_status, Varies::in_ticks>(SSCM),
    axis_relay(8121, R).means("pulses are being sent", "脈衝輸出中 SRUN").shows<read_status, Varies::while_moving>(SRUN),
    axis_relay(8122, R).means("the motion has stopped, interrupt", "運動停止 (中斷標示) SENI").shows<read_status, Varies::in_ticks>(SENI),
    axis_relay(8123, R).means("no command of the chip is in progress", "Ic 指令起動中的相反 SEND").from_factory(1).shows<read_status, Varies::in_ticks>(SEND),
    axis_relay(8124, R).means("error interrupt", "錯誤中斷 SERR").shows<read_status, Varies::in_ticks>(SERR),
    axis_relay(8125, R).means("event interrupt", "事件中斷 SINT").always(0),
    axis_relay(8126, R).means("sequence number, low bit", "執行或停止的序號 SSC0").always(0),
    axis_relay(8127, R).means("sequence number, high bit", "執行或停止的序號 SSC1").always(0),
    axis_relay(8128, R).means("condition of comparator 1 is met: positive soft limit", "比較器 1 條件滿足 SCP1(軟體正極限)").shows<read_status, Varies::while_moving>(SCP1),
    axis_relay(8129, R).means("condition of comparator 2 is met: negative soft limit", "比較器 2 條件滿足 SCP2(軟體負極限)").shows<read_status, Varies::while_moving>(SCP2),
    axis_relay(8130, R).means("condition of comparator 3 is met", "比較器 3 條件滿足 SCP3").shows<read_status, Varies::while_moving>(SCP3),
    axis_relay(8131, R).means("condition of comparator 4 is met", "比較器 4 條件滿足 SCP4").shows<read_status, Varies::while_moving>(SCP4),
    axis_relay(8132, R).means("condition of comparator 5 is met", "比較器 5 條件滿足 SCP5").shows<read_status, Varies::while_moving>(SCP5),
    axis_relay(8133, R).means("an override of the position has failed", "位置重設不成功 SEOR").always(0),
    axis_relay(8134, R).means("the preregister of operations is full", "預置數據暫存器已滿 SPRF").always(0),
    axis_relay(8135, R).means("the preregister of comparator 5 is full", "比較器 5 預置暫存器已滿 SPDF").always(0),
    axis_relay(8136, R).means("accelerates", "加速中 SFU").shows<read_status, Varies::while_moving>(SFU),
    axis_relay(8137, R).means("decelerates", "減速中 SFD").shows<read_status, Varies::while_moving>(SFD),
    axis_relay(8138, R).means("runs at its low speed", "低速中 SFC").shows<read_status, Varies::while_moving>(SFC),
    axis_relay(8139, R).means("alarm input is active", "ALM 有效 SALM").shows<read_status, Varies::in_ticks>(SALM),
    axis_relay(8140, R).means("positive limit switch is active", "+EL 有效 SPEL").shows<read_status, Varies::in_ticks>(SPEL),
    axis_relay(8141, R).means("negative limit switch is active", "-EL 有效 SMEL").shows<read_status, Varies::in_ticks>(SMEL),
    axis_relay(8142, R).means("origin switch (DOG) is active", "ORG 有效 SORG").shows<read_status, Varies::in_ticks>(SORG),
    axis_relay(8143, R).means("slow-down input SD is active, latched", "SD 有效 SSD").always(0),
    axis_relay(8144, R).means("direction: 0 positive, 1 negative", "運動方向：0 正/1 負 SDIR").shows<read_status, Varies::while_moving>(SDIR),
    axis_relay(8145, R).means("input CSTA is active", "當 CSTA 輸入有效時=1 SSTA").always(0),
    axis_relay(8146, R).means("input CSTP is active", "當 CSTP 輸入有效時=1 SSTP").always(0),
    axis_relay(8147, R).means("input CEMG is active: emergency stop", "當 CEMG 輸入有效時=1 SEMG").shows<read_status, Varies::in_ticks>(SEMG),
    axis_relay(8148, R).means("input PCS is active", "當 PCS 輸入有效時=1 SPCS").always(0),
    axis_relay(8149, R).means("signal ERC is active", "當 ERC 輸入有效時=1 SERC").shows<read_status, Varies::in_ticks>(SERC),
    axis_relay(8150, R).means("index pulse EZ of the encoder is active", "當 EZ 輸入有效時=1 SEZ").shows<read_status, Varies::in_ticks>(SEZ),
    axis_relay(8151, R).means("input +DR is active", "當 +DR 輸入有效時=1 SDRP").always(0),
    axis_relay(8152, R).means("input CLR is active", "當 CLR 輸入有效時=1 SCLR").shows<read_status, Varies::in_ticks>(SCLR),
    axis_relay(8153, R).means("input LTC is active: counters are latched", "當 LTC 輸入有效時=1 SLTC").shows<read_status, Varies::in_ticks>(SLTC),
    axis_relay(8154, R).means("input SD is active", "當 SD 輸入有效時=1 SDIN").always(0),
    axis_relay(8155, R).means("in-position input INP is active", "當 INP 輸入有效時=1 SINP").shows<read_status, Varies::in_ticks>(SINP),
    axis_relay(8156, R).means("state of the preregister of RCMP5, low bit", "監控預置 RCMP5 的狀態 PFC0").always(0),
    axis_relay(8157, R).means("state of the preregister of RCMP5, high bit", "監控預置 RCMP5 的狀態 PFC1").always(0),
    axis_relay(8158, R).means("state of the preregister of operations", "監控預置寄存器的狀態 PFM0").always(0),
    axis_relays(8159, 8191, 0).means("no function in the manual, plain storage"), axis_relays(8159, 8191, 1).means("no function in the manual, plain storage"), axis_relays(8159, 8191, 2).means("no function in the manual, plain storage"), axis_relays(8159, 8191, 3).means("no function in the manual, plain storage"),
    axis_relay(8192, R).means("ready input of the drive", "驅動器 READY 輸入狀態").shows<read_status, Varies::in_ticks>(SRDY),
    axis_relays(8193, 8194, 0).means("system message without a meaning in the manual", "系統訊息"), axis_relays(8193, 8194, 1).means("system message without a meaning in the manual", "系統訊息"), axis_relays(8193, 8194, 2).means("system message without a meaning in the manual", "系統訊息"), axis_relays(8193, 8194, 3).means("system message without a meaning in the manual", "系統訊息"),
    axis_relay(8195, R).means("the last homing has found home", "HOME 完成").shows<read_status, Varies::in_ticks>(HOME_DONE),
    axis_relay(8196, R).means("the last return to zero has reached zero", "ZERO 完成").shows<read_status, Varies::in_ticks>(ZERO_DONE),
    axis_relay(8197, R).means("homing is in progress", "由 M8x05 引起的找原點運動中").shows<read_status, Varies::in_ticks>(HOME_RUNS),
    axis_relay(8198, R).means("the return to zero is in progress", "由 M8x06 引起的回零點運動中").shows<read_status, Varies::in_ticks>(ZERO_RUNS),
    axis_relay(8199, R).means("follows the hand wheel", "手搖輪跟隨運動中").shows<read_status, Varies::in_ticks>(WHEEL_RUNS),
});

inline constexpr auto kPanelContactRows = section("M85x 人機對應接點", kProgram, {
    relays(8500, 8501).means_each(kPagesLeft).does<write_command>(m85::kParameterPageLeft),
    relay(m85::kLogoOver).means("the logo time is over", "LOGO 時間到會自動觸發"),
    relays(8503, 8506).means_each(kEditKeys),
    relay(m85::kEditPageEntered).means("the panel goes from the main page to the edit page", "主畫面到編輯頁需觸發").does<write_command>(m85::kEditPageEntered),
    relays(8508, 8510).means_each(kRunKeys).does<write_command>(8508),
    relays(8511, 8512).means_each(kHandKeys),
    relays(8513, 8514).means_each(kZeroKeys).does<write_command>(8513),
    relays(8515, 8518).means_each(kFileKeys),
    relays(8519, 8524).means("no function in the manual, plain storage").does<write_command>(8519),
    relays(8525, 8559).means("no function in the manual, plain storage"),
    relays(8560, 8597).means_each(kManualKeys).does<write_command>(8560),
    relays(8598, 8599).means("no function in the manual, plain storage"),
});

inline constexpr auto kKeptPanelContactRows = section("M86x 人機對應接點", kPlc, {
    relay(8600).means("key of the panel: once, or repeatedly", "單動/連動選擇鍵").persists_at_once(),
    relays(8601, 8699).means("no function in the manual, plain storage, persistent").persists_at_once(),
});
// clang-format on

}  // namespace understudy::emulator::models::super_40nc
