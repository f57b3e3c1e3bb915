#include "emulator/device/register_map/register_names.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include "emulator/device/register_map/row.h"

namespace understudy::emulator {

namespace {

constexpr std::string_view kHole = "{}";

/// Hashes the beginning of a name with FNV-1a, character by character.
constexpr std::uint32_t begin_hash(Table table) { return 2166136261U + static_cast<std::uint32_t>(table); }
constexpr std::uint32_t hash_on(std::uint32_t hash, char next) {
  return (hash ^ static_cast<unsigned char>(next)) * 16777619U;
}

std::string_view half_of(const RegisterRow& row, RegisterPart part) {
  return part == RegisterPart::whole ? std::string_view()
         : part == RegisterPart::low ? row.low_half
                                     : row.high_half;
}

/// Returns the number in a text like "7". Rejects "07" and "+7".
std::optional<int> number_in(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  const std::string_view digits = text.substr(number < 0 ? 1 : 0);
  if (digits.size() > 1 && digits.front() == '0') return std::nullopt;
  return number;
}

/// Returns the index of the row's register that has this label between the two ends of the pattern.
std::optional<int> index_of_label(const RegisterRow& row, std::string_view label) {
  if (!row.labels.empty()) {
    const auto found = std::find(row.labels.begin(), row.labels.end(), label);
    if (found == row.labels.end()) return std::nullopt;
    return static_cast<int>(found - row.labels.begin());
  }
  const auto number = number_in(label);
  if (!number) return std::nullopt;
  const std::int64_t beyond_first = std::int64_t{*number} - row.first_number;
  const std::int64_t index = row.number_step == 0 ? 0 : beyond_first / row.number_step;
  const bool is_one = index >= 0 && index < row.count && index * row.number_step == beyond_first;
  return is_one ? std::optional<int>(static_cast<int>(index)) : std::nullopt;
}

}  // namespace

RegisterNames::RegisterNames(std::span<const RegisterRow> rows) : rows_(rows) {
  patterns_.reserve(rows_.size());
  for (std::size_t number = 0; number < rows_.size(); ++number) {
    const RegisterRow& row = rows_[number];
    for (const bool is_alias : {false, true}) {
      const std::string_view text = is_alias ? row.alias : row.name;
      if (text.empty()) continue;
      const std::string_view beginning = text.substr(0, text.find(kHole));
      longest_ = std::max(longest_, beginning.size());
      std::uint32_t hash = begin_hash(row.table);
      for (const char c : beginning) hash = hash_on(hash, c);
      Pattern pattern{.hash = hash, .row = static_cast<std::uint16_t>(number), .is_alias = is_alias};
      patterns_.push_back(pattern);
      if (!is_32_bit(row.type)) continue;
      for (const RegisterPart half : {RegisterPart::low, RegisterPart::high}) {
        pattern.part = half;
        patterns_.push_back(pattern);
      }
    }
  }
  buckets_.resize(std::bit_ceil(patterns_.size() + 1));
  for (std::size_t i = patterns_.size(); i-- > 0;) {
    std::uint32_t& first = buckets_[patterns_[i].hash & (buckets_.size() - 1)];
    patterns_[i].next = first;
    first = static_cast<std::uint32_t>(i + 1);
  }
}

std::string_view RegisterNames::text_of(const Pattern& pattern) const {
  const RegisterRow& row = rows_[pattern.row];
  return pattern.is_alias ? row.alias : row.name;
}

/// Returns the index of the register to which a name refers, or nothing if the name does not match the
/// pattern. `begins_with` is the length of the beginning that has the pattern's hash.
std::optional<int> RegisterNames::index_of(const Pattern& pattern, std::size_t begins_with,
                                           std::string_view name) const {
  const RegisterRow& row = rows_[pattern.row];
  const std::string_view text = text_of(pattern);
  const std::size_t hole = text.find(kHole);
  const std::string_view beginning = text.substr(0, hole);
  if (beginning.size() != begins_with || !name.starts_with(beginning)) return std::nullopt;
  std::string_view rest = name.substr(begins_with);
  const std::string_view half = half_of(row, pattern.part);
  if (!rest.ends_with(half)) return std::nullopt;
  rest.remove_suffix(half.size());
  if (hole == std::string_view::npos) return rest.empty() ? std::optional<int>(0) : std::nullopt;
  const std::string_view end = text.substr(hole + kHole.size());
  if (!rest.ends_with(end)) return std::nullopt;
  rest.remove_suffix(end.size());
  return index_of_label(row, rest);
}

/// Calls `act` with each match until it returns true.
template <typename Act>
void RegisterNames::for_each_match(Table table, std::string_view name, Act act) const {
  std::uint32_t hash = begin_hash(table);
  for (std::size_t length = 0;; ++length) {
    for (std::uint32_t at = buckets_[hash & (buckets_.size() - 1)]; at != 0;) {
      const Pattern& pattern = patterns_[at - 1];
      at = pattern.next;
      if (pattern.hash != hash || rows_[pattern.row].table != table) continue;
      const auto index = index_of(pattern, length, name);
      if (index && act(Named{.row = pattern.row, .index = *index, .part = pattern.part})) return;
    }
    if (length == std::min(name.size(), longest_)) return;
    hash = hash_on(hash, name[length]);
  }
}

std::optional<RegisterNames::Named> RegisterNames::find(Table table, std::string_view name) const {
  std::optional<Named> found;
  for_each_match(table, name, [&](const Named& named) {
    found = named;
    return true;
  });
  return found;
}

void RegisterNames::for_each(
    const std::function<void(const Named& named, const std::string& name)>& act) const {
  // The patterns of a row are neighbours.
  for (std::size_t first = 0; first < patterns_.size();) {
    const std::size_t number = patterns_[first].row;
    const RegisterRow& row = rows_[number];
    std::size_t end = first;
    while (end < patterns_.size() && patterns_[end].row == number) ++end;
    for (int index = 0; index < row.count; ++index) {
      for (std::size_t i = first; i < end; ++i) {
        const std::string_view text = text_of(patterns_[i]);
        // Without "{}", only the first register has this name.
        if (index > 0 && text.find(kHole) == std::string_view::npos) continue;
        act({.row = number, .index = index, .part = patterns_[i].part},
            name_of(row, index, text) + std::string(half_of(row, patterns_[i].part)));
      }
    }
    first = end;
  }
}

void RegisterNames::require_distinct() const {
  for_each([&](const Named& named, const std::string& name) {
    int count = 0;
    for_each_match(rows_[named.row].table, name, [&](const Named&) { return ++count > 1; });
    if (count > 1) throw std::logic_error("register map: two registers are named " + name);
  });
}

std::string RegisterNames::name_of(const RegisterRow& row, int index, std::string_view pattern) {
  const std::size_t hole = pattern.find(kHole);
  if (hole == std::string_view::npos) return std::string(pattern);
  const auto label = static_cast<std::size_t>(index);
  return std::string(pattern.substr(0, hole)) +
         (row.labels.empty() ? std::to_string(row.first_number + index * row.number_step)
                             : std::string(row.labels[label])) +
         std::string(pattern.substr(hole + kHole.size()));
}

namespace {

const Meaning& meaning_at(const RegisterRow& row, int index) {
  return row.meanings.empty() ? row.meaning : row.meanings[static_cast<std::size_t>(index)];
}

}  // namespace

std::string meaning_of(const RegisterRow& row, int index) {
  const std::string text = RegisterNames::name_of(row, index, meaning_at(row, index).in_english);
  if (row.axis_names.empty() || text.empty()) return text;
  return std::string(row.axis_names[static_cast<std::size_t>(index)]) + ": " + text;
}

std::string heading_of(const RegisterRow& row, int index) {
  return RegisterNames::name_of(row, index, meaning_at(row, index).in_the_manual);
}

}  // namespace understudy::emulator
