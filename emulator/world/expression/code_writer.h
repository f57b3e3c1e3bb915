// Writes the code of an Expression, and calculates the required stack size.
#pragma once

#include <cstddef>
#include <cstdint>

#include "emulator/world/expression/expression.h"

namespace understudy::emulator::world {

/// The maximum number of values on the stack of an expression.
inline constexpr std::size_t kDeepestStack = 64;

class CodeWriter {
 public:
  /// Appends an instruction. `offset` is its position in the text. Throws ExpressionError if the stack
  /// becomes too large.
  void emit(Instruction::Kind kind, std::size_t offset, Operator operation = Operator::add,
            std::size_t argument = 0);
  void emit_constant(Number number, std::size_t offset);
  /// Appends a tolerance in millionths of a percent.
  void emit_within_share(std::int64_t millionths_of_a_percent, std::size_t offset);
  /// Appends a name. If its handle already occurs, that name is used again, with its first spelling.
  void emit_name(NamedNumber number, std::string_view spelling, std::size_t offset);

  /// Appends a jump forward to the position at which land() will be called.
  std::size_t emit_jump(Instruction::Kind kind, std::size_t offset);
  void land(std::size_t jump);
  /// Called between the two branches of a choice, because only one of the branches leaves a value.
  void drop_value() { --stack_; }

  /// Returns the code and starts again. `text` is its source text.
  Expression take();
  void set_text(std::string_view text) { made_.text = text; }

 private:
  Expression made_;
  int stack_ = 0;  // the number of values on the stack at this point
};

}  // namespace understudy::emulator::world
