// Writes the code of an Expression, and keeps count of the stack that it will need.
#pragma once

#include <cstddef>
#include <cstdint>

#include "emulator/world/expression/expression.h"

namespace understudy::emulator::world {

/// How many values an expression may need at a time.
inline constexpr std::size_t kDeepestStack = 64;

class CodeWriter {
 public:
  /// `offset` is where in the text it comes from. Throws ExpressionError if it needs too deep a
  /// stack.
  void emit(Instruction::Kind kind, std::size_t offset, Operator operation = Operator::add,
            std::size_t argument = 0);
  void emit_constant(Number number, std::size_t offset);
  /// A tolerance of that share.
  void emit_within_share(std::int64_t millionths_of_a_percent, std::size_t offset);
  /// A name known by its handle is used again, in its first spelling.
  void emit_name(NamedNumber number, std::string_view spelling, std::size_t offset);

  /// A jump forward, to where the code ends when land() is called.
  std::size_t emit_jump(Instruction::Kind kind, std::size_t offset);
  void land(std::size_t jump);
  /// Between the two ways of a choice: either leaves its value, not both.
  void drop_value() { --stack_; }

  /// Returns what is written, and starts again. `text` is where it comes from.
  Expression take();
  void set_text(std::string_view text) { made_.text = text; }

 private:
  Expression made_;
  int stack_ = 0;  // how many values are on the stack here
};

}  // namespace understudy::emulator::world
