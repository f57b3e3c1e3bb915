// Evenly spaced values of a range, as whole counts of its finest digit, and as text again: 0.5 to 2.5, 1ms to
// 20ms, 500mV to 2V. Exact: nothing is rounded.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace understudy::emulator::play {

/// A number with or without a unit, as somebody wrote it.
struct Amount {
  enum class Kind : std::uint8_t { number, duration, voltage } kind = Kind::number;
  std::int64_t digits = 0;  // without the point
  int decimals = 0;         // behind it
  std::int64_t unit = 1;    // nanoseconds or millivolts
};
/// "12", "-0.25", "1.5s", "300mV"; nothing if it is something else, or has more than 15 digits.
std::optional<Amount> parse_amount(std::string_view text);
/// "a number", "a duration", "a voltage".
std::string_view kind_name(Amount::Kind kind);

/// What amounts of one kind are counted in.
class AmountScale {
 public:
  explicit AmountScale(Amount::Kind kind) : kind_(kind) {}
  Amount::Kind kind() const { return kind_; }
  /// Makes it fine enough for this one, which is of its kind.
  void include(const Amount& amount);
  /// Nothing for what 64 bits do not hold, or what is not a whole number of nanoseconds or millivolts.
  std::optional<std::int64_t> count_of(const Amount& amount) const;
  /// One of the last digit that was included.
  std::int64_t finest() const { return finest_; }
  /// As a parameter's value: "0.50", "3.05s".
  std::string text_of(std::int64_t count) const;

 private:
  Amount::Kind kind_;
  int decimals_ = 0;         // of a number
  std::int64_t finest_ = 0;  // 0: nothing was included
};

}  // namespace understudy::emulator::play
