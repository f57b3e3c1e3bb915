// SUPER-40NC: parameters D9, in the manual's order. If the manual prints no range or factory value for a D9,
// the row has that of the panel's parameter (《基本參數說明》, 《X(Y/Z/U)軸參數說明》; parameters.h). No
// value is refused: a value outside its range is stored, and limited where it is used.
#pragma once

#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/row_words.h"

namespace understudy::emulator::models::super_40nc {

// clang-format off
inline constexpr auto kGeneralParameterRows = section("D9 參數暫存器的功用(一般用)", kMemory, {
    data(d9::kStation).kept_at_once().range(0, 15).may(kMemory | Hazards::stops_answering),  // station number
    data(d9::kFileNumber).kept_at_once().range(0, 29999).does<select_file>().may(kProgram),
    data(d9::kRecipeNumber).kept_at_once().range(0, 99).does<select_recipe>().may(kProgram),
    data(9003).kept_at_once().range(0, 4).in("axes").may(kMemory | kMotion),  // C21
    data(d9::kSystemSpeed).kept_at_once().range(1, 9999999).in("0.001 mm/s").from_factory(10000).may(kMemory | kMotion),  // C10
    data(d9::kContinuousPath).kept_at_once().range(0, 1).may(kMemory | kMotion),  // continuous path: a choice
    data(9006).kept_at_once().range(0, 1),  // C20
    data(d9::kLogoTime).kept_at_once().range(0, 10000).in("ms").from_factory(6000),  // C0
    data(9008, 9009).kept_at_once(),
    data(9010).kept_at_once().not_modelled("the panel's lines"),
    data(d9::kTargetSpeed).kept_at_once().range(1, 10000).in("RPM").from_factory(5000).may(kMemory | kMotion),  // C22
    data(d9::kSAcceleration).kept_at_once().range(1, 32767).in("multiplier pps").from_factory(1).may(kMemory | kMotion),  // C11
    data(d9::kSDeceleration).kept_at_once().range(1, 32767).in("multiplier pps").from_factory(1).may(kMemory | kMotion),  // C12
    data(d9::kAccelerationTime).kept_at_once().range(1, 10000).in("ms").from_factory(500).may(kMemory | kMotion),  // C13
    data(d9::kDecelerationTime).kept_at_once().range(1, 10000).in("ms").from_factory(500).may(kMemory | kMotion),  // C14
    data(d9::kArcPlane).kept_at_once().range(0, 2).from_factory(2).may(kMemory | kMotion),  // C23
    data(9017, 9019).kept_at_once().may(kMemory | Hazards::stops_answering),  // C24 to C26
    data(9020).kept_at_once(),
    data(d9::kEditLock).kept_at_once().not_modelled("the panel's edit page"),  // C15
    data(9022, 9024).kept_at_once(),
    data(d9::kKeyLock).kept_at_once().range(0, 111111),  // C16
    data(d9::kPassword).kept_at_once().from_factory(1234).not_modelled("the panel's password"),  // C3
    data(9027).kept_at_once(),
    data(d9::kFinishSignalTime).kept_at_once().range(0, 9999).in("ms"),  // C4
    data(d9::kEndSignalTime).kept_at_once().range(0, 9999).in("ms"),  // C5
    data(9030, 9034).kept_at_once(),
    data(9035, R).kept_at_once(),
    data(9036, R).kept_at_once().in("lines").from_factory(1000),  // PLC
    data(9037, R).kept_at_once().in("lines").from_factory(500),   // X
    data(9038, R).kept_at_once().in("lines").from_factory(500),   // Y
    data(9039, R).kept_at_once().in("lines").from_factory(500),   // Z
    data(9040, R).kept_at_once().in("lines").from_factory(500),   // U
    data(9041, R).kept_at_once().in("lines"),                     // GM
    data(9042, R).kept_at_once().in("lines").from_factory(1500),  // C
    data(9043, R).kept_at_once().in("files").from_factory(20),
    data(9044, R).kept_at_once().in("pages"),
    data(d9::kLinesOfAFile).kept_at_once().range(1, 30000).in("lines").from_factory(1500).does<lay_out_files>(),
    data(9046, 9099).kept_at_once(),
});

/// The chip's counters, among which D9x27 to D9x30 and D9x55 choose.
inline constexpr BitField kCounterBits[] = {bits(0, "C1"), bits(1, "C2"), bits(2, "C3"), bits(3, "C4")};
inline constexpr BitField kCountersButTheFirst[] = {bits(0, "C2"), bits(1, "C3"), bits(2, "C4")};

inline constexpr auto kAxisParameterRows = section("D9x 參數暫存器的功用(XYZU 軸用)", kMemory | kMotion, {
    parameter(d9x::kPulseMode).range(1, 7).from_factory(1),  // X0
    parameter(d9x::kOtStop).range(0, 1).does<change_axis>(d9x::kOtStop),
    parameter(d9x::kOrgLogic).range(0, 1).does<change_axis>(d9x::kOrgLogic),  // X32
    parameter(d9x::kAlmStop).range(0, 1).does<change_axis>(d9x::kAlmStop),
    parameter(d9x::kElAlmErc).range(0, 1).from_factory(1).not_modelled("ERC"),
    parameter(d9x::kHomeErc).range(0, 1).from_factory(1).not_modelled("ERC"),
    parameter(d9x::kErcSignal).range(0, 7).from_factory(4).not_modelled("ERC"),
    parameter(7).range(0, 1).from_factory(1).not_modelled("there is no CSTA"),
    parameter(8).range(0, 1).from_factory(1).not_modelled("there is no CSTP"),
    parameter(d9x::kClrSignal).range(0, 3).not_modelled("there is no CLR").does<change_axis>(d9x::kClrSignal),
    parameter(10).range(0, 1).from_factory(1).not_modelled("there is no PCS"),
    parameter(11).range(0, 1).from_factory(1).not_modelled("the shape of pulses"),
    parameter(12).range(0, 3).not_modelled("an encoder gives counts"),
    parameter(d9x::kEncoderDirection).range(0, 1).does<change_axis>(d9x::kEncoderDirection),
    parameter(14).range(0, 1).from_factory(1).not_modelled("the edge of EZ"),
    parameter(d9x::kMpgMode).range(0, 3).from_factory(2).does<change_axis>(d9x::kMpgMode),  // X40
    parameter(d9x::kMpgDirection).range(0, 1).does<change_axis>(d9x::kMpgDirection),  // X41
    parameter(d9x::kPulseMask).range(0, 1),
    parameter(18).range(0, 1).not_modelled("synchronous starts"),
    parameter(d9x::kEncoderDisable).range(0, 1).does<change_axis>(d9x::kEncoderDisable),
    parameter(d9x::kMpgDisable).range(0, 1).does<change_axis>(d9x::kMpgDisable),
    parameter(d9x::kHomeMode).range(0, 12).from_factory(4),  // X20
    parameter(d9x::kCNumber).range(0, 15).in("count"),  // X31
    parameter(d9x::kC2Source).range(0, 2).does<change_axis>(d9x::kC2Source),
    parameter(d9x::kC3Source).range(0, 2).does<change_axis>(d9x::kC3Source),
    parameter(d9x::kC4Source).range(0, 3).does<change_axis>(d9x::kC4Source),
    parameter(d9x::kC4Enable).range(0, 1).does<change_axis>(d9x::kC4Enable),
    parameter(d9x::kClrResetC).range(0, 15).with_bits(kCounterBits).not_modelled("there is no CLR").does<change_axis>(d9x::kClrResetC),
    parameter(d9x::kHomeResetC).range(0, 15).with_bits(kCounterBits).from_factory(15),
    parameter(d9x::kCountCorrect).range(0, 15).with_bits(kCounterBits),
    parameter(d9x::kDisableC2ToC4).range(0, 7).with_bits(kCountersButTheFirst).does<change_axis>(d9x::kDisableC2ToC4),
    parameter(d9x::kCp1Source).range(0, 3).does<change_axis>(d9x::kCp1Source),
    parameter(d9x::kCp1Method).range(0, 6).from_factory(6).does<change_axis>(d9x::kCp1Method),  // X35
    parameter(d9x::kCp1Action).range(0, 3).from_factory(1).does<change_axis>(d9x::kCp1Action),  // X35
    parameter(34).range(0, 1).not_modelled("ring counters"),
    parameter(d9x::kCp2Source).range(0, 3).does<change_axis>(d9x::kCp2Source),
    parameter(d9x::kCp2Method).range(0, 6).from_factory(6).does<change_axis>(d9x::kCp2Method),  // X36
    parameter(d9x::kCp2Action).range(0, 3).from_factory(1).does<change_axis>(d9x::kCp2Action),  // X36
    parameter(38).range(0, 1).not_modelled("ring counters"),
    parameter(d9x::kCp3Source).range(0, 3).does<change_axis>(d9x::kCp3Source),
    parameter(d9x::kCp3Method).range(0, 5).does<change_axis>(d9x::kCp3Method),
    parameter(d9x::kCp3Action).range(0, 3).does<change_axis>(d9x::kCp3Action),
    parameter(42).range(0, 1).not_modelled("there is no IDX"),
    parameter(d9x::kCp4Source).range(0, 3).does<change_axis>(d9x::kCp4Source),
    parameter(d9x::kCp4Method).range(0, 10).does<change_axis>(d9x::kCp4Method),
    parameter(d9x::kCp4Action).range(0, 3).does<change_axis>(d9x::kCp4Action),
    parameter(d9x::kCp5Source).range(0, 5).does<change_axis>(d9x::kCp5Source),
    parameter(d9x::kCp5Method).range(0, 5).does<change_axis>(d9x::kCp5Method),
    parameter(d9x::kCp5Action).range(0, 3).does<change_axis>(d9x::kCp5Action),
    parameter(49).range(0, 7).in("pulse").not_modelled("idle pulses"),
    parameter(d9x::kLatchOfCounters).range(0, 3).from_factory(1).does<change_axis>(d9x::kLatchOfCounters),
    parameter(d9x::kC3LatchSpeed).range(0, 1).does<change_axis>(d9x::kC3LatchSpeed),
    parameter(d9x::kStopLatch).range(0, 1).does<change_axis>(d9x::kStopLatch),
    parameter(53).range(0, 11).not_modelled("synchronous starts"),
    parameter(54).range(0, 3).not_modelled("synchronous starts"),
    parameter(d9x::kLatchResetC).range(0, 15).with_bits(kCounterBits).does<change_axis>(d9x::kLatchResetC),
    parameter(d9x::kBacklash).range(0, 4095).in("pulse"),  // X1
    parameter(d9x::kCorrectMode).range(0, 2),
    parameter(58).range(0, 1).not_modelled("pulses of the wheel after a stop"),
    parameter(59).range(0, 2047).in("n/2048").not_modelled("X42 to X44 are the ratio"),
    parameter(60).range(0, 31).not_modelled("X42 to X44 are the ratio"),
    parameter(61).range(0, 65535).in("1.6 us").not_modelled("vibration suppression"),
    parameter(62).range(0, 65535).in("1.6 us").not_modelled("vibration suppression"),
    parameter(d9x::kPlusOtSignal).range(0, 2).from_factory(1).does<change_axis>(d9x::kPlusOtSignal),  // X33
    parameter(d9x::kMinusOtSignal).range(0, 2).from_factory(1).does<change_axis>(d9x::kMinusOtSignal),  // X34
    parameter(d9x::kDotPosition).range(0, 3).in("digits").from_factory(3).not_modelled("the panel's decimal point"),  // X61
    parameter(d9x::kAccelerationTime).range(1, 65535).in("ms").from_factory(500),  // X2
    parameter(d9x::kDecelerationTime).range(1, 65535).in("ms").from_factory(500),  // X3
    parameter(d9x::kSAcceleration).range(0, 32767).in("multiplier pps").from_factory(1),  // X4
    parameter(d9x::kSDeceleration).range(0, 32767).in("multiplier pps").from_factory(1),  // X5
    parameter(d9x::kPpr).range(200, 131072).in("pulse/rev").from_factory(4000),  // X6
    parameter(d9x::kCmx).range(1, 131072).from_factory(1).does<change_axis>(d9x::kCmx),  // X10
    parameter(d9x::kCdv).range(1, 131072).from_factory(1).does<change_axis>(d9x::kCdv),  // X11
    parameter(73).range(0, 1),  // X15
    parameter(d9x::kZeroSetEnable).range(0, 1),  // X60
    parameter(d9x::kMaxSpeed).range(1, 10000).in("RPM").from_factory(3000),  // X12
    parameter(d9x::kBiasSpeed).range(1, 10000).in("RPM").from_factory(1),  // X13
    parameter(d9x::kZeroSpeed).range(1, 10000).in("RPM").from_factory(500),  // X26
    parameter(d9x::kDefaultSpeed).range(1, 10000).in("RPM").from_factory(100),  // X14
    parameter(d9x::kHomeSpeed).range(1, 10000).in("RPM").from_factory(500),  // X21
    parameter(d9x::kCreepSpeed).range(1, 10000).in("RPM").from_factory(20),  // X22
    parameter(d9x::kHomeDirection).range(0, 1),  // X23
    parameter(d9x::kHomePosition).range(-9999999, 9999999).in("0.001 mm"),  // X24
    parameter(d9x::kHomeOffset).range(-9999999, 9999999).in("0.001 mm"),  // X30
    parameter(d9x::kZeroSequence).range(0, 4),  // X51
    parameter(d9x::kPlusSoftLimit).range(-9999999, 9999999).in("0.001 mm").from_factory(9999999).does<change_axis>(d9x::kPlusSoftLimit),  // X35
    parameter(d9x::kMinusSoftLimit).range(-9999999, 9999999).in("0.001 mm").from_factory(-9999999).does<change_axis>(d9x::kMinusSoftLimit),  // X36
    parameter(d9x::kMpg1Rate).range(0, 9999).from_factory(1).does<change_axis>(d9x::kMpg1Rate),  // X42
    parameter(d9x::kMpg10Rate).range(0, 9999).from_factory(10).does<change_axis>(d9x::kMpg10Rate),  // X43
    parameter(d9x::kMpg100Rate).range(0, 9999).from_factory(100).does<change_axis>(d9x::kMpg100Rate),  // X44
    parameter(d9x::kLowSpeedLength).range(-999999, 999999).in("0.001 mm"),  // X16
    parameter(d9x::kFinishSignalTime).range(0, 9999).in("ms"),  // X45
    parameter(d9x::kEndSignalTime).range(0, 9999).in("ms"),  // X46
    parameter(d9x::kMoveOff).range(0, 999).in("pulse").from_factory(5),  // X25
    parameter(d9x::kJogLow).range(1, 9999).in("RPM").from_factory(50),  // X53
    parameter(d9x::kJogMedium).range(1, 9999).in("RPM").from_factory(100),  // X54
    parameter(d9x::kJogHigh).range(1, 9999).in("RPM").from_factory(250),  // X55
    parameter(d9x::kJogDirection).range(0, 1),  // X52
    parameter(d9x::kKeyLock).range(0, 111111111),  // X56
    parameter(d9x::kHomeSequence).range(0, 4),  // X50
});
// clang-format on

}  // namespace understudy::emulator::models::super_40nc
