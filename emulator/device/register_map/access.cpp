#include "emulator/device/register_map/access.h"

#include <algorithm>
#include <array>
#include <utility>

namespace understudy::emulator {

namespace {

std::pair<Value, Value> limits_of(Type type) {
  switch (type) {
    case Type::u16: return {0, UINT16_MAX};
    case Type::s16: return {INT16_MIN, INT16_MAX};
    case Type::u32: return {0, UINT32_MAX};
    case Type::s32: return {INT32_MIN, INT32_MAX};
  }
  return {0, 0};
}

Cell cell_of(const Place& place) { return {.argument = place.row->argument, .index = place.index}; }

std::uint32_t present_bits(const RegisterBank& bank, const Place& place) {
  if (place.row->reader != nullptr) {
    return static_cast<std::uint32_t>(place.row->reader(bank, cell_of(place)));
  }
  return bank.image()[static_cast<std::size_t>(place.slot)];
}

std::uint16_t word_of(std::uint32_t bits, Place::Part part) {
  return static_cast<std::uint16_t>(part == Place::Part::high ? bits >> 16 : bits);
}

std::uint32_t with_word(std::uint32_t bits, Place::Part part, std::uint16_t word) {
  switch (part) {
    case Place::Part::whole: return word;
    case Place::Part::low: return (bits & 0xFFFF'0000U) | word;
    case Place::Part::high: return (bits & 0x0000'FFFFU) | (static_cast<std::uint32_t>(word) << 16);
  }
  return bits;
}

/// Reading back what was written misses nothing; reading what the controller should say by itself does.
void mention_if_missed(const RegisterBank& bank, const Place& place) {
  if (!place.row->unmodelled.empty() && place.row->access == Access::read)
    bank.mention_unmodelled(*place.row);
}

/// One register that a request touches, with what the request makes of it.
struct Change {
  Place place;
  std::uint32_t bits = 0;
  bool low = false;  // which words the request brings
  bool high = false;
};

bool complete(const Change& change) {
  return !is_32_bit(change.place.row->type) || (change.low && change.high);
}

bool in_range(const Change& change) {
  const RegisterRow& row = *change.place.row;
  if (!row.ranged) return true;
  const Value value = value_of(change.bits, row.type);
  return value >= row.min && value <= row.max;
}

void bring_into_range(Change& change) {
  const RegisterRow& row = *change.place.row;
  change.bits = static_cast<std::uint32_t>(std::clamp(value_of(change.bits, row.type), row.min, row.max));
}

// A Modbus request brings at most 123 words; programs, scenarios and the control socket at most two.
constexpr std::size_t kMostChanges = 128;

struct Changes {
  std::span<Change> all;
  std::size_t count = 0;
};

/// Calls `act` with room for the changes of this many words. Clearing room for the most would cost more than
/// all the rest of a program's write.
template <typename Act>
Refusal with_room_for(std::size_t words, Act act) {
  if (words <= 2) {
    std::array<Change, 2> few;
    Changes changes{.all = few};
    return act(changes);
  }
  std::array<Change, kMostChanges> many;
  Changes changes{.all = many};
  return act(changes);
}

/// Whether a register may be written what a request makes of it; what the policy lets in is brought into
/// range.
Refusal judge(Change& change, const MapPolicy& policy) {
  if (!complete(change)) {
    if (policy.halves == MapPolicy::Halves::come_whole) return Refusal::no_register;
    // Half a value cannot be judged.
    if (policy.halves == MapPolicy::Halves::may_be_written_alone) return Refusal::none;
  }
  if (in_range(change)) return Refusal::none;
  if (policy.out_of_range == MapPolicy::OutOfRange::refused) return Refusal::bad_value;
  bring_into_range(change);
  return Refusal::none;
}

/// What each register would hold, and whether that may be. Addresses are judged before values. Behind a
/// refusal only those changes are left that are made all the same.
Refusal gather(const RegisterBank& bank, Table table, std::uint16_t first,
               std::span<const std::uint16_t> words, Changes& changes) {
  const MapPolicy& policy = bank.map_policy();
  if (first + words.size() > 65536 || words.size() > kMostChanges) return Refusal::no_register;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const Place place = bank.at(table, static_cast<std::uint16_t>(first + i));
    if (!place) {
      if (policy.unmapped == MapPolicy::Unmapped::refused) return Refusal::no_register;
      continue;
    }
    if (place.row->access == Access::read) {
      if (policy.read_only == MapPolicy::ReadOnly::refused) return Refusal::no_register;
      continue;
    }
    const bool continues = changes.count > 0 && changes.all[changes.count - 1].place.slot == place.slot;
    if (!continues) changes.all[changes.count++] = {.place = place, .bits = present_bits(bank, place)};
    Change& change = changes.all[changes.count - 1];
    change.bits = with_word(change.bits, place.part, words[i]);
    if (place.part == Place::Part::low) change.low = true;
    if (place.part == Place::Part::high) change.high = true;
  }
  for (std::size_t i = 0; i < changes.count; ++i) {
    if (const Refusal refusal = judge(changes.all[i], policy); refusal != Refusal::none) {
      changes.count = policy.partly == MapPolicy::Partly::up_to_the_refused ? i : 0;
      return refusal;
    }
  }
  return Refusal::none;
}

void store(RegisterBank& bank, Change& change) {
  change.bits &= change.place.row->stored_bits;
  bank.image()[static_cast<std::size_t>(change.place.slot)] = change.bits;
}

void take_effect(RegisterBank& bank, const Change& change) {
  const RegisterRow& row = *change.place.row;
  if (change.bits == 0 && !row.acts_on_zero) return;
  if (!row.unmodelled.empty()) bank.mention_unmodelled(row);
  if (row.effect != nullptr) {
    Cell cell = cell_of(change.place);
    cell.high_half = !is_32_bit(row.type) || change.high;
    row.effect(bank, cell, value_of(change.bits, row.type));
  }
  bank.register_written(row, static_cast<std::size_t>(change.place.slot));
}

/// Stores everything, then lets it take effect, both in ascending order; or each register in its turn.
void carry_out(RegisterBank& bank, Changes& changes) {
  const std::span all = std::span(changes.all).first(changes.count);
  if (bank.map_policy().effects == MapPolicy::Effects::one_by_one) {
    for (Change& change : all) {
      store(bank, change);
      take_effect(bank, change);
    }
  } else {
    for (Change& change : all) store(bank, change);
    for (const Change& change : all) take_effect(bank, change);
  }
  bank.registers_written();
}

Refusal words_for(const RegisterBank& bank, const NamedPlace& named, Value value, PreparedWrite& out) {
  const Place& place = named.place;
  const RegisterRow& row = *place.row;
  const bool whole_32 = is_32_bit(row.type) && place.part == Place::Part::whole;
  const bool half = place.part != Place::Part::whole;
  if (named.bit >= 0) {
    if (value != 0 && value != 1) return Refusal::bad_value;
    const Value mask = Value{1} << named.bit;
    const Value whole = read_value(bank, place);
    value = value == 1 ? whole | mask : whole & ~mask;
    if (!half)
      value = value_of(static_cast<std::uint32_t>(value), row.type);  // the sign bit is a bit as well
  }
  // What does not fit the register's words cannot even be sent.
  const auto [lowest, highest] = half ? std::pair<Value, Value>{0, UINT16_MAX} : limits_of(row.type);
  if (value < lowest || value > highest) return Refusal::bad_value;

  const auto bits = static_cast<std::uint32_t>(value);
  const auto low = static_cast<std::uint16_t>(bits);
  const auto high = static_cast<std::uint16_t>(bits >> 16);
  const bool low_first = bank.low_word_first();
  if (whole_32) {
    out = {row.table, place.address(), {low_first ? low : high, low_first ? high : low}, 2};
  } else {
    const bool second_word =
        place.part != Place::Part::whole && (place.part == Place::Part::high) == low_first;
    out = {row.table, static_cast<std::uint16_t>(place.address() + (second_word ? 1 : 0)), {low, 0}, 1};
  }
  return Refusal::none;
}

}  // namespace

Refusal read_words(const RegisterBank& bank, Table table, std::uint16_t first,
                   std::span<std::uint16_t> words) {
  const MapPolicy& policy = bank.map_policy();
  if (first + words.size() > 65536) return Refusal::no_register;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const Place place = bank.at(table, static_cast<std::uint16_t>(first + i));
    if (!place) {
      if (policy.unmapped == MapPolicy::Unmapped::refused) return Refusal::no_register;
      words[i] = 0;
      continue;
    }
    if (place.row->access == Access::write) {
      if (policy.write_only == MapPolicy::WriteOnly::refused) return Refusal::no_register;
      words[i] = 0;
      continue;
    }
    mention_if_missed(bank, place);
    words[i] = word_of(present_bits(bank, place), place.part);
  }
  return Refusal::none;
}

Refusal write_words(RegisterBank& bank, Table table, std::uint16_t first,
                    std::span<const std::uint16_t> words) {
  return with_room_for(words.size(), [&](Changes& changes) {
    const Refusal refusal = gather(bank, table, first, words, changes);
    if (refusal == Refusal::none || (refusal == Refusal::bad_value && changes.count > 0))
      carry_out(bank, changes);
    return refusal;
  });
}

Value read_value(const RegisterBank& bank, const Place& place) {
  if (place.row->access == Access::write) return 0;
  mention_if_missed(bank, place);
  const std::uint32_t bits = present_bits(bank, place);
  if (place.part != Place::Part::whole) return word_of(bits, place.part);
  return value_of(bits, place.row->type);
}

Value read_value(const RegisterBank& bank, const NamedPlace& place) {
  const Value value = read_value(bank, place.place);
  return place.bit < 0 ? value : (value >> place.bit) & 1;
}

Refusal prepare_value(const RegisterBank& bank, const NamedPlace& place, Value value, PreparedWrite& write) {
  if (place.place.row->access == Access::read) return Refusal::no_register;
  if (const Refusal refusal = words_for(bank, place, value, write); refusal != Refusal::none) return refusal;
  return with_room_for(write.count, [&](Changes& changes) {
    return gather(bank, write.table, write.first, std::span(write.words).first(write.count), changes);
  });
}

Refusal write_prepared(RegisterBank& bank, const PreparedWrite& write) {
  return write_words(bank, write.table, write.first, std::span(write.words).first(write.count));
}

Refusal write_value(RegisterBank& bank, const NamedPlace& named, Value value) {
  const Place& place = named.place;
  const RegisterRow& row = *place.row;
  if (named.bit < 0 && place.part == Place::Part::whole) {
    // What its words would come to when they are looked up again: programs write like this all the time.
    if (row.access == Access::read) return Refusal::no_register;
    const auto [lowest, highest] = limits_of(row.type);
    if (value < lowest || value > highest) return Refusal::bad_value;
    if (!bank.has_row(row)) {
      return bank.map_policy().unmapped == MapPolicy::Unmapped::refused ? Refusal::no_register
                                                                        : Refusal::none;
    }
    std::array<Change, 1> one = {
        Change{.place = place, .bits = static_cast<std::uint32_t>(value), .low = true, .high = true}};
    const Refusal refusal = judge(one[0], bank.map_policy());
    if (refusal != Refusal::none) return refusal;
    Changes changes{.all = one, .count = 1};
    carry_out(bank, changes);
    return Refusal::none;
  }
  PreparedWrite write;
  const Refusal refusal = prepare_value(bank, named, value, write);
  return refusal == Refusal::none ? write_prepared(bank, write) : refusal;
}

}  // namespace understudy::emulator
