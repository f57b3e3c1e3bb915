// Code that reading and writing share (access.h): the present content of a register, and why it is not
// available.
#pragma once

#include <cstddef>
#include <cstdint>

#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/wire_words.h"

namespace understudy::emulator {

inline Cell cell_of(const Place& place) {
  return {.argument = place.row->argument, .index = place.index, .axis = place.row->first_axis + place.index};
}

inline std::uint32_t with_bits_of_fields(const RegisterBank& bank, const Place& place, std::uint32_t bits) {
  for (const BitField& field : place.row->fields) {
    if (field.reader == nullptr) continue;
    const auto value = static_cast<std::uint32_t>(field.reader(bank, cell_of(place)));
    bits = (bits & ~field.mask()) | (value << field.bit & field.mask());
  }
  return bits;
}

inline std::uint32_t present_bits(const RegisterBank& bank, const Place& place) {
  const RegisterRow& row = *place.row;
  if (row.reader != nullptr) return static_cast<std::uint32_t>(row.reader(bank, cell_of(place)));
  const std::uint32_t bits = row.is_view ? static_cast<std::uint32_t>(row.factory)
                                         : bank.image()[static_cast<std::size_t>(place.slot)];
  return row.fields.empty() ? bits : with_bits_of_fields(bank, place, bits);
}

inline std::uint16_t word_of(std::uint32_t bits, Place::Part part) {
  return static_cast<std::uint16_t>(part == Place::Part::high ? bits >> 16 : bits);
}

/// Warns about an unmodelled register that the controller itself should set. No warning is needed for reading
/// back a written value.
inline void mention_if_missed(const RegisterBank& bank, const Place& place) {
  if (!place.row->not_implemented.empty() && place.row->access == Access::read)
    bank.warn_not_implemented(*place.row);
}

inline Objection objection(Refusal refusal, Cause cause, std::size_t address) {
  return {refusal, cause, static_cast<std::uint16_t>(address)};
}

/// Converts the device's answer to a request into an objection that contains the device's number for the
/// reason.
inline Objection objection_of(const DeviceAnswer& answer, const RegisterRequest& request) {
  const auto because = [&](Cause cause) {
    return Objection{answer.refusal, cause, request.first, answer.reason};
  };
  switch (answer.refusal) {
    case Refusal::none: return {};
    case Refusal::no_register: return because(Cause::no_register);
    case Refusal::bad_value: return because(Cause::bad_message);
    case Refusal::busy: return because(Cause::busy);
    case Refusal::failure: return because(Cause::failure);
  }
  return {};
}

/// Asks the device whether it accepts a request that has passed all checks so far.
inline Objection admission(const RegisterBank& bank, const RegisterRequest& request, Checked checked) {
  return objection_of(bank.admits(request, checked), request);
}

/// Returns true if writes to unmapped addresses are ignored rather than refused.
inline bool swallows_writes_to_nothing(const RegisterBank& bank) {
  return bank.map_policy().unmapped == MapPolicy::Unmapped::reads_zero;
}

/// Returns true if a request that begins or ends with this word contains only half of the word's register.
inline bool is_cut(const Place& place, bool is_first, bool is_last, bool low_word_first) {
  if (place.part == Place::Part::whole) return false;
  return is_second_word(place, low_word_first) ? is_first : is_last;
}

}  // namespace understudy::emulator
