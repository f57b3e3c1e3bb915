// Which words of a device the names mean, and how to read or write them in as few requests as possible:
// neighbours share one.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "emulator/play/scenario/scenario.h"
#include "emulator/world/expression/number.h"

namespace understudy::emulator::play {

/// Consecutive words of one device; in tables of bits, bits.
struct Words {
  std::size_t device = 0;
  Table table = Table::holding;
  std::uint16_t first = 0;
  int count = 0;

  int end() const { return first + count; }
};

/// Whether one bit of a register is meant: the other bits are read before it is written.
inline bool is_bit(const Target& target) { return target.place && target.place->bit >= 0; }

/// The table that a target is in.
Table table_of(const Target& target);
/// Whether there is a function that writes to it.
bool can_be_sent(const Target& target);

/// Where a target lies. `low_word_first`: as its device has it at this moment. A bit lies where its register
/// does.
Words words_of(const Target& target, bool low_word_first);

/// A request, and which of the entries it is for.
struct Request {
  Words words;
  std::vector<std::size_t> entries;
};

/// In the order of the entries; an entry joins the request before it if its words follow those, or are among
/// them.
std::vector<Request> read_requests(std::span<const Words> entries);
/// For writing: an entry joins only if its words follow, and never if it `stands_alone`.
std::vector<Request> write_requests(std::span<const Words> entries,
                                    const std::function<bool(std::size_t)>& stands_alone);

/// What can be sent to a target, and what can come back from it. A word by its number has no sign.
struct Limits {
  Value low = 0;
  Value high = 0;
};
Limits limits_of(const Target& target);

/// A register's value as a number, a real one's too; none where the bits of a real are not a number.
std::optional<world::Number> number_of(const Target& target, Value value);
/// The value that a number is there; none: a fraction for a whole number, or more than a single can hold.
std::optional<Value> value_for(const Target& target, world::Number number);

/// What the words of a target say.
Value value_in(const Target& target, std::span<const std::uint16_t> words, bool low_word_first);
/// The words that set a target, or one bit of it, to a value: `present` is what they hold now. Throws
/// NameError for a value that does not fit.
std::vector<std::uint16_t> words_with(const Target& target, Value value, bool low_word_first,
                                      std::span<const std::uint16_t> present = {});

}  // namespace understudy::emulator::play
