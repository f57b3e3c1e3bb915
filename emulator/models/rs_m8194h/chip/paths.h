// RS-M8194H: interpolation as a value. One group of axes at a time follows a path (7.2, 7.4).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/state/fields.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "motion/coordinated.h"
#include "motion/state_fields.h"

namespace understudy::emulator::models::rs_m8194h {

/// The kinds of streams, each with its own INITIAL and CONTINUE commands.
enum class Stream : std::uint8_t { line_2d, line_3d, mix_2d };
inline constexpr std::size_t kStreams = 3;

/// The settings from an INITIAL, for all CONTINUE commands of its kind.
struct StreamSettings {
  bool given = false;
  std::array<std::uint8_t, 3> axes{};  // axis codes; 0: none
  bool constant = false;
  std::uint32_t start_pps = 0;
  std::uint32_t drive_pps = 0;
  std::uint32_t acceleration = 0;

  bool operator==(const StreamSettings&) const = default;
};

struct Paths {
  enum class Runs : std::uint8_t { nothing, single, stream, rectangle, helix };

  motion::Coordinated together{};
  Runs runs = Runs::nothing;
  Stream stream = Stream::line_2d;  // valid only if `runs` or `open` is true
  bool open = false;        // the last segment of the stream has not arrived; the stream may have starved
  std::uint8_t broken = 0;  // streams that were broken off, as bits by Stream, until they begin again
  AxisMask axes = 0;        // axes of the running path
  std::array<std::uint8_t, 3> assigned{};  // AXIS_ASSIGN
  SpeedSettings vector{};                  // set by VECTOR_SPEED and VSV to VAO
  std::array<StreamSettings, kStreams> streams{};
  std::array<double, 4> end{};  // end of the queued paths, in pulses from where they began
  std::int8_t constant_axis = motion::Coordinated::kNone;  // axis1 of a path at constant speed (a choice)

  bool operator==(const Paths&) const = default;

  bool is_driving(std::size_t axis) const { return together.takes(axis); }
};

/// Returns the bit of a stream kind in Paths::broken.
constexpr std::uint8_t bit_of(Stream stream) {
  return static_cast<std::uint8_t>(1U << static_cast<unsigned>(stream));
}

/// Returns the axes in a list of axis codes.
constexpr AxisMask mask_of_codes(const std::array<std::uint8_t, 3>& codes) {
  return static_cast<AxisMask>((codes[0] | codes[1] | codes[2]) & kAllAxes);
}
/// Returns the number of an axis code 1, 2, 4 or 8, or -1.
constexpr std::int8_t axis_of_code(std::uint8_t code) {
  return static_cast<std::int8_t>(code == 1 ? 0 : code == 2 ? 1 : code == 4 ? 2 : code == 8 ? 3 : -1);
}

}  // namespace understudy::emulator::models::rs_m8194h

namespace understudy {

template <>
struct StateOf<emulator::models::rs_m8194h::Stream> {
  static constexpr auto last = emulator::models::rs_m8194h::Stream::mix_2d;
};

template <>
struct StateOf<emulator::models::rs_m8194h::Paths::Runs> {
  static constexpr auto last = emulator::models::rs_m8194h::Paths::Runs::helix;
};

template <>
struct StateOf<emulator::models::rs_m8194h::StreamSettings> {
  using Value = emulator::models::rs_m8194h::StreamSettings;
  static constexpr auto fields =
      FieldList{field<&Value::given>(),     field<&Value::axes>(),      field<&Value::constant>(),
                field<&Value::start_pps>(), field<&Value::drive_pps>(), field<&Value::acceleration>()};
};

template <>
struct StateOf<emulator::models::rs_m8194h::Paths> {
  using Value = emulator::models::rs_m8194h::Paths;
  static constexpr auto fields =
      FieldList{field<&Value::together>(), field<&Value::runs>(),         field<&Value::stream>(),
                field<&Value::open>(),     field<&Value::broken>(),       field<&Value::axes>(),
                field<&Value::assigned>(), field<&Value::vector>(),       field<&Value::streams>(),
                field<&Value::end>(),      field<&Value::constant_axis>()};
  static void check(const Value& paths) {
    require_state(paths.constant_axis >= -1 && paths.constant_axis < 4,
                  "a path has an axis that does not exist");
    require_state(paths.broken >> emulator::models::rs_m8194h::kStreams == 0, "a stream does not exist");
  }
};

}  // namespace understudy
