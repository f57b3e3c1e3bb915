// A panel of a recording's page as a picture, drawn without a browser.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "emulator/page/drawing.h"
#include "emulator/page/story_data.h"

namespace understudy::emulator::page {

inline constexpr std::array<std::string_view, 4> kPicturePanels{"timeline", "axes", "path", "bus"};

/// Draws a panel at the current moment of the recording, below its name and its story. Throws RefusedError
/// with the reason.
Drawing story_picture(const Asker& ask, const std::string& name, std::string_view panel);

/// Returns a line that describes the picture.
std::string picture_words(const Asker& ask, const std::string& name, std::string_view panel);

}  // namespace understudy::emulator::page
