// The vocabulary with which a model declares its registers: one row per register (or range of similar
// registers), in the manual's order and spelling. Everything else about registers is derived from these rows.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string_view>

#include "base/simulated_time.h"
#include "emulator/device/register_map/hazards.h"
#include "emulator/device/register_map/refusal.h"

namespace understudy::emulator {

class RegisterBank;
template <typename D>
class RegisterBankOf;

enum class Table : std::uint8_t { holding, input, coil, discrete };
enum class Access : std::uint8_t { read, write, read_write };
/// `bit` is for coils and discrete inputs, one per address. `f32` is an IEEE 754 single-precision number.
enum class Type : std::uint8_t { u16, s16, u32, s32, bit, f32 };

/// Wide enough for the values of every type. A real is stored as its 32 bits; see real_of() and
/// value_of_real().
using Value = std::int64_t;

/// A firmware version in hundredths: 1.52 is 152. As "since", 0 means the first version.
using Firmware = std::uint16_t;

constexpr bool is_32_bit(Type type) { return type == Type::u32 || type == Type::s32 || type == Type::f32; }
constexpr bool is_signed(Type type) { return type == Type::s16 || type == Type::s32 || type == Type::f32; }
/// Returns the width in bits: 1, 16 or 32.
constexpr int width_of(Type type) { return type == Type::bit ? 1 : is_32_bit(type) ? 32 : 16; }
constexpr bool is_table_of_bits(Table table) { return table == Table::coil || table == Table::discrete; }

constexpr float real_of(Value value) { return std::bit_cast<float>(static_cast<std::uint32_t>(value)); }
constexpr Value value_of_real(float real) { return std::bit_cast<std::uint32_t>(real); }

/// Returns the low bits as a signed or unsigned value of the type.
constexpr Value value_of(std::uint32_t bits, Type type) {
  switch (type) {
    case Type::u16: return static_cast<std::uint16_t>(bits);
    case Type::s16: return static_cast<std::int16_t>(bits);
    case Type::u32: return bits;
    case Type::s32: return static_cast<std::int32_t>(bits);
    case Type::bit: return bits & 1;
    case Type::f32: return bits;
  }
  return 0;
}

/// The limits of a type. For reals, they are given as bits.
struct TypeLimits {
  Value lowest = 0;
  Value highest = 0;
};
constexpr TypeLimits limits_of(Type type) {
  switch (type) {
    case Type::u16: return {0, UINT16_MAX};
    case Type::s16: return {INT16_MIN, INT16_MAX};
    case Type::s32: return {INT32_MIN, INT32_MAX};
    case Type::bit: return {0, 1};
    case Type::u32:
    case Type::f32: return {0, UINT32_MAX};
  }
  return {};
}

/// The register for which a row's function is called.
struct Cell {
  int argument = 0;       // declared with the row, for example an axis
  int index = 0;          // 0 .. count-1
  int axis = 0;           // the device's number of the axis, if the row is for several axes
  bool high_half = true;  // true if a write includes the high word (always true for 16-bit registers)
};

/// When the value of a reader may change without a write. A program that waits for a value is evaluated again
/// only in these ticks.
enum class Varies : std::uint8_t {
  in_ticks,      // in ticks that are run in full, or through outside events
  while_moving,  // with the pulses of an axis, so even in ticks that Device::fast_forward_to() skips
  with_time,     // merely because time passes, at the ticks that `changes_at` returns
};

/// Returns the present value if it differs from the stored value.
using Reader = Value (*)(const RegisterBank& bank, Cell cell);
/// Returns the first tick after `done` in which the value may change merely because time passes, or kNever if
/// it does not depend on time now.
using NextChange = Tick (*)(const RegisterBank& bank, Cell cell, Tick done);
/// Does everything that a write does in addition to storing the value. Effects run in ascending order, after
/// the whole request has been stored.
using Effect = void (*)(RegisterBank& bank, Cell cell, Value value);
/// Handles the words that one request has written to a window, or refuses them without changing anything.
using Message = DeviceAnswer (*)(RegisterBank& bank, Cell cell, std::span<const std::uint16_t> words);

/// Adapts a model's functions to these types. The functions' first parameter is the device that contains the
/// bank (register_bank.h). `D` may be incomplete where the rows are declared.
template <auto function>
struct Handler;
template <typename D, Value (*function)(const D&, Cell)>
struct Handler<function> {
  static Value call(const RegisterBank& bank, Cell cell) {
    return function(static_cast<const RegisterBankOf<D>&>(bank).device(), cell);
  }
};
template <typename D, Tick (*function)(const D&, Cell, Tick)>
struct Handler<function> {
  static Tick call(const RegisterBank& bank, Cell cell, Tick done) {
    return function(static_cast<const RegisterBankOf<D>&>(bank).device(), cell, done);
  }
};
template <typename D, void (*function)(D&, Cell, Value)>
struct Handler<function> {
  static void call(RegisterBank& bank, Cell cell, Value value) {
    function(static_cast<RegisterBankOf<D>&>(bank).device(), cell, value);
  }
};
template <typename D, Refusal (*function)(D&, Cell, std::span<const std::uint16_t>)>
struct Handler<function> {
  static DeviceAnswer call(RegisterBank& bank, Cell cell, std::span<const std::uint16_t> words) {
    return function(static_cast<RegisterBankOf<D>&>(bank).device(), cell, words);
  }
};
template <typename D, DeviceAnswer (*function)(D&, Cell, std::span<const std::uint16_t>)>
struct Handler<function> {
  static DeviceAnswer call(RegisterBank& bank, Cell cell, std::span<const std::uint16_t> words) {
    return function(static_cast<RegisterBankOf<D>&>(bank).device(), cell, words);
  }
};

/// A named group of bits in a register: "STATUS.READY".
struct BitField {
  int bit = 0;  // the lowest bit
  std::string_view name;
  int width = 1;
  Reader reader = nullptr;  // reads the present value if it differs from the register's bits
  Varies varies = Varies::in_ticks;

  template <auto function, Varies when>
  constexpr BitField& reads() {
    reader = Handler<function>::call;
    varies = when;
    return *this;
  }
  constexpr std::uint32_t mask() const { return (width >= 32 ? ~0U : (1U << width) - 1U) << bit; }
};

constexpr BitField bits(int lowest, std::string_view name, int width = 1) {
  BitField field;
  field.bit = lowest;
  field.name = name;
  field.width = width;
  return field;
}

/// The meaning of a register in a few words. "{}" stands for its number or axis, as in names.
struct Meaning {
  std::string_view in_english;
  std::string_view in_the_manual;  // the manual's own words; empty if it does not mention this register
};

struct RegisterRow {
  std::uint16_t address = 0;
  std::string_view name;   // as printed in the manual, without _L/_RegL; "{}" stands for the number
  std::string_view alias;  // a second spelling, or another name for the first register; may be empty
  Type type = Type::u16;
  Access access = Access::read_write;
  Table table = Table::holding;

  bool ranged = false;  // the manual specifies a range
  Value min = 0;
  Value max = 0;
  std::string_view unit;
  Value factory = 0;
  bool persistent = false;
  bool needs_no_time = false;               // stored in battery-backed RAM or FRAM, not EEPROM
  std::uint32_t stored_bits = 0xFFFF'FFFF;  // the bits of a written value that the register stores

  int count = 1;   // a range of `count` registers,
  int stride = 1;  // `stride` addresses apart; in names, first_number + index * number_step replaces "{}"
  int first_number = 0;
  int number_step = 1;
  std::span<const std::string_view> labels{};  // used in names instead of numbers: the axes, for example
  int first_axis = 0;                          // the axis of the first label
  std::string_view low_half = "_L";            // the manual's endings for the halves of a 32-bit register
  std::string_view high_half = "_H";
  bool swaps_words = false;  // its words are in the opposite order to the model's
  bool swaps_bytes = false;  // the low byte of each word comes first

  Firmware since = 0;
  std::string_view section;  // the section of the manual
  Meaning meaning{};
  std::span<const Meaning> meanings{};             // one per register, if their meanings differ
  std::span<const std::string_view> axis_names{};  // the axes of the registers, if their names have numbers

  int argument = 0;
  Reader reader = nullptr;
  Varies varies = Varies::in_ticks;  // when the reader's value may change
  NextChange next_change = nullptr;  // if the value depends on time
  Effect effect = nullptr;
  bool is_view = false;  // shows other state, or `factory` without a reader; no slot, not persistent
  std::span<const BitField> fields{};
  Message message = nullptr;            // for a window: handles what a request writes from its first word on
  int min_words = 1;                    // the minimum number of words of such a message
  bool acts_on_zero = true;             // false: a trigger, on which writing 0 has no effect
  std::string_view not_implemented;     // if the register only stores and returns its value: what is missing
  Hazards hazards = Hazards::unmarked;  // the hazards of a write; see hazards_of()

  // --- how a row is written down ---------------------------------------------------------------
  /// Specifies what a write can do in a real controller.
  constexpr RegisterRow& may(Hazards what) {
    hazards = what;
    return *this;
  }
  constexpr RegisterRow& also(std::string_view other_spelling) {
    alias = other_spelling;
    return *this;
  }
  constexpr RegisterRow& means(std::string_view in_english, std::string_view in_the_manual = {}) {
    meaning = {.in_english = in_english, .in_the_manual = in_the_manual};
    return *this;
  }
  constexpr RegisterRow& means_each(std::span<const Meaning> one_each) {
    meanings = one_each;
    return *this;
  }
  constexpr RegisterRow& of_axes(std::span<const std::string_view> names) {
    axis_names = names;
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
  /// The register is stored at once, in battery-backed RAM or FRAM.
  constexpr RegisterRow& persists_at_once() {
    needs_no_time = true;
    return persists();
  }
  constexpr RegisterRow& persists() {
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
  /// Sets the step between the numbers of times(): D8100, D8200, ...
  constexpr RegisterRow& numbered_by(int step) {
    number_step = step;
    return *this;
  }
  /// Declares one register per axis, `apart` addresses apart. "{}" in the name stands for the axis. `first`
  /// is the number of the first of these axes, if the row does not include all axes of the device.
  constexpr RegisterRow& each(std::span<const std::string_view> axes, int apart, int first = 0) {
    labels = axes;
    first_axis = first;
    return times(static_cast<int>(axes.size()), apart, 0);
  }
  /// Like range(), for a real.
  constexpr RegisterRow& real_range(float low, float high) {
    return range(value_of_real(low), value_of_real(high));
  }
  constexpr RegisterRow& halves(std::string_view low, std::string_view high) {
    low_half = low;
    high_half = high;
    return *this;
  }
  /// The register's words, or the bytes in them, have a different order from the model's.
  constexpr RegisterRow& ordered(bool other_words, bool other_bytes) {
    swaps_words = other_words;
    swaps_bytes = other_bytes;
    return *this;
  }
  constexpr RegisterRow& since_firmware(Firmware version) {
    since = version;
    return *this;
  }
  template <auto function, Varies when>
  constexpr RegisterRow& reads(int with_argument = 0) {
    reader = Handler<function>::call;
    varies = when;
    argument = with_argument;
    return *this;
  }
  /// The reader's value depends on time: it changes at the ticks that the function returns.
  template <auto function>
  constexpr RegisterRow& changes_at() {
    next_change = Handler<function>::call;
    return *this;
  }
  /// The register is a view of other state: a reader shows the state, and an effect passes writes on to it.
  template <auto function, Varies when>
  constexpr RegisterRow& shows(int with_argument = 0) {
    is_view = true;
    return reads<function, when>(with_argument);
  }
  /// The register is a view with a constant value.
  constexpr RegisterRow& always(Value value) {
    is_view = true;
    return from_factory(value);
  }
  /// The register is a view whose bits represent other state.
  constexpr RegisterRow& shows_bits(std::span<const BitField> of_it, int with_argument = 0) {
    is_view = true;
    return with_bits(of_it, with_argument);
  }
  constexpr RegisterRow& with_bits(std::span<const BitField> of_it, int with_argument = 0) {
    fields = of_it;
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
  /// Returns true if the reader, or the reader of a field, varies with the pulses of an axis.
  constexpr bool moves() const {
    bool does = varies == Varies::while_moving;
    for (const BitField& field : fields) does = does || field.varies == Varies::while_moving;
    return does;
  }
  constexpr RegisterRow& missing_trigger(std::string_view what_is_missing) {
    acts_on_zero = false;
    return not_modelled(what_is_missing);
  }
  constexpr RegisterRow& not_modelled(std::string_view what_is_missing) {
    not_implemented = what_is_missing;
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

constexpr RegisterRow reg(Table table, std::uint16_t address, std::string_view name, Type type,
                          Access access) {
  RegisterRow row = reg(address, name, type, access);
  row.table = table;
  return row;
}
constexpr RegisterRow input(std::uint16_t address, std::string_view name, Type type) {
  return reg(Table::input, address, name, type, Access::read);
}
constexpr RegisterRow coil(std::uint16_t address, std::string_view name, Access access = Access::read_write) {
  return reg(Table::coil, address, name, Type::bit, access);
}
constexpr RegisterRow discrete(std::uint16_t address, std::string_view name) {
  return reg(Table::discrete, address, name, Type::bit, Access::read);
}

constexpr bool can_be_written(const RegisterRow& row) {
  return row.access != Access::read && (row.table == Table::holding || row.table == Table::coil);
}
/// Returns what a write to a register of the row can do. Every write changes at least a value.
constexpr Hazards hazards_of(const RegisterRow& row) {
  if (!can_be_written(row)) return Hazards::settings;  // according to the manual, nothing happens
  return row.hazards | Hazards::settings | (row.persistent ? Hazards::memory : Hazards::reads);
}
/// Returns true if every writable row specifies what a write can do. For each built-in model, this is
/// required at compile time.
constexpr bool are_marked(std::span<const RegisterRow> rows) {
  for (const RegisterRow& row : rows) {
    if (can_be_written(row) && row.hazards == Hazards::unmarked) return false;
  }
  return true;
}
/// Adds the mark to a row that has none.
constexpr RegisterRow marked(RegisterRow row, Hazards hazards) {
  if (row.hazards == Hazards::unmarked) row.hazards = hazards;
  return row;
}

/// Declares words that form a message if one request writes them. "{}" in the name is the word's number.
template <auto function>
constexpr RegisterRow window(std::uint16_t address, std::string_view name, int words, int min = 1) {
  RegisterRow row = reg(address, name, Type::u16, Access::write);
  row.is_view = true;
  row.message = Handler<function>::call;
  row.min_words = min;
  return row.times(words, 1, 0);
}

/// The model's answers to questions that the register map or the Modbus standard leaves open.
struct MapPolicy {
  /// `holes_read_zero` applies to addresses before the last register of a table. Reads beyond that, and
  /// writes, are refused.
  enum class Unmapped : std::uint8_t { refused, reads_zero, holes_read_zero } unmapped = Unmapped::refused;
  enum class WriteOnly : std::uint8_t { reads_zero, refused } write_only = WriteOnly::reads_zero;
  enum class ReadOnly : std::uint8_t { refused, ignores_writes } read_only = ReadOnly::refused;
  /// A write of only half a register is accepted with any resulting value, checked together with the other
  /// half, never accepted, or (for the low half) accepted as the whole value, with its sign.
  enum class Halves : std::uint8_t {
    may_be_written_alone,
    judged_with_the_other,
    come_whole,
    low_gives_the_sign
  } halves = Halves::may_be_written_alone;
  enum class ReadHalves : std::uint8_t {
    may_be_read_alone,
    come_whole
  } read_halves = ReadHalves::may_be_read_alone;
  /// The refusal of a request that contains half a register, if that is not allowed.
  Refusal cut_pair = Refusal::no_register;
  /// With `stored`, the value is stored unchanged and limited when it is used; the range is the manual's.
  enum class OutOfRange : std::uint8_t { refused, clamped, stored } out_of_range = OutOfRange::refused;
  /// What a request with one value out of range writes: nothing, or the registers before that value.
  enum class Partly : std::uint8_t { never, up_to_the_refused } partly = Partly::never;
  /// When the registers of a request take effect: after all of them are stored, or one by one.
  enum class Effects : std::uint8_t { after_all, one_by_one } effects = Effects::after_all;
  bool low_word_first = true;
  /// The holding register that selects the word order, if the order can change; 1 means low word first. It is
  /// for our own hosts; the device itself reports the present order (RegisterBank::low_word_first).
  std::string_view word_order_in{};
};

}  // namespace understudy::emulator
