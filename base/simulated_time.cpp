#include "base/simulated_time.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace understudy {

namespace {

struct Unit {
  std::string_view name;
  std::int64_t nanoseconds;
};

// If one name ends with another, the longer comes first ("ms" before "s").
constexpr std::array<Unit, 6> kUnits{{{"ns", 1},
                                      {"us", 1'000},
                                      {"ms", 1'000'000},
                                      {"min", 60'000'000'000},
                                      {"h", 3'600'000'000'000},
                                      {"s", 1'000'000'000}}};

}  // namespace

std::optional<SimTime> parse_duration(std::string_view text) {
  for (const Unit& unit : kUnits) {
    if (!text.ends_with(unit.name)) continue;
    std::string_view digits = text.substr(0, text.size() - unit.name.size());
    while (!digits.empty() && digits.back() == ' ') digits.remove_suffix(1);
    std::int64_t whole = 0;
    std::int64_t fraction_ns = 0;
    std::int64_t place_ns = unit.nanoseconds;
    bool point = false;
    bool any_digit = false;
    for (const char c : digits) {
      if (c == '.' && !point) {
        point = true;
        continue;
      }
      if (c < '0' || c > '9') return std::nullopt;
      any_digit = true;
      if (!point) {
        // A number above a century is a typing error, and would overflow.
        if (whole > 4'000'000'000'000'000'000 / 10 / unit.nanoseconds) return std::nullopt;
        whole = whole * 10 + (c - '0');
      } else {
        if (place_ns % 10 != 0) {
          if (c != '0') return std::nullopt;  // finer than a nanosecond
          continue;
        }
        place_ns /= 10;
        fraction_ns += (c - '0') * place_ns;
      }
    }
    if (!any_digit) return std::nullopt;
    return SimTime{whole * unit.nanoseconds + fraction_ns};
  }
  return std::nullopt;
}

std::string format_duration(SimTime duration) {
  const std::int64_t ns = duration.count();
  const std::int64_t magnitude = ns < 0 ? -ns : ns;
  const Unit unit = magnitude >= 1'000'000'000 || magnitude == 0 ? Unit{"s", 1'000'000'000}
                    : magnitude >= 1'000'000                     ? Unit{"ms", 1'000'000}
                    : magnitude >= 1'000                         ? Unit{"us", 1'000}
                                                                 : Unit{"ns", 1};
  std::string text = std::to_string(magnitude / unit.nanoseconds);
  if (const std::int64_t rest = magnitude % unit.nanoseconds; rest != 0) {
    std::string digits = std::to_string(rest + unit.nanoseconds).substr(1);
    while (digits.back() == '0') digits.pop_back();
    text += "." + digits;
  }
  return (ns < 0 ? "-" : "") + text + std::string(unit.name);
}

}  // namespace understudy
