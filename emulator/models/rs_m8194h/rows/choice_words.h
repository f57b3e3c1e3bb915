// Short names for the confidence levels of choices, for the rows of RS-M8194H.
#pragma once

#include "base/choices.h"

namespace understudy::emulator::models::rs_m8194h {

inline constexpr Confidence kFollows = Confidence::follows;
inline constexpr Confidence kLikely = Confidence::likely;
inline constexpr Confidence kProposal = Confidence::proposal;

}  // namespace understudy::emulator::models::rs_m8194h
