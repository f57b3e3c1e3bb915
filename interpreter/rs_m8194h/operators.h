// Operators of VAR_CALCULATE and IF.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

namespace understudy::interpreter::rs_m8194h {

enum class Comparison : std::uint8_t { less, less_or_equal, greater, greater_or_equal, equal, not_equal };

/// The codes of each operator. The manual's list and its frame write the two letters in different orders
/// and the list has two operators that are missing from the frame. All forms are accepted; the first
/// form is used for output.
struct ComparisonRow {
  Comparison comparison;
  std::string_view text;
  std::array<std::uint16_t, 4> codes;  // 0: no further code
};
inline constexpr auto kComparisons = std::to_array<ComparisonRow>({
    {Comparison::less, "<", {0x003C, 0x3C00}},
    {Comparison::less_or_equal, "<=", {0x3C3D, 0x3D3C}},
    {Comparison::greater, ">", {0x003E, 0x3E00}},
    {Comparison::greater_or_equal, ">=", {0x3E3D, 0x3D3E}},
    {Comparison::equal, "==", {0x3D3D, 0x003D, 0x3D00}},
    {Comparison::not_equal, "!=", {0x213D, 0x3D21, 0x0021, 0x2100}},
});

/// Returns null if the code is not an operator.
constexpr const ComparisonRow* find_comparison(std::uint32_t code) {
  for (const ComparisonRow& row : kComparisons) {
    for (const std::uint16_t one : row.codes) {
      if (one != 0 && one == code) return &row;
    }
  }
  return nullptr;
}

constexpr bool holds(Comparison comparison, std::int64_t left, std::int64_t right) {
  switch (comparison) {
    case Comparison::less: return left < right;
    case Comparison::less_or_equal: return left <= right;
    case Comparison::greater: return left > right;
    case Comparison::greater_or_equal: return left >= right;
    case Comparison::equal: return left == right;
    case Comparison::not_equal: return left != right;
  }
  return false;
}

/// Operators of VAR_CALCULATE, in ASCII.
inline constexpr std::string_view kArithmetic = "+-*/&|";

constexpr bool is_arithmetic(std::uint32_t code) {
  return code < 0x80 && code != 0 && kArithmetic.find(static_cast<char>(code)) != std::string_view::npos;
}

/// Calculates with two 32-bit numbers. A division by 0 is not allowed. If necessary, the caller wraps the
/// result to 32 bits.
constexpr std::int64_t calculate_exactly(char arithmetic, std::int32_t left, std::int32_t right) {
  const auto a = std::int64_t{left};
  const auto b = std::int64_t{right};
  switch (arithmetic) {
    case '+': return a + b;
    case '-': return a - b;
    case '*': return a * b;
    case '/': return a / b;
    case '&': return left & right;
    case '|': return left | right;
    default: return 0;
  }
}

constexpr std::int32_t nearest_of_32_bits(std::int64_t exact) {
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(exact, INT32_MIN, INT32_MAX));
}

}  // namespace understudy::interpreter::rs_m8194h
