// Short names for the confidence levels of choices, for the rows of a SUPER-40NC.
#pragma once

#include "base/choices.h"

namespace understudy::emulator::models::super_40nc {

inline constexpr Confidence kFollows = Confidence::follows;
inline constexpr Confidence kLikely = Confidence::likely;
inline constexpr Confidence kProposal = Confidence::proposal;

}  // namespace understudy::emulator::models::super_40nc
