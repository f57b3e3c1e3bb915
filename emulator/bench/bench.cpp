#include "emulator/bench/bench.h"

#include <cmath>

#include "emulator/parse_real.h"

namespace understudy::emulator {

std::optional<std::int64_t> parse_baud_tolerance(std::string_view text) {
  constexpr double kMostPercent = 10;
  constexpr double kPpmOfPercent = 10'000;
  if (!text.ends_with('%')) return std::nullopt;
  text.remove_suffix(1);
  const auto percent = parse_real(text);
  if (!percent || !(*percent >= 0 && *percent <= kMostPercent)) return std::nullopt;
  return std::llround(*percent * kPpmOfPercent);
}

int find_terminal(const Model& model, std::string_view name) {
  for (std::size_t i = 0; i < model.terminals.size(); ++i) {
    if (model.terminals[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

int find_axis(const Model& model, std::string_view name) {
  for (std::size_t i = 0; i < model.axes.size(); ++i) {
    if (model.axes[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace understudy::emulator
