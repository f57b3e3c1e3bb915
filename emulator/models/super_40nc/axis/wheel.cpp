#include "emulator/models/super_40nc/axis/wheel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "emulator/models/super_40nc/axis/axis_state.h"
#include "emulator/models/super_40nc/axis/ownership.h"
#include "emulator/models/super_40nc/ground/ground.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/row_words.h"
#include "emulator/models/super_40nc/rows/settings.h"
#include "interpreter/super_40nc/error.h"
#include "motion/axis.h"
#include "motion/following.h"
#include "motion/unit_scale.h"

namespace understudy::emulator::models::super_40nc {

std::int64_t Wheel::wheel_lu_per_count(int axis_number) const {
  const Settings settings = registers();
  if (settings.is_on(stored_x(d9x::kMpgDisable), axis_number)) return 0;
  switch (axis(axis_number).wheel) {
    case WheelSource::none: return 0;
    case WheelSource::mpg_line: return axis(axis_number).wheel_lu;
    case WheelSource::contact_1: return settings.of(stored_x(d9x::kMpg1Rate), axis_number);
    case WheelSource::contact_10: return settings.of(stored_x(d9x::kMpg10Rate), axis_number);
    case WheelSource::contact_100: return settings.of(stored_x(d9x::kMpg100Rate), axis_number);
    case WheelSource::selector: break;
  }
  switch (settings.raw(stored_d(d8::kUserData1))) {
    case 0: return settings.of(stored_x(d9x::kMpg1Rate), axis_number);
    case 1: return settings.of(stored_x(d9x::kMpg10Rate), axis_number);
    case 2: return settings.of(stored_x(d9x::kMpg100Rate), axis_number);
    default: return 0;
  }
}

/// Sets the ratio from the present parameters. The remainder of earlier counts is kept unless the divider
/// changes.
void Wheel::follow_ratio(int axis) {
  motion::Follower& follower = chip(axis).follower;
  const Settings settings = registers();
  const motion::UnitScale scale = settings.scale(axis);
  const int sense = settings.is_on(stored_x(d9x::kMpgDirection), axis) ? -1 : +1;
  constexpr std::int64_t kMax = INT32_MAX;
  follower.numerator =
      std::clamp<std::int64_t>(wheel_lu_per_count(axis) * scale.multiplier, -kMax, kMax) * sense;
  if (follower.denominator != scale.divider) follower.left_over = 0;
  follower.denominator = scale.divider;
  if (chose(option("wheel_ratio", "pulses_per_count"))) {
    follower.numerator = wheel_lu_per_count(axis) * sense;
    follower.denominator = 1;
  }
  follower.catches_up = chose(option("wheel_speed", "caught_up"));
  follower.top_speed_pps = std::max<std::int64_t>(1, std::llround(std::min(settings.top_pps(axis), 2e9)));
}

void Wheel::start_wheel(int axis_number, WheelSource source) {
  AxisState& state = axis(axis_number);
  const Grant given = starts_.ask(axis_number, Request::wheel);
  if (given == Grant::continues_if_same_kind && state.wheel != source) report(Code::axis_taken);
  if (given != Grant::starts) return;
  starts_.prepare(axis_number);
  motion::AxisSettings without_backlash = chip(axis_number).settings;
  without_backlash.backlash_pulses = 0;
  chip(axis_number).set(without_backlash);
  starts_.begun(axis_number, chip(axis_number).follow({}), Activity::wheel);
  if (state.holder != Activity::wheel) return;
  state.wheel = source;
  state.wheel_edges = 0;
  follow_ratio(axis_number);
  constexpr int kModeWheel = 0x01;
  starts_.mirror_start(axis_number, kModeWheel, 0, {});
}

void Wheel::feed_wheel(std::int32_t edges) {
  for (int number = 0; number < kAxisCount; ++number) {
    AxisState& state = axis(number);
    if (state.holder != Activity::wheel) continue;
    follow_ratio(number);
    static constexpr std::array<std::int32_t, 4> kEdgesOfACount{4, 2, 1, 1};
    const bool is_decoded = chose(option("wheel_input", "counts"));
    const auto decoding = static_cast<std::size_t>(registers().of(stored_x(d9x::kMpgMode), number));
    const std::int32_t each = is_decoded ? 1 : kEdgesOfACount[decoding];
    const std::int64_t sum = std::int64_t{state.wheel_edges} + edges;
    const std::int64_t counts = (sum - ((sum % each) + each) % each) / each;
    state.wheel_edges = static_cast<std::int32_t>(sum - counts * each);
    if (counts != 0) chip(number).feed(counts);
  }
}

/// At a limit, the wheel has no effect in the direction of the limit.
void Wheel::wheel_ended(int axis) {
  const motion::Cause why = chip(axis).cause;
  const bool is_limit = why == motion::Cause::limit_plus || why == motion::Cause::limit_minus ||
                        why == motion::Cause::soft_limit_plus || why == motion::Cause::soft_limit_minus;
  if (why != motion::Cause::stopped) starts_.fail(axis, code_of(why));
  const bool ends = chose(option("wheel_at_limit", "following_ends"));
  if (!is_limit || ends || chip(axis).follow({}) != motion::Cause::none) return starts_.let_go(axis);
  follow_ratio(axis);
}

}  // namespace understudy::emulator::models::super_40nc
