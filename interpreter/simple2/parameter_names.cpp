#include "interpreter/simple2/parameter_names.h"

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "interpreter/simple2/text.h"

namespace understudy::interpreter::simple2 {
namespace {

struct NumberedNames {
  int first;
  int last;
  std::string_view prefix;
};

// The manual's aliases contain the parameter number.
constexpr NumberedNames kNumbered[] = {
    {0, 31, "MEM"},
    {32, 63, "VAR"},
    {64, 158, "DAT"},
    {167, 182, "DAT"},
};

std::optional<std::uint8_t> whole_number(std::string_view digits) {
  std::uint8_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (digits.empty() || error != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
  return number;
}

}  // namespace

std::optional<std::string> parameter_name(std::uint8_t number) {
  for (const RegisterName& row : kRegisterNames) {
    if (row.number == number) return std::string(row.name);
  }
  for (const NumberedNames& range : kNumbered) {
    if (number >= range.first && number <= range.last)
      return std::string(range.prefix) + std::to_string(number);
  }
  return std::nullopt;
}

std::optional<std::uint8_t> parameter_number(std::string_view name) {
  for (const RegisterName& row : kRegisterNames) {
    if (same_name(name, row.name)) return row.number;
    if (!row.other_spelling.empty() && same_name(name, row.other_spelling)) return row.number;
  }
  for (const NumberedNames& range : kNumbered) {
    const auto number = whole_number(after_prefix(name, range.prefix));
    if (number && *number >= range.first && *number <= range.last) return number;
  }
  return std::nullopt;
}

}  // namespace understudy::interpreter::simple2
