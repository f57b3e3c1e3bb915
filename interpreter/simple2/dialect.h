// The dialect of Simple2-R3's program language in a given firmware, including the options that the manual
// leaves open.
#pragma once

#include <cstdint>

namespace understudy::interpreter::simple2 {

struct Dialect {
  // --- determined by the firmware -------------------------------------------------------------
  /// From 1.40 on, Wait_Move_* jumps to its flag while the axis moves. Before, it waited and had no flag.
  bool wait_move_jumps = true;
  /// Up to 1.39, Wait_Move_B did the same as Move_INC_B_Wait, with its flag as the parameter (remark at
  /// 0x34). The same text also states that the instruction waits; `false` follows that statement.
  bool quirk_wait_move_b_is_move_inc_b_wait = false;
  /// Up to 1.41, Jump_Timer1_GE does not work (firmware note "1.41 以前", and 0x1A).
  bool quirk_jump_timer1_does_not_work = false;

  // --- left open by the manual; our option is first --------------------------------------------
  /// A Loop of n makes either n passes in total, or n further passes (0x04).
  enum class LoopCount : std::uint8_t { passes, further_passes } loop_count = LoopCount::passes;
  /// When a jump or a skip leaves a Loop, its count is either forgotten, or continues when the Loop is
  /// reached again (0x04).
  enum class LoopLeft : std::uint8_t { forgotten, remembered } loop_left = LoopLeft::forgotten;
  /// "No LOOP inside a LOOP" ends the program either when a Loop is reached while an outer Loop is counting,
  /// or as soon as the outer Loop is reached for the first time (0x04).
  enum class LoopNesting : std::uint8_t { when_met, when_outer_starts } loop_nesting = LoopNesting::when_met;
  /// An unknown command either does nothing or ends the program.
  enum class UnknownCommand : std::uint8_t {
    does_nothing,
    ends
  } unknown_command = UnknownCommand::does_nothing;
  /// After line 255, the program either ends or continues at line 0.
  enum class AfterLastLine : std::uint8_t { ends, goes_on_at_0 } after_last_line = AfterLastLine::ends;
  /// A Delay_* either lasts from its slot to the slot of the next line, or the slot of the next line follows
  /// after the delay.
  enum class DelayCounts : std::uint8_t {
    to_next_line,
    before_next_slot
  } delay_counts = DelayCounts::to_next_line;
  /// When the test of a waiting line succeeds, either the slot ends, or the next line runs in the same slot.
  enum class WaitSlot : std::uint8_t {
    slot_of_its_own,
    next_line_runs_in_it
  } wait_slot = WaitSlot::slot_of_its_own;
  /// In firmware where Jump_Timer1_GE does not work, it either never jumps or always jumps.
  enum class Timer1Defect : std::uint8_t {
    never_jumps,
    always_jumps
  } timer1_defect = Timer1Defect::never_jumps;
  /// An input, output, STATUS bit, counter or timer that does not exist is either OFF or 0 and has no effect,
  /// or ends the program.
  enum class UndefinedOperand : std::uint8_t {
    harmless,
    ends
  } undefined_operand = UndefinedOperand::harmless;
  /// A parameter number without a meaning either reads as 0 (the machine decides) or ends the program.
  enum class UndefinedParameter : std::uint8_t {
    reads_zero,
    ends
  } undefined_parameter = UndefinedParameter::reads_zero;
  /// A write to a read-only parameter either has no effect or ends the program.
  enum class ReadOnlyParameter : std::uint8_t {
    ignored,
    ends
  } read_only_parameter = ReadOnlyParameter::ignored;
  /// An operand that is neither 1 (ON) nor 0 (OFF) either means ON, or only its lowest bit counts.
  enum class Logic : std::uint8_t { not_zero_is_on, lowest_bit } logic = Logic::not_zero_is_on;
  /// A value outside the range of a register, a delay or a command is either clamped, or first reduced to its
  /// low 16 bits.
  enum class ValueOutOfRange : std::uint8_t {
    clamped,
    low_16_bits
  } value_out_of_range = ValueOutOfRange::clamped;
  /// A result outside signed 32 bits either wraps or saturates.
  enum class Overflow : std::uint8_t { wraps, saturates } overflow = Overflow::wraps;
  /// A quotient is rounded either towards zero or downwards. The remainder follows from it.
  enum class Division : std::uint8_t { towards_zero, downwards } division = Division::towards_zero;
  /// A counter that leaves the range 0 to 65535 by counting or setting either wraps or saturates.
  enum class CounterOverflow : std::uint8_t { wraps, saturates } counter_overflow = CounterOverflow::wraps;

  /// A jump or a Loop to flag 0, or to a flag above the last one, either acts as if no line had the flag, or
  /// has no effect.
  enum class UndefinedFlag : std::uint8_t { line_0, line_void } undefined_flag = UndefinedFlag::line_0;
  /// Jump_Timer*_GE compares 32-bit numbers, either unsigned or signed.
  enum class TimerCompare : std::uint8_t {
    without_sign,
    with_sign
  } timer_compare = TimerCompare::without_sign;

  /// If the move for which a line waits is cut short, the line ends, the line waits until a later move
  /// completes, or the program ends.
  enum class WaitCutShort : std::uint8_t {
    line_is_over,
    waits_on,
    program_ends
  } wait_cut_short = WaitCutShort::line_is_over;
  /// If a waiting line is overwritten, either the new line runs in the next slot, or the old wait continues.
  enum class RewrittenLine : std::uint8_t { reread, waits_on } rewritten_line = RewrittenLine::reread;

  bool operator==(const Dialect&) const = default;
};

/// Returns our dialect of a firmware. Its number is in hundredths: 1.39 is 139.
constexpr Dialect dialect_of_firmware(int hundredths) {
  Dialect dialect;
  dialect.wait_move_jumps = hundredths >= 140;
  dialect.quirk_wait_move_b_is_move_inc_b_wait = hundredths <= 139;
  dialect.quirk_jump_timer1_does_not_work = hundredths <= 141;
  return dialect;
}

/// Returns the level that a logic operand means.
constexpr bool is_on(const Dialect& dialect, std::uint8_t logic) {
  return dialect.logic == Dialect::Logic::lowest_bit ? (logic & 1) != 0 : logic != 0;
}

/// Returns `value` as it is stored in a cell with the range `lowest` to `highest`, which has at most 16 bits.
constexpr std::int32_t fitted(const Dialect& dialect, std::int32_t value, std::int32_t lowest,
                              std::int32_t highest) {
  if (dialect.value_out_of_range == Dialect::ValueOutOfRange::low_16_bits) value &= 0xFFFF;
  return value < lowest ? lowest : value > highest ? highest : value;
}

}  // namespace understudy::interpreter::simple2
