// Which words of a device the names mean, and how to read or write them in as few requests as possible:
// neighbours share one.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "emulator/play/scenario/scenario.h"

namespace understudy::emulator::play {

inline constexpr int kMostWordsToRead = 125;   // of one request
inline constexpr int kMostWordsToWrite = 123;  // (MODBUS Application Protocol V1.1b3, 6.3 and 6.12)

/// Consecutive words of one device.
struct Words {
  std::size_t device = 0;
  std::uint16_t first = 0;
  int count = 0;

  int end() const { return first + count; }
};

/// Whether one bit of a register is meant: the other bits are read before it is written.
inline bool is_bit(const Target& target) { return target.place && target.place->bit >= 0; }

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

/// What the words of a target say.
Value value_in(const Target& target, std::span<const std::uint16_t> words, bool low_word_first);
/// The words that set a target, or one bit of it, to a value: `present` is what they hold now. Throws
/// NameError for a value that does not fit.
std::vector<std::uint16_t> words_with(const Target& target, Value value, bool low_word_first,
                                      std::span<const std::uint16_t> present = {});

}  // namespace understudy::emulator::play
