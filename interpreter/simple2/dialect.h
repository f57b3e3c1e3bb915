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
  /// Up to 1.41 Jump_Timer1_GE does not work (firmware note "1.41 以前", and 0x1A). How is not said: it never
  /// jumps.
  bool quirk_jump_timer1_never_jumps = false;

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

  bool operator==(const Dialect&) const = default;
};

/// The firmware in hundredths: 1.39 is 139. The choices are ours.
constexpr Dialect dialect_of_firmware(int hundredths) {
  Dialect dialect;
  dialect.wait_move_jumps = hundredths >= 140;
  dialect.quirk_wait_move_b_is_move_inc_b_wait = hundredths <= 139;
  dialect.quirk_jump_timer1_never_jumps = hundredths <= 141;
  return dialect;
}

}  // namespace understudy::interpreter::simple2
