// The parts of a row of the instruction table.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/operand.h"

namespace understudy::interpreter::super_40nc {

/// The instructions, one for each mnemonic, in the order of the table.
enum class Op : std::uint8_t {
  // Logic
  ld,
  ldi,
  ldp,
  ldf,
  or_,
  ori,
  orp,
  orf,
  and_,
  ani,
  anp,
  anf,
  anb,
  orb,
  mps,
  mrd,
  mpp,
  inv,
  nop,
  alt,
  pls,
  plf,
  set,
  rst,
  out,
  out_tc,
  end,
  // Data
  mov,
  zrst,
  fmv,
  add,
  sub,
  mul,
  div,
  ld_equal,
  ld_gt,
  ld_lt,
  ld_ne,
  ld_le,
  ld_ge,
  ad_equal,
  ad_gt,
  ad_lt,
  ad_ne,
  ad_le,
  ad_ge,
  or_equal,
  or_gt,
  or_lt,
  or_ne,
  or_le,
  or_ge,
  inc,
  dec,
  abs,
  // Sequence
  lab,
  if_,
  else_,
  endi,
  cal,
  ret,
  jmp,
  cj,
  cjn,
  wat,
  wtn,
  tmr,
  // Motion
  f,
  lin,
  cw,
  ccw,
  c3p,
  cwr,
  ccwr,
  xyp,
  xzp,
  yzp,
  absc,
  incc,
  rpm,
  drv,
  hom,
  mpg,
  mrk,
  vdrv,
  pjg,
  mjg,
  chk,
  stp,
  str,
  pset,
  mset,
  // Names that have no description
  m,
  brk,
  aost,
  arot,
  pnt,
};
inline constexpr int kOpCount = static_cast<int>(Op::pnt) + 1;

enum class Group : std::uint8_t { logic, data, sequence, motion, undocumented };

/// The role of a field in its instruction.
enum class Slot : std::uint8_t {
  none,        // the field must be unset
  contact,     // read
  bit,         // switched
  resettable,  // for RST: like bit, and also timers and counters if a choice allows them
  timer,       // the coil of a timer or counter
  preset,
  source,  // a value
  target,  // a register that is written
  range,   // an end of ZRST's range
  label,   // K0 to K9999999
  times,   // an unset field means once
  amount,  // a value; the row's `unset` describes the meaning of an unset field
  needed,  // must be set
};

/// Returns the letters that are allowed in a slot.
constexpr Letters letters_of(Slot slot) {
  switch (slot) {
    case Slot::none: return 0;
    case Slot::contact: return letters(Letter::x, Letter::y, Letter::m, Letter::t, Letter::c);
    case Slot::bit: return letters(Letter::y, Letter::m);
    case Slot::resettable: return letters(Letter::y, Letter::m, Letter::t, Letter::c);
    case Slot::timer: return letters(Letter::t, Letter::c);
    case Slot::preset:
    case Slot::times:
    case Slot::amount:
    case Slot::needed: return letters(Letter::k, Letter::d);
    case Slot::source: return letters(Letter::k, Letter::t, Letter::c, Letter::d);
    case Slot::target: return letters(Letter::d);
    case Slot::range: return letters(Letter::y, Letter::m, Letter::t, Letter::c, Letter::d);
    case Slot::label: return letters(Letter::k);
  }
  return 0;
}
/// Returns a description of the allowed operands.
constexpr std::string_view describe(Slot slot) {
  switch (slot) {
    case Slot::none: return "";
    case Slot::contact: return "X, Y, M, T or C";
    case Slot::bit: return "Y or M";
    case Slot::resettable: return "Y, M, T or C";
    case Slot::timer: return "T or C";
    case Slot::preset:
    case Slot::times:
    case Slot::amount:
    case Slot::needed: return "K or D";
    case Slot::source: return "K, T, C or D";
    case Slot::target: return "D";
    case Slot::range: return "Y, M, T, C or D";
    case Slot::label: return "K0 to K9999999";
  }
  return "";
}
constexpr bool may_be_unset(Slot slot) {
  return slot == Slot::none || slot == Slot::times || slot == Slot::amount;
}

/// Returns the field that F, TMR, CWR and CCWR need, or none for other instructions.
constexpr std::size_t place_of_needed(Op op) {
  constexpr std::size_t kNone = 4;
  if (op == Op::f || op == Op::tmr) return 0;
  return op == Op::cwr || op == Op::ccwr ? 2 : kNone;
}

/// How an instruction in the PLC uses its condition.
enum class ConditionUse : std::uint8_t {
  nothing,  // not in the PLC, or has no condition
  contact,  // is part of the condition
  every_scan,
  every_scan_on_or_off,
  rising_edge,
  falling_edge,
  level,
};

/// What a step program waits for in this line.
enum class Waits : std::uint8_t { no, for_on, for_off, for_time, for_arrival, for_home, for_standstill };

using Slots = std::array<Slot, 4>;

struct InstructionRow {
  Op op;
  std::string_view mnemonic;
  Group group;
  Areas areas;  // where it is allowed
  int steps;
  Slots slots;
  ConditionUse in_plc;
  std::string_view meaning;  // for the documentation
  std::string_view section;  // of the manual
  Waits waits = Waits::no;
  bool ends_single_step = false;
  Areas void_in = 0;            // where it is allowed but has no effect, which D8094 reports
  std::string_view unset = {};  // the meaning of an unset field

  constexpr int fields() const {
    int count = 0;
    for (const Slot slot : slots) count += slot == Slot::none ? 0 : 1;
    return count;
  }

  // These functions set properties that only a few rows have.
  constexpr InstructionRow waits_for(Waits what) const {
    InstructionRow row = *this;
    row.waits = what;
    return row;
  }
  constexpr InstructionRow is_motion() const {
    InstructionRow row = *this;
    row.ends_single_step = true;
    return row;
  }
  constexpr InstructionRow is_void_in(Areas some) const {
    InstructionRow row = *this;
    row.void_in = some;
    return row;
  }
  constexpr InstructionRow without(std::string_view means) const {
    InstructionRow row = *this;
    row.unset = means;
    return row;
  }
};

// These functions create rows, grouped as in the manual.
constexpr InstructionRow logic(Op op, std::string_view mnemonic, Areas areas, int steps, const Slots& slots,
                               ConditionUse in_plc, std::string_view meaning, std::string_view section) {
  return {op, mnemonic, Group::logic, areas, steps, slots, in_plc, meaning, section};
}
constexpr InstructionRow data(Op op, std::string_view mnemonic, int steps, const Slots& slots,
                              ConditionUse in_plc, std::string_view meaning, std::string_view section) {
  return {op, mnemonic, Group::data, (1U << kAreaCount) - 1, steps, slots, in_plc, meaning, section};
}
constexpr InstructionRow sequence(Op op, std::string_view mnemonic, int steps, const Slots& slots,
                                  Waits waits, std::string_view meaning, std::string_view section) {
  return {op,      mnemonic, Group::sequence,       (1U << kStepProgramCount) - 1,
          steps,   slots,    ConditionUse::nothing, meaning,
          section, waits};
}
constexpr InstructionRow motion(Op op, std::string_view mnemonic, Areas areas, int steps, const Slots& slots,
                                ConditionUse in_plc, std::string_view meaning, std::string_view section) {
  return {op, mnemonic, Group::motion, areas, steps, slots, in_plc, meaning, section};
}
/// Creates the row of an instruction that has no description. It is refused when it is loaded.
constexpr InstructionRow undescribed(Op op, std::string_view mnemonic, std::string_view section) {
  return {op,     mnemonic, Group::undocumented,   0,
          1,      {},       ConditionUse::nothing, "Only named in the manual; refused",
          section};
}

}  // namespace understudy::interpreter::super_40nc
