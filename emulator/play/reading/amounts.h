// Evenly spaced values in a range, both as integer counts of the finest digit and as text: 0.5 to 2.5, 1ms to
// 20ms, 500mV to 2V. They are exact; nothing is rounded.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace understudy::emulator::play {

/// A number with or without a unit, as it was written.
struct Amount {
  enum class Kind : std::uint8_t { number, duration, voltage } kind = Kind::number;
  std::int64_t digits = 0;  // all digits, without the decimal point
  int decimals = 0;         // the number of decimal places
  std::int64_t unit = 1;    // nanoseconds or millivolts
};
/// Parses "12", "-0.25", "1.5s" or "300mV". Returns nothing for any other text, or for more than 15 digits.
std::optional<Amount> parse_amount(std::string_view text);
/// Returns "a number", "a duration" or "a voltage".
std::string_view kind_name(Amount::Kind kind);

/// The scale for counting amounts of one kind.
class AmountScale {
 public:
  explicit AmountScale(Amount::Kind kind) : kind_(kind) {}
  Amount::Kind kind() const { return kind_; }
  /// Refines the scale so that it can represent an amount of the same kind.
  void include(const Amount& amount);
  /// Returns nothing if the count does not fit in 64 bits, or if the amount is not a whole number of
  /// nanoseconds or millivolts.
  std::optional<std::int64_t> count_of(const Amount& amount) const;
  /// Returns the count of one unit in the last included digit.
  std::int64_t finest() const { return finest_; }
  /// Returns the text of a parameter's value: "0.50", "3.05s".
  std::string text_of(std::int64_t count) const;

 private:
  Amount::Kind kind_;
  int decimals_ = 0;         // for numbers only
  std::int64_t finest_ = 0;  // 0: no amount was included
};

}  // namespace understudy::emulator::play
