// The possible contents of an instruction's field (a constant, a contact or a register), and which of them
// exist. (Manual, 接點元件編號一覽表, 暫存器元件編號一覽表.) All numbers are decimal; registers have 32 bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace understudy::interpreter::super_40nc {

/// The letter of an operand. The manual prints `unset` as "*****"; a listing writes `*`.
enum class Letter : std::uint8_t { unset, k, x, y, m, t, c, d };

struct Operand {
  Letter letter = Letter::unset;
  std::int32_t number = 0;  // K: the value itself

  constexpr bool is_set() const { return letter != Letter::unset; }
  bool operator==(const Operand&) const = default;
};

/// A set of letters.
using Letters = std::uint8_t;
constexpr Letters letters(auto... some) {
  return static_cast<Letters>((0U | ... | (1U << static_cast<unsigned>(some))));
}
constexpr bool has(Letters some, Letter letter) {
  return ((some >> static_cast<unsigned>(letter)) & 1U) != 0;
}

/// Devices with the same letter and consecutive numbers. The devices from `kept` on are retentive.
struct Block {
  Letter letter;
  int first;
  int last;
  int kept;      // 1 + last if none is retentive
  bool special;  // the device computes the value and reacts to writes
};

inline constexpr std::array<Block, 9> kBlocks{{
    {Letter::x, 0, 47, 48, false},
    {Letter::y, 0, 31, 32, false},
    {Letter::m, 0, 511, 400, false},
    {Letter::m, 8000, 8699, 8600, true},
    {Letter::t, 0, 63, 56, false},  // contact and current value
    {Letter::c, 0, 31, 16, false},
    {Letter::d, 0, 999, 500, false},
    {Letter::d, 8000, 8599, 8600, true},
    {Letter::d, 9000, 9499, 9000, true},
}};

/// Returns null for a constant, and if there is no such device.
constexpr const Block* block_of(Operand operand) {
  for (const Block& block : kBlocks) {
    if (block.letter == operand.letter && operand.number >= block.first && operand.number <= block.last) {
      return &block;
    }
  }
  return nullptr;
}

constexpr bool is_special(Operand operand) {
  const Block* const block = block_of(operand);
  return block != nullptr && block->special;
}

inline constexpr std::string_view kLetterNames[] = {"*", "K", "X", "Y", "M", "T", "C", "D"};
constexpr std::string_view name_of(Letter letter) { return kLetterNames[static_cast<std::size_t>(letter)]; }

}  // namespace understudy::interpreter::super_40nc
