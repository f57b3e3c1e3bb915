#include "emulator/world/expression/code_writer.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include "emulator/world/expression/expression.h"
#include "emulator/world/expression/number.h"

namespace understudy::emulator::world {

namespace {

// Returns by how many values an instruction changes the size of the stack.
int growth(Instruction::Kind kind) {
  switch (kind) {
    case Instruction::Kind::constant:
    case Instruction::Kind::name: return 1;
    case Instruction::Kind::within: return -2;
    case Instruction::Kind::binary:
    case Instruction::Kind::within_share:
    case Instruction::Kind::skip_if_false:  // if it does not skip
    case Instruction::Kind::skip_if_true:
    case Instruction::Kind::choose: return -1;
    case Instruction::Kind::unary:
    case Instruction::Kind::truth:
    case Instruction::Kind::skip: break;
  }
  return 0;
}

}  // namespace

void CodeWriter::emit(Instruction::Kind kind, std::size_t offset, Operator operation, std::size_t argument) {
  stack_ += growth(kind);
  made_.stack_depth = std::max(made_.stack_depth, stack_);
  if (stack_ > static_cast<int>(kDeepestStack)) {
    throw ExpressionError(
        made_.text, offset,
        "nested too deeply; expected at most " + std::to_string(kDeepestStack) + " values at a time");
  }
  made_.code.push_back(
      {kind, operation, static_cast<std::uint16_t>(offset), static_cast<std::int32_t>(argument)});
}

void CodeWriter::emit_constant(Number number, std::size_t offset) {
  made_.constants.push_back(number);
  emit(Instruction::Kind::constant, offset, {}, made_.constants.size() - 1);
}

void CodeWriter::emit_within_share(std::int64_t millionths_of_a_percent, std::size_t offset) {
  made_.constants.emplace_back(millionths_of_a_percent);
  emit(Instruction::Kind::within_share, offset, {}, made_.constants.size() - 1);
}

void CodeWriter::emit_name(NamedNumber number, std::string_view spelling, std::size_t offset) {
  const auto known = std::find_if(made_.names.begin(), made_.names.end(), [&](const Expression::Name& name) {
    return name.number.handle == number.handle;
  });
  const auto index = static_cast<std::size_t>(known - made_.names.begin());
  if (known == made_.names.end()) made_.names.push_back({number, std::string(spelling)});
  emit(Instruction::Kind::name, offset, {}, index);
}

std::size_t CodeWriter::emit_jump(Instruction::Kind kind, std::size_t offset) {
  emit(kind, offset);
  return made_.code.size() - 1;
}

void CodeWriter::land(std::size_t jump) {
  made_.code[jump].argument = static_cast<std::int32_t>(made_.code.size() - jump - 1);
}

Expression CodeWriter::take() {
  Expression made = std::exchange(made_, {});
  made_.text = made.text;
  stack_ = 0;
  return made;
}

}  // namespace understudy::emulator::world
