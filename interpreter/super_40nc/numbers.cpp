#include "interpreter/super_40nc/numbers.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "base/complete_table.h"
#include "interpreter/super_40nc/access.h"
#include "interpreter/super_40nc/error.h"
#include "interpreter/super_40nc/instruction_row.h"
#include "interpreter/super_40nc/operand.h"
#include "interpreter/super_40nc/options.h"
#include "interpreter/super_40nc/program.h"

namespace understudy::interpreter::super_40nc {
namespace {

constexpr std::int64_t kMin = std::numeric_limits<std::int32_t>::min();
constexpr std::int64_t kMax = std::numeric_limits<std::int32_t>::max();

constexpr std::int32_t wrapped(std::int64_t value) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(value));
}

/// Returns the next register in the same block, or unset at the end of the block.
Operand next_to(Operand reg) {
  const Block* const block = block_of(reg);
  if (block == nullptr || reg.number == block->last) return {};
  return {reg.letter, reg.number + 1};
}

Calculated divide(const Instruction& line, Access& access, const Options& options) {
  const std::int64_t dividend = access.value(line.fields[0]);
  const std::int64_t divisor = access.value(line.fields[1]);
  if (divisor == 0 && options.chose(option("division_by_zero", "unchanged"))) {
    return {false, Code::division_by_zero};
  }
  if (options.chose(option("div_at_the_end", "nothing_with_a_code")) && !next_to(line.fields[2]).is_set())
    return {false, Code::out_of_range};
  Calculated result;
  if (divisor == 0) result.code = Code::division_by_zero;
  std::int64_t quotient = divisor == 0 ? 0 : dividend / divisor;  // rounded towards 0
  std::int64_t remainder = divisor == 0 ? 0 : dividend % divisor;
  const bool is_above = remainder != 0 && (remainder < 0) != (divisor < 0);
  if (is_above && options.chose(option("division_rounding", "downwards"))) {
    --quotient;
    remainder += divisor;
  }
  result.has_changed = access.write(line.fields[2], wrapped(quotient));
  if (const Operand behind = next_to(line.fields[2]); behind.is_set()) {
    result.has_changed |= access.write(behind, wrapped(remainder));
  }
  return result;
}

/// FMV: writes registers in ascending order. Each write takes effect before the next one.
Calculated fill(const Instruction& line, Access& access, const Options& options) {
  const std::int64_t count = access.value(line.fields[2]);
  const Block* const block = block_of(line.fields[1]);
  if (count <= 0 || block == nullptr) return {};
  Calculated result;
  const std::int64_t room = block->last - line.fields[1].number + 1;
  if (count > room) result.code = Code::out_of_range;
  if (count > room && options.chose(option("fmv_end", "nothing"))) return result;
  const std::int32_t value = access.value(line.fields[0]);
  for (std::int64_t i = 0; i < std::min(count, room); ++i) {
    const Operand target{line.fields[1].letter, line.fields[1].number + static_cast<std::int32_t>(i)};
    result.has_changed |= access.write(target, value);
  }
  return result;
}

/// ZRST. The higher end comes first only if a choice allows it.
Calculated clear(const Instruction& line, Access& access, const Options& options) {
  const auto [first, last] = std::minmax(line.fields[0].number, line.fields[1].number);
  const bool is_alone = line.fields[0].number > line.fields[1].number &&
                        options.chose(option("zrst_swapped", "the_first_alone"));
  Calculated result;
  for (Operand at{line.fields[0].letter, is_alone ? last : first}; at.number <= last; ++at.number) {
    result.has_changed |= at.letter == Letter::d ? access.write(at, 0) : access.reset(at);
  }
  return result;
}

std::int32_t product(std::int64_t first, std::int64_t second, const Options& options) {
  const std::int64_t whole = first * second;
  return options.chose(option("product_size", "low_half"))
             ? wrapped(whole)
             : static_cast<std::int32_t>(std::clamp(whole, kMin, kMax));
}

std::int64_t sum(std::int64_t whole, const Options& options) {
  return options.chose(option("sum_size", "saturates")) ? std::clamp(whole, kMin, kMax) : whole;
}

Calculated gives(const Instruction& line, std::size_t field, std::int64_t result, Access& access) {
  return {access.write(line.fields[field], wrapped(result))};
}
std::int64_t value(const Instruction& line, std::size_t field, const Access& access) {
  return access.value(line.fields[field]);
}

using Calculation = Calculated (*)(const Instruction& line, Access& access, const Options& options);
constexpr HandlerRow<Op, Calculation> kCalculationRows[] = {
    {Op::mov, [](const auto& line, auto& access,
                 const auto&) { return gives(line, 1, value(line, 0, access), access); }},
    {Op::zrst,
     [](const auto& line, auto& access, const auto& options) { return clear(line, access, options); }},
    {Op::fmv, fill},
    {Op::add,
     [](const auto& line, auto& access, const auto& options) {
       return gives(line, 2, sum(value(line, 0, access) + value(line, 1, access), options), access);
     }},
    {Op::sub,
     [](const auto& line, auto& access, const auto& options) {
       return gives(line, 2, sum(value(line, 0, access) - value(line, 1, access), options), access);
     }},
    {Op::mul,
     [](const auto& line, auto& access, const auto& options) {
       return gives(line, 2, product(value(line, 0, access), value(line, 1, access), options), access);
     }},
    {Op::div, divide},
    {Op::inc, [](const auto& line, auto& access,
                 const auto&) { return gives(line, 0, value(line, 0, access) + 1, access); }},
    {Op::dec, [](const auto& line, auto& access,
                 const auto&) { return gives(line, 0, value(line, 0, access) - 1, access); }},
    {Op::abs,
     [](const auto& line, auto& access, const auto&) {
       return gives(line, 0, std::abs(value(line, 0, access)), access);  // INT32_MIN does not change
     }},
};
constexpr std::array kCalculationOps{Op::mov, Op::zrst, Op::fmv, Op::add, Op::sub,
                                     Op::mul, Op::div,  Op::inc, Op::dec, Op::abs};
constexpr CompleteTable<Op, Calculation> kCalculations(kCalculationOps, kCalculationRows);

}  // namespace

Calculated calculate(const Instruction& instruction, Access& access, const Options& options) {
  return kCalculations[instruction.op](instruction, access, options);
}

}  // namespace understudy::interpreter::super_40nc
