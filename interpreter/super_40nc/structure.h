// Checks the lines of an area as a whole: blocks and branches, IF with ELSE and ENDI, labels, END, and the
// available memory.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "interpreter/super_40nc/error.h"
#include "interpreter/super_40nc/options.h"
#include "interpreter/super_40nc/program.h"

namespace understudy::interpreter::super_40nc {

struct Fault {
  int line = 0;  // index into the area's lines
  Code code = Code::none;
  std::string what;
  std::string expected;
  int other_line = -1;  // for a duplicate label
  enum class Weight : std::uint8_t { error, warning, note };
  Weight weight = Weight::error;
};

/// Returns the faults in the order of the lines.
std::vector<Fault> faults_of(const AreaProgram& program, Area area, const Options& options);

/// These classify instructions: those that begin a block, contacts of any kind, and those that join blocks.
constexpr bool begins_block(Op op) {
  return (op >= Op::ld && op <= Op::ldf) || (op >= Op::ld_equal && op <= Op::ld_ge);
}
constexpr bool is_contact(Op op) { return op <= Op::anf || (op >= Op::ld_equal && op <= Op::or_ge); }
constexpr bool joins_blocks(Op op) { return op == Op::anb || op == Op::orb; }
/// Instructions that make a decision: contacts, jumps and IF by their condition, and waits for a contact.
constexpr bool decides(Op op) {
  return is_contact(op) || op == Op::cj || op == Op::cjn || op == Op::if_ || op == Op::wat || op == Op::wtn;
}
constexpr bool reads_group(Op op) { return op == Op::cj || op == Op::cjn || op == Op::if_; }

}  // namespace understudy::interpreter::super_40nc
