// Finds the words of a device to which names refer, and the smallest number of requests that read or write
// them: adjacent words are combined in one request.
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

/// Consecutive words of a device, or bits in bit tables.
struct Words {
  std::size_t device = 0;
  Table table = Table::holding;
  std::uint16_t first = 0;
  int count = 0;

  int end() const { return first + count; }
};

/// Returns true if the target is one bit of a register. The other bits must be read before it is written.
inline bool is_bit(const Target& target) { return target.place && target.place->bit >= 0; }

/// Returns the table of a target.
Table table_of(const Target& target);
/// Returns true if a function can write to the target's table.
bool can_be_sent(const Target& target);

/// Returns the words of a target. For a bit, these are the words of its register. `low_word_first` is the
/// device's present word order.
Words words_of(const Target& target, bool low_word_first);

/// A request, and the entries for which it is sent.
struct Request {
  Words words;
  std::vector<std::size_t> entries;
};

/// Returns requests in the order of the entries. An entry is added to the previous request if its words
/// directly follow the words of that request, or are among them.
std::vector<Request> read_requests(std::span<const Words> entries);
/// Like read_requests(), but for writing: an entry is added only if its words directly follow, and never if
/// `stands_alone`.
std::vector<Request> write_requests(std::span<const Words> entries,
                                    const std::function<bool(std::size_t)>& stands_alone);

/// The limits of values that can be written to a target or read from it. A word that is addressed by number
/// is unsigned.
struct Limits {
  Value low = 0;
  Value high = 0;
};
Limits limits_of(const Target& target);

/// Returns the value of a register as a number, which may be real. Returns nothing if the bits of a real are
/// not a number.
std::optional<world::Number> number_of(const Target& target, Value value);
/// Returns the value for a number. Returns nothing for a fraction if the target is an integer, or for a
/// number that exceeds single precision if the target is real.
std::optional<Value> value_for(const Target& target, world::Number number);

/// Returns the value contained in the words of a target.
Value value_in(const Target& target, std::span<const std::uint16_t> words, bool low_word_first);
/// Returns the words that set a target, or one of its bits, to a value. `present` are the present words.
/// Throws NameError for a value that does not fit.
std::vector<std::uint16_t> words_with(const Target& target, Value value, bool low_word_first,
                                      std::span<const std::uint16_t> present = {});

}  // namespace understudy::emulator::play
