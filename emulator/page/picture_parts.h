// Colours, sizes and functions that the panels of a picture share.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "emulator/page/drawing.h"
#include "emulator/page/story_data.h"

namespace understudy::emulator::page {

// The page's colours in its light theme.
inline constexpr Colour kGround{255, 255, 255};
inline constexpr Colour kInk{26, 29, 33};
inline constexpr Colour kFaint{84, 93, 105};
inline constexpr Colour kLine{221, 226, 232};
inline constexpr Colour kEdge{116, 126, 139};
inline constexpr Colour kBed{140, 149, 161};
inline constexpr Colour kAccent{22, 89, 183};
inline constexpr Colour kBad{179, 38, 30};
inline constexpr Colour kOn{20, 117, 47};
inline constexpr Colour kLimit{138, 90, 0};
inline constexpr Colour kSpeed{196, 61, 5};
inline constexpr Colour kProgram{134, 48, 159};

inline constexpr double kPictureWidth = 1200;
inline constexpr double kPictureMargin = 12;

inline Colour faded(Colour colour, double alpha) {
  colour.alpha = alpha;
  return colour;
}

/// Returns "12,345.5".
std::string grouped(double number);
/// Returns seconds to the microsecond: "3.598083 s".
std::string seconds_of(std::int64_t time_ns);

/// Returns a round number that is at least `rough`: 1, 2 or 5 times a power of ten.
double round_step(double rough);

struct StoryAxis {
  std::string name;  // "feeder.A"
  Json machine;
};
std::vector<StoryAxis> axes_of(const Asker& ask);

/// Returns the minimum and the maximum of a curve.
std::pair<double, double> range_of(const Json& curve);

/// Each function draws a panel below `top`, and returns its lower end.
double draw_timeline(Drawing& drawing, double top, const Asker& ask, const Json& timeline);
double draw_axes(Drawing& drawing, double top, const Asker& ask);
double draw_path(Drawing& drawing, double top, const Asker& ask, const Json& timeline);
double draw_bus(Drawing& drawing, double top, const Asker& ask);

}  // namespace understudy::emulator::page
