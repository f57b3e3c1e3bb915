// The vocabulary a model declares its registers in: one row for each register (or a range of similar ones),
// in the manual's order and spelling. Everything else about registers is read from these rows.
#pragma once

#include <cstdint>
#include <string_view>

namespace understudy::emulator {

class RegisterBank;
template <typename D>
class RegisterBankOf;

enum class Table : std::uint8_t { holding, input, coil, discrete };
enum class Access : std::uint8_t { read, write, read_write };
enum class Type : std::uint8_t { u16, s16, u32, s32 };

/// Wide enough for every type's value.
using Value = std::int64_t;

/// A firmware version in hundredths: 1.52 is 152. 0 as "since": from the first on.
using Firmware = std::uint16_t;

constexpr bool is_32_bit(Type type) { return type == Type::u32 || type == Type::s32; }
constexpr bool is_signed(Type type) { return type == Type::s16 || type == Type::s32; }

/// The low bits of a value, as a signed or unsigned quantity of the type.
constexpr Value value_of(std::uint32_t bits, Type type) {
  switch (type) {
    case Type::u16: return static_cast<std::uint16_t>(bits);
    case Type::s16: return static_cast<std::int16_t>(bits);
    case Type::u32: return bits;
    case Type::s32: return static_cast<std::int32_t>(bits);
  }
  return 0;
}

/// Which register of a row is meant, as its functions see it.
struct Cell {
  int argument = 0;       // what the row was declared with, an axis for example
  int index = 0;          // 0 .. count-1
  bool high_half = true;  // a write: the high word came with it (always so for 16-bit registers)
};

/// The present value, if it is not simply the stored one.
using Reader = Value (*)(const RegisterBank& bank, Cell cell);
/// What a write does beyond storing. Runs after the whole request is stored, in ascending order.
using Effect = void (*)(RegisterBank& bank, Cell cell, Value value);

/// A model's functions take its own device, of which the bank that they are called for is a part
/// (register_bank.h). `D` may be incomplete where the rows stand.
template <auto function>
struct Handler;
template <typename D, Value (*function)(const D&, Cell)>
struct Handler<function> {
  static Value call(const RegisterBank& bank, Cell cell) {
    return function(static_cast<const RegisterBankOf<D>&>(bank).device(), cell);
  }
};
template <typename D, void (*function)(D&, Cell, Value)>
struct Handler<function> {
  static void call(RegisterBank& bank, Cell cell, Value value) {
    function(static_cast<RegisterBankOf<D>&>(bank).device(), cell, value);
  }
};

struct RegisterRow {
  std::uint16_t address = 0;
  std::string_view name;   // as the manual prints it, without _L/_RegL; "{}" stands for the number
  std::string_view alias;  // a second spelling of the manual; empty if there is none
  Type type = Type::u16;
  Access access = Access::read_write;
  Table table = Table::holding;

  bool ranged = false;  // whether the manual gives a range
  Value min = 0;
  Value max = 0;
  std::string_view unit;
  Value factory = 0;
  bool persistent = false;
  std::uint32_t stored_bits = 0xFFFF'FFFF;  // what the register really holds of a written value

  int count = 1;   // a range of `count` registers, `stride` addresses apart,
  int stride = 1;  // whose names carry first_number, first_number + 1, ...
  int first_number = 0;
  std::string_view low_half = "_L";  // what the manual appends to the halves of a 32-bit register
  std::string_view high_half = "_H";

  Firmware since = 0;
  std::string_view section;  // of the manual

  int argument = 0;
  Reader reader = nullptr;
  Effect effect = nullptr;
  bool acts_on_zero = true;     // false: a trigger, for which a written 0 does nothing
  std::string_view unmodelled;  // what is missing, if the register only stores and reads back

  // --- how a row is written down ---------------------------------------------------------------
  constexpr RegisterRow& also(std::string_view other_spelling) {
    alias = other_spelling;
    return *this;
  }
  constexpr RegisterRow& range(Value low, Value high) {
    ranged = true;
    min = low;
    max = high;
    return *this;
  }
  constexpr RegisterRow& in(std::string_view unit_name) {
    unit = unit_name;
    return *this;
  }
  constexpr RegisterRow& from_factory(Value value) {
    factory = value;
    return *this;
  }
  constexpr RegisterRow& kept() {
    persistent = true;
    return *this;
  }
  constexpr RegisterRow& holding_bits(std::uint32_t bits) {
    stored_bits = bits;
    return *this;
  }
  constexpr RegisterRow& times(int how_many, int apart, int number_of_first) {
    count = how_many;
    stride = apart;
    first_number = number_of_first;
    return *this;
  }
  constexpr RegisterRow& halves(std::string_view low, std::string_view high) {
    low_half = low;
    high_half = high;
    return *this;
  }
  constexpr RegisterRow& since_firmware(Firmware version) {
    since = version;
    return *this;
  }
  template <auto function>
  constexpr RegisterRow& reads(int with_argument = 0) {
    reader = Handler<function>::call;
    argument = with_argument;
    return *this;
  }
  template <auto function>
  constexpr RegisterRow& does(int with_argument = 0) {
    effect = Handler<function>::call;
    argument = with_argument;
    return *this;
  }
  template <auto function>
  constexpr RegisterRow& triggers(int with_argument = 0) {
    acts_on_zero = false;
    return does<function>(with_argument);
  }
  constexpr RegisterRow& missing_trigger(std::string_view what_is_missing) {
    acts_on_zero = false;
    return not_modelled(what_is_missing);
  }
  constexpr RegisterRow& not_modelled(std::string_view what_is_missing) {
    unmodelled = what_is_missing;
    return *this;
  }
};

constexpr RegisterRow reg(std::uint16_t address, std::string_view name, Type type, Access access) {
  RegisterRow row;
  row.address = address;
  row.name = name;
  row.type = type;
  row.access = access;
  return row;
}

/// What a model answers where the map or the Modbus standard leaves it open.
struct MapPolicy {
  enum class Unmapped : std::uint8_t { refused, reads_zero } unmapped = Unmapped::refused;
  enum class WriteOnly : std::uint8_t { reads_zero, refused } write_only = WriteOnly::reads_zero;
  enum class ReadOnly : std::uint8_t { refused, ignores_writes } read_only = ReadOnly::refused;
  /// Half of a 32-bit register alone: taken whatever the whole becomes, judged with the other half as it is,
  /// or never taken.
  enum class Halves : std::uint8_t {
    may_be_written_alone,
    judged_with_the_other,
    come_whole
  } halves = Halves::may_be_written_alone;
  enum class OutOfRange : std::uint8_t { refused, clamped } out_of_range = OutOfRange::refused;
  /// What a request with a value out of range leaves behind: nothing, or the registers before that one.
  enum class Partly : std::uint8_t { never, up_to_the_refused } partly = Partly::never;
  /// Whether the registers of one request take effect once all of them are stored, or each in its turn.
  enum class Effects : std::uint8_t { after_all, one_by_one } effects = Effects::after_all;
  bool low_word_first = true;
};

}  // namespace understudy::emulator
