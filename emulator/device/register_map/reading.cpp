// Reads consecutive words or bits for requests.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/present.h"
#include "emulator/device/register_map/refusal.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/device/register_map/wire_words.h"

namespace understudy::emulator {

namespace {

/// Returns true if the policy allows a request to read an address that has no register.
bool may_read_hole(const RegisterBank& bank, Table table, std::size_t address) {
  switch (bank.map_policy().unmapped) {
    case MapPolicy::Unmapped::refused: return false;
    case MapPolicy::Unmapped::reads_zero: return true;
    case MapPolicy::Unmapped::holes_read_zero:
      return address < static_cast<std::size_t>(bank.map().end_of(table));
  }
  return false;
}

/// Checks whether the word at an address can be read. `place` stays empty if the word reads as zero.
Objection readable(const RegisterBank& bank, Table table, std::size_t address, Place& place) {
  if (!place) {
    return may_read_hole(bank, table, address) ? Objection{}
                                               : objection(Refusal::no_register, Cause::no_register, address);
  }
  if (place.row->access != Access::write) return {};
  if (bank.map_policy().write_only == MapPolicy::WriteOnly::refused) {
    return objection(Refusal::no_register, Cause::write_only, address);
  }
  place = {};
  return {};
}

/// Returns how many consecutive registers, beginning with a place, belong to the same row and can be read
/// directly from the image.
std::size_t stored_neighbours(const Place& place) {
  const RegisterRow& row = *place.row;
  if (row.is_view || row.swaps_bytes || row.reader != nullptr || !row.fields.empty() ||
      place.part != Place::Part::whole)
    return 0;
  return static_cast<std::size_t>(row.stride == 1 ? row.count - place.index : 1);
}

void put_pair(std::span<std::uint16_t> words, std::uint32_t bits, bool low_first) {
  words[low_first ? 0 : 1] = static_cast<std::uint16_t>(bits);
  words[low_first ? 1 : 0] = static_cast<std::uint16_t>(bits >> 16);
}

/// Returns true if the place is the first word of a 32-bit register and the request covers both words.
bool is_whole_pair(const Place& place, bool low_first, std::size_t words_left) {
  return place.part != Place::Part::whole && !is_second_word(place, low_first) && words_left >= 2;
}

/// Packs the lowest bit of each word into whole bytes, beginning with bit number `at`.
void pack(std::span<const std::uint32_t> bits, std::size_t at, std::span<std::uint8_t> packed) {
  std::size_t i = 0;
  const auto one = [&] { packed[at / 8] |= static_cast<std::uint8_t>((bits[i++] & 1U) << at % 8); };
  for (; i < bits.size() && at % 8 != 0; ++at) one();
  for (; i + 8 <= bits.size(); i += 8, at += 8) {
    const std::uint32_t* const of = &bits[i];  // unrolled by hand, because the compiler would not do it
    const std::uint32_t low = (of[0] & 1U) | (of[1] & 1U) << 1 | (of[2] & 1U) << 2 | (of[3] & 1U) << 3;
    const std::uint32_t high = (of[4] & 1U) | (of[5] & 1U) << 1 | (of[6] & 1U) << 2 | (of[7] & 1U) << 3;
    packed[at / 8] = static_cast<std::uint8_t>(low | high << 4);
  }
  for (; i < bits.size(); ++at) one();
}

}  // namespace

Objection read_request(const RegisterBank& bank, Table table, std::uint16_t first,
                       std::span<std::uint16_t> words) {
  const bool low_first = bank.low_word_first();
  const bool pairs_whole = bank.map_policy().read_halves == MapPolicy::ReadHalves::come_whole;
  if (first + words.size() > 65536) return objection(Refusal::no_register, Cause::no_register, first);
  const auto pairs = bank.map().stored_pairs(table);
  const auto image = bank.image();
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::size_t address = first + i;
    if (address < pairs.size() && pairs[address] != Place::kNoSlot && i + 1 < words.size()) {
      put_pair(words.subspan(i++, 2), image[static_cast<std::size_t>(pairs[address])], low_first);
      continue;
    }
    Place place = bank.at(table, static_cast<std::uint16_t>(address), low_first);
    if (const Objection refused = readable(bank, table, address, place)) return refused;
    if (!place) {
      words[i] = 0;
      continue;
    }
    if (pairs_whole && is_cut(place, i == 0, i + 1 == words.size(), low_first)) {
      return objection(bank.map_policy().cut_pair, Cause::cut_pair, address);
    }
    mention_if_missed(bank, place);
    if (is_whole_pair(place, low_first, words.size() - i)) {
      const auto pair = wire_words(*place.row, present_bits(bank, place), low_first);
      words[i] = pair[0];
      words[++i] = pair[1];
      continue;
    }
    const std::size_t rest = stored_neighbours(place);
    if (rest > 1) {  // the following registers of the same row
      const std::size_t count = std::min(rest, words.size() - i);
      const auto stored = image.subspan(static_cast<std::size_t>(place.slot), count);
      std::transform(stored.begin(), stored.end(), words.begin() + static_cast<std::ptrdiff_t>(i),
                     [](std::uint32_t bits) { return static_cast<std::uint16_t>(bits); });
      i += count - 1;
      continue;
    }
    words[i] = wire_word(*place.row, word_of(present_bits(bank, place), place.part));
  }
  return admission(bank, {.table = table, .first = first, .count = words.size()}, Checked::everything);
}

Objection read_bits_request(const RegisterBank& bank, Table table, std::uint16_t first, std::size_t count,
                            std::span<std::uint8_t> packed) {
  if (first + count > 65536) return objection(Refusal::no_register, Cause::no_register, first);
  std::fill(packed.begin(), packed.end(), std::uint8_t{0});
  const auto sources = bank.map().bit_sources(table);
  const auto image = bank.image();
  // Most bits are 0, so only the bits that are 1 are written.
  const auto put = [&](std::size_t i, std::uint32_t bit) {
    if ((bit & 1U) != 0) packed[i / 8] |= static_cast<std::uint8_t>(1U << i % 8);
  };
  for (std::size_t i = 0; i < count;) {
    const std::size_t address = first + i;
    const BitSource source = address < sources.size() ? sources[address] : BitSource{};
    if (source.how == BitSource::How::stored) {
      const std::size_t run = std::min<std::size_t>(source.run, count - i);
      const auto slot = static_cast<std::size_t>(source.slot);
      run == 1 ? put(i, image[slot]) : pack(image.subspan(slot, run), i, packed);
      i += run;
      continue;
    }
    if (source.how == BitSource::How::constant) {
      const std::size_t end = std::min<std::size_t>(i + source.run, count);
      for (; source.slot != 0 && i < end; ++i) put(i, 1);
      i = end;
      continue;
    }
    if (source.how == BitSource::How::reader) {
      const RegisterRow& row = bank.map().rows()[static_cast<std::size_t>(source.slot)];
      const Cell cell{.argument = row.argument, .index = source.run, .axis = row.first_axis + source.run};
      put(i++, static_cast<std::uint32_t>(row.reader(bank, cell)));
      continue;
    }
    Place place = bank.at(table, static_cast<std::uint16_t>(address), true);
    if (const Objection refused = readable(bank, table, address, place)) return refused;
    if (!place) {
      ++i;
      continue;
    }
    mention_if_missed(bank, place);
    put(i++, present_bits(bank, place));
  }
  return admission(bank, {.table = table, .first = first, .count = count}, Checked::everything);
}

}  // namespace understudy::emulator
