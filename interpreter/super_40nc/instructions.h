// The SUPER-40NC's program languages as data: every mnemonic with its areas, fields, steps and meaning.
// (Manual, 指令使用說明一覽表, and a chapter for each instruction.)
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "interpreter/super_40nc/instruction_row.h"

namespace understudy::interpreter::super_40nc {

namespace instruction_words {

inline constexpr Areas kPlc = one(Area::plc);
inline constexpr Areas kC = one(Area::c);
inline constexpr Areas kAxes = one(Area::x) | one(Area::y) | one(Area::z) | one(Area::u);
inline constexpr Areas kSteps = kC | kAxes;
inline constexpr Areas kPlcAndC = kPlc | kC;
inline constexpr Areas kAll = kPlc | kSteps;

inline constexpr Slots kNoField{};
inline constexpr Slots kContact{Slot::contact};
inline constexpr Slots kBit{Slot::bit};
inline constexpr Slots kResettable{Slot::resettable};
inline constexpr Slots kTimer{Slot::timer, Slot::preset};
inline constexpr Slots kMove{Slot::source, Slot::target};
inline constexpr Slots kRange{Slot::range, Slot::range};
inline constexpr Slots kFill{Slot::source, Slot::target, Slot::source};
inline constexpr Slots kSum{Slot::source, Slot::source, Slot::target};
inline constexpr Slots kTwoSources{Slot::source, Slot::source};
inline constexpr Slots kTarget{Slot::target};
inline constexpr Slots kLabel{Slot::label};
inline constexpr Slots kCall{Slot::label, Slot::times};
inline constexpr Slots kNeeded{Slot::needed};
inline constexpr Slots kFourAmounts{Slot::amount, Slot::amount, Slot::amount, Slot::amount};
inline constexpr Slots kRadius{Slot::amount, Slot::amount, Slot::needed};

}  // namespace instruction_words

/// The instructions in the order of Op. OUTtc is written as OUT; the first field distinguishes the two.
inline constexpr std::array<InstructionRow, kOpCount> kInstructions = [] {
  using namespace instruction_words;
  return std::array<InstructionRow, kOpCount>{
      // Logic
      logic(Op::ld, "LD", kAll, 1, kContact, ConditionUse::contact,
            "Begins a block: ON while the device is ON", "LD , LDI , OUT , OUTtc 指令"),
      logic(Op::ldi, "LDI", kAll, 1, kContact, ConditionUse::contact,
            "Begins a block: ON while the device is OFF", "LD , LDI , OUT , OUTtc 指令"),
      logic(Op::ldp, "LDP", kPlc, 1, kContact, ConditionUse::contact,
            "Begins a block: ON for one scan when the device turns ON",
            "LDP , LDF , ORP , ORF , ANP , ANF 指令"),
      logic(Op::ldf, "LDF", kPlc, 1, kContact, ConditionUse::contact,
            "Begins a block: ON for one scan when the device turns OFF",
            "LDP , LDF , ORP , ORF , ANP , ANF 指令"),
      logic(Op::or_, "OR", kAll, 1, kContact, ConditionUse::contact, "In parallel: ON while the device is ON",
            "OR, ORI 指令"),
      logic(Op::ori, "ORI", kAll, 1, kContact, ConditionUse::contact,
            "In parallel: ON while the device is OFF", "OR, ORI 指令"),
      logic(Op::orp, "ORP", kPlc, 1, kContact, ConditionUse::contact,
            "In parallel: ON for one scan when the device turns ON",
            "LDP , LDF , ORP , ORF , ANP , ANF 指令"),
      logic(Op::orf, "ORF", kPlc, 1, kContact, ConditionUse::contact,
            "In parallel: ON for one scan when the device turns OFF",
            "LDP , LDF , ORP , ORF , ANP , ANF 指令"),
      logic(Op::and_, "AND", kAll, 1, kContact, ConditionUse::contact, "In series: ON while the device is ON",
            "AND , ANI 指令"),
      logic(Op::ani, "ANI", kAll, 1, kContact, ConditionUse::contact, "In series: ON while the device is OFF",
            "AND , ANI 指令"),
      logic(Op::anp, "ANP", kPlc, 1, kContact, ConditionUse::contact,
            "In series: ON for one scan when the device turns ON", "LDP , LDF , ORP , ORF , ANP , ANF 指令"),
      logic(Op::anf, "ANF", kPlc, 1, kContact, ConditionUse::contact,
            "In series: ON for one scan when the device turns OFF", "LDP , LDF , ORP , ORF , ANP , ANF 指令"),
      logic(Op::anb, "ANB", kAll, 1, kNoField, ConditionUse::contact, "Joins the last two blocks in series",
            "ORB , ANB 指令"),
      logic(Op::orb, "ORB", kAll, 1, kNoField, ConditionUse::contact, "Joins the last two blocks in parallel",
            "ORB , ANB 指令"),
      logic(Op::mps, "MPS", kPlc, 1, kNoField, ConditionUse::contact,
            "Begins a branch: keeps the result so far", "MPS , MRD , MPP 指令"),
      logic(Op::mrd, "MRD", kPlc, 1, kNoField, ConditionUse::contact, "Continues from the branch's result",
            "MPS , MRD , MPP 指令"),
      logic(Op::mpp, "MPP", kPlc, 1, kNoField, ConditionUse::contact,
            "Continues from the branch's result and ends the branch", "MPS , MRD , MPP 指令"),
      logic(Op::inv, "INV", kPlc, 1, kNoField, ConditionUse::contact, "Inverts the result so far",
            "INV 指令"),
      logic(Op::nop, "NOP", kAll, 1, kNoField, ConditionUse::nothing, "Does nothing, but takes a step",
            "NOP 指令"),
      logic(Op::alt, "ALT", kPlc, 1, kBit, ConditionUse::rising_edge,
            "Toggles the device when the condition turns ON", "ALT 指令"),
      logic(Op::pls, "PLS", kPlc, 1, kBit, ConditionUse::rising_edge,
            "Device ON for one scan when the condition turns ON", "PLS , PLF 指令"),
      logic(Op::plf, "PLF", kPlc, 1, kBit, ConditionUse::falling_edge,
            "Device ON for one scan when the condition turns OFF", "PLS , PLF 指令"),
      logic(Op::set, "SET", kAll, 1, kBit, ConditionUse::every_scan,
            "Switches the device ON until it is reset", "SET , RST 指令"),
      logic(Op::rst, "RST", kAll, 1, kResettable, ConditionUse::every_scan,
            "Switches the device OFF; sets a timer or counter to 0", "SET , RST 指令"),
      logic(Op::out, "OUT", kPlc, 1, kBit, ConditionUse::every_scan_on_or_off,
            "The device follows the condition", "LD , LDI , OUT , OUTtc 指令"),
      logic(Op::out_tc, "OUTtc", kPlc, 2, kTimer, ConditionUse::every_scan_on_or_off,
            "Timer or counter: runs, or counts, up to the preset", "LD , LDI , OUT , OUTtc 指令"),
      logic(Op::end, "END", kAll, 1, kNoField, ConditionUse::nothing,
            "PLC: end of the scan. Step program: end, with its signal", "END 指令"),
      // Data
      data(Op::mov, "MOV", 2, kMove, ConditionUse::every_scan, "Copies the value to the register",
           "MOV 指令"),
      data(Op::zrst, "ZRST", 2, kRange, ConditionUse::every_scan,
           "Clears all devices from the first to the second", "ZRST 指令"),
      data(Op::fmv, "FMV", 3, kFill, ConditionUse::every_scan,
           "Copies the value to the given number of registers", "FMV 指令"),
      data(Op::add, "ADD", 3, kSum, ConditionUse::every_scan, "Adds", "ADD , SUB , MUL , DIV 指令"),
      data(Op::sub, "SUB", 3, kSum, ConditionUse::every_scan, "Subtracts", "ADD , SUB , MUL , DIV 指令"),
      data(Op::mul, "MUL", 3, kSum, ConditionUse::every_scan, "Multiplies; keeps the low 32 bits",
           "ADD , SUB , MUL , DIV 指令"),
      data(Op::div, "DIV", 3, kSum, ConditionUse::every_scan,
           "Divides; stores the remainder in the next register", "ADD , SUB , MUL , DIV 指令"),
      data(Op::ld_equal, "LD=", 2, kTwoSources, ConditionUse::contact,
           "Begins a block: ON while the first value equals the second",
           "LD= , LD> , LD< , LD<> , LD<= , LD>= 指令"),
      data(Op::ld_gt, "LD>", 2, kTwoSources, ConditionUse::contact,
           "Begins a block: ON while the first value is greater than the second",
           "LD= , LD> , LD< , LD<> , LD<= , LD>= 指令"),
      data(Op::ld_lt, "LD<", 2, kTwoSources, ConditionUse::contact,
           "Begins a block: ON while the first value is less than the second",
           "LD= , LD> , LD< , LD<> , LD<= , LD>= 指令"),
      data(Op::ld_ne, "LD<>", 2, kTwoSources, ConditionUse::contact,
           "Begins a block: ON while the first value differs from the second",
           "LD= , LD> , LD< , LD<> , LD<= , LD>= 指令"),
      data(Op::ld_le, "LD<=", 2, kTwoSources, ConditionUse::contact,
           "Begins a block: ON while the first value is at most the second",
           "LD= , LD> , LD< , LD<> , LD<= , LD>= 指令"),
      data(Op::ld_ge, "LD>=", 2, kTwoSources, ConditionUse::contact,
           "Begins a block: ON while the first value is at least the second",
           "LD= , LD> , LD< , LD<> , LD<= , LD>= 指令"),
      data(Op::ad_equal, "AD=", 2, kTwoSources, ConditionUse::contact,
           "In series: ON while the first value equals the second",
           "AD= , AD> , AD< , AD<> , AD<= , AD>= 指令"),
      data(Op::ad_gt, "AD>", 2, kTwoSources, ConditionUse::contact,
           "In series: ON while the first value is greater than the second",
           "AD= , AD> , AD< , AD<> , AD<= , AD>= 指令"),
      data(Op::ad_lt, "AD<", 2, kTwoSources, ConditionUse::contact,
           "In series: ON while the first value is less than the second",
           "AD= , AD> , AD< , AD<> , AD<= , AD>= 指令"),
      data(Op::ad_ne, "AD<>", 2, kTwoSources, ConditionUse::contact,
           "In series: ON while the first value differs from the second",
           "AD= , AD> , AD< , AD<> , AD<= , AD>= 指令"),
      data(Op::ad_le, "AD<=", 2, kTwoSources, ConditionUse::contact,
           "In series: ON while the first value is at most the second",
           "AD= , AD> , AD< , AD<> , AD<= , AD>= 指令"),
      data(Op::ad_ge, "AD>=", 2, kTwoSources, ConditionUse::contact,
           "In series: ON while the first value is at least the second",
           "AD= , AD> , AD< , AD<> , AD<= , AD>= 指令"),
      data(Op::or_equal, "OR=", 2, kTwoSources, ConditionUse::contact,
           "In parallel: ON while the first value equals the second",
           "OR= , OR> , OR< , OR<> , OR<= , OR>= 指令"),
      data(Op::or_gt, "OR>", 2, kTwoSources, ConditionUse::contact,
           "In parallel: ON while the first value is greater than the second",
           "OR= , OR> , OR< , OR<> , OR<= , OR>= 指令"),
      data(Op::or_lt, "OR<", 2, kTwoSources, ConditionUse::contact,
           "In parallel: ON while the first value is less than the second",
           "OR= , OR> , OR< , OR<> , OR<= , OR>= 指令"),
      data(Op::or_ne, "OR<>", 2, kTwoSources, ConditionUse::contact,
           "In parallel: ON while the first value differs from the second",
           "OR= , OR> , OR< , OR<> , OR<= , OR>= 指令"),
      data(Op::or_le, "OR<=", 2, kTwoSources, ConditionUse::contact,
           "In parallel: ON while the first value is at most the second",
           "OR= , OR> , OR< , OR<> , OR<= , OR>= 指令"),
      data(Op::or_ge, "OR>=", 2, kTwoSources, ConditionUse::contact,
           "In parallel: ON while the first value is at least the second",
           "OR= , OR> , OR< , OR<> , OR<= , OR>= 指令"),
      data(Op::inc, "INC", 1, kTarget, ConditionUse::every_scan, "Adds 1", "INC , DEC 指令"),
      data(Op::dec, "DEC", 1, kTarget, ConditionUse::every_scan, "Subtracts 1", "INC , DEC 指令"),
      data(Op::abs, "ABS", 1, kTarget, ConditionUse::every_scan, "Takes the absolute value", "ABS 指令"),
      // Sequence
      sequence(Op::lab, "LAB", 1, kLabel, Waits::no, "Marks a place to jump to", "LAB 指令"),
      sequence(Op::if_, "IF", 1, kNoField, Waits::no,
               "Continues here if the condition holds, otherwise at ELSE or ENDI", "IF , ELSE , ENDI 指令"),
      sequence(Op::else_, "ELSE", 1, kNoField, Waits::no,
               "IF continues here if its condition does not hold; reached from above, it jumps to ENDI",
               "IF , ELSE , ENDI 指令"),
      sequence(Op::endi, "ENDI", 1, kNoField, Waits::no, "Ends an IF", "IF , ELSE , ENDI 指令"),
      sequence(Op::cal, "CAL", 3, kCall, Waits::no,
               "Calls the subroutine at the label the given number of times", "CAL , RET 指令")
          .without("once"),
      sequence(Op::ret, "RET", 1, kNoField, Waits::no, "Ends a pass of a subroutine", "CAL , RET 指令"),
      sequence(Op::jmp, "JMP", 2, kLabel, Waits::no, "Jumps to the label", "JMP 指令"),
      sequence(Op::cj, "CJ", 2, kLabel, Waits::no, "Jumps to the label if the condition holds",
               "CJ , CJN 指令"),
      sequence(Op::cjn, "CJN", 2, kLabel, Waits::no, "Jumps to the label if the condition does not hold",
               "CJ , CJN 指令"),
      sequence(Op::wat, "WAT", 1, kContact, Waits::for_on, "Waits until the device is ON", "WAT , WTN 指令"),
      sequence(Op::wtn, "WTN", 1, kContact, Waits::for_off, "Waits until the device is OFF",
               "WAT , WTN 指令"),
      sequence(Op::tmr, "TMR", 1, kNeeded, Waits::for_time, "Waits the given number of milliseconds",
               "TMR 指令"),
      // Motion
      motion(Op::f, "F", kC, 1, kNeeded, ConditionUse::nothing, "Feed rate of lines and arcs, in 0.001 mm/s",
             "F 指令"),
      motion(Op::lin, "LIN", kC, 4, kFourAmounts, ConditionUse::nothing,
             "Moves up to four axes along a straight line", "LIN 指令")
          .waits_for(Waits::for_arrival)
          .is_motion()
          .without("the axis does not take part"),
      motion(Op::cw, "CW", kC, 4, kFourAmounts, ConditionUse::nothing, "Clockwise arc around a centre",
             "CW , CCW 指令")
          .waits_for(Waits::for_arrival)
          .is_motion()
          .without("end: unchanged; centre: 0"),
      motion(Op::ccw, "CCW", kC, 4, kFourAmounts, ConditionUse::nothing,
             "Counter-clockwise arc around a centre", "CW , CCW 指令")
          .waits_for(Waits::for_arrival)
          .is_motion()
          .without("end: unchanged; centre: 0"),
      motion(Op::c3p, "C3P", kC, 4, kFourAmounts, ConditionUse::nothing,
             "Arc through a point to an end point", "C3P 指令")
          .waits_for(Waits::for_arrival)
          .is_motion()
          .without("unchanged"),
      motion(Op::cwr, "CWR", kC, 4, kRadius, ConditionUse::nothing, "Clockwise arc of a given radius",
             "CWR , CCWR 指令")
          .waits_for(Waits::for_arrival)
          .is_motion()
          .without("unchanged"),
      motion(Op::ccwr, "CCWR", kC, 4, kRadius, ConditionUse::nothing,
             "Counter-clockwise arc of a given radius", "CWR , CCWR 指令")
          .waits_for(Waits::for_arrival)
          .is_motion()
          .without("unchanged"),
      motion(Op::xyp, "XYP", kC, 1, kNoField, ConditionUse::nothing, "Arcs lie in XY",
             "XYP , XZP , YZP 指令"),
      motion(Op::xzp, "XZP", kC, 1, kNoField, ConditionUse::nothing, "Arcs lie in XZ",
             "XYP , XZP , YZP 指令"),
      motion(Op::yzp, "YZP", kC, 1, kNoField, ConditionUse::nothing, "Arcs lie in YZ",
             "XYP , XZP , YZP 指令"),
      motion(Op::absc, "ABSC", kAll, 1, kNoField, ConditionUse::every_scan, "Targets are absolute",
             "ABSC , INCC 指令"),
      motion(Op::incc, "INCC", kAll, 1, kNoField, ConditionUse::every_scan, "Targets are relative",
             "ABSC , INCC 指令"),
      motion(Op::rpm, "RPM", kAll, 4, kFourAmounts, ConditionUse::every_scan, "Speeds of DRV and MRK, in rpm",
             "RPM 指令")
          .without("the axis keeps its speed"),
      motion(Op::drv, "DRV", kAll, 4, kFourAmounts, ConditionUse::rising_edge, "Moves axes independently",
             "DRV 指令")
          .waits_for(Waits::for_arrival)
          .is_motion()
          .without("the axis does not take part"),
      motion(Op::hom, "HOM", kAll, 4, kFourAmounts, ConditionUse::rising_edge,
             "Searches for the home of axes", "HOM 指令")
          .waits_for(Waits::for_home)
          .is_motion()
          .without("the axis is not affected"),
      motion(Op::mpg, "MPG", kSteps, 4, kFourAmounts, ConditionUse::nothing,
             "Makes axes follow the hand wheel, this far for each count", "MPG 指令")
          .without("the axis keeps its ratio"),
      motion(Op::mrk, "MRK", kSteps, 4, kFourAmounts, ConditionUse::nothing,
             "Moves axes, then searches for a mark at creep speed", "MRK 指令")
          .waits_for(Waits::for_arrival)
          .is_motion()
          .without("the axis does not take part"),
      motion(Op::vdrv, "VDRV", kSteps, 4, kFourAmounts, ConditionUse::nothing,
             "Turns axes at a speed, in rpm", "VDRV 指令")
          .waits_for(Waits::for_standstill)
          .is_motion()
          .without("the axis is not affected"),
      motion(Op::pjg, "PJG", kAll, 4, kFourAmounts, ConditionUse::level,
             "Jogs axes in the positive direction", "PJG , MJG 指令")
          .is_void_in(kSteps)
          .without("the axis is not affected"),
      motion(Op::mjg, "MJG", kAll, 4, kFourAmounts, ConditionUse::level,
             "Jogs axes in the negative direction", "PJG , MJG 指令")
          .is_void_in(kSteps)
          .without("the axis is not affected"),
      motion(Op::chk, "CHK", kAll, 1, kNeeded, ConditionUse::nothing, "Sets whether DRV waits for arrival",
             "CHK 指令")
          .is_void_in(kPlcAndC),
      motion(Op::stp, "STP", kAll, 4, kFourAmounts, ConditionUse::every_scan,
             "Stops step programs and their motors at once", "STP 指令")
          .without("no action; all four: C"),
      motion(Op::str, "STR", kAll, 4, kFourAmounts, ConditionUse::rising_edge, "Starts step programs",
             "STR 指令")
          .without("no action; all four: C"),
      motion(Op::pset, "PSET", kAll, 4, kFourAmounts, ConditionUse::every_scan,
             "Sets the coordinates of axes; nothing moves", "PSET 指令")
          .without("the axis is not affected"),
      motion(Op::mset, "MSET", kAll, 4, kFourAmounts, ConditionUse::every_scan,
             "Sets the machine coordinates of axes; nothing moves", "指令一覽表")
          .without("the axis is not affected"),
      // Names that have no description
      undescribed(Op::m, "M", "Motion指令一覽表"),
      undescribed(Op::brk, "BRK", "Motion指令一覽表"),
      undescribed(Op::aost, "AOST", "Motion指令一覽表"),
      undescribed(Op::arot, "AROT", "Motion指令一覽表"),
      undescribed(Op::pnt, "PNT", "編輯頁操作說明"),
  };
}();

constexpr const InstructionRow& row_of(Op op) { return kInstructions[static_cast<std::size_t>(op)]; }

/// Checks that the number of steps matches the number of fields. The target of a jump occupies a separate
/// step, and CWR and CCWR have four steps.
consteval bool table_makes_sense() {
  for (std::size_t i = 0; i < kInstructions.size(); ++i) {
    const InstructionRow& row = kInstructions[i];
    if (row.op != static_cast<Op>(i)) throw "rows must be in the order of Op";
    const bool has_target = row.op == Op::jmp || row.op == Op::cj || row.op == Op::cjn || row.op == Op::cal;
    const bool has_four = row.op == Op::cwr || row.op == Op::ccwr;
    const int fields = has_four ? 4 : row.fields() + (has_target ? 1 : 0);
    if (row.steps != (fields == 0 ? 1 : fields)) throw "steps are the fields, at least 1";
  }
  return true;
}
static_assert(table_makes_sense());

}  // namespace understudy::interpreter::super_40nc
