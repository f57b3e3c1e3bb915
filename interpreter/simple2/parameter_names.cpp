#include "interpreter/simple2/parameter_names.h"

#include <charconv>

#include "interpreter/simple2/text.h"

namespace understudy::interpreter::simple2 {
namespace {

struct NumberedNames {
  int first;
  int last;
  std::string_view prefix;
};

// The manual's aliases carry the number of the parameter.
constexpr NumberedNames kNumbered[] = {
    {0, 31, "MEM"},
    {32, 63, "VAR"},
    {64, 158, "DAT"},
    {167, 182, "DAT"},
};

struct RegisterName {
  std::uint8_t number;
  std::string_view name;
  std::string_view other_spelling = {};  // in another table of the manual, or where it misprints the axis
};

// As the table of registers spells them.
constexpr RegisterName kRegisterNames[] = {
    {144, "Aaxis_Home_Speed", "Axis_Home_Speed"},
    {145, "Baxis_Home_Speed"},
    {146, "Aaxis_Resoultion", "Axis_Resoultion"},
    {147, "Baxis_Resoultion"},
    {148, "Aaxis_Home_AccTime", "Axis_Home_AccTime"},
    {149, "Baxis_Home_AccTime"},
    {150, "Axis_VelMode_ACC", "Aaxis_VelMode_ACC"},
    {151, "Baxis_VelMode_ACC"},
    {152, "ENCA"},
    {153, "ENCB"},
    {154, "Cord_A"},
    {155, "Cord_B"},
    {156, "Analog_A"},
    {157, "Analog_B"},
    {158, "CalcREG"},
    {167, "ENCA_Resoultion"},
    {168, "ENCB_Resoultion"},
    {169, "ENCA_RPM"},
    {170, "ENCB_RPM"},
    {171, "Counter1_Value"},
    {172, "Counter2_Value"},
    {173, "Timer1_Value"},
    {174, "Timer2_Value"},
    {175, "Axis_EncSync_NUM", "Aaxis_EncSync_NUM"},
    {176, "Axis_EncSync_DEN", "Aaxis_EncSync_DEN"},
    {177, "Baxis_EncSync_NUM"},
    {178, "Baxis_EncSync_DEN"},
    {179, "Axis_SyncSlope", "Aaxis_SyncSlope"},
    {180, "Baxis_SyncSlope"},
    {181, "Axis_SyncRPM", "Aaxis_SyncRPM"},
    {182, "Baxis_SyncRPM"},  // printed Axis_SyncRPM once more
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
