// The meanings of the error numbers in replies.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "emulator/models/slim/setup.h"

namespace understudy::emulator::models::slim {

/// Indexed by error number (rules/errors.h).
inline constexpr std::array<std::string_view, 14> kErrorWords{
    "",
    "this is not a valid command: check its spelling and operands",
    "a value or an index is out of range",
    "this command is not allowed in this place: typed, in a program, or while a program runs",
    "that axis is not assigned, or its module belongs to an axis",
    "PN50 does not list this module",
    "the chain is paused and accepts no moves",
    "PR2 or PR3 differs between the axes of the command",
    "the buffer of moves, or the program, is full",
    "the servo is off (HOFF)",
    "the following error is too large",
    "overload",
    "the temperature is too high",
    "there is no such line or label, or the stack is full"};

/// Returns the meaning of a reply such as "ERR 2", or an empty text for any other line.
inline std::string_view meaning_of_reply(const Setup& setup, std::string_view line) {
  constexpr std::string_view kBegin = "ERR ";
  if (!line.starts_with(kBegin)) return {};
  std::size_t number = 0;
  for (const char digit : line.substr(kBegin.size())) {
    if (digit < '0' || digit > '9' || number >= kErrorWords.size()) return {};
    number = number * 10 + static_cast<std::size_t>(digit - '0');
  }
  if (setup.code_of(Error::range) != static_cast<int>(Error::range))
    return "it is refused (by the choice error_codes, every error has the number 1)";
  return number < kErrorWords.size() ? kErrorWords[number] : std::string_view();
}

}  // namespace understudy::emulator::models::slim
