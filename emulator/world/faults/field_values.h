// Converts fields of faults to and from text. Errors are NameErrors: "nth: what is wrong; expected ...".
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/simulated_time.h"

namespace understudy::emulator::world {

std::int64_t field_number(std::string_view name, const std::string& text, std::int64_t lowest,
                          std::int64_t highest);
/// Parses "3", "3..7", or "3.." (up to `highest`). Returns the first and the last number.
std::pair<std::int64_t, std::int64_t> field_span(std::string_view name, const std::string& text,
                                                 std::int64_t lowest, std::int64_t highest);
/// Parses "on", "off", 0 or 1.
std::int64_t field_level(std::string_view name, const std::string& text);
/// Parses a duration between `shortest` and a year.
SimTime field_duration(std::string_view name, const std::string& text, SimTime shortest);
/// Parses one to 256 bytes: "FF 00" or "ff00".
std::vector<std::uint8_t> field_bytes(std::string_view name, const std::string& text);
/// Parses "1%" or "0.25%" into a fraction of kAlways.
std::int64_t field_chance(std::string_view name, const std::string& text);
/// Returns the index of the text in a list of words.
std::size_t field_word(std::string_view name, const std::string& text,
                       std::span<const std::string_view> words);

std::string hex_text(const std::vector<std::uint8_t>& bytes);  // "FF00"
std::string chance_text(std::int64_t chance);

}  // namespace understudy::emulator::world
