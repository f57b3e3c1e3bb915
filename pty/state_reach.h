// Limits the times in a restored state, so that sums of a few of them do not overflow.
#pragma once

#include "pty/line_settings.h"

namespace understudy::pty {

constexpr bool is_within_reach(SimTime time) {
  constexpr SimTime kFarthest{std::int64_t{1} << 61};
  return time >= -kFarthest && time <= kFarthest;
}

}  // namespace understudy::pty
