// A controller that a user describes: a list of registers, and what some of them are for. All of it is data
// with names of its own; whoever reads files makes it (emulator/model_file/), model.h makes a Model of it.
#pragma once

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

struct ListedRegister {
  Table table = Table::holding;
  std::uint16_t address = 0;
  std::string name{};
  Type type = Type::u16;
  Access access = Access::read_write;
  bool ranged = false;
  Value least = 0;
  Value most = 0;
  std::string unit{};
  bool persistent = false;
  Value factory = 0;
  std::vector<BitName> bits{};
};

/// A register, by its number in the list, or bits of it.
struct Spot {
  std::size_t number = 0;
  int bit = -1;  // the lowest of them; -1: the whole register
  int width = 1;
  bool is_whole() const { return bit < 0; }
  bool operator==(const Spot&) const = default;
};

/// What a register holds, or a number in its place.
struct Quantity {
  std::optional<Spot> spot{};
  double number = 0;  // where there is no register
  double unit = 1;    // what a count stands for
};

/// Holds where the spot has `value`, or without one anything but 0.
struct Condition {
  Spot spot;
  std::optional<Value> value{};
  bool matches(Value held) const { return value ? held == *value : held != 0; }
};

// --- axes ------------------------------------------------------------------------------------------

/// What an axis asks registers for. Distances are counts of position, speeds counts of speed.
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

/// What hosts tell an axis. The order is that in which those of one request act.
enum class Command : std::uint8_t {
  stop_at_once,
  stop,
  enable,  // while it holds
  home,
  start,           // to `target`
  start_relative,  // by `distance`
  forward,         // while it holds
  backward,        // while it holds
};
inline constexpr std::size_t kCommands = 8;
/// Whether it counts as long as it holds, or at the moment when it is given.
constexpr bool is_level(Command command) {
  return command == Command::enable || command == Command::forward || command == Command::backward;
}

/// What registers show of an axis.
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
/// When each of them changes although no host writes it.
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
/// Whether it is 0 or 1.
constexpr bool is_flag(View view) { return view >= View::busy; }

/// What a start does while the axis moves: goes on to the new target, nothing, or it is answered by busy.
enum class WhileBusy : std::uint8_t { replace, ignore, refuse };
/// And while it is not enabled: nothing, or it is answered by failure.
enum class WhileDisabled : std::uint8_t { ignore, refuse };

struct AxisBinding {
  std::string name;
  std::array<std::optional<Quantity>, kNumbers> numbers{};
  std::array<std::optional<Condition>, kCommands> commands{};
  std::array<std::optional<Spot>, kViews> views{};
  motion::UnitScale pulses_per_count{};  // of position
  double pps_per_count = 1;              // of speed
  // Numbers of inputs; -1: there is none.
  int upper_limit_input = -1;
  int lower_limit_input = -1;
  int home_input = -1;
  int alarm_input = -1;
  int home_way = -1;              // where the home switch is looked for
  Value home_position = 0;        // counts, once it is found
  int pulses_per_revolution = 0;  // 0: it is not known
  WhileBusy while_busy = WhileBusy::replace;
  WhileDisabled while_disabled = WhileDisabled::ignore;

  const std::optional<Quantity>& number(Number which) const {
    return numbers[static_cast<std::size_t>(which)];
  }
  const std::optional<Condition>& command(Command which) const {
    return commands[static_cast<std::size_t>(which)];
  }
};

// --- what has no axis --------------------------------------------------------------------------------

/// A register that comes after another value, as a temperature comes after its setpoint.
struct Following {
  Spot spot;                              // a whole register
  Quantity of;                            // where it goes
  std::optional<Condition> as_long_as{};  // none: always
  Quantity rest;                          // where it goes otherwise
  double time_constant_s = 0;             // 0: at once, but for `most_per_s`
  double most_per_s = 0;                  // counts a second; 0: any
  Tick every = 100;                       // how often it is renewed
};

/// A bit or a register that is 1 while a relation holds.
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
  std::optional<Spot> spot{};  // an input that is shown nowhere has none
};

// --- the line ----------------------------------------------------------------------------------------

struct Line {
  std::vector<int> bauds{19200, 9600};
  pty::Parity parity = pty::Parity::none;
  int stop_bits = 1;
  std::optional<pty::SimTime> silence{};  // that ends a frame; none: 3.5 characters
  int lowest_station = 1;
  int highest_station = 247;
  std::string station_in{};  // the register that holds the number; empty: none does
  std::vector<std::uint8_t> functions{1, 2, 3, 4, 5, 6, 15, 16};
  std::vector<FunctionLimit> limits{};
  bool obeys_broadcasts = true;
};

/// 3.5 characters, and above 19200 baud always 1.75 ms: as Modbus has it.
inline pty::SimTime standard_silence(const pty::LineSettings& settings) {
  if (settings.baud > 19200) return std::chrono::microseconds(1750);
  return settings.duration_of(7) / 2;
}

struct Description {
  std::string name{};
  std::string title{};
  std::string text{};  // of the whole (Model::description)
  std::vector<ListedRegister> registers{};
  MapPolicy policy{.low_word_first = false};
  Line line{};
  std::vector<Terminal> terminals{};  // inputs, then outputs
  std::vector<AxisBinding> axes{};
  std::vector<Following> followings{};
  std::vector<Comparison> comparisons{};
  std::vector<std::size_t> momentary{};  // registers that are 0 again once what they start has been started
};

}  // namespace understudy::emulator::models::imported
