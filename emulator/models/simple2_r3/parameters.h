// Simple2-R3: the parameter numbers with which a program accesses registers. 159 to 166, and 183 and above,
// are not defined.
#pragma once

#include <array>
#include <iterator>

#include "emulator/device/model.h"
#include "interpreter/simple2/parameter_names.h"

namespace understudy::emulator::models::simple2_r3 {

inline constexpr auto kParameters = [] {
  using interpreter::simple2::kRegisterNames;
  constexpr ParameterRow kRanges[] = {{0, 32, "PROG_MEM{}"},       {32, 32, "PROG_VAR{}"},
                                      {64, 16, "Parms_Pulse{}"},   {80, 16, "Parms_Speed{}"},
                                      {96, 16, "Parms_AccTime{}"}, {112, 16, "Parms_DecTime{}"},
                                      {128, 16, "Parms_mRPM{}"}};
  std::array<ParameterRow, std::size(kRanges) + std::size(kRegisterNames)> rows{};
  std::size_t next = 0;
  for (const ParameterRow& range : kRanges) rows[next++] = range;
  for (const auto& single : kRegisterNames) rows[next++] = {single.number, 1, single.name};
  return rows;
}();

}  // namespace understudy::emulator::models::simple2_r3
