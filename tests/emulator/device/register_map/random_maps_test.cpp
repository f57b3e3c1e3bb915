// Read requests on random maps: each word and bit is what its row says, whatever its neighbours are and
// however much the request reads at once.
#include <gtest/gtest.h>

#include <array>
#include <deque>
#include <map>
#include <optional>
#include <random>

#include "emulator/device/register_map/access.h"
#include "tests/emulator/device/register_map/toy_device.h"

namespace understudy::emulator {
namespace random_maps_test {

constexpr Firmware kOld = 100;
constexpr Firmware kNew = 200;

Value shown(const ToyDevice&, Cell cell) { return cell.index * 0x01020304 + cell.argument; }
Value shown_bit(const ToyDevice&, Cell cell) { return (cell.index * 5 + cell.argument) / 3 & 1; }
constexpr Value kFieldShows = 5;
Value shown_in_field(const ToyDevice&, Cell) { return kFieldShows; }

constexpr BitField kFields[] = {bits(2, "PLAIN"),
                                bits(4, "SHOWN", 3).reads<shown_in_field, Varies::in_ticks>()};

/// The contents of one address, from its row alone.
struct Spot {
  const RegisterRow* row = nullptr;
  int index = 0;
  int word = 0;  // of a 32-bit register: 1 for its second address
  std::size_t slot = 0;
};

class Drawn {
 public:
  explicit Drawn(std::uint64_t seed) : random_(seed) {
    // At the end of the addresses as well as at their beginning, so that some tables are full and some are
    // not.
    draw_rows(Table::coil);
    draw_rows(Table::discrete);
    draw_rows(Table::holding);
    draw_rows(Table::input);
    policy.unmapped = static_cast<MapPolicy::Unmapped>(below(3));
    policy.write_only = static_cast<MapPolicy::WriteOnly>(below(2));
    policy.read_halves = static_cast<MapPolicy::ReadHalves>(below(2));
    firmware = below(3) == 0 ? kOld : kNew;
    toy.emplace(rows, policy, firmware);
    toy->device.is_low_word_first = below(2) == 0;
    for (std::uint32_t& bits : toy->device.image()) bits = static_cast<std::uint32_t>(random_());
    std::size_t slot = 0;
    for (const RegisterRow& row : rows) {
      for (int i = 0; i < row.count; ++i) {
        for (int word = 0; word < (is_32_bit(row.type) ? 2 : 1); ++word) {
          const int address = row.address + i * row.stride + word;
          ends[row.table] = std::max(ends[row.table], address + 1);
          if (firmware >= row.since) spots[{row.table, address}] = {&row, i, word, slot};
        }
        if (!row.is_view) ++slot;
      }
    }
  }

  int below(int many) { return std::uniform_int_distribution<int>(0, many - 1)(random_); }

  std::uint32_t value_at(const Spot& spot) const {
    const RegisterRow& row = *spot.row;
    const Cell cell{.argument = row.argument, .index = spot.index, .axis = spot.index};
    if (row.reader != nullptr) return static_cast<std::uint32_t>(row.reader(toy->device, cell));
    std::uint32_t value =
        row.is_view ? static_cast<std::uint32_t>(row.factory) : toy->device.image()[spot.slot];
    if (!row.fields.empty()) value = (value & ~0x70U) | static_cast<std::uint32_t>(kFieldShows) << 4;
    return value;
  }

  /// Returns the words or bits of a request; none if it is refused, with the cause.
  Cause answer(Table table, int first, int count, std::vector<std::uint16_t>& words) const {
    for (int i = 0; i < count; ++i) {
      const auto found = spots.find({table, first + i});
      if (first + count > 65536) return Cause::no_register;
      if (found == spots.end()) {
        const bool is_before_the_end = ends.contains(table) && first + i < ends.at(table);
        const bool reads_zero =
            policy.unmapped == MapPolicy::Unmapped::reads_zero ||
            (policy.unmapped == MapPolicy::Unmapped::holes_read_zero && is_before_the_end);
        if (!reads_zero) return Cause::no_register;
        words.push_back(0);
        continue;
      }
      const Spot& spot = found->second;
      if (spot.row->access == Access::write) {
        if (policy.write_only == MapPolicy::WriteOnly::refused) return Cause::write_only;
        words.push_back(0);
        continue;
      }
      const bool is_pair = is_32_bit(spot.row->type);
      const bool is_cut = is_pair && (spot.word == 1 ? i == 0 : i + 1 == count);
      if (is_cut && policy.read_halves == MapPolicy::ReadHalves::come_whole) return Cause::cut_pair;
      const bool is_high = is_pair && (spot.word == 1) == toy->device.is_low_word_first;
      words.push_back(static_cast<std::uint16_t>(is_high ? value_at(spot) >> 16 : value_at(spot)));
    }
    return Cause::none;
  }

  MapPolicy policy;
  Firmware firmware = kNew;
  std::vector<RegisterRow> rows;
  std::optional<Toy> toy;
  std::map<std::pair<Table, int>, Spot> spots;
  std::map<Table, int> ends;
  std::deque<std::string> names;  // rows point to them

 private:
  void draw_rows(Table table) {
    const bool is_at_the_end = below(4) == 0;
    int address = is_at_the_end ? 65536 - 60 - below(8) : below(6);
    for (int number = below(8); number >= 0; --number) {
      names.push_back(std::string(to_string(table)).substr(0, 1) + "_" + std::to_string(rows.size()) + "_{}");
      RegisterRow row = is_table_of_bits(table) ? bit_row(table) : word_row(table);
      row.address = static_cast<std::uint16_t>(address);
      row.name = names.back();
      const int words = is_32_bit(row.type) ? 2 : 1;
      row.times(1 + below(12), words + (below(4) == 0 ? below(3) : 0), 0);
      if (below(8) == 0) row.since_firmware(kNew);
      if (below(10) == 0) row.not_modelled("nothing of it");
      address += row.count * row.stride + (below(3) == 0 ? below(4) : 0);
      if (address > 65536) return;
      rows.push_back(row);
    }
  }

  RegisterRow bit_row(Table table) {
    const Access access = table == Table::coil && below(2) == 0 ? Access::read_write : Access::read;
    RegisterRow row = reg(table, 0, {}, Type::bit, access);
    switch (access == Access::read ? below(4) : below(5) / 4 * 4) {
      case 0: return row;
      case 1: return row.always(below(2));
      case 2: return row.shows<shown_bit, Varies::in_ticks>(below(4));
      case 3: return row.reads<shown_bit, Varies::in_ticks>(below(4));
      default: row.access = Access::write; return row;
    }
  }

  RegisterRow word_row(Table table) {
    constexpr Type kTypes[] = {Type::u16, Type::u16, Type::s16, Type::u32, Type::s32, Type::f32};
    const Access access = table == Table::holding && below(2) == 0 ? Access::read_write : Access::read;
    RegisterRow row = reg(table, 0, {}, kTypes[below(6)], access);
    switch (access == Access::read ? below(6) : below(6) / 5 * 6) {
      case 0: return row;
      case 1: return row.always(below(30000));
      case 2: return row.shows<shown, Varies::in_ticks>(below(4));
      case 3: return row.reads<shown, Varies::in_ticks>(below(4));
      case 4: return row.type == Type::f32 ? row : row.with_bits(kFields);
      case 5: return row.type == Type::f32 ? row : row.shows_bits(kFields);
      default: row.access = Access::write; return row;
    }
  }

  std::mt19937_64 random_;
};

void expect_alike(Drawn& drawn, Table table, int first, int count, std::uint64_t seed) {
  std::vector<std::uint16_t> wanted;
  const Cause cause = drawn.answer(table, first, count, wanted);
  const auto size = static_cast<std::size_t>(count);
  std::vector<std::uint16_t> got(size, 0xAAAA);
  Objection objection;
  if (is_table_of_bits(table)) {
    for (std::uint16_t& bit : wanted) bit &= 1;
    std::vector<std::uint8_t> packed((size + 7) / 8, 0xAA);
    objection = read_bits_request(drawn.toy->device, table, static_cast<std::uint16_t>(first), size, packed);
    for (std::size_t i = 0; i < size; ++i) got[i] = packed[i / 8] >> i % 8 & 1;
    if (!objection && size % 8 != 0) {
      EXPECT_EQ(packed.back() >> size % 8, 0) << "behind the last bit";
    }
  } else {
    objection = read_request(drawn.toy->device, table, static_cast<std::uint16_t>(first), got);
  }
  ASSERT_EQ(objection.cause, cause) << "seed " << seed << ", " << to_string(table) << " " << first << ":"
                                    << count;
  if (cause == Cause::none) {
    ASSERT_EQ(got, wanted) << "seed " << seed << ", " << to_string(table) << " " << first << ":" << count;
  }
}

TEST(RandomMaps, AreReadAsTheirRowsSay) {
  int answered = 0;
  int refused = 0;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    Drawn drawn(seed);
    for (const Table table : {Table::coil, Table::discrete, Table::holding, Table::input}) {
      const auto first = drawn.spots.lower_bound({table, 0});
      const bool is_high = first != drawn.spots.end() && first->first.second > 60000;
      for (int i = 0; i < 150; ++i) {
        const int begin = is_high ? 65536 - 1 - drawn.below(80) : drawn.below(80);
        const int count = 1 + drawn.below(drawn.below(2) == 0 ? 4 : 70);
        expect_alike(drawn, table, begin, count, seed);
        if (HasFatalFailure()) return;
        std::vector<std::uint16_t> words;
        ++(drawn.answer(table, begin, count, words) == Cause::none ? answered : refused);
      }
    }
  }
  EXPECT_GT(answered, 20'000);
  EXPECT_GT(refused, 10'000);
}

}  // namespace random_maps_test
}  // namespace understudy::emulator
