#include "emulator/box/capture/log_pattern.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/box/capture/capture.h"
#include "emulator/box/capture/log_time.h"

namespace understudy::emulator::box {

namespace {

using Field = LogPattern::Field;

constexpr std::array kFields{
    std::pair{std::string_view("{time}"), Field::time},     std::pair{std::string_view("{us}"), Field::us},
    std::pair{std::string_view("{sample}"), Field::sample}, std::pair{std::string_view("{dir}"), Field::dir},
    std::pair{std::string_view("{name}"), Field::name},     std::pair{std::string_view("{hex}"), Field::hex},
    std::pair{std::string_view("{bytes}"), Field::bytes},   std::pair{std::string_view("{*}"), Field::any}};

/// Which of the two is the host is found by content. Longer words come before their beginnings.
constexpr std::array kDirections{std::pair{std::string_view("request"), Side::one},
                                 std::pair{std::string_view("response"), Side::other},
                                 std::pair{std::string_view("received"), Side::other},
                                 std::pair{std::string_view("recv"), Side::other},
                                 std::pair{std::string_view("read"), Side::other},
                                 std::pair{std::string_view("reply"), Side::other},
                                 std::pair{std::string_view("sent"), Side::one},
                                 std::pair{std::string_view("send"), Side::one},
                                 std::pair{std::string_view("write"), Side::one},
                                 std::pair{std::string_view("out"), Side::one},
                                 std::pair{std::string_view("in"), Side::other},
                                 std::pair{std::string_view("tx"), Side::one},
                                 std::pair{std::string_view("rx"), Side::other},
                                 std::pair{std::string_view("->"), Side::one},
                                 std::pair{std::string_view("<-"), Side::other},
                                 std::pair{std::string_view(">"), Side::one},
                                 std::pair{std::string_view("<"), Side::other}};

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r'; }
bool is_hex(char c) { return std::isxdigit(static_cast<unsigned char>(c)) != 0; }
bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::uint8_t hex_value(std::string_view digits) {
  unsigned value = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  return static_cast<std::uint8_t>(value);
}

std::size_t take_number(std::string_view text, std::uint64_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() ? static_cast<std::size_t>(end - text.data()) : 0;
}

std::size_t take_direction(std::string_view text, Side& side) {
  for (const auto& [word, meant] : kDirections) {
    if (text.size() < word.size()) continue;
    const bool is_equal = std::equal(word.begin(), word.end(), text.begin(), [](char a, char b) {
      return a == static_cast<char>(std::tolower(static_cast<unsigned char>(b)));
    });
    const bool ends = text.size() == word.size() || !is_word(word.back()) || !is_word(text[word.size()]);
    if (!is_equal || !ends) continue;
    side = meant;
    return word.size();
  }
  return 0;
}

/// "[01][03]" or "<01><03>"
std::size_t take_bracketed(std::string_view text, LogLine& line) {
  constexpr std::size_t kSize = 4;
  std::size_t at = 0;
  const char open = text.empty() ? ' ' : text[0];
  if (open != '[' && open != '<') return 0;
  const char close = open == '[' ? ']' : '>';
  while (at + kSize <= text.size() && text[at] == open && is_hex(text[at + 1]) && is_hex(text[at + 2]) &&
         text[at + 3] == close) {
    line.bytes.push_back(hex_value(text.substr(at + 1, 2)));
    at += kSize;
  }
  line.side = open == '[' ? Side::one : Side::other;
  return at;
}

/// A space at the end may be missing in the line.
std::size_t take_spaces(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::find_if_not(text, is_space) - text.begin());
}

}  // namespace

std::size_t take_hex(std::string_view text, CapturedBytes& bytes) {
  std::size_t end = 0;
  std::size_t at = 0;
  while (true) {
    while (at < text.size() &&
           (is_space(text[at]) || std::string_view(",:;-[]<>").find(text[at]) != std::string_view::npos))
      ++at;
    const bool has_prefix =
        text.size() - at > 2 && (text[at] == '0' || text[at] == '\\') && (text[at + 1] | 0x20) == 'x';
    const std::size_t first = at + (has_prefix ? 2 : 0);
    std::size_t last = first;
    while (last < text.size() && is_hex(text[last])) ++last;
    const std::size_t count = last - first;
    const bool is_whole = last == text.size() || !is_word(text[last]);
    if (!is_whole || count == 0 || (has_prefix ? count > 2 : count % 2 != 0)) return end;
    if (has_prefix) {
      bytes.push_back(hex_value(text.substr(first, count)));
    } else {
      for (std::size_t i = first; i < last; i += 2) bytes.push_back(hex_value(text.substr(i, 2)));
    }
    at = last;
    end = last;
  }
}

LogPattern::LogPattern(std::string_view text, bool needs_bytes) {
  bool has_bytes = false;
  for (std::size_t at = 0; at < text.size();) {
    const std::string_view rest = text.substr(at);
    const auto* const field =
        std::ranges::find_if(kFields, [&](const auto& row) { return rest.starts_with(row.first); });
    if (field != kFields.end()) {
      tokens_.push_back({.field = field->second});
      has_bytes = has_bytes || field->second == Field::hex || field->second == Field::bytes;
      at += field->first.size();
      continue;
    }
    // A brace that begins a name is a mistake; `{"ph"` of JSON is not.
    if (rest[0] == '{' && rest.size() > 1 && std::isalpha(static_cast<unsigned char>(rest[1])) != 0)
      throw std::invalid_argument(
          quoted(rest.substr(0, rest.find('}') + 1)) +
          " is not a field; expected {time}, {us}, {sample}, {dir}, {name}, {hex}, {bytes} or {*}");
    if (is_space(rest[0])) {
      if (tokens_.empty() || tokens_.back().field != Field::space) tokens_.push_back({.field = Field::space});
    } else if (!tokens_.empty() && tokens_.back().field == Field::literal) {
      tokens_.back().literal += rest[0];
    } else {
      tokens_.push_back({.field = Field::literal, .literal = std::string(1, rest[0])});
    }
    ++at;
  }
  if (needs_bytes && !has_bytes)
    throw std::invalid_argument(quoted(text) + " has no bytes; expected {hex}, as in '{time} {dir} {hex}'");
}

bool LogPattern::match_from(std::size_t token, std::string_view text, LogLine& line) const {
  if (token == tokens_.size()) return text.empty();
  const Token& now = tokens_[token];
  const auto continues = [&](std::size_t taken) {
    return taken != 0 && match_from(token + 1, text.substr(taken), line);
  };
  switch (now.field) {
    case Field::literal: return text.starts_with(now.literal) && continues(now.literal.size());
    case Field::space: return continues(take_spaces(text));
    case Field::time: {
      const auto time = take_log_time(text);
      if (!time) return false;
      line.at = time->at;
      line.is_time_of_day = time->is_of_day;
      return continues(time->size);
    }
    case Field::us: {
      constexpr double kLatest = 9e15;
      double us = 0;
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), us);
      if (error != std::errc() || !(us >= 0 && us < kLatest)) return false;
      line.at = SimTime{std::llround(us * 1000)};
      return continues(static_cast<std::size_t>(end - text.data()));
    }
    case Field::sample: {
      std::uint64_t number = 0;
      const std::size_t taken = take_number(text, number);
      line.sample = number;
      return continues(taken);
    }
    case Field::dir: return continues(take_direction(text, line.side));
    case Field::hex: {
      line.bytes.clear();
      return continues(take_hex(text, line.bytes));
    }
    case Field::bytes: {
      line.bytes.clear();
      return continues(take_bracketed(text, line));
    }
    case Field::name:
    case Field::any: {
      for (std::size_t size = 0; size <= text.size(); ++size) {
        if (!match_from(token + 1, text.substr(size), line)) continue;
        if (now.field == Field::name) line.name = std::string(text.substr(0, size));
        return true;
      }
      return false;
    }
  }
  return false;
}

std::optional<LogLine> LogPattern::match(std::string_view line) const {
  while (!line.empty() && is_space(line.back())) line.remove_suffix(1);
  // What is longer is no line of a log; trying all lengths for {*} would take long, too.
  constexpr std::size_t kLongestLine = 2048;
  if (line.size() > kLongestLine) return {};
  LogLine found;
  if (!match_from(0, line, found)) return {};
  return found;
}

}  // namespace understudy::emulator::box
