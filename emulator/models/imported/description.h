// Describes a controller that a user imports: a list of registers, and the purpose of some of them. All of it
// is data that owns its names. emulator/model_file/ reads it from files, and model.h creates a Model from it.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/complete_table.h"
#include "base/files/file_error.h"
#include "base/simulated_time.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/row.h"
#include "motion/unit_scale.h"

namespace understudy::emulator::models::imported {

struct BitName {
  std::string name;
  int bit = 0;
  int width = 1;
};

/// The order of the words of a quantity, and of the bytes in each word, on the line.
struct WordOrder {
  enum class Words : std::uint8_t { as_the_model, high_first, low_first } words = Words::as_the_model;
  bool low_byte_first = false;
  bool operator==(const WordOrder&) const = default;
};

struct ListedRegister {
  Table table = Table::holding;
  std::uint16_t address = 0;
  std::string name{};
  std::string printed{};  // the name in the manual, if it cannot be used as `name`
  std::string alias{};    // the name that another row of the list uses for it
  Type type = Type::u16;
  bool is_bcd = false;  // each four bits are a decimal digit; all values here are in this code
  WordOrder order{};
  Access access = Access::read_write;
  bool ranged = false;
  Value min = 0;
  Value max = 0;
  std::string unit{};
  bool persistent = false;
  Value factory = 0;
  std::vector<BitName> bits{};
  Firmware since = 0;  // 0: in every firmware
};

/// Returns the number that binary-coded decimals stand for.
constexpr Value decoded(Value code) {
  Value number = 0;
  for (int shift = 28; shift >= 0; shift -= 4) number = number * 10 + ((code >> shift) & 0xF);
  return number;
}
/// Returns the nearest number that fits, as binary-coded decimals.
constexpr Value coded(Value number, Type type) {
  number = std::clamp<Value>(number, 0, is_32_bit(type) ? 99'999'999 : 9999);
  Value made = 0;
  for (int shift = 0; number > 0; number /= 10, shift += 4) made |= (number % 10) << shift;
  return made;
}
/// Returns the number that a stored value of a register stands for.
constexpr Value meaning_of(const ListedRegister& listed, Value stored) {
  return listed.is_bcd ? decoded(stored) : stored;
}

/// Names a register, by its number in the list, or some of its bits.
struct Spot {
  std::size_t number = 0;
  int bit = -1;  // the lowest bit; -1: the whole register
  int width = 1;
  bool is_whole() const { return bit < 0; }
  bool operator==(const Spot&) const = default;
};

/// The value of a register, or a fixed number.
struct Quantity {
  std::optional<Spot> spot{};
  double number = 0;  // used if there is no register
  double unit = 1;    // the quantity that one count represents
};

/// A condition that is true if the spot contains `value`, or, without a value, if the spot is not 0.
struct Condition {
  Spot spot;
  std::optional<Value> value{};
  bool matches(Value held) const { return value ? held == *value : held != 0; }
};

// --- axes ------------------------------------------------------------------------------------------

/// The numbers that an axis reads from registers. Distances are in position counts, speeds in speed counts.
enum class Number : std::uint8_t {
  target,
  distance,
  speed,
  start_speed,
  acceleration_time,
  deceleration_time,
  acceleration,
  deceleration,
  rated_speed,
  home_speed,
};
inline constexpr std::size_t kNumbers = 10;

/// The commands that hosts issue to an axis, in the order in which they take effect if one request contains
/// several.
enum class Command : std::uint8_t {
  stop_at_once,
  stop,
  enable,  // as long as the condition is true
  home,
  start,           // to `target`
  start_relative,  // by `distance`
  forward,         // as long as the condition is true
  backward,        // as long as the condition is true
};
inline constexpr std::size_t kCommands = 8;
/// Returns true if a command applies as long as its condition is true, and false for a one-shot command.
constexpr bool is_level(Command command) {
  return command == Command::enable || command == Command::forward || command == Command::backward;
}

/// The properties of an axis that registers can show.
enum class View : std::uint8_t {
  position,
  actual_speed,
  encoder,
  busy,
  ready,
  arrived,
  homed,
  enabled,
  alarm,
  at_upper_limit,
  at_lower_limit,
};
inline constexpr std::size_t kViews = 11;
/// When each view changes without a write from a host.
inline constexpr HandlerRow<View, Varies> kChangesOfViews[] = {
    {View::position, Varies::while_moving},   {View::actual_speed, Varies::while_moving},
    {View::encoder, Varies::while_moving},    {View::busy, Varies::in_ticks},
    {View::ready, Varies::in_ticks},          {View::arrived, Varies::in_ticks},
    {View::homed, Varies::in_ticks},          {View::enabled, Varies::in_ticks},
    {View::alarm, Varies::in_ticks},          {View::at_upper_limit, Varies::in_ticks},
    {View::at_lower_limit, Varies::in_ticks},
};
static_assert(std::size(kChangesOfViews) == kViews);
constexpr Varies changes_of(View view) {
  constexpr std::array kAll = [] {
    std::array<View, kViews> all{};
    for (std::size_t i = 0; i < kViews; ++i) all[i] = static_cast<View>(i);
    return all;
  }();
  constexpr CompleteTable<View, Varies> kTable(kAll, kChangesOfViews);
  return kTable[view];
}
/// Returns true if the view is 0 or 1.
constexpr bool is_flag(View view) { return view >= View::busy; }

/// The effect of a start while the axis is moving: the axis continues to the new target, nothing happens, or
/// the answer is `busy`.
enum class WhileBusy : std::uint8_t { replace, ignore, refuse };
/// The effect of a start while the axis is not enabled: nothing happens, or the answer is `failure`.
enum class WhileDisabled : std::uint8_t { ignore, refuse };

struct AxisBinding {
  std::string name;
  std::array<std::optional<Quantity>, kNumbers> numbers{};
  std::array<std::optional<Condition>, kCommands> commands{};
  std::array<std::optional<Spot>, kViews> views{};
  motion::UnitScale pulses_per_count{};  // pulses per position count
  double pps_per_count = 1;              // pulses per second per speed count
  // Numbers of inputs; -1: none.
  int upper_limit_input = -1;
  int lower_limit_input = -1;
  int home_input = -1;
  int alarm_input = -1;
  int home_direction = -1;        // direction of the search for the home switch
  Value home_position = 0;        // the position in counts when home has been found
  int pulses_per_revolution = 0;  // 0: unknown
  WhileBusy while_busy = WhileBusy::replace;
  WhileDisabled while_disabled = WhileDisabled::ignore;

  const std::optional<Quantity>& number(Number which) const {
    return numbers[static_cast<std::size_t>(which)];
  }
  const std::optional<Condition>& command(Command which) const {
    return commands[static_cast<std::size_t>(which)];
  }
};

// --- values that do not belong to an axis ------------------------------------------------------------------

/// A register that follows another value, such as a temperature that follows its setpoint.
struct Following {
  Spot spot;                              // a whole register
  Quantity of;                            // the followed value
  std::optional<Condition> as_long_as{};  // the condition for following; none: always
  Quantity rest;                          // the value that it otherwise approaches
  double time_constant_s = 0;             // 0: immediate, limited only by `max_per_s`
  double max_per_s = 0;                   // counts per second; 0: no limit
  Tick every = 100;                       // the interval between updates
};

/// A bit or a register that is 1 while a comparison is true.
struct Comparison {
  enum class Relation : std::uint8_t { less, at_most, equal, unequal, at_least, greater };
  Spot spot;
  Quantity left;
  Relation relation = Relation::equal;
  Quantity right;
};

struct Terminal {
  std::string name;
  bool is_input = true;
  std::optional<Spot> spot{};  // none for an input that no register shows
};

// --- the line ----------------------------------------------------------------------------------------

struct Line {
  bool is_ascii = false;  // Modbus ASCII frames
  std::vector<int> bauds{19200, 9600};
  int data_bits = 8;
  pty::Parity parity = pty::Parity::none;
  int stop_bits = 1;
  std::optional<pty::SimTime> silence{};  // silence that ends a frame; none: 3.5 characters
  int lowest_station = 1;
  int highest_station = 247;
  std::string station_in{};  // name of the register that stores the station number; empty: none
  std::vector<std::uint8_t> functions{1, 2, 3, 4, 5, 6, 15, 16};
  std::vector<FunctionLimit> limits{};
  std::vector<std::pair<std::uint8_t, std::string>> identity{};  // for function 43/14, ascending
  std::string server_id{};                                       // for function 17
  bool obeys_broadcasts = true;
};

/// Returns the silence of the Modbus standard: 3.5 characters, but 1.75 ms above 19200 baud.
inline pty::SimTime standard_silence(const pty::LineSettings& settings) {
  if (settings.baud > 19200) return std::chrono::microseconds(1750);
  return settings.duration_of(7) / 2;
}

struct Description {
  std::string name{};
  std::string title{};
  std::string text{};                            // the text of the whole controller (Model::description)
  std::vector<FileError::Diagnostic> remarks{};  // what its files leave open, and how that was interpreted
  std::vector<Firmware> firmwares{100};          // ascending; the last is the default
  std::vector<ListedRegister> registers{};
  MapPolicy policy{.low_word_first = false};
  Line line{};
  std::vector<Terminal> terminals{};  // inputs, then outputs
  std::vector<AxisBinding> axes{};
  std::vector<Following> followings{};
  std::vector<Comparison> comparisons{};
  std::vector<std::size_t> momentary{};  // registers that return to 0 when their command has started
};

}  // namespace understudy::emulator::models::imported
