// RS-M8194H: what the firmware stores for an axis, in addition to the motor that sends its pulses
// (motion/axis.h).
//
//   commands ──> motor ──> travel ──> LP, EP, ABS: three counters of the same pulses
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "base/simulated_time.h"
#include "base/state/fields.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/terminals.h"
#include "motion/axis.h"
#include "motion/counter.h"
#include "motion/encoder_line.h"
#include "motion/environment.h"
#include "motion/external_drive.h"
#include "motion/state_fields.h"

namespace understudy::emulator::models::rs_m8194h {

/// Bits of ERROR_CODE (4.9.2).
enum class ErrorBit : std::uint8_t {
  soft_limit_plus,
  soft_limit_minus,
  limit_plus,
  limit_minus,
  alarm,
  emergency,
  reserved,
  home,
  soft_stop,
  soft_emergency,
};
inline constexpr std::size_t kErrors = 10;
/// The number of the transition table that counts the errors.
inline constexpr std::size_t kErrorTable = 3;
constexpr std::uint16_t bit_of(ErrorBit bit) {
  return static_cast<std::uint16_t>(1U << static_cast<unsigned>(bit));
}

/// The factors that call an ISR, nINT 0 to 7 (7.3.12), and two others that inputs 138 and 139 show.
enum class Factor : std::uint8_t {
  pulse,
  at_least_minus,  // P >= C-
  below_minus,     // P < C-
  below_plus,      // P < C+
  at_least_plus,   // P >= C+
  constant_ended,
  constant_started,
  drive_ended,
  homed,
  synchronous,
};
inline constexpr std::size_t kIsrFactors = 8;
inline constexpr std::size_t kFactors = 10;

/// The events that are interrupt factors, in the order of nINT (7.3.12).
inline constexpr std::array<motion::Event, kIsrFactors> kFactorEvents{motion::Event::pulse,
                                                                      motion::Event::comparator_3,
                                                                      motion::Event::comparator_2,
                                                                      motion::Event::comparator_1,
                                                                      motion::Event::comparator_0,
                                                                      motion::Event::constant_ended,
                                                                      motion::Event::constant_started,
                                                                      motion::Event::ended};

/// Returns the error bit for a cause that ends a motion or prevents it from beginning (drives/ends.cpp).
std::uint16_t error_of(motion::Cause cause);

/// What an axis is doing.
enum class Activity : std::uint8_t { idle, single, path, homing };
inline constexpr std::size_t kActivities = 4;

/// A drive of one axis, as requested by a command.
struct Drive {
  enum class What : std::uint8_t { none, fixed, absolute, endless, home, scan };
  What what = What::none;
  std::int32_t value = 0;  // pulses, a position, or pulses per second

  bool operator==(const Drive&) const = default;
};

/// C+ or C-: a value, and the counter with which it is compared (7.3.6).
struct Compare {
  std::int32_t value = 0;
  std::uint8_t source = 0;  // 0 LP, 1 EP

  bool operator==(const Compare&) const = default;
};

/// The output settings of an activated axis, which motion/synchronous.h does not include (7.3.5).
struct OutSettings {
  std::uint8_t level = 0;       // outEdge
  std::uint8_t width_code = 0;  // PulseWidth
  std::int64_t pulses = 0;      // number of pulses output so far
  Tick pulse_until = 0;         // end of the last pulse, if it is a millisecond long or more

  bool operator==(const OutSettings&) const = default;
};

/// Returns the time in nanoseconds that is `takes_s` seconds after `at_ns`.
constexpr std::int64_t after(std::int64_t at_ns, double takes_s) {
  constexpr double kMax_s = 1e9;
  const double whole_ns = std::clamp(takes_s, 0.0, kMax_s) * 1e9;
  return at_ns + static_cast<std::int64_t>(whole_ns);
}

/// Input levels behind the input filter, which passes a level only after a delay (3.14).
struct FilteredPins {
  std::uint16_t raw = 0;                  // levels at the terminals; a bit is 1 while conducting
  std::uint16_t passed = 0;               // levels after the filter, as the chip sees them
  std::array<Tick, kPinsOfAxis> since{};  // the last change of each raw bit

  bool operator==(const FilteredPins&) const = default;
};

struct AxisUnit {
  BasicSettings basic{};
  SpeedSettings speed{};
  HomeSettings homing{};
  motion::Counter logic{};
  motion::Counter absolute{};
  motion::Counter encoder{};  // counts the travel, or the bench's encoder if there is one
  bool has_encoder = false;
  std::int64_t encoder_raw = 0;   // count of the bench's encoder, in edges
  std::int64_t encoder_zero = 0;  // raw count at which the divided count was 0
  std::int64_t sent_pulses = 0;   // pulses of the last tick
  std::uint16_t error_code = 0;
  std::uint16_t met = 0;              // error bits for the causes because of which the path is slowing down
  bool locked = false;                // locked by STOP_*
  bool path_locked = false;           // locked by VSTOP_*
  bool held = false;                  // held by DRV_HOLD
  Drive held_drive{};                 // the drive that waits for DRV_START, or for its axis to stop
  Drive paused_drive{};               // the drive that continues after a trigger's pause
  std::int64_t paused_to_pulses = 0;  // travel at which the paused drive ends, if it ends
  FilteredPins pins{};
  bool emergency = false;  // the EMG input, after its filter
  motion::ExternalDrive external{};
  std::int64_t began_pulses = 0;                 // travel at the beginning of the last drive
  std::uint32_t external_pps = 0;                // the speed of EXD_CP
  std::array<std::uint32_t, 2> external_seen{};  // edges of EXP+ and EXP- seen so far
  std::int64_t external_waiting = 0;  // pulses for edges that came after the last drive's last pulse
  std::int64_t external_free_ns = 0;  // end of the last drive's pulses; 0: it was not a move by edges
  std::array<Compare, 2> compare{};   // C+, C-
  std::uint8_t factors = 0;           // INTFACTOR_ENABLE, one bit per nINT
  std::array<std::uint8_t, kIsrFactors> isr_of{};
  std::uint8_t action_isr = 0;  // the ISR in its action set
  OutSettings out{};
  std::int32_t latched = 0;

  bool operator==(const AxisUnit&) const = default;
};

SpeedRange range_of(const AxisUnit& axis, const SpeedRules& rules);
/// Returns the speed law of a drive at a speed other than V.
motion::SpeedLaw law_at(const AxisUnit& axis, std::uint32_t drive_pps, const SpeedRules& rules);
motion::SpeedLaw law_of(const AxisUnit& axis, const SpeedRules& rules);

/// Returns the travel that EP counts: that of the bench's encoder, or that of the pulses themselves.
std::int64_t encoder_travel(const AxisUnit& axis, const motion::Axis& motor);
/// These return the three counters.
std::int32_t logic_count(const AxisUnit& axis, const motion::Axis& motor);
std::int32_t absolute_count(const AxisUnit& axis, const motion::Axis& motor);
std::int32_t encoder_count(const AxisUnit& axis, const motion::Axis& motor);
/// Sets LP or EP. A count beyond the ring wraps into it if `ring_folds`; otherwise, it remains as a 32-bit
/// count until it enters the ring.
void set_count(motion::Counter& counter, const BasicSettings& settings, std::int64_t count,
               std::int64_t travel, bool ring_folds);
void set_logic_position(AxisUnit& axis, motion::Axis& motor, std::int32_t value, bool ring_folds);
void set_absolute_position(AxisUnit& axis, motion::Axis& motor, std::int32_t value, bool ring_folds);
void set_encoder_position(AxisUnit& axis, motion::Axis& motor, std::int32_t value, bool ring_folds);
/// Returns true if a count is outside its ring, which a choice allows until the count enters the ring.
bool is_beyond_ring(const AxisUnit& axis);
void enter_ring(AxisUnit& axis, const motion::Axis& motor);
/// Sets the levels of EXP+ and EXP- from the number of edges seen so far: a line is low after each odd edge.
void set_external_levels(AxisUnit& axis);
/// Updates the bench's encoder to this count of edges.
void update_encoder(AxisUnit& axis, motion::Axis& motor, std::int64_t raw_count);

/// Applies the basic settings, including to a running motion.
void apply_basic(AxisUnit& axis, motion::Axis& motor, const BasicSettings& settings,
                 const AxisOptions& options);
/// Arms the motor's limits and comparators. Call this again whenever a counter, a limit or a comparator is
/// set. `asked` contains the events that are in use.
void arm(const AxisUnit& axis, motion::Axis& motor, motion::Events asked, const AxisOptions& options);
/// Returns EP as a function of the travel, with the settings of the axis, for a machine with this encoder
/// line.
motion::EncoderLine encoder_line(const AxisUnit& axis, motion::EncoderLine machine);

/// A choice: bits 5 to 9 of DI_ALL contain either the levels of the lines, or whether the inputs are active
/// according to their settings.
enum class UpperBits : std::uint8_t { line_levels, active };
/// Return DI_ALL (4.6.2) and DI_SIGNAL (4.7.2).
std::uint16_t di_all_word(const AxisUnit& axis, bool emergency_is_on, bool is_driving, UpperBits upper);
std::uint16_t di_signal_word(const AxisUnit& axis);
/// Returns true if a pin is at the active level according to its setting: 0 is low, and "on" is low.
constexpr bool is_active(bool is_on, std::uint8_t level_setting) { return is_on == (level_setting == 0); }

}  // namespace understudy::emulator::models::rs_m8194h

namespace understudy {

template <>
struct StateOf<emulator::models::rs_m8194h::Drive::What> {
  static constexpr auto last = emulator::models::rs_m8194h::Drive::What::scan;
};

template <>
struct StateOf<emulator::models::rs_m8194h::Drive> {
  using Value = emulator::models::rs_m8194h::Drive;
  static constexpr auto fields = FieldList{field<&Value::what>(), field<&Value::value>()};
};

template <>
struct StateOf<emulator::models::rs_m8194h::Compare> {
  using Value = emulator::models::rs_m8194h::Compare;
  static constexpr auto fields = FieldList{field<&Value::value>(), field<&Value::source>()};
};

template <>
struct StateOf<emulator::models::rs_m8194h::OutSettings> {
  using Value = emulator::models::rs_m8194h::OutSettings;
  static constexpr auto fields = FieldList{field<&Value::level>(), field<&Value::width_code>(),
                                           field<&Value::pulses>(), field<&Value::pulse_until>()};
};

template <>
struct StateOf<emulator::models::rs_m8194h::FilteredPins> {
  using Value = emulator::models::rs_m8194h::FilteredPins;
  static constexpr auto fields =
      FieldList{field<&Value::raw>(), field<&Value::passed>(), field<&Value::since>()};
};

template <>
struct StateOf<emulator::models::rs_m8194h::AxisUnit> {
  using Value = emulator::models::rs_m8194h::AxisUnit;
  static constexpr auto fields = FieldList{field<&Value::basic>(),
                                           field<&Value::speed>(),
                                           field<&Value::homing>(),
                                           field<&Value::logic>(),
                                           field<&Value::absolute>(),
                                           field<&Value::encoder>(),
                                           field<&Value::has_encoder>(),
                                           field<&Value::encoder_raw>(),
                                           field<&Value::encoder_zero>(),
                                           field<&Value::sent_pulses>(),
                                           field<&Value::error_code>(),
                                           field<&Value::met>(),
                                           field<&Value::locked>(),
                                           field<&Value::path_locked>(),
                                           field<&Value::held>(),
                                           field<&Value::held_drive>(),
                                           field<&Value::paused_drive>(),
                                           field<&Value::paused_to_pulses>(),
                                           field<&Value::pins>(),
                                           field<&Value::emergency>(),
                                           field<&Value::external>(),
                                           field<&Value::began_pulses>(),
                                           field<&Value::external_pps>(),
                                           field<&Value::external_seen>(),
                                           field<&Value::external_waiting>(),
                                           field<&Value::external_free_ns>(),
                                           field<&Value::compare>(),
                                           field<&Value::factors>(),
                                           field<&Value::isr_of>(),
                                           field<&Value::action_isr>(),
                                           field<&Value::out>(),
                                           field<&Value::latched>()};
  static void check(const Value& unit) {
    require_state(unit.speed.mode < 4, "a speed mode of an axis is not in the manual");
    for (const Tick since : unit.pins.since)
      require_state(since >= -kFar && since <= kFar, "a time is out of range");
    require_state(unit.began_pulses >= -kFar && unit.began_pulses <= kFar, "a drive began too far away");
    require_state(unit.external_waiting >= -kFar && unit.external_waiting <= kFar,
                  "too many pulses are waiting");
    require_state(unit.out.pulse_until >= -kFar && unit.out.pulse_until <= kFar, "a pulse is too long");
    require_state(unit.encoder_raw >= -kFar && unit.encoder_raw <= kFar && unit.encoder_zero >= -kFar &&
                      unit.encoder_zero <= kFar,
                  "an encoder count is too large");
  }
  static constexpr std::int64_t kFar = std::int64_t{1} << 56;
};

}  // namespace understudy
