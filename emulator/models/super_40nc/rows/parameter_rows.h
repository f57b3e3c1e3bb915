// SUPER-40NC: parameters D9, in the manual's order. If the manual does not print a range or factory value for
// a D9, the row has those of the corresponding panel parameter (《基本參數說明》, 《X(Y/Z/U)軸參數說明》;
// parameters.h). No value is refused: a value outside its range is stored, and limited when it is used.
#pragma once

#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/row_words.h"

namespace understudy::emulator::models::super_40nc {

// clang-format off
inline constexpr Meaning kSwappedArcs[] = {  // D9017 to D9019
    {"swaps CW and CCW in XY", ""},
    {"swaps CW and CCW in XZ", ""},
    {"swaps CW and CCW in YZ", ""},
};
inline constexpr auto kGeneralParameterRows = section("D9 參數暫存器的功用(一般用)", kMemory, {
    data(d9::kStation).means("station number", "工作站號(Station)").persists_at_once().range(0, 15).may(kMemory | Hazards::stops_answering),
    data(d9::kFileNumber).means("file number of the path program", "運動路徑程式號碼選取(File number)").persists_at_once().range(0, 29999).does<select_file>().may(kProgram),
    data(d9::kRecipeNumber).means("file number of the recipe", "配方暫存器檔案號碼(D file num.)").persists_at_once().range(0, 99).does<select_recipe>().may(kProgram),
    data(9003).means("axes of the common coordinate system", "共用座標系軸數").persists_at_once().range(0, 4).in("axes").may(kMemory | kMotion),  // C21
    data(d9::kSystemSpeed).means("default feed", "預設速度(Sys. speed)").persists_at_once().range(1, 9999999).in("0.001 mm/s").from_factory(10000).may(kMemory | kMotion),  // C10
    data(d9::kContinuousPath).means("1: continuous path", "連續路徑(Cont. path)").persists_at_once().range(0, 1).may(kMemory | kMotion),
    data(9006).means("0 absolute, 1 relative", "系統初始為絕對座標或相對座標(Inc. or Abs.)").persists_at_once().range(0, 1),  // C20
    data(d9::kLogoTime).means("logo time", "首頁商標畫面顯示時間(Logo time)").persists_at_once().range(0, 10000).in("ms").from_factory(6000),  // C0
    data(9008, 9009).means("no function in the manual, plain storage").persists_at_once(),
    data(9010).means("lines that the panel shows", "設定顯示行數").persists_at_once().not_modelled("the panel's lines"),
    data(d9::kTargetSpeed).means("speed that acceleration times refer to", "加速時間目標速度").persists_at_once().range(1, 10000).in("RPM").from_factory(5000).may(kMemory | kMotion),  // C22
    data(d9::kSAcceleration).means("S section of acceleration", "預設 S 曲線加速度").persists_at_once().range(1, 32767).in("multiplier pps").from_factory(1).may(kMemory | kMotion),  // C11
    data(d9::kSDeceleration).means("S section of deceleration", "預設 S 曲線減速度").persists_at_once().range(1, 32767).in("multiplier pps").from_factory(1).may(kMemory | kMotion),  // C12
    data(d9::kAccelerationTime).means("acceleration time", "預設加速時間").persists_at_once().range(1, 10000).in("ms").from_factory(500).may(kMemory | kMotion),  // C13
    data(d9::kDecelerationTime).means("deceleration time", "預設減速時間").persists_at_once().range(1, 10000).in("ms").from_factory(500).may(kMemory | kMotion),  // C14
    data(d9::kArcPlane).means("arc plane: 0 XY, 1 XZ, 2 YZ", "做圓平面").persists_at_once().range(0, 2).from_factory(2).may(kMemory | kMotion),  // C23
    data(9017, 9019).means_each(kSwappedArcs).persists_at_once().may(kMemory | kMotion),  // C24 to C26
    data(9020).means("no function in the manual, plain storage").persists_at_once(),
    data(d9::kEditLock).means("lock of the edit page", "編輯鍵上鎖").persists_at_once().not_modelled("the panel's edit page"),  // C15
    data(9022, 9024).means("no function in the manual, plain storage").persists_at_once(),
    data(d9::kKeyLock).means("lock of the main page", "按鍵上鎖(Key Lock)").persists_at_once().range(0, 111111),  // C16
    data(d9::kPassword).means("password", "密碼(Password)").persists_at_once().from_factory(1234).not_modelled("the panel's password"),  // C3
    data(9027).means("no function in the manual, plain storage").persists_at_once(),
    data(d9::kFinishSignalTime).means("duration of the finish signal Y8", "完成信號時間(Finish Signal Tmr.)").persists_at_once().range(0, 9999).in("ms"),  // C4
    data(d9::kEndSignalTime).means("duration of the end signal Y9", "結束信號時間(End Signal Timer)").persists_at_once().range(0, 9999).in("ms"),  // C5
    data(9030, 9034).means("no function in the manual, plain storage").persists_at_once(),
    data(9035, R).means("reserved", "僅讀保留").persists_at_once(),
    data(9036, R).means("lines of the PLC program", "PLC 程式行數").persists_at_once().in("lines").from_factory(1000),
    data(9037, R).means("lines of the program X", "XM 程式行數").persists_at_once().in("lines").from_factory(500),
    data(9038, R).means("lines of the program Y", "YM 程式行數").persists_at_once().in("lines").from_factory(500),
    data(9039, R).means("lines of the program Z", "ZM 程式行數").persists_at_once().in("lines").from_factory(500),
    data(9040, R).means("lines of the program U", "UM 程式行數").persists_at_once().in("lines").from_factory(500),
    data(9041, R).means("lines of the program GM", "GM 程式行數").persists_at_once().in("lines"),
    data(9042, R).means("lines of the path program C", "MC 程式行數").persists_at_once().in("lines").from_factory(1500),
    data(9043, R).means("number of files of path programs", "可使用的檔案數量").persists_at_once().in("files").from_factory(20),
    data(9044, R).means("pages of a file", "每檔案需要的頁數").persists_at_once().in("pages"),
    data(d9::kLinesOfAFile).means("lines of a file of path programs", "每個路徑程式佔用行數").persists_at_once().range(1, 30000).in("lines").from_factory(1500).does<lay_out_files>(),
    data(9046, 9099).means("no function in the manual, plain storage").persists_at_once(),
});

/// The chip's counters, from which D9x27 to D9x30 and D9x55 select.
inline constexpr BitField kCounterBits[] = {bits(0, "C1"), bits(1, "C2"), bits(2, "C3"), bits(3, "C4")};
inline constexpr BitField kCountersButTheFirst[] = {bits(0, "C2"), bits(1, "C3"), bits(2, "C4")};

inline constexpr auto kAxisParameterRows = section("D9x 參數暫存器的功用(XYZU 軸用)", kMemory | kMotion, {
    parameter(d9x::kPulseMode).means("direction of the motor", "馬達運轉方向(Pulse mode)").range(1, 7).from_factory(1),  // X0
    parameter(d9x::kOtStop).means("stop at EL: 0 at once, 1 slows down", "EL 有效時的停止方式(OT stop)").range(0, 1).does<change_axis>(d9x::kOtStop),
    parameter(d9x::kOrgLogic).means("DOG: 0 NO, 1 NC", "ORG 信號的輸入邏輯(ORG logic)").range(0, 1).does<change_axis>(d9x::kOrgLogic),  // X32
    parameter(d9x::kAlmStop).means("stop at an alarm: 0 at once, 1 slows down", "ALM 有效時的停止方式(ALM stop)").range(0, 1).does<change_axis>(d9x::kAlmStop),
    parameter(d9x::kElAlmErc).means("1: sends ERC at a stop by EL, ALM or CEMG", "自動輸出 ERC 信號(EL/ALM ERC)").range(0, 1).from_factory(1).not_modelled("ERC"),
    parameter(d9x::kHomeErc).means("1: sends ERC when home is found", "完成原點送 ERC(Home ERC)").range(0, 1).from_factory(1).not_modelled("ERC"),
    parameter(d9x::kErcSignal).means("output width of ERC", "ERC 的輸出寬度(ERC signal)").range(0, 7).from_factory(4).not_modelled("ERC"),
    parameter(7).means("CSTA: 0 level, 1 edge", "CSTA 為位準/邊緣觸發(CSTA signal)").range(0, 1).from_factory(1).not_modelled("there is no CSTA"),
    parameter(8).means("stop at CSTP: 0 at once, 1 slows down", "CSTP 有效時的停止方式(CSTP stop)").range(0, 1).from_factory(1).not_modelled("there is no CSTP"),
    parameter(d9x::kClrSignal).means("CLR clears: 0 and 1 at an edge, 2 and 3 at a level", "CLR 輸入信號模式(CLR signal)").range(0, 3).not_modelled("there is no CLR").does<change_axis>(d9x::kClrSignal),
    parameter(10).means("1: PCS acts as CSTA", "變更 PCS 為 CSTA(PCS->CSTA)").range(0, 1).from_factory(1).not_modelled("there is no PCS"),
    parameter(11).means("1: pulses have a duty cycle of 50 %", "脈沖寬度保持 50%佔空比(Pulse 50%)").range(0, 1).from_factory(1).not_modelled("the shape of pulses"),
    parameter(12).means("encoder: 0 AB x1, 1 AB x2, 2 AB x4, 3 up and down", "EA/EB 輸入模式(EA/EB signal)").range(0, 3).not_modelled("an encoder gives counts"),
    parameter(d9x::kEncoderDirection).means("1: encoder reversed", "轉換 EA/EB 輸入的計數方向(EA/EB dir.)").range(0, 1).does<change_axis>(d9x::kEncoderDirection),
    parameter(14).means("edge of EZ: 0 falling, 1 rising", "EZ 信號的輸入邏輯(EZ logic)").range(0, 1).from_factory(1).not_modelled("the edge of EZ"),
    parameter(d9x::kMpgMode).means("hand wheel: 0 AB x1, 1 AB x2, 2 AB x4, 3 up and down", "PA/PB 輸入模式(MPG MODE)").range(0, 3).from_factory(2).does<change_axis>(d9x::kMpgMode),  // X40
    parameter(d9x::kMpgDirection).means("1: hand wheel reversed", "轉換 PA/PB 輸入的計數方向(MPG dir.)").range(0, 1).does<change_axis>(d9x::kMpgDirection),  // X41
    parameter(d9x::kPulseMask).means("1: sends no pulses", "屏蔽脈沖輸出(Pulse mask)").range(0, 1),
    parameter(18).means("1: a stop of the axis triggers its next start", "致能同一軸的停止所觸發的啟動(Stop->start)").range(0, 1).not_modelled("synchronous starts"),
    parameter(d9x::kEncoderDisable).means("1: encoder disabled", "禁止 EA/EB 輸入(EA disable)").range(0, 1).does<change_axis>(d9x::kEncoderDisable),
    parameter(d9x::kMpgDisable).means("1: hand wheel disabled", "禁止 PA/PB 輸入(MPG disable)").range(0, 1).does<change_axis>(d9x::kMpgDisable),
    parameter(d9x::kHomeMode).means("home mode", "回原點方式(Home mode)").range(0, 12).from_factory(4),  // X20
    parameter(d9x::kCNumber).means("number of C signals minus 1", "回原點 C 的數量(C number)").range(0, 15).in("count"),  // X31
    parameter(d9x::kC2Source).means("counter 2 counts: 0 encoder, 1 pulses, 2 hand wheel", "COUNTER2 的來源(C2 source)").range(0, 2).does<change_axis>(d9x::kC2Source),
    parameter(d9x::kC3Source).means("counter 3 counts the deviation of: 0 pulses and encoder, 1 pulses and hand wheel, 2 encoder and hand wheel", "COUNTER3 偏差計數器的來源(C3 source)").range(0, 2).does<change_axis>(d9x::kC3Source),
    parameter(d9x::kC4Source).means("counter 4 counts: 0 pulses, 1 encoder, 2 hand wheel, 3 time", "COUNTER4 的來源(C4 source)").range(0, 3).does<change_axis>(d9x::kC4Source),
    parameter(d9x::kC4Enable).means("1: counter 4 counts only during an operation", "當 LSI 正在操作時只能操作計數器 4(C4 enable)").range(0, 1).does<change_axis>(d9x::kC4Enable),
    parameter(d9x::kClrResetC).means("counters that CLR clears", "CLR 有效時復位計數器(CLR reset C)").range(0, 15).with_bits(kCounterBits).not_modelled("there is no CLR").does<change_axis>(d9x::kClrResetC),
    parameter(d9x::kHomeResetC).means("counters that are cleared at home", "原點結束復位計數器(Home rst. C)").range(0, 15).with_bits(kCounterBits).from_factory(15),
    parameter(d9x::kCountCorrect).means("counters that count corrections", "間隙/打滑模式操作計數器(Cnt correct)").range(0, 15).with_bits(kCounterBits),
    parameter(d9x::kDisableC2ToC4).means("counters 2 to 4 that do not count", "停止計 2-計 4 的計數(Dis. C2-4)").range(0, 7).with_bits(kCountersButTheFirst).does<change_axis>(d9x::kDisableC2ToC4),
    parameter(d9x::kCp1Source).means("source of comparator 1: 0 to 3 select counters 1 to 4", "比較器 1 與誰比(CP1 source)").range(0, 3).does<change_axis>(d9x::kCp1Source),
    parameter(d9x::kCp1Method).means("method of comparator 1: 0 never, 1 =, 2 = upward, 3 = downward, 4 >, 5 <, 6 positive soft limit", "比較器 1 的比較方式(CP1 method)").range(0, 6).from_factory(6).does<change_axis>(d9x::kCp1Method),  // X35
    parameter(d9x::kCp1Action).means("action of comparator 1: 0 none, 1 stops at once, 2 slows down, 3 loads the preregister", "比較器 1 滿足時做(CP1 action)").range(0, 3).from_factory(1).does<change_axis>(d9x::kCp1Action),  // X35
    parameter(34).means("1: counter 1 is a ring, with comparator 1", "比較器 1 配合將計數器 1 用于循環計數用(CP1->rotary)").range(0, 1).not_modelled("ring counters"),
    parameter(d9x::kCp2Source).means("source of comparator 2: 0 to 3 select counters 1 to 4", "比較器 2 與誰比(CP2 source)").range(0, 3).does<change_axis>(d9x::kCp2Source),
    parameter(d9x::kCp2Method).means("method of comparator 2: 0 never, 1 =, 2 = upward, 3 = downward, 4 >, 5 <, 6 negative soft limit", "比較器 2 的比較方式(CP2 method)").range(0, 6).from_factory(6).does<change_axis>(d9x::kCp2Method),  // X36
    parameter(d9x::kCp2Action).means("action of comparator 2: 0 none, 1 stops at once, 2 slows down, 3 loads the preregister", "比較器 2 滿足時做(CP2 action)").range(0, 3).from_factory(1).does<change_axis>(d9x::kCp2Action),  // X36
    parameter(38).means("1: counter 2 is a ring, with comparator 2", "比較器 2 將計數器 2 用于循環計數用(CP2->rotary)").range(0, 1).not_modelled("ring counters"),
    parameter(d9x::kCp3Source).means("source of comparator 3: 0 to 3 select counters 1 to 4", "比較器 3 與誰比(CP3 source)").range(0, 3).does<change_axis>(d9x::kCp3Source),
    parameter(d9x::kCp3Method).means("method of comparator 3: 0 never, 1 =, 2 = upward, 3 = downward, 4 >, 5 <", "比較器 3 的比較方式(CP3 method)").range(0, 5).does<change_axis>(d9x::kCp3Method),
    parameter(d9x::kCp3Action).means("action of comparator 3: 0 none, 1 stops at once, 2 slows down, 3 loads the preregister", "比較器 3 滿足時做(CP3 action)").range(0, 3).does<change_axis>(d9x::kCp3Action),
    parameter(42).means("IDX: 0 at comparator 4, 1 at counter 4 = 0", "計數器 4 送 IDX(C4 IDX)").range(0, 1).not_modelled("there is no IDX"),
    parameter(d9x::kCp4Source).means("source of comparator 4: 0 to 3 select counters 1 to 4", "比較器 4 與誰比(CP4 source)").range(0, 3).does<change_axis>(d9x::kCp4Source),
    parameter(d9x::kCp4Method).means("method of comparator 4: 0 never, 1 =, 2 = upward, 3 = downward, 4 >, 5 <, 8 to 10 IDX", "比較器 4 的比較方式(CP4 method)").range(0, 10).does<change_axis>(d9x::kCp4Method),
    parameter(d9x::kCp4Action).means("action of comparator 4: 0 none, 1 stops at once, 2 slows down, 3 loads the preregister", "比較器 4 滿足時做(CP4 action)").range(0, 3).does<change_axis>(d9x::kCp4Action),
    parameter(d9x::kCp5Source).means("source of comparator 5: 0 to 3 select counters 1 to 4, 4 the pulses left, 5 the speed", "比較器 5 與誰比(CP5 source)").range(0, 5).does<change_axis>(d9x::kCp5Source),
    parameter(d9x::kCp5Method).means("method of comparator 5: 0 never, 1 =, 2 = upward, 3 = downward, 4 >, 5 <", "比較器 5 的比較方式(CP5 method)").range(0, 5).does<change_axis>(d9x::kCp5Method),
    parameter(d9x::kCp5Action).means("action of comparator 5: 0 none, 1 stops at once, 2 slows down, 3 loads the preregister", "比較器 5 滿足時做(CP5 action)").range(0, 3).does<change_axis>(d9x::kCp5Action),
    parameter(49).means("pulses before an acceleration", "空轉脈沖數量(Idle pulse)").range(0, 7).in("pulse").not_modelled("idle pulses"),
    parameter(d9x::kLatchOfCounters).means("counters are latched by: 0 LTC, 1 ORG, 2 comparator 4, 3 comparator 5", "設定所有計數器的鎖定條件(C1-4 latch)").range(0, 3).from_factory(1).does<change_axis>(d9x::kLatchOfCounters),
    parameter(d9x::kC3LatchSpeed).means("1: latches the speed instead of counter 3", "代替計數器 3 門鎖當前速度(C3 latch spd)").range(0, 1).does<change_axis>(d9x::kC3LatchSpeed),
    parameter(d9x::kStopLatch).means("1: the hardware does not latch", "通過定時硬體操作來停止門鎖(Stop latch)").range(0, 1).does<change_axis>(d9x::kStopLatch),
    parameter(53).means("internal synchronous signal", "同步信號(Syn. source)").range(0, 11).not_modelled("synchronous starts"),
    parameter(54).means("axis of the internal synchronous start", "選擇內部同步起動信號來源軸(Syn. axis)").range(0, 3).not_modelled("synchronous starts"),
    parameter(d9x::kLatchResetC).means("counters that are cleared when they are latched", "計數器被門時要同時復位(Latch rst C)").range(0, 15).with_bits(kCounterBits).does<change_axis>(d9x::kLatchResetC),
    parameter(d9x::kBacklash).means("backlash", "間隙/打滑補償值(Backlash)").range(0, 4095).in("pulse"),  // X1
    parameter(d9x::kCorrectMode).means("correction: 0 none, 1 backlash, 2 slip", "選擇一個運動量校正方式(Correct md.)").range(0, 2),
    parameter(58).means("1: hand-wheel pulses still act after a stop", "停止命令後仍操作已輸入的 PA/PB 值(MPG stop)").range(0, 1).not_modelled("pulses of the wheel after a stop"),
    parameter(59).means("divider of hand-wheel pulses", "PA/PB 脈沖分割率(MDV)").range(0, 2047).in("n/2048").not_modelled("X42 to X44 are the ratio"),
    parameter(60).means("multiplier of hand-wheel pulses", "PA/PB 脈沖倍率(MMX)").range(0, 31).not_modelled("X42 to X44 are the ratio"),
    parameter(61).means("damping of vibrations, RT", "減震 RT 時間(RT time)").range(0, 65535).in("1.6 us").not_modelled("vibration suppression"),
    parameter(62).means("damping of vibrations, FT", "減震 FT 時間(FT time)").range(0, 65535).in("1.6 us").not_modelled("vibration suppression"),
    parameter(d9x::kPlusOtSignal).means("+EL: 0 unused, 1 NO, 2 NC", "正向硬體極限設定(+OT signal)").range(0, 2).from_factory(1).does<change_axis>(d9x::kPlusOtSignal),  // X33
    parameter(d9x::kMinusOtSignal).means("-EL: 0 unused, 1 NO, 2 NC", "負向硬體極限設定(-OT signal)").range(0, 2).from_factory(1).does<change_axis>(d9x::kMinusOtSignal),  // X34
    parameter(d9x::kDotPosition).means("decimals", "小數點位數(Dot Position)").range(0, 3).in("digits").from_factory(3).not_modelled("the panel's decimal point"),  // X61
    parameter(d9x::kAccelerationTime).means("acceleration time", "加速時間(Acc.)").range(1, 65535).in("ms").from_factory(500),  // X2
    parameter(d9x::kDecelerationTime).means("deceleration time", "減速時間(Dec.)").range(1, 65535).in("ms").from_factory(500),  // X3
    parameter(d9x::kSAcceleration).means("S section of acceleration", "S 曲線加速度段(S-Acc.)").range(0, 32767).in("multiplier pps").from_factory(1),  // X4
    parameter(d9x::kSDeceleration).means("S section of deceleration", "S-曲線減速度段(S-Dec.)").range(0, 32767).in("multiplier pps").from_factory(1),  // X5
    parameter(d9x::kPpr).means("pulses per revolution", "每轉脈沖數(PPR)").range(200, 131072).in("pulse/rev").from_factory(4000),  // X6
    parameter(d9x::kCmx).means("multiplier of positions, CMX", "馬達一轉進給量乘數(CMX)").range(1, 131072).from_factory(1).does<change_axis>(d9x::kCmx),  // X10
    parameter(d9x::kCdv).means("divisor of positions, CDV", "馬達一轉進給量除數(CDV)").range(1, 131072).from_factory(1).does<change_axis>(d9x::kCdv),  // X11
    parameter(73).means("0 absolute, 1 relative", "預設座標模式(Default Coord. Mode)").range(0, 1),  // X15
    parameter(d9x::kZeroSetEnable).means("ZERO SET by key", "清零致能(Zero Set Enable)").range(0, 1),  // X60
    parameter(d9x::kMaxSpeed).means("maximum speed", "最高速限(Max. speed)").range(1, 10000).in("RPM").from_factory(3000),  // X12
    parameter(d9x::kBiasSpeed).means("start speed", "自起動速度(Bias speed)").range(1, 10000).in("RPM").from_factory(1),  // X13
    parameter(d9x::kZeroSpeed).means("speed of the return to zero", "回工作零點的速度(Zero speed)").range(1, 10000).in("RPM").from_factory(500),  // X26
    parameter(d9x::kDefaultSpeed).means("default speed", "預設速度(Default Speed)").range(1, 10000).in("RPM").from_factory(100),  // X14
    parameter(d9x::kHomeSpeed).means("home speed", "回機械原點的速度(Home speed)").range(1, 10000).in("RPM").from_factory(500),  // X21
    parameter(d9x::kCreepSpeed).means("creep speed of homing, speed of backlash", "原點低速(Creep speed)").range(1, 10000).in("RPM").from_factory(20),  // X22
    parameter(d9x::kHomeDirection).means("home direction: 0 positive, 1 negative", "回機械原點的方向(Home dir.)").range(0, 1),  // X23
    parameter(d9x::kHomePosition).means("position at home", "原點顯示位置 (Home posi.)").range(-9999999, 9999999).in("0.001 mm"),  // X24
    parameter(d9x::kHomeOffset).means("offset from home", "找到原點後的偏移量(Home offset)").range(-9999999, 9999999).in("0.001 mm"),  // X30
    parameter(d9x::kZeroSequence).means("order number of ZERO; 0: never", "回零點順序(Zero Sequence)").range(0, 4),  // X51
    parameter(d9x::kPlusSoftLimit).means("positive soft limit", "正軟體極限(+Soft limit)").range(-9999999, 9999999).in("0.001 mm").from_factory(9999999).does<change_axis>(d9x::kPlusSoftLimit),  // X35
    parameter(d9x::kMinusSoftLimit).means("negative soft limit", "負軟體極限(-Soft limit)").range(-9999999, 9999999).in("0.001 mm").from_factory(-9999999).does<change_axis>(d9x::kMinusSoftLimit),  // X36
    parameter(d9x::kMpg1Rate).means("hand wheel *1", "MPG*1 的倍率(MPG*1 Rate)").range(0, 9999).from_factory(1).does<change_axis>(d9x::kMpg1Rate),  // X42
    parameter(d9x::kMpg10Rate).means("hand wheel *10", "MPG*10 的倍率(MPG*10 Rate)").range(0, 9999).from_factory(10).does<change_axis>(d9x::kMpg10Rate),  // X43
    parameter(d9x::kMpg100Rate).means("hand wheel *100", "MPG*100 的倍率(MPG*100 Rate)").range(0, 9999).from_factory(100).does<change_axis>(d9x::kMpg100Rate),  // X44
    parameter(d9x::kLowSpeedLength).means("low-speed distance of MRK", "MRK 低速距離(Low Speed Length)").range(-999999, 999999).in("0.001 mm"),  // X16
    parameter(d9x::kFinishSignalTime).means("duration of the finish signal", "完成信號時間(Finish Signal Tmr.)").range(0, 9999).in("ms"),  // X45
    parameter(d9x::kEndSignalTime).means("duration of the end signal", "結束信號時間(End Signal Timer)").range(0, 9999).in("ms"),  // X46
    parameter(d9x::kMoveOff).means("step away from the DOG", "離開 DOG 的距離(MOVE OFF)").range(0, 999).in("pulse").from_factory(5),  // X25
    parameter(d9x::kJogLow).means("low jog speed", "寸動低速").range(1, 9999).in("RPM").from_factory(50),  // X53
    parameter(d9x::kJogMedium).means("medium jog speed", "寸動中速").range(1, 9999).in("RPM").from_factory(100),  // X54
    parameter(d9x::kJogHigh).means("high jog speed", "寸動高速").range(1, 9999).in("RPM").from_factory(250),  // X55
    parameter(d9x::kJogDirection).means("jog keys swapped", "人機寸動方向").range(0, 1),  // X52
    parameter(d9x::kKeyLock).means("lock of the manual page", "按鍵上鎖(Key Lock)").range(0, 111111111),  // X56
    parameter(d9x::kHomeSequence).means("order number of HOME; 0: never", "回原點順序(Home Sequence)").range(0, 4),  // X50
});
// clang-format on

}  // namespace understudy::emulator::models::super_40nc
