// The reasons for refusing a request or a macro line, in both numberings of input 102, with their exceptions
// and with the download error codes of input 114.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace understudy::interpreter::rs_m8194h {

enum class Fault : std::uint8_t {
  none,
  function_code,
  parameter,
  register_count,
  undefined_command,
  macro_memory,
  mp_in_isr,
  isr_in_mp,
  real_time_in_macro,
  macro_outside,
  if_too_deep,
  else_outside,
  end_if_outside,
  if_open,
  comparison,
  for_too_deep,
  exit_for_outside,
  next_outside,
  for_open,
  label_twice,
  label_in_if,
  label_in_for,
  goto_without_label,
  operand,
  half_of_pair,
  address,
  fifo_full,
  no_module,
  macro_runs,
};

struct FaultRow {
  Fault fault;
  std::uint8_t reason_4_16_2;   // in input 102; beyond that list, as in the other numbering
  std::uint8_t reason_12_1_12;  // the same in the other numbering
  std::uint8_t exception;       // Modbus
  std::uint8_t download_error;  // shown in input 114; 0: not a download error
  std::string_view meaning;
};
inline constexpr auto kFaults = std::to_array<FaultRow>({
    {Fault::none, 0x00, 0x00, 0, 0x00, "no error"},
    {Fault::function_code, 0x01, 0x01, 1, 0, "unknown function code"},
    {Fault::parameter, 0x02, 0x02, 3, 0, "a parameter is out of range"},
    {Fault::register_count, 0x02, 0x02, 3, 0, "too few or too many registers for this command"},
    {Fault::undefined_command, 0x02, 0x03, 3, 0x0F, "undefined command"},
    {Fault::macro_memory, 0x03, 0x04, 3, 0x01, "more lines than this macro has room for"},
    {Fault::mp_in_isr, 0x04, 0x05, 3, 0, "not allowed in an ISR"},
    {Fault::isr_in_mp, 0x05, 0x06, 3, 0, "only allowed in an ISR"},
    {Fault::real_time_in_macro, 0x06, 0x07, 3, 0, "a real-time command in a macro"},
    {Fault::macro_outside, 0x07, 0x08, 3, 0, "a macro line outside a macro"},
    {Fault::if_too_deep, 0xB1, 0xB1, 3, 0x02, "IF nested more than seven deep"},
    {Fault::else_outside, 0xB2, 0xB2, 3, 0x03, "ELSE outside an IF"},
    {Fault::end_if_outside, 0xB3, 0xB3, 3, 0x04, "END_IF without an IF"},
    {Fault::if_open, 0xB4, 0xB4, 3, 0x05, "IF without an END_IF"},
    {Fault::comparison, 0x02, 0x02, 3, 0x06, "not a comparison operator"},
    {Fault::for_too_deep, 0xB5, 0xB5, 3, 0x07, "FOR nested more than seven deep"},
    {Fault::exit_for_outside, 0xB6, 0xB6, 3, 0x08, "EXIT_FOR outside a FOR"},
    {Fault::next_outside, 0xB7, 0xB7, 3, 0x09, "NEXT without a FOR"},
    {Fault::for_open, 0xB8, 0xB8, 3, 0x0A, "FOR without a NEXT"},
    {Fault::label_twice, 0xB9, 0xB9, 3, 0x0B, "this label already exists"},
    {Fault::label_in_if, 0xBA, 0xBA, 3, 0x0C, "a label inside an IF"},
    {Fault::label_in_for, 0xBB, 0xBB, 3, 0x0D, "a label inside a FOR"},
    {Fault::goto_without_label, 0xBC, 0xBC, 3, 0x0E, "GOTO without its label"},
    {Fault::operand, 0x02, 0x02, 3, 0x10, "wrong operand or operator of VAR_CALCULATE"},
    {Fault::half_of_pair, 0xC0, 0xC0, 2, 0, "half of a 32-bit item"},
    {Fault::address, 0x02, 0x02, 2, 0, "not an address of this table"},
    {Fault::fifo_full, 0xC1, 0xC1, 6, 0, "no free block in the FIFO"},
    {Fault::no_module, 0xC2, 0xC2, 4, 0, "the i-8094H does not answer"},
    {Fault::macro_runs, 0xC3, 0xC3, 6, 0, "a macro is running"},
});
static_assert([] {
  for (std::size_t i = 0; i < kFaults.size(); ++i) {
    if (kFaults[i].fault != static_cast<Fault>(i)) return false;
  }
  return true;
}());

constexpr const FaultRow& row_of(Fault fault) { return kFaults[static_cast<std::size_t>(fault)]; }
constexpr bool is_download_error(Fault fault) { return row_of(fault).download_error != 0; }

}  // namespace understudy::interpreter::rs_m8194h
