// Describes a picture in words, for readers who cannot see it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "emulator/play/report/run_log.h"

namespace understudy::emulator::play {

/// Returns "1.5s waits for a reply, 512ms".
std::string words_of(const SeenWait& wait);

/// Returns a line: "a move: what moved and switched, from 0s to 3.2s".
std::string picture_name(const Stretch& stretch, std::string_view of);

/// Returns each signal that varies, with its minimum, maximum and last value, and the time of a failure.
std::string picture_words(const Stretch& stretch, std::optional<SimTime> failed_at);

}  // namespace understudy::emulator::play
