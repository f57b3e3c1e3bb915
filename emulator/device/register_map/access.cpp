#include "emulator/device/register_map/access.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/simulated_time.h"
#include "base/text/parse_real.h"
#include "emulator/device/register_map/present.h"
#include "emulator/device/register_map/refusal.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/device/register_map/wire_words.h"

namespace understudy::emulator {

namespace {

std::uint32_t with_word(std::uint32_t bits, Place::Part part, std::uint16_t word) {
  switch (part) {
    case Place::Part::whole: return word;
    case Place::Part::low: return (bits & 0xFFFF'0000U) | word;
    case Place::Part::high: return (bits & 0x0000'FFFFU) | (static_cast<std::uint32_t>(word) << 16);
  }
  return bits;
}

/// A register that a request affects, and the value that the request writes to it.
struct Change {
  Place place;
  std::uint32_t bits = 0;
  bool low = false;  // true if the request contains the low word
  bool high = false;
};

bool complete(const Change& change) {
  return !is_32_bit(change.place.row->type) || (change.low && change.high);
}

bool in_range(const Change& change) {
  const RegisterRow& row = *change.place.row;
  return is_in_range(row, value_of(change.bits, row.type));
}

void bring_into_range(Change& change) {
  const RegisterRow& row = *change.place.row;
  const Value value = value_of(change.bits, row.type);
  if (row.type == Type::f32) {
    change.bits = static_cast<std::uint32_t>(real_of(value) > real_of(row.max) ? row.max : row.min);
  } else {
    change.bits = static_cast<std::uint32_t>(std::clamp(value, row.min, row.max));
  }
}

// A Modbus request has at most 123 words or 1,968 bits. Programs, scenarios and the control socket write at
// most two words.
constexpr std::size_t kManyWords = 128;
constexpr std::size_t kMaxWords = 2000;

struct Changes {
  std::span<Change> all;
  std::size_t count = 0;
};

/// Calls `act` with room for the changes of this many words. Always clearing the maximum would take longer
/// than the rest of a program's write.
template <typename Act>
auto with_room_for(std::size_t words, Act act) {
  if (words <= 2) {
    std::array<Change, 2> few;
    Changes changes{.all = few};
    return act(changes);
  }
  if (words <= kManyWords) {
    std::array<Change, kManyWords> many;
    Changes changes{.all = many};
    return act(changes);
  }
  std::vector<Change> bits(std::min(words, kMaxWords));
  Changes changes{.all = bits};
  return act(changes);
}

/// If a low half is written alone and this sets the whole value, extends its sign.
void extend_sign(Change& change) {
  if (!is_32_bit(change.place.row->type) || !change.low || change.high) return;
  change.bits = static_cast<std::uint32_t>(static_cast<std::int16_t>(change.bits & 0xFFFF));
  change.high = true;
}

/// Checks the value that a request writes to a register, and clamps it if the policy requires that.
Objection judge(Change& change, const MapPolicy& policy) {
  if (policy.halves == MapPolicy::Halves::low_gives_the_sign) extend_sign(change);
  // Half of a value cannot be checked.
  if (!complete(change) && policy.halves == MapPolicy::Halves::may_be_written_alone) return {};
  if (policy.out_of_range == MapPolicy::OutOfRange::stored || in_range(change)) return {};
  if (policy.out_of_range == MapPolicy::OutOfRange::refused) {
    return objection(Refusal::bad_value, Cause::out_of_range, change.place.address());
  }
  bring_into_range(change);
  return {};
}

/// Collects the changes to all registers that the request can write, and checks its addresses.
Objection gather_addresses(const RegisterBank& bank, const RegisterRequest& request, Changes& changes) {
  const MapPolicy& policy = bank.map_policy();
  const bool low_first = bank.low_word_first();
  const auto words = request.words;
  const bool pairs_whole = policy.halves == MapPolicy::Halves::come_whole;
  if (request.first + words.size() > 65536 || words.size() > kMaxWords) {
    return objection(Refusal::no_register, Cause::no_register, request.first);
  }
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::size_t address = request.first + i;
    const Place place = bank.at(request.table, static_cast<std::uint16_t>(address), low_first);
    if (!place) {
      if (!swallows_writes_to_nothing(bank)) {
        return objection(Refusal::no_register, Cause::no_register, address);
      }
      continue;
    }
    if (place.row->message != nullptr) return objection(Refusal::no_register, Cause::cut_message, address);
    if (place.row->access == Access::read) {
      if (policy.read_only == MapPolicy::ReadOnly::refused) {
        return objection(Refusal::no_register, Cause::read_only, address);
      }
      continue;
    }
    if (pairs_whole && is_cut(place, i == 0, i + 1 == words.size(), low_first)) {
      return objection(policy.cut_pair, Cause::cut_pair, address);
    }
    const bool continues = changes.count > 0 && changes.all[changes.count - 1].place.is_same_register(place);
    if (!continues) changes.all[changes.count++] = {.place = place, .bits = present_bits(bank, place)};
    Change& change = changes.all[changes.count - 1];
    change.bits = with_word(change.bits, place.part, wire_word(*place.row, words[i]));
    if (place.part == Place::Part::low) change.low = true;
    if (place.part == Place::Part::high) change.high = true;
  }
  return {};
}

/// Collects the changes. Checks addresses first, then values. After a refusal, `changes` contains only those
/// that must still be made.
Objection gather(const RegisterBank& bank, const RegisterRequest& request, Changes& changes) {
  Objection refused = gather_addresses(bank, request, changes);
  if (!refused) refused = admission(bank, request, Checked::addresses);
  const MapPolicy& policy = bank.map_policy();
  for (std::size_t i = 0; i < changes.count && !refused; ++i) {
    refused = judge(changes.all[i], policy);
    if (!refused) continue;
    const bool is_partly_done =
        refused.refusal == Refusal::bad_value && policy.partly == MapPolicy::Partly::up_to_the_refused;
    changes.count = is_partly_done ? i : 0;
    return refused;
  }
  if (!refused) refused = admission(bank, request, Checked::everything);
  if (refused) changes.count = 0;
  return refused;
}

/// Returns the window in which a request begins, or an empty place if there is none.
Place window_at(const RegisterBank& bank, Table table, std::uint16_t first) {
  const Place place = bank.at(table, first);
  return place && place.row->message != nullptr ? place : Place{};
}

/// Passes a complete message to the device, or refuses it. All its words must be in the window.
Objection write_message(RegisterBank& bank, const Place& window, const RegisterRequest& request) {
  const RegisterRow& row = *window.row;
  const auto max = static_cast<std::size_t>(row.count - window.index);
  const bool is_part = window.index != 0;
  if (is_part && !bank.takes_parts()) {
    return objection(Refusal::no_register, Cause::cut_message, request.first);
  }
  if (request.count > max) {
    return objection(Refusal::no_register, Cause::cut_message, request.first + max);
  }
  if (const Objection refused = admission(bank, request, Checked::addresses)) return refused;
  if (!is_part && request.count < static_cast<std::size_t>(row.min_words)) {
    return objection(Refusal::bad_value, Cause::bad_message, request.first);
  }
  if (const Objection refused = admission(bank, request, Checked::everything)) return refused;
  const DeviceAnswer answer = row.message(bank, cell_of(window), request.words);
  if (answer.refusal == Refusal::none) bank.registers_written();
  Objection refused = objection_of(answer, request);
  if (refused.cause == Cause::no_register) refused.cause = Cause::bad_message;
  return refused;
}

/// Executes a write outside windows that the device handles as one message.
Objection write_whole(RegisterBank& bank, const RegisterRequest& request) {
  if (const Objection refused = admission(bank, request, Checked::addresses)) return refused;
  if (const Objection refused = admission(bank, request, Checked::everything)) return refused;
  const DeviceAnswer answer = bank.take_whole(request);
  if (answer.refusal == Refusal::none) bank.registers_written();
  return objection_of(answer, request);
}

void store(RegisterBank& bank, Change& change) {
  change.bits &= change.place.row->stored_bits;
  if (change.place.row->is_view) return;
  bank.image()[static_cast<std::size_t>(change.place.slot)] = change.bits;
}

void take_effect(RegisterBank& bank, const Change& change) {
  const RegisterRow& row = *change.place.row;
  if (change.bits == 0 && !row.acts_on_zero) return;
  if (!row.not_implemented.empty()) bank.warn_not_implemented(row);
  if (row.effect != nullptr) {
    Cell cell = cell_of(change.place);
    cell.high_half = !is_32_bit(row.type) || change.high;
    row.effect(bank, cell, value_of(change.bits, row.type));
  }
  if (!row.is_view) bank.register_written(row, static_cast<std::size_t>(change.place.slot));
}

/// Performs the changes in ascending order. Depending on the policy, either stores all of them before
/// applying their effects, or does both for each register in turn.
void carry_out(RegisterBank& bank, Changes& changes) {
  std::span all = std::span(changes.all).first(changes.count);
  const auto diverted = std::remove_if(
      all.begin(), all.end(), [&](const Change& change) { return bank.diverts(change.place, change.bits); });
  all = all.first(static_cast<std::size_t>(diverted - all.begin()));
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

/// Returns the new value of the register, or of its half, after a value is written to the named part. Returns
/// nothing if the value does not fit.
std::optional<Value> merged(const RegisterBank& bank, const NamedPlace& named, Value value) {
  const Place& place = named.place;
  const bool half = place.part != Place::Part::whole;
  if (named.bit >= 0) {
    const Value max = (Value{1} << named.width) - 1;
    if (value < 0 || value > max) return std::nullopt;
    const Value whole = read_value(bank, place);
    value = (whole & ~(max << named.bit)) | value << named.bit;
    // A write can set the sign bit like any other bit.
    if (!half) value = value_of(static_cast<std::uint32_t>(value), place.row->type);
  }
  // A value that does not fit in the register's words cannot be sent at all.
  const auto [lowest, highest] = half ? limits_of(Type::u16) : limits_of(place.row->type);
  if (value < lowest || value > highest) return std::nullopt;
  return value;
}

Refusal words_for(const RegisterBank& bank, const NamedPlace& named, Value wanted, PreparedWrite& out) {
  const Place& place = named.place;
  const RegisterRow& row = *place.row;
  const bool whole_32 = is_32_bit(row.type) && place.part == Place::Part::whole;
  const auto value = merged(bank, named, wanted);
  if (!value) return Refusal::bad_value;

  const auto bits = static_cast<std::uint32_t>(*value);
  const bool low_first = bank.low_word_first();
  if (whole_32) {
    out = {row.table, place.address(), wire_words(row, bits, low_first), 2};
  } else {
    const bool second_word = is_second_word(place, low_first);
    const std::uint16_t word = wire_word(row, static_cast<std::uint16_t>(bits));
    out = {row.table, static_cast<std::uint16_t>(place.address() + (second_word ? 1 : 0)), {word, 0}, 1};
  }
  return Refusal::none;
}

}  // namespace

Objection write_request(RegisterBank& bank, Table table, std::uint16_t first,
                        std::span<const std::uint16_t> words, bool is_single) {
  const RegisterRequest request{
      .table = table, .first = first, .count = words.size(), .words = words, .is_single = is_single};
  if (const Place window = window_at(bank, table, first)) return write_message(bank, window, request);
  if (bank.takes_whole(request)) return write_whole(bank, request);
  return with_room_for(words.size(), [&](Changes& changes) {
    const Objection refused = gather(bank, request, changes);
    if (!refused || changes.count > 0) carry_out(bank, changes);
    return refused;
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
  return place.bit < 0 ? value : value >> place.bit & ((Value{1} << place.width) - 1);
}

Tick next_change(const RegisterBank& bank, const NamedPlace& named, Tick done) {
  const RegisterRow& row = *named.place.row;
  return row.next_change == nullptr ? kNever : row.next_change(bank, cell_of(named.place), done);
}

double number_of(const NamedPlace& place, Value value) {
  if (!place.is_real()) return static_cast<double>(value);
  // Returns 0.1 for the nearest single-precision number, so the value looks as the user wrote it.
  const double real = static_cast<double>(real_of(value));
  return parse_real(value_text(value, Type::f32)).value_or(real);
}

std::optional<Value> value_of_number(const NamedPlace& place, double number) {
  if (place.is_real()) {
    const auto real = static_cast<float>(number);
    if (std::isinf(real) && !std::isinf(number)) return std::nullopt;
    return value_of_real(real);
  }
  constexpr double kMax = 1e15;  // larger doubles are all whole numbers, and do not fit in any register
  if (!(std::abs(number) <= kMax) || number != std::trunc(number)) return std::nullopt;
  return static_cast<Value>(number);
}

std::string why_not_writable(const NamedPlace& named) {
  const Place& place = named.place;
  const RegisterRow& row = *place.row;
  if (row.message != nullptr) return "accepts only complete messages; expected a Modbus request";
  if (row.access == Access::read || place.part == Place::Part::whole)
    return "cannot be written; it is read-only";
  return "cannot be written alone; expected the whole " + RegisterMap::name_of(row, place.index);
}

Refusal prepare_value(const RegisterBank& bank, const NamedPlace& place, Value value, PreparedWrite& write) {
  const RegisterRow& row = *place.place.row;
  if (row.access == Access::read || row.message != nullptr) return Refusal::no_register;
  if (const Refusal refusal = words_for(bank, place, value, write); refusal != Refusal::none) return refusal;
  return with_room_for(write.count, [&](Changes& changes) {
    const RegisterRequest request{.table = write.table,
                                  .first = write.first,
                                  .count = write.count,
                                  .words = std::span(write.words).first(write.count)};
    return gather(bank, request, changes).refusal;
  });
}

Refusal write_prepared(RegisterBank& bank, const PreparedWrite& write) {
  return write_words(bank, write.table, write.first, std::span(write.words).first(write.count));
}

Refusal write_value(RegisterBank& bank, const NamedPlace& named, Value value) {
  // The result is the same as when looking up the words, but this is faster, and programs write like this all
  // the time.
  const Place& place = named.place;
  const RegisterRow& row = *place.row;
  if (row.access == Access::read || row.message != nullptr) return Refusal::no_register;
  const auto merged_value = merged(bank, named, value);
  if (!merged_value) return Refusal::bad_value;
  if (!bank.has_row(row)) return swallows_writes_to_nothing(bank) ? Refusal::none : Refusal::no_register;
  const bool is_half = place.part != Place::Part::whole;
  const MapPolicy& policy = bank.map_policy();
  if (is_half && policy.halves == MapPolicy::Halves::come_whole) return Refusal::no_register;
  auto bits = static_cast<std::uint32_t>(*merged_value);
  if (is_half) bits = with_word(present_bits(bank, place), place.part, static_cast<std::uint16_t>(bits));
  std::array<Change, 1> one = {Change{.place = place,
                                      .bits = bits,
                                      .low = place.part != Place::Part::high,
                                      .high = place.part != Place::Part::low}};
  if (const Objection refused = judge(one[0], policy)) return refused.refusal;
  Changes changes{.all = one, .count = 1};
  carry_out(bank, changes);
  return Refusal::none;
}

}  // namespace understudy::emulator
