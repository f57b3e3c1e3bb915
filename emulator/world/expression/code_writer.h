// Writes the code of an Expression, and keeps track of the stack that it needs.
#pragma once

#include <cstddef>
#include <cstdint>

#include "emulator/world/expression/expression.h"

namespace understudy::emulator::world {

/// The largest number of values that an expression may hold at a time.
inline constexpr std::size_t kDeepestStack = 64;

class CodeWriter {
 public:
  /// Appends an instruction. `offset` is its position in the text. Throws ExpressionError if the stack gets
  /// too deep.
  void emit(Instruction::Kind kind, std::size_t offset, Operator operation = Operator::add,
            std::size_t argument = 0);
  void emit_constant(Number number, std::size_t offset);
  /// Appends a tolerance in millionths of a percent.
  void emit_within_share(std::int64_t millionths_of_a_percent, std::size_t offset);
  /// Appends a name. If its handle is known, the name is reused with its first spelling.
  void emit_name(NamedNumber number, std::string_view spelling, std::size_t offset);

  /// Appends a forward jump to the position at which land() is called.
  std::size_t emit_jump(Instruction::Kind kind, std::size_t offset);
  void land(std::size_t jump);
  /// Called between the two branches of a choice: only one of the branches leaves its value.
  void drop_value() { --stack_; }

  /// Returns the code and starts again. `text` is its source.
  Expression take();
  void set_text(std::string_view text) { made_.text = text; }

 private:
  Expression made_;
  int stack_ = 0;  // how many values are on the stack here
};

}  // namespace understudy::emulator::world
