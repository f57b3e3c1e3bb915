#include "emulator/box/capture/log_time.h"

#include <array>
#include <charconv>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/simulated_time.h"

namespace understudy::emulator::box {

namespace {

constexpr std::array<std::string_view, 12> kMonths{"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                   "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Reads a text from left to right.
class Cursor {
 public:
  explicit Cursor(std::string_view text) : text_(text) {}
  std::size_t at() const { return at_; }
  bool is_at_digit() const { return at_ < text_.size() && is_digit(text_[at_]); }
  bool take(char c) {
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  bool take_one_of(std::string_view any) {
    if (at_ >= text_.size() || any.find(text_[at_]) == std::string_view::npos) return false;
    ++at_;
    return true;
  }
  std::string_view take_digits(std::size_t max) {
    const std::size_t begin = at_;
    while (is_at_digit() && at_ - begin < max) ++at_;
    return text_.substr(begin, at_ - begin);
  }
  std::optional<int> take_number(std::size_t min, std::size_t max) {
    const std::string_view digits = take_digits(max);
    if (digits.size() < min || is_at_digit()) return {};
    int number = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), number);
    return number;
  }
  std::string_view rest() const { return text_.substr(at_); }
  void skip(std::size_t count) { at_ += count; }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

SimTime fraction_of(std::string_view digits) {
  std::string nine(digits.substr(0, 9));
  nine.resize(9, '0');
  std::int64_t nanoseconds = 0;
  std::from_chars(nine.data(), nine.data() + nine.size(), nanoseconds);
  return SimTime{nanoseconds};
}

/// "14:03:07.125" or "14:03:07,125"
std::optional<SimTime> take_clock(Cursor& text) {
  const auto hours = text.take_number(1, 2);
  if (!hours || !text.take(':')) return {};
  const auto minutes = text.take_number(2, 2);
  if (!minutes || !text.take(':')) return {};
  const auto seconds = text.take_number(2, 2);
  if (!seconds) return {};
  SimTime time = std::chrono::hours(*hours) + std::chrono::minutes(*minutes) + std::chrono::seconds(*seconds);
  Cursor before = text;
  if (text.take_one_of(".,")) {
    const std::string_view digits = text.take_digits(18);
    if (digits.empty()) text = before;
    time += fraction_of(digits);
  }
  return time;
}

std::optional<SimTime> days_since_1970(int year, int month, int day) {
  const std::chrono::year_month_day date{std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  // Nanoseconds of 64 bits end in 2262.
  if (!date.ok() || year > 2261) return {};
  return std::chrono::sys_days(date).time_since_epoch();
}

std::optional<SimTime> take_date(Cursor& text) {
  for (std::size_t month = 0; month < kMonths.size(); ++month) {
    if (!text.rest().starts_with(kMonths[month])) continue;
    text.skip(3);
    while (text.take(' ')) {
    }
    const auto day = text.take_number(1, 2);
    // Such dates have no year.
    return day ? days_since_1970(2000, static_cast<int>(month) + 1, *day) : std::nullopt;
  }
  const auto year = text.take_number(4, 4);
  if (!year || !text.take_one_of("-/")) return {};
  const auto month = text.take_number(2, 2);
  if (!month || !text.take_one_of("-/")) return {};
  const auto day = text.take_number(2, 2);
  return day ? days_since_1970(*year, *month, *day) : std::nullopt;
}

}  // namespace

std::optional<SimTime> parse_log_seconds(std::string_view text) {
  constexpr std::size_t kMaxWholeSeconds = 10;
  const std::size_t point = text.find('.');
  const std::string_view whole = text.substr(0, point);
  const std::string_view fraction = point == std::string_view::npos ? "" : text.substr(point + 1);
  std::int64_t seconds = 0;
  const auto [end, error] = std::from_chars(whole.data(), whole.data() + whole.size(), seconds);
  if (whole.empty() || whole.size() > kMaxWholeSeconds || error != std::errc() ||
      end != whole.data() + whole.size() || seconds < 0 || seconds > 9'000'000'000 ||
      fraction.find_first_not_of("0123456789") != std::string_view::npos)
    return {};
  return std::chrono::seconds(seconds) + fraction_of(fraction);
}

std::optional<LogTime> take_log_time(std::string_view text) {
  Cursor dated(text);
  if (const auto date = take_date(dated); date && dated.take_one_of(" T")) {
    const auto clock = take_clock(dated);
    if (!clock) return {};
    dated.take('Z');
    return LogTime{.at = *date + *clock, .size = dated.at()};
  }
  Cursor clock_only(text);
  if (const auto clock = take_clock(clock_only))
    return LogTime{.at = *clock, .size = clock_only.at(), .is_of_day = true};
  Cursor number(text);
  number.take_digits(18);
  Cursor after = number;
  if (after.take('.') && after.is_at_digit()) {
    after.take_digits(18);
    number = after;
  }
  // A date or clock that is none is not a number, either.
  if (Cursor next = number; next.take_one_of("-:/") && next.is_at_digit()) return {};
  const auto seconds = parse_log_seconds(text.substr(0, number.at()));
  if (!seconds) return {};
  return LogTime{.at = *seconds, .size = number.at()};
}

}  // namespace understudy::emulator::box
