// Access to contacts and registers by operand, for both languages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "interpreter/super_40nc/machine.h"
#include "interpreter/super_40nc/operand.h"

namespace understudy::interpreter::super_40nc {

/// Returns the cell of a plain contact, or of the contact of a timer or counter.
constexpr std::uint32_t contact_cell(const CellLayout& layout, Operand contact) {
  const auto number = static_cast<std::uint32_t>(contact.number);
  switch (contact.letter) {
    case Letter::x: return layout.x + number;
    case Letter::y: return layout.y + number;
    case Letter::m: return layout.m + number;
    case Letter::t: return layout.t + number;
    case Letter::c: return layout.c + number;
    case Letter::unset:
    case Letter::k:
    case Letter::d: break;
  }
  return 0;
}
/// Returns the cell of a plain register, or of the value of a timer or counter.
constexpr std::uint32_t value_cell(const CellLayout& layout, Operand value) {
  const auto number = static_cast<std::uint32_t>(value.number);
  if (value.letter == Letter::t) return layout.t_value + number;
  return value.letter == Letter::c ? layout.c_value + number : layout.d + number;
}
constexpr bool is_retentive(Operand operand) {
  const Block* const block = block_of(operand);
  return block != nullptr && operand.number >= block->kept;
}

class Access {
 public:
  explicit Access(Machine& machine) : machine_(machine), layout_(machine.layout()), cells_(machine.cells()) {}

  Machine& machine() const { return machine_; }

  bool contact(Operand operand) const {
    if (is_special(operand)) return machine_.special_contact(operand.number);
    return cells_[contact_cell(layout_, operand)] != 0;
  }
  std::int32_t value(Operand operand) const {
    if (operand.letter == Letter::k) return operand.number;
    if (is_special(operand)) return machine_.special_register(operand.number);
    return static_cast<std::int32_t>(cells_[value_cell(layout_, operand)]);
  }

  // The following functions return true if anything has changed.
  bool switch_contact(Operand operand, bool on) {
    if (is_special(operand)) return machine_.set_special_contact(operand.number, on);
    return put(contact_cell(layout_, operand), on ? 1 : 0, is_retentive(operand));
  }
  bool write(Operand operand, std::int32_t value) {
    if (is_special(operand)) return machine_.set_special_register(operand.number, value);
    return put(value_cell(layout_, operand), static_cast<std::uint32_t>(value), is_retentive(operand));
  }
  /// RST: switches off a contact. A timer or counter also loses its value.
  bool reset(Operand operand) {
    const bool counts = operand.letter == Letter::t || operand.letter == Letter::c;
    const bool has_lost_value = counts && write(operand, 0);
    return switch_contact(operand, false) || has_lost_value;
  }

 private:
  bool put(std::uint32_t cell, std::uint32_t value, bool kept) {
    if (cells_[cell] == value) return false;
    cells_[cell] = value;
    if (kept) machine_.retentive_cell_written(cell);
    return true;
  }

  Machine& machine_;
  CellLayout layout_;
  std::span<std::uint32_t> cells_;
};

}  // namespace understudy::interpreter::super_40nc
