// What the fields of a fault say as text, and back. Complaints are NameErrors: "nth: what is wrong; expected
// ...".
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
/// "3", "3..7", "3.." (then `highest` is the last): first and last.
std::pair<std::int64_t, std::int64_t> field_span(std::string_view name, const std::string& text,
                                                 std::int64_t lowest, std::int64_t highest);
/// "on", "off", 0, 1.
std::int64_t field_level(std::string_view name, const std::string& text);
/// From `shortest` to a year.
SimTime field_duration(std::string_view name, const std::string& text, SimTime shortest);
/// "FF 00" or "ff00": one to 256 bytes.
std::vector<std::uint8_t> field_bytes(std::string_view name, const std::string& text);
/// "1%", "0.25%", in kAlways.
std::int64_t field_chance(std::string_view name, const std::string& text);
/// One of some words: its number.
std::size_t field_word(std::string_view name, const std::string& text,
                       std::span<const std::string_view> words);

std::string hex_text(const std::vector<std::uint8_t>& bytes);  // "FF00"
std::string chance_text(std::int64_t chance);

}  // namespace understudy::emulator::world
