#include "emulator/model_file/joined_rows.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/model_file/list_row.h"
#include "emulator/model_file/list_words.h"
#include "emulator/model_file/register_list.h"
#include "emulator/model_file/row_values.h"
#include "emulator/models/imported/description.h"

namespace understudy::emulator::model_file {

using models::imported::BitName;
using models::imported::ListedRegister;

namespace {

constexpr int kByte = 8;

/// Returns true if a name contains a word for the high half, false if it contains a word for the low half,
/// and nothing otherwise.
std::optional<bool> says_high(const std::string& name) {
  constexpr std::array<std::string_view, 8> kHigh{"high", "hi", "h", "upper", "msb", "msw", "hb", "hw"};
  constexpr std::array<std::string_view, 8> kLow{"low", "lo", "l", "lower", "lsb", "lsw", "lb", "lw"};
  bool is_high = name.find("高") != std::string::npos;
  bool is_low = name.find("低") != std::string::npos;
  const std::string text = lower(name) + " ";
  std::string word;
  for (const char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      word += c;
      continue;
    }
    is_high |= std::find(kHigh.begin(), kHigh.end(), word) != kHigh.end();
    is_low |= std::find(kLow.begin(), kLow.end(), word) != kLow.end();
    word.clear();
  }
  return is_high == is_low ? std::nullopt : std::optional(is_high);
}

bool has_byte(const ListRow& row) {
  const auto& type = row.type();
  return type && type->kind == TypeMeaning::Kind::number && type->bits == kByte;
}

bool reads_only(Access access) { return access == Access::read; }
bool writes_only(Access access) { return access == Access::write; }

std::string type_text(const ListedRegister& listed) {
  if (listed.type == Type::bit) return "bit";
  const std::string width = std::to_string(width_of(listed.type));
  return (listed.type == Type::f32 ? "f" : is_signed(listed.type) ? "s" : "u") + width;
}

std::string range_of(const ListedRegister& listed) {
  return value_text(listed.min, listed.type) + ".." + value_text(listed.max, listed.type);
}

std::string other(std::string_view fact, const std::string& there, const std::string& here) {
  return "another " + std::string(fact) + " (" + there + ", here " + here + ")";
}

/// Returns the first difference between two descriptions of a register that contradict each other.
std::string difference(const DescribedTwice& both) {
  const ListedRegister& whole = both.whole;
  const ListedRegister& again = both.again;
  const auto both_have = [&](Column column) { return both.first_row.has(column) && both.row.has(column); };
  if (whole.type != again.type) return other("type", type_text(whole), type_text(again));
  if (!(whole.order == again.order)) return "a different order of words or bytes";
  if (!whole.unit.empty() && !again.unit.empty() && whole.unit != again.unit)
    return other("unit", whole.unit, again.unit);
  if (whole.ranged && again.ranged && (whole.min != again.min || whole.max != again.max))
    return other("range", range_of(whole), range_of(again));
  if (both_have(Column::factory) && whole.factory != again.factory)
    return other("default", value_text(whole.factory, whole.type), value_text(again.factory, again.type));
  if (both_have(Column::persistent) && whole.persistent != again.persistent) return "a different persistence";
  if (both_have(Column::since) && whole.since != again.since)
    return other("firmware", version_text(whole.since), version_text(again.since));
  if (both.has_other_name() && !whole.alias.empty() && whole.alias != again.name)
    return "two other names (" + whole.name + " and " + whole.alias + ")";
  return "";
}

/// Returns the bit names of both rows. Throws std::invalid_argument if the rows have bits in common.
std::vector<BitName> joined_bits(const ListedRegister& whole, const ListedRegister& again) {
  std::vector<BitName> all = whole.bits;
  for (const BitName& bit : again.bits) {
    const bool is_known = std::any_of(all.begin(), all.end(), [&](const BitName& one) {
      return one.name == bit.name && one.bit == bit.bit && one.width == bit.width;
    });
    if (!is_known) all.push_back(bit);
  }
  require_apart(all);
  return all;
}

Access joined_access(Access first, Access second) { return first == second ? first : Access::read_write; }

}  // namespace

bool are_bytes(const DescribedTwice& both) {
  const bool is_read_and_written = (reads_only(both.whole.access) && writes_only(both.again.access)) ||
                                   (writes_only(both.whole.access) && reads_only(both.again.access));
  return has_byte(both.first_row) && has_byte(both.row) && both.has_other_name() && !is_read_and_written;
}

std::string join_bytes(const DescribedTwice& both) {
  if (!both.whole.bits.empty()) return "named bits";
  const auto first = says_high(both.first_row.text(Column::name));
  const auto second = says_high(both.row.text(Column::name));
  if (!first && !second)
    return "8 bits too, and the names do not show which byte is high (10.b8 and 10.b0 do)";
  const bool is_high = second.value_or(!first.value_or(false));
  if (first.value_or(!is_high) == is_high) return "the same byte, according to the two names";
  const auto byte_of = [](const std::string& name, bool is_the_high_one) {
    return BitName{.name = as_word(name), .bit = is_the_high_one ? kByte : 0, .width = kByte};
  };
  constexpr Value kMask = 0xFF;
  const auto shifted = [](Value value, bool is_the_high_one) {
    return (value & kMask) << (is_the_high_one ? kByte : 0);
  };
  ListedRegister joined{
      .table = both.whole.table,
      .address = both.whole.address,
      .name = "Register_" + std::to_string(both.whole.address),
      .access = joined_access(both.whole.access, both.again.access),
      .persistent = both.whole.persistent || both.again.persistent,
      .factory = shifted(both.whole.factory, !is_high) | shifted(both.again.factory, is_high),
      .bits = {byte_of(both.whole.name, !is_high), byte_of(both.again.name, is_high)},
      .since = std::min(both.whole.since, both.again.since)};
  if (joined.bits.front().name == joined.bits.back().name) return "a name with the same letters and digits";
  both.whole = std::move(joined);
  return "";
}

bool is_word_of(const DescribedTwice& both) {
  const bool is_word = both.again.type == Type::u16 || both.again.type == Type::s16;
  const bool is_served = both.whole.access == both.again.access || both.whole.access == Access::read_write;
  return is_word && is_served && is_32_bit(both.whole.type) && both.has_other_name() &&
         says_high(both.row.text(Column::name)).has_value();
}

std::string join_rows(const DescribedTwice& both) {
  if (std::string fact = difference(both); !fact.empty()) return fact;
  ListedRegister& whole = both.whole;
  const ListedRegister& again = both.again;
  try {
    whole.bits = joined_bits(whole, again);
  } catch (const std::invalid_argument&) {
    return "different names for the bits";
  }
  whole.access = joined_access(whole.access, again.access);
  if (whole.unit.empty()) whole.unit = again.unit;
  if (!whole.ranged && again.ranged) {
    whole.min = again.min;
    whole.max = again.max;
    whole.ranged = true;
  }
  const bool is_stated = both.first_row.has(Column::factory);
  if (both.row.has(Column::factory) || (!is_stated && again.ranged)) whole.factory = again.factory;
  whole.persistent |= again.persistent;
  if (!both.first_row.has(Column::since)) whole.since = again.since;
  if (both.has_other_name()) whole.alias = again.name;
  return "";
}

}  // namespace understudy::emulator::model_file
