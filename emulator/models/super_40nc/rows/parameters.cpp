// The parameters by their numbers on the panel (《基本參數說明》, 《X(Y/Z/U)軸參數說明》). They are the
// registers D9. The ranges and factory values here are those of the panel, even if the table of D9 differs.
#include "emulator/models/super_40nc/rows/parameters.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/device/model.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/row_words.h"
#include "emulator/models/super_40nc/rows/terminals.h"

namespace understudy::emulator::models::super_40nc {

namespace {

struct PanelParameter {
  int number;
  int d9;  // for axes, the number added to D9x00; 0 for a base parameter without a printed register
  std::int32_t min;
  std::int32_t max;
  std::string_view unit;
  std::int32_t factory;           // as on the panel
  std::string_view meaning = {};  // if it has no register; otherwise, the register's meaning applies
};

// clang-format off
constexpr PanelParameter kBase[] = {
    {0, 9007, 2000, 9999, "ms", 2000},
    {1, 0, 0, 1, "", 1, "buzzer of the panel"},
    {2, 0, 0, 255, "min", 5, "backlight of the panel"},
    {3, 9026, 0, 99999999, "", 1234},
    {4, 9028, 0, 9999, "ms", 0},
    {5, 9029, 0, 9999, "ms", 0},
    {10, 9004, 1, 9999999, "0.001 mm/s", 10000},
    {11, 9012, 1, 32767, "multiplier pps", 1},
    {12, 9013, 1, 32767, "multiplier pps", 1},
    {13, 9014, 1, 10000, "ms", 500},
    {14, 9015, 1, 10000, "ms", 500},
    {15, 9021, 0, 1, "", 0},
    {16, 9025, 0, 111111, "", 0},
    {20, 9006, 0, 1, "", 0},
    {21, 9003, 0, 4, "axes", 0},
    {22, 9011, 1, 10000, "RPM", 5000},
    {23, 9016, 0, 2, "", 2},
    {24, 9017, 0, 1, "", 0},
    {25, 9018, 0, 1, "", 0},
    {26, 9019, 0, 1, "", 0},
};

constexpr PanelParameter kOfAxis[] = {
    {0, 0, 1, 3, "", 1},
    {1, 56, 0, 4095, "pulse", 0},
    {2, 66, 1, 10000, "ms", 500},
    {3, 67, 1, 10000, "ms", 500},
    {4, 68, 1, 32767, "multiplier pps", 1},
    {5, 69, 1, 32767, "multiplier pps", 1},
    {6, 70, 200, 131072, "PPR", 4000},
    {10, 71, 1, 131072, "", 1},
    {11, 72, 1, 131072, "", 1},
    {12, 75, 1, 10000, "RPM", 3000},
    {13, 76, 1, 10000, "RPM", 1},
    {14, 78, 1, 10000, "RPM", 500},
    {15, 73, 0, 1, "", 0},
    {16, 90, -999999, 999999, "0.001 mm", 0},
    {20, 21, 0, 12, "", 4},
    {21, 79, 1, 10000, "RPM", 500},
    {22, 80, 1, 10000, "RPM", 20},
    {23, 81, 0, 1, "", 1},
    {24, 82, -9999999, 9999999, "0.001 mm", 0},
    {25, 93, 0, 999, "pulse", 5},
    {26, 77, 1, 10000, "RPM", 500},
    {30, 83, -9999999, 9999999, "0.001 mm", 1000},
    {31, 22, 0, 15, "", 0},
    {32, 2, 0, 1, "", 0},
    {33, 63, 0, 2, "", 1},
    {34, 64, 0, 2, "", 1},
    {35, 85, -9999999, 9999999, "0.001 mm", 9999999},
    {36, 86, -9999999, 9999999, "0.001 mm", -9999999},
    {40, 15, 0, 3, "", 2},
    {41, 16, 0, 1, "", 2},
    {42, 87, 0, 31, "0.001 mm", 1},
    {43, 88, 0, 31, "0.001 mm", 10},
    {44, 89, 0, 31, "0.001 mm", 100},
    {45, 91, 0, 9999, "ms", 0},
    {46, 92, 0, 9999, "ms", 0},
    {50, 99, 0, 4, "", 0},
    {51, 84, 0, 4, "", 0},
    {52, 97, 0, 1, "", 0},
    {53, 94, 1, 10000, "RPM", 50},
    {54, 95, 1, 10000, "RPM", 100},
    {55, 96, 1, 10000, "RPM", 250},
    {56, 98, 0, 111111111, "", 0},
    {60, 74, 0, 1, "", 0},
    {61, 65, 0, 3, "digits", 2},
};
// clang-format on

/// A register of a row.
struct RegisterOfRow {
  const RegisterRow& row;
  int index;
};

RegisterOfRow register_of(int d9) {
  const int address = data_address(d9);
  for (const RegisterRow& row : kRegisters) {
    const int beyond = address - row.address;
    const bool is_it = row.table == Table::holding && beyond >= 0 && beyond % row.stride == 0 &&
                       beyond / row.stride < row.count;
    if (is_it) return {.row = row, .index = beyond / row.stride};
  }
  throw std::logic_error("D" + std::to_string(d9) + " is not a register");
}

/// Returns the meaning of the parameter. The meaning does not contain the axis, because the number identifies
/// it.
std::string_view meaning_of_parameter(const RegisterOfRow& found) {
  const RegisterRow& row = found.row;
  return (row.meanings.empty() ? row.meaning : row.meanings[static_cast<std::size_t>(found.index)])
      .in_english;
}

struct MadeParameters {
  std::vector<std::string> texts;
  std::vector<NamedParameterRow> rows;
};

MadeParameters make_parameters() {
  constexpr std::size_t kCount = std::size(kBase) + kAxisCount * std::size(kOfAxis);
  constexpr std::size_t kTextsOfEach = 3;
  MadeParameters made;
  made.texts.reserve(kTextsOfEach * kCount);  // rows point into this vector
  const auto keep = [&](std::string text) -> std::string_view {
    return made.texts.emplace_back(std::move(text));
  };
  const auto add = [&](const PanelParameter& row, std::string_view letter, int d9) {
    const bool has_register = d9 != 0;
    const std::int32_t factory =
        has_register ? static_cast<std::int32_t>(register_of(d9).row.factory) : row.factory;
    const std::string_view in_words = has_register ? meaning_of_parameter(register_of(d9)) : row.meaning;
    const std::string_view meaning =
        factory == row.factory
            ? in_words
            : keep(std::string(in_words) + "; on the panel's page " + std::to_string(row.factory));
    made.rows.push_back({.number = keep(std::string(letter) + std::to_string(row.number)),
                         .name = has_register ? keep("D" + std::to_string(d9)) : std::string_view("-"),
                         .persistent = has_register,
                         .min = std::to_string(row.min),
                         .max = std::to_string(row.max),
                         .unit = row.unit,
                         .factory = std::to_string(factory),
                         .meaning = meaning,
                         .not_implemented = has_register ? "" : "the panel's own"});
  };
  for (const PanelParameter& row : kBase) add(row, "C", row.d9);
  for (int axis = 0; axis < kAxisCount; ++axis) {
    for (const PanelParameter& row : kOfAxis) {
      add(row, kAxisNames[static_cast<std::size_t>(axis)], 9100 + 100 * axis + row.d9);
    }
  }
  return made;
}

}  // namespace

std::span<const NamedParameterRow> named_parameters() {
  static const MadeParameters made = make_parameters();
  return made.rows;
}

}  // namespace understudy::emulator::models::super_40nc
