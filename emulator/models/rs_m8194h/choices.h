// RS-M8194H: what its manual leaves open, and what we do. docs/fidelity/rs-m8194h.md is made from these rows.
#pragma once

#include "emulator/device/choices.h"

namespace understudy::emulator::models::rs_m8194h {

inline constexpr Confidence kFollows = Confidence::follows;
inline constexpr Confidence kLikely = Confidence::likely;
inline constexpr Confidence kProposal = Confidence::proposal;

inline constexpr ChoiceRow kChoices[] = {
    {"broadcast", "2.1.3", "a request to address 0", "obeyed_silently", kLikely,
     "Modbus broadcast; the manual knows stations 1 to 247 only"},
    {"silent_time", "14.1", "the silence that ends a frame", "3ms", kFollows,
     "Silent Time of the settings' screen; User Silent Time is 0 there"},
    {"response_delay", "14.1", "when a reply begins", "after_silent_time", kProposal,
     "the manual gives no time of its own"},
    {"holes", "12.1", "words between the printed rows", "read_zero", kFollows,
     "two of them are printed as undefined and 0"},
};

}  // namespace understudy::emulator::models::rs_m8194h
