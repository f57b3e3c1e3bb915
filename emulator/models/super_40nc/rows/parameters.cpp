// The parameters by the numbers that the panel shows (《基本參數說明》, 《X(Y/Z/U)軸參數說明》). They are the
// registers D9; ranges and factory values here are the panel's, even where the table of D9 differs.
#include "emulator/models/super_40nc/rows/parameters.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
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
  int d9;  // for axes: added to D9x00; 0 for a base parameter without a printed register
  std::int32_t least;
  std::int32_t most;
  std::string_view unit;
  std::int32_t factory;  // as on the panel
  std::string_view meaning;
};

// clang-format off
constexpr PanelParameter kBase[] = {
    {0, 9007, 2000, 9999, "ms", 2000, "logo"},
    {1, 0, 0, 1, "", 1, "buzzer of the panel"},
    {2, 0, 0, 255, "min", 5, "backlight of the panel"},
    {3, 9026, 0, 99999999, "", 1234, "password"},
    {4, 9028, 0, 9999, "ms", 0, "time of the finish signal Y8"},
    {5, 9029, 0, 9999, "ms", 0, "time of the end signal Y9"},
    {10, 9004, 1, 9999999, "0.001 mm/s", 10000, "default feed"},
    {11, 9012, 1, 32767, "multiplier pps", 1, "S section of acceleration"},
    {12, 9013, 1, 32767, "multiplier pps", 1, "S section of deceleration"},
    {13, 9014, 1, 10000, "ms", 500, "acceleration time"},
    {14, 9015, 1, 10000, "ms", 500, "deceleration time"},
    {15, 9021, 0, 1, "", 0, "lock of the edit page"},
    {16, 9025, 0, 111111, "", 0, "lock of the main page"},
    {20, 9006, 0, 1, "", 0, "0 absolute, 1 relative"},
    {21, 9003, 0, 4, "axes", 0, "axes of the common coordinate system"},
    {22, 9011, 1, 10000, "RPM", 5000, "speed that acceleration times refer to"},
    {23, 9016, 0, 2, "", 2, "arc plane: 0 XY, 1 XZ, 2 YZ"},
    {24, 9017, 0, 1, "", 0, "swaps CW and CCW in XY"},
    {25, 9018, 0, 1, "", 0, "swaps CW and CCW in XZ"},
    {26, 9019, 0, 1, "", 0, "swaps CW and CCW in YZ"},
};

constexpr PanelParameter kOfAxis[] = {
    {0, 0, 1, 3, "", 1, "direction of the motor"},
    {1, 56, 0, 4095, "pulse", 0, "backlash"},
    {2, 66, 1, 10000, "ms", 500, "acceleration time"},
    {3, 67, 1, 10000, "ms", 500, "deceleration time"},
    {4, 68, 1, 32767, "multiplier pps", 1, "S section of acceleration"},
    {5, 69, 1, 32767, "multiplier pps", 1, "S section of deceleration"},
    {6, 70, 200, 131072, "PPR", 4000, "pulses per revolution"},
    {10, 71, 1, 131072, "", 1, "multiplier of positions, CMX"},
    {11, 72, 1, 131072, "", 1, "divisor of positions, CDV"},
    {12, 75, 1, 10000, "RPM", 3000, "highest speed"},
    {13, 76, 1, 10000, "RPM", 1, "start speed"},
    {14, 78, 1, 10000, "RPM", 500, "default speed"},
    {15, 73, 0, 1, "", 0, "0 absolute, 1 relative"},
    {16, 90, -999999, 999999, "0.001 mm", 0, "low-speed distance of MRK"},
    {20, 21, 0, 12, "", 4, "home mode"},
    {21, 79, 1, 10000, "RPM", 500, "home speed"},
    {22, 80, 1, 10000, "RPM", 20, "creep speed of homing, speed of backlash"},
    {23, 81, 0, 1, "", 1, "home direction: 0 positive, 1 negative"},
    {24, 82, -9999999, 9999999, "0.001 mm", 0, "position at home"},
    {25, 93, 0, 999, "pulse", 5, "step away from the DOG"},
    {26, 77, 1, 10000, "RPM", 500, "speed of the return to zero"},
    {30, 83, -9999999, 9999999, "0.001 mm", 1000, "offset from home"},
    {31, 22, 0, 15, "", 0, "number of C signals minus 1"},
    {32, 2, 0, 1, "", 0, "DOG: 0 NO, 1 NC"},
    {33, 63, 0, 2, "", 1, "+EL: 0 unused, 1 NO, 2 NC"},
    {34, 64, 0, 2, "", 1, "-EL: 0 unused, 1 NO, 2 NC"},
    {35, 85, -9999999, 9999999, "0.001 mm", 9999999, "positive soft limit"},
    {36, 86, -9999999, 9999999, "0.001 mm", -9999999, "negative soft limit"},
    {40, 15, 0, 3, "", 2, "hand-wheel: 0 AB x1, 1 AB x2, 2 AB x4, 3 up and down"},
    {41, 16, 0, 1, "", 2, "hand-wheel reversed"},
    {42, 87, 0, 31, "0.001 mm", 1, "hand-wheel *1"},
    {43, 88, 0, 31, "0.001 mm", 10, "hand-wheel *10"},
    {44, 89, 0, 31, "0.001 mm", 100, "hand-wheel *100"},
    {45, 91, 0, 9999, "ms", 0, "time of the finish signal"},
    {46, 92, 0, 9999, "ms", 0, "time of the end signal"},
    {50, 99, 0, 4, "", 0, "order of HOME, 0 never"},
    {51, 84, 0, 4, "", 0, "order of ZERO, 0 never"},
    {52, 97, 0, 1, "", 0, "jog keys swapped"},
    {53, 94, 1, 10000, "RPM", 50, "low jog speed"},
    {54, 95, 1, 10000, "RPM", 100, "medium jog speed"},
    {55, 96, 1, 10000, "RPM", 250, "high jog speed"},
    {56, 98, 0, 111111111, "", 0, "lock of the manual page"},
    {60, 74, 0, 1, "", 0, "ZERO SET by key"},
    {61, 65, 0, 3, "digits", 2, "decimals"},
};
// clang-format on

std::int32_t factory_of(int d9) {
  const int address = data_address(d9);
  for (const RegisterRow& row : kRegisters) {
    const int beyond = address - row.address;
    const bool is_it = row.table == Table::holding && beyond >= 0 && beyond % row.stride == 0 &&
                       beyond / row.stride < row.count;
    if (is_it) return static_cast<std::int32_t>(row.factory);
  }
  return 0;
}

struct MadeParameters {
  std::vector<std::string> texts;
  std::vector<NamedParameterRow> rows;
};

MadeParameters make_parameters() {
  constexpr std::size_t kCount = std::size(kBase) + kAxisCount * std::size(kOfAxis);
  constexpr std::size_t kTextsOfEach = 3;
  MadeParameters made;
  made.texts.reserve(kTextsOfEach * kCount);  // rows point into it
  const auto keep = [&](std::string text) -> std::string_view {
    return made.texts.emplace_back(std::move(text));
  };
  const auto add = [&](const PanelParameter& row, std::string_view letter, int d9) {
    const bool has_register = d9 != 0;
    const std::int32_t factory = has_register ? factory_of(d9) : row.factory;
    const std::string_view meaning =
        factory == row.factory
            ? row.meaning
            : keep(std::string(row.meaning) + "; on the panel's page " + std::to_string(row.factory));
    made.rows.push_back({.number = keep(std::string(letter) + std::to_string(row.number)),
                         .name = has_register ? keep("D" + std::to_string(d9)) : std::string_view("-"),
                         .persistent = has_register,
                         .least = std::to_string(row.least),
                         .most = std::to_string(row.most),
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
