// The vocabulary of SUPER-40NC's register tables: a device is identified by a letter and a number, from which
// its address follows (《接點元件編號一覽表》, 《暫存器元件編號一覽表》).
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/rows/effects.h"

namespace understudy::emulator::models::super_40nc {

inline constexpr Type s32 = Type::s32;
inline constexpr Access R = Access::read;
inline constexpr Access RW = Access::read_write;

inline constexpr int kAxisCount = 4;
inline constexpr std::array<std::string_view, kAxisCount> kAxisNames{"X", "Y", "Z", "U"};

// What writes can do. The PLC and the programs use contacts and present values for any purpose, so a contact
// can do everything that they can do.
inline constexpr Hazards kValue = Hazards::settings;
inline constexpr Hazards kMemory = Hazards::memory;
inline constexpr Hazards kMotion = Hazards::motion;
inline constexpr Hazards kPlc = Hazards::output | Hazards::motion;
inline constexpr Hazards kProgram = Hazards::memory | Hazards::output | Hazards::motion;

/// Addresses on the wire.
constexpr std::uint16_t relay_address(int number) {
  return static_cast<std::uint16_t>(number < 8000 ? 1000 + number : number - 6000);
}
constexpr std::uint16_t data_address(int number) {
  if (number < 1000) return static_cast<std::uint16_t>(2 * number);
  return static_cast<std::uint16_t>(number < 9000 ? 7000 + 2 * (number - 8000) : 9000 + 2 * (number - 9000));
}

/// These create a row for one relay M, or for several with consecutive numbers.
constexpr RegisterRow relay(int number, Access access = RW) {
  return coil(relay_address(number), "M{}", access).times(1, 1, number);
}
constexpr RegisterRow relays(int first, int last, Access access = RW) {
  return relay(first, access).times(last - first + 1, 1, first);
}
/// Creates a row for M81.., M82.., M83.., M84..: one contact per axis, beginning with X.
constexpr RegisterRow axis_relays(int first_of_x, int last_of_x, int axis) {
  return relays(first_of_x + 100 * axis, last_of_x + 100 * axis);
}
constexpr RegisterRow axis_relay(int of_x, Access access = RW) {
  return relay(of_x, access).times(kAxisCount, 100, of_x).numbered_by(100).of_axes(kAxisNames);
}

/// These create a row for one data register D, or for several.
constexpr RegisterRow data(int number, Access access = RW) {
  return reg(data_address(number), "D{}", s32, access).times(1, 2, number);
}
constexpr RegisterRow data(int first, int last, Access access = RW) {
  return data(first, access).times(last - first + 1, 2, first);
}
/// Creates a row for D81.., D82.., D83.., D84.. or D91.. and so on: one register per axis, beginning with X.
constexpr RegisterRow axis_data(int of_x, Access access = RW) {
  return data(of_x, access).times(kAxisCount, 200, of_x).numbered_by(100).of_axes(kAxisNames);
}
/// Creates a row for several adjacent registers of one axis.
constexpr RegisterRow axis_data(int first_of_x, int last_of_x, int axis) {
  return data(first_of_x + 100 * axis, last_of_x + 100 * axis);
}
/// Returns the register number of X's parameter D9x00 + number.
constexpr int of_x(int number) { return 9100 + number; }
/// Creates a row for D9x00 + number of all axes.
constexpr RegisterRow parameter(int number) { return axis_data(of_x(number)).persists_at_once(); }

template <std::size_t N>
constexpr std::array<RegisterRow, N> section(std::string_view name, Hazards hazards,
                                             const RegisterRow (&rows)[N]) {
  std::array<RegisterRow, N> named{};
  for (std::size_t i = 0; i < N; ++i) {
    named[i] = marked(rows[i], hazards);
    named[i].section = name;
  }
  return named;
}
/// A section whose registers are read-only or have individual marks.
template <std::size_t N>
consteval std::array<RegisterRow, N> section(std::string_view name, const RegisterRow (&rows)[N]) {
  return section(name, Hazards::unmarked, rows);
}

}  // namespace understudy::emulator::models::super_40nc
