// Simple2-R3's program language as one firmware speaks it, and what the manual leaves open, as a value.
#pragma once

#include <cstdint>

namespace understudy::interpreter::simple2 {

struct Dialect {
  // --- what the firmware decides --------------------------------------------------------------
  /// From 1.40 on Wait_Move_* jumps to its flag while the axis moves; before, it waited and took no flag.
  bool wait_move_jumps = true;
  /// Up to 1.39 Wait_Move_B did what Move_INC_B_Wait does, its flag taken for a parameter (remark at 0x34).
  /// The same text says that it waits; false believes that.
  bool quirk_wait_move_b_is_move_inc_b_wait = false;
  /// Up to 1.41 Jump_Timer1_GE does not work (firmware note "1.41 以前", and 0x1A).
  bool quirk_jump_timer1_does_not_work = false;

  // --- what the manual leaves open, ours first -------------------------------------------------
  /// A Loop of n: n passes in all, or n further ones (0x04).
  enum class LoopCount : std::uint8_t { passes, further_passes } loop_count = LoopCount::passes;
  /// A Loop left by a jump or a skip: forgotten, or it goes on counting when it is met again (0x04).
  enum class LoopLeft : std::uint8_t { forgotten, remembered } loop_left = LoopLeft::forgotten;
  /// "No LOOP inside a LOOP" ends the program when a Loop is met while one around it counts, or already when
  /// the outer Loop is met for the first time (0x04).
  enum class LoopNesting : std::uint8_t { when_met, when_outer_starts } loop_nesting = LoopNesting::when_met;
  /// A command that the list does not have.
  enum class UnknownCommand : std::uint8_t {
    does_nothing,
    ends
  } unknown_command = UnknownCommand::does_nothing;
  /// After line 255.
  enum class AfterLastLine : std::uint8_t { ends, goes_on_at_0 } after_last_line = AfterLastLine::ends;
  /// Delay_*: from its slot to the slot of the next line, or the next line's slot comes after the delay.
  enum class DelayCounts : std::uint8_t {
    to_next_line,
    before_next_slot
  } delay_counts = DelayCounts::to_next_line;
  /// Once the test of a waiting line succeeds: its slot is over, or the line after it runs in the same slot.
  enum class WaitSlot : std::uint8_t {
    slot_of_its_own,
    next_line_runs_in_it
  } wait_slot = WaitSlot::slot_of_its_own;
  /// How Jump_Timer1_GE fails where it does not work.
  enum class Timer1Defect : std::uint8_t {
    never_jumps,
    always_jumps
  } timer1_defect = Timer1Defect::never_jumps;
  /// An input, output, STATUS bit, counter or timer that does not exist: OFF, 0 and no effect, or the program
  /// ends.
  enum class UndefinedOperand : std::uint8_t {
    harmless,
    ends
  } undefined_operand = UndefinedOperand::harmless;
  /// A parameter number without a meaning: the machine's business (it reads 0), or the program ends.
  enum class UndefinedParameter : std::uint8_t {
    reads_zero,
    ends
  } undefined_parameter = UndefinedParameter::reads_zero;
  /// A line that would write a parameter that can only be read: it has no effect, or the program ends.
  enum class ReadOnlyParameter : std::uint8_t {
    ignored,
    ends
  } read_only_parameter = ReadOnlyParameter::ignored;
  /// An operand that is 1 for ON and 0 for OFF, and holds something else: ON, or what its lowest bit says.
  enum class Logic : std::uint8_t { not_zero_is_on, lowest_bit } logic = Logic::not_zero_is_on;
  /// A value beyond what a register, a delay or a command takes.
  enum class ValueOutOfRange : std::uint8_t {
    clamped,
    low_16_bits
  } value_out_of_range = ValueOutOfRange::clamped;
  /// A result beyond 32 bits with a sign.
  enum class Overflow : std::uint8_t { wraps, saturates } overflow = Overflow::wraps;
  /// Which way a quotient that is not whole is rounded; the remainder is what is left then.
  enum class Division : std::uint8_t { towards_zero, downwards } division = Division::towards_zero;
  /// A counter counted or set beyond 0 to 65535.
  enum class CounterOverflow : std::uint8_t { wraps, saturates } counter_overflow = CounterOverflow::wraps;

  /// A jump or a Loop to flag 0, or to one beyond the last: as to a flag that no line has, or the line is
  /// void.
  enum class UndefinedFlag : std::uint8_t { line_0, line_void } undefined_flag = UndefinedFlag::line_0;
  /// How Jump_Timer*_GE compares 32 bits.
  enum class TimerCompare : std::uint8_t {
    without_sign,
    with_sign
  } timer_compare = TimerCompare::without_sign;

  /// A line that waits for a move, and that move is ended by something else before its end: the line is over
  /// (unless the machine goes on calling it moving), or the program is.
  enum class WaitCutShort : std::uint8_t {
    line_is_over,
    program_ends
  } wait_cut_short = WaitCutShort::line_is_over;

  bool operator==(const Dialect&) const = default;
};

/// The firmware in hundredths: 1.39 is 139. The choices are ours.
constexpr Dialect dialect_of_firmware(int hundredths) {
  Dialect dialect;
  dialect.wait_move_jumps = hundredths >= 140;
  dialect.quirk_wait_move_b_is_move_inc_b_wait = hundredths <= 139;
  dialect.quirk_jump_timer1_does_not_work = hundredths <= 141;
  return dialect;
}

/// What an operand of logic says.
constexpr bool is_on(const Dialect& dialect, std::uint8_t logic) {
  return dialect.logic == Dialect::Logic::lowest_bit ? (logic & 1) != 0 : logic != 0;
}

/// `value` as something that holds `lowest` to `highest` of at most 16 bits takes it.
constexpr std::int32_t fitted(const Dialect& dialect, std::int32_t value, std::int32_t lowest,
                              std::int32_t highest) {
  if (dialect.value_out_of_range == Dialect::ValueOutOfRange::low_16_bits) value &= 0xFFFF;
  return value < lowest ? lowest : value > highest ? highest : value;
}

}  // namespace understudy::interpreter::simple2
