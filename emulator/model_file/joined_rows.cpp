#include "emulator/model_file/joined_rows.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/one_line.h"
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
  if (listed.is_bcd) return "bcd" + width;
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
  if (whole.type != again.type || whole.is_bcd != again.is_bcd)
    return other("type", type_text(whole), type_text(again));
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

/// Returns the access to a register of which hosts read some bits and write others.
Access access_to_all(Access one, Access other) {
  const bool is_read = one != Access::write || other != Access::write;
  const bool is_written = one != Access::read || other != Access::read;
  return is_read && is_written ? Access::read_write : is_read ? Access::read : Access::write;
}

/// Returns the value of some bits after power-up. Their own range cannot be kept.
Value default_of_part(const ListRow& row, const ListedRegister& only, const BitName& part) {
  const Value highest = (Value{1} << part.width) - 1;
  if (only.factory < 0 || only.factory > highest) {
    row.fail(Column::factory, quoted(std::to_string(only.factory)) + " does not fit into " +
                                  std::to_string(part.width) + (part.width == 1 ? " bit" : " bits") +
                                  "; expected 0 to " + std::to_string(highest));
  }
  if (only.ranged && (only.min > 0 || only.max < highest)) {
    const Column column = row.has(Column::values)  ? Column::values
                          : row.has(Column::range) ? Column::range
                                                   : Column::max;
    row.remark(
        "range of bits", column,
        "the range of " + quoted(part.name) + " is ignored, because only whole registers have a range");
  }
  return only.factory;
}

std::string access_text(Access access) {
  return access == Access::read ? "R" : access == Access::write ? "W" : "R/W";
}

/// The access and the persistence belong to the whole register, so all its bits have them.
void join_access(const DescribedTwice& both) {
  ListedRegister& whole = both.whole;
  const std::string name = "register " + std::to_string(whole.address) + " is ";
  const Column column = both.row.has(Column::access) ? Column::access : Column::writable;
  if (both.row.has(column)) {
    const Access before = whole.access;
    whole.access = access_to_all(before, both.again.access);
    if (whole.access != before || whole.access != both.again.access) {
      both.row.remark("access of bits", column,
                      quoted(both.row.text(column)) + " differs from other rows of the register: " + name +
                          access_text(whole.access) + " as a whole");
    }
  }
  if (!both.row.has(Column::persistent) || both.again.persistent == whole.persistent) return;
  whole.persistent = true;
  both.row.remark("persistence of bits", Column::persistent,
                  quoted(both.row.text(Column::persistent)) +
                      " differs from other rows of the register: " + name + "persistent as a whole");
}

/// Returns the lowest bit of a part in a register with two words. The row names the word by its address.
int bit_in_pair(const DescribedTwice& both, const BitName& part) {
  constexpr int kWord = 16;
  const ListedRegister& whole = both.whole;
  const bool is_first = both.again.address == whole.address;
  const bool low_is_first = whole.order.words == WordOrder::Words::low_first;
  const int bit = part.bit + (is_first == low_is_first ? 0 : kWord);
  if (whole.order.words == WordOrder::Words::as_the_model) {
    both.row.remark("bits of pairs", Column::address,
                    quoted(both.row.text(Column::address)) + " is bit " + std::to_string(bit) + " of " +
                        quoted(whole.name) + ", because the high word comes first");
  }
  return bit;
}

}  // namespace

ListedRegister register_of_part(const ListRow& row, const ListedRegister& only, const BitName& part) {
  return {.table = only.table,
          .address = only.address,
          .name = "Register_" + std::to_string(only.address),
          .access = only.access,
          .persistent = only.persistent,
          .factory = default_of_part(row, only, part) << part.bit,
          .bits = {part},
          .since = only.since};
}

void join_part(const DescribedTwice& both, BitName part, bool is_made_of_parts) {
  ListedRegister& whole = both.whole;
  const ListRow& row = both.row;
  if (whole.type == Type::f32)
    row.fail(Column::address, quoted(whole.name) + " is a real number; expected a register with bits");
  const auto value = static_cast<std::uint32_t>(default_of_part(row, both.again, part));
  if (is_32_bit(whole.type)) part.bit = bit_in_pair(both, part);
  auto all = whole.bits;
  all.push_back(part);
  try {
    require_apart(all);
  } catch (const std::invalid_argument& error) {
    row.fail(Column::address, error.what());
  }
  if (row.has(Column::factory)) {
    const std::uint32_t mask = bits(part.bit, "", part.width).mask();
    const auto before = static_cast<std::uint32_t>(whole.factory);
    const std::uint32_t after = (before & ~mask) | value << part.bit;
    if (!is_made_of_parts && both.first_row.has(Column::factory) && after != before) {
      row.fail(Column::factory, quoted(row.text(Column::factory)) + " contradicts the default of " +
                                    quoted(whole.name) + " in line " + std::to_string(both.first_row.line()) +
                                    "; expected rows that agree");
    }
    whole.factory = value_of(after, whole.type);
  }
  whole.bits = std::move(all);
  if (is_made_of_parts) whole.since = std::min(whole.since, both.again.since);
  join_access(both);
}

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
