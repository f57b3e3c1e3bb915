// The data instructions of both languages: signed 32-bit numbers that wrap. (Manual, Data 指令一覽表.)
#pragma once

#include "interpreter/super_40nc/access.h"
#include "interpreter/super_40nc/error.h"
#include "interpreter/super_40nc/options.h"
#include "interpreter/super_40nc/program.h"

namespace understudy::interpreter::super_40nc {

struct Calculated {
  bool has_changed = false;
  Code code = Code::none;
};

/// Executes one of MOV to DIV, INC, DEC and ABS.
Calculated calculate(const Instruction& instruction, Access& access, const Options& options);
constexpr bool is_calculation(Op op) {
  return (op >= Op::mov && op <= Op::div) || (op >= Op::inc && op <= Op::abs);
}

/// The possible relations of two values. Bit 0: less, bit 1: equal, bit 2: greater.
using Relations = std::uint8_t;
constexpr Relations relation_of(std::int32_t first, std::int32_t second) {
  return static_cast<Relations>((first < second ? 1U : 0U) | (first == second ? 2U : 0U) |
                                (first > second ? 4U : 0U));
}
/// Returns the relations for which a comparing contact is ON; 0 for other instructions.
constexpr Relations relations_of(Op op) {
  if (op < Op::ld_equal || op > Op::or_ge) return 0;
  constexpr Relations kInOrder[] = {2, 4, 1, 1 | 4, 1 | 2, 2 | 4};  // = > < <> <= >=
  return kInOrder[(static_cast<int>(op) - static_cast<int>(Op::ld_equal)) % 6];
}

/// The place of a contact in its block.
enum class Place : std::uint8_t { begins, in_series, in_parallel };
constexpr Place place_of(Op op) {
  const bool is_series = (op >= Op::and_ && op <= Op::anf) || (op >= Op::ad_equal && op <= Op::ad_ge);
  const bool is_parallel = (op >= Op::or_ && op <= Op::orf) || (op >= Op::or_equal && op <= Op::or_ge);
  return is_series ? Place::in_series : is_parallel ? Place::in_parallel : Place::begins;
}
constexpr bool is_inverted(Op op) { return op == Op::ldi || op == Op::ori || op == Op::ani; }

}  // namespace understudy::interpreter::super_40nc
