#include "emulator/page/story_picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/page/drawing.h"
#include "emulator/page/picture_parts.h"
#include "emulator/page/story_data.h"

namespace understudy::emulator::page {

namespace {

constexpr double kRow = 18;
constexpr double kTitleSize = 15;
constexpr double kRight = kPictureWidth - kPictureMargin;

/// Draws a text in as many lines as it needs, broken at spaces.
double wrapped(Drawing& drawing, double top, const std::string& text, Colour colour) {
  const auto max = static_cast<std::size_t>((kRight - kPictureMargin) / Drawing::width_of("x"));
  std::string line;
  const auto put = [&] {
    drawing.text(kPictureMargin, top + kRow / 2, line, colour, kRight - kPictureMargin);
    top += kRow;
    line.clear();
  };
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at);
    at = end + 1;
    if (!line.empty() && length_of(line) + 1 + length_of(word) > max) put();
    line += (line.empty() ? "" : " ") + word;
  }
  if (!line.empty()) put();
  return top;
}

double head(Drawing& drawing, const std::string& name, const Json& timeline) {
  const std::string at = seconds_of(timeline.at("at_ns").get<std::int64_t>());
  drawing.text(kPictureMargin, 20, name, kInk, 900, Shape::Anchor::begin, kTitleSize);
  drawing.text(kRight, 20, "at " + at, kInk, 300, Shape::Anchor::end, kTitleSize);
  double top = 36;
  if (timeline.contains("story")) {
    const std::string scenario = timeline.value("scenario", "");
    top = wrapped(
        drawing, top,
        (scenario.empty() ? "" : scenario + ": ") + timeline.at("story").at("text").get<std::string>(), kBad);
  }
  return top + 6;
}

}  // namespace

std::string grouped(double number) {
  const double rounded = std::round(number * 10) / 10;
  std::string digits = std::to_string(static_cast<long long>(std::abs(rounded)));
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, ",");
  const auto tenth = static_cast<int>(std::lround(std::abs(rounded) * 10)) % 10;
  if (tenth != 0) digits += "." + std::to_string(tenth);
  return (rounded < 0 ? "-" : "") + digits;
}

std::string seconds_of(std::int64_t time_ns) {
  const std::int64_t micros = time_ns / 1'000;
  const std::string part = std::to_string(micros % 1'000'000);
  return std::to_string(micros / 1'000'000) + "." + std::string(6 - part.size(), '0') + part + " s";
}

double round_step(double rough) {
  const double power = std::pow(10, std::floor(std::log10(std::max(rough, 1e-12))));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough) return factor * power;
  return 10 * power;
}

std::vector<StoryAxis> axes_of(const Asker& ask) {
  std::vector<StoryAxis> axes;
  const Json bench = require_reply(ask, {{"do", "bench"}}).at("bench");
  for (const Json& device : bench.at("devices")) {
    const Json reported = require_reply(ask, {{"do", "bench"}, {"device", device.at("name")}}).at("device");
    for (const Json& axis : reported.at("axes"))
      axes.push_back({.name = device.at("name").get<std::string>() + "." + axis.at("name").get<std::string>(),
                      .machine = axis.value("machine", Json::object())});
  }
  return axes;
}

std::pair<double, double> range_of(const Json& curve) {
  std::pair<double, double> range{std::numeric_limits<double>::infinity(),
                                  -std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < curve.at("least").size(); ++i) {
    if (!curve.at("least")[i].is_number()) continue;
    range.first = std::min(range.first, curve.at("least")[i].get<double>());
    range.second = std::max(range.second, curve.at("greatest")[i].get<double>());
  }
  return range;
}

Drawing story_picture(const Asker& ask, const std::string& name, std::string_view panel) {
  const Json timeline = timeline_of(ask);
  Drawing drawing(kPictureWidth, 0);
  drawing.box(0, 0, kPictureWidth, 100'000, kGround);
  const double top = head(drawing, name, timeline);
  double bottom = top;
  if (panel == "timeline") {
    bottom = draw_timeline(drawing, top, ask, timeline);
  } else if (panel == "axes") {
    bottom = draw_axes(drawing, top, ask);
  } else if (panel == "path") {
    bottom = draw_path(drawing, top, ask, timeline);
  } else {
    bottom = draw_bus(drawing, top, ask);
  }
  drawing.set_height(std::ceil(bottom + kPictureMargin));
  return drawing;
}

std::string picture_words(const Asker& ask, const std::string& name, std::string_view panel) {
  const Json timeline = timeline_of(ask);
  const std::string story =
      timeline.contains("story") ? ": " + timeline.at("story").at("text").get<std::string>() : "";
  return std::string(panel) + " of " + name + " at " + seconds_of(timeline.at("at_ns").get<std::int64_t>()) +
         story;
}

double draw_axes(Drawing& drawing, double top, const Asker& ask) {
  constexpr double kHeight = 84;
  std::vector<StoryAxis> axes = axes_of(ask);
  if (axes.empty()) throw RefusedError("no device of this recording drives an axis");
  Json names = Json::array();
  for (const StoryAxis& axis : axes)
    for (const char* const what : {".position", ".speed", ".target"}) names.push_back(axis.name + what);
  const Json values = require_reply(ask, {{"do", "look"}, {"names", names}}).at("values");
  for (std::size_t i = 0; i < axes.size(); ++i, top += kHeight) {
    const Json& machine = axes[i].machine;
    const Json& reported = values[3 * i];
    const double position = reported.is_number() ? reported.get<double>() : 0;
    const auto place = [&](const char* key, const char* of) {
      const bool is_present =
          machine.contains(key) && machine.at(key).contains(of) && machine.at(key).at(of).is_number();
      return is_present ? machine.at(key).at(of).get<double>() : std::numeric_limits<double>::quiet_NaN();
    };
    double low = std::min(position, 0.0) - 500;
    double high = std::max(position, 0.0) + 500;
    const bool has_travel = machine.contains("travel") && machine.at("travel").size() == 2;
    if (has_travel) {
      low = std::min(low, machine.at("travel")[0].get<double>());
      high = std::max(high, machine.at("travel")[1].get<double>());
    }
    const auto x = [&](double pulses) {
      return kPictureMargin + (pulses - low) / (high - low) * (kRight - kPictureMargin);
    };
    drawing.text(kPictureMargin, top + 10, axes[i].name, kInk, 400, Shape::Anchor::begin, 14);
    drawing.text(460, top + 10, grouped(position) + " pulses", kInk, 200, Shape::Anchor::end, 14);
    if (values[3 * i + 1].is_number())
      drawing.text(640, top + 10, grouped(values[3 * i + 1].get<double>()) + " pulses/s", kFaint, 200,
                   Shape::Anchor::end);
    const double bed = top + 40;
    drawing.box(kPictureMargin, bed - 4, kRight, bed + 4, kBed);
    if (const double at = place("lower_limit", "at"); at > low)
      drawing.box(x(low), bed + 6, x(at), bed + 15, kLimit);
    if (const double at = place("upper_limit", "at"); at < high)
      drawing.box(x(at), bed + 6, x(high), bed + 15, kLimit);
    if (machine.contains("home") && machine.at("home").contains("on")) {
      const Json& zone = machine.at("home").at("on");
      const double from = zone[0].get<double>();
      drawing.box(x(from), bed + 6, std::max(x(zone[1].get<double>()), x(from) + 2), bed + 15, kAccent);
    }
    drawing.line({{x(position), bed - 16}, {x(position), bed + 18}}, kAccent, 3);
    drawing.line({{x(position), bed - 14}}, kAccent, 12);
    const double step = round_step((high - low) / 8);
    for (double mark = std::ceil(low / step) * step; mark <= high; mark += step)
      drawing.text(std::clamp(x(mark), 40.0, kPictureWidth - 40), bed + 28, grouped(mark + 0), kFaint, 100,
                   Shape::Anchor::middle, 11);
  }
  return top;
}

namespace {

/// Returns the indices of the first two curves that vary, filled up with others if fewer do.
std::vector<std::size_t> two_that_move(const std::vector<Json>& curves) {
  std::vector<std::size_t> moving;
  for (const bool wants_still : {false, true}) {
    for (std::size_t i = 0; i < curves.size() && moving.size() < 2; ++i) {
      const auto [low, high] = range_of(curves[i]);
      if ((high > low) != wants_still) moving.push_back(i);
    }
  }
  std::sort(moving.begin(), moving.end());
  return moving;
}

}  // namespace

double draw_path(Drawing& drawing, double top, const Asker& ask, const Json& timeline) {
  constexpr double kHeight = 640;
  const Course course{.from_ns = timeline.at("begin_ns").get<std::int64_t>(),
                      .to_ns = std::max(timeline.at("end_ns").get<std::int64_t>(),
                                        timeline.at("begin_ns").get<std::int64_t>() + 1'000'000),
                      .dots = 3'000};
  std::vector<std::string> names;
  for (const StoryAxis& axis : axes_of(ask)) names.push_back(axis.name + ".position");
  if (names.size() < 2) throw RefusedError("a path needs two axes; expected another panel");
  const std::vector<Json> curves = curves_of(ask, names, course);
  const std::vector<std::size_t> moving = two_that_move(curves);
  const auto& [left, right] = range_of(curves[moving[0]]);
  const auto& [low, high] = range_of(curves[moving[1]]);
  const double across = kRight - kPictureMargin - 80;
  const double size = std::max({(right - left) / (across - 40), (high - low) / (kHeight - 40), 1e-3});
  const double middle_x = kPictureMargin + 80 + across / 2;
  const double middle_y = top + kHeight / 2;
  const auto x = [&, first = left, last = right](double pulses) {
    return middle_x + (pulses - (first + last) / 2) / size;
  };
  const auto y = [&, first = low, last = high](double pulses) {
    return middle_y - (pulses - (first + last) / 2) / size;
  };
  const double step = round_step(size * 110);
  for (double mark = std::ceil(((left + right) / 2 - across / 2 * size) / step) * step; x(mark) <= kRight;
       mark += step) {
    drawing.box(x(mark), top, x(mark) + 1, top + kHeight, mark == 0 ? kEdge : kLine);
    drawing.text(x(mark), top + kHeight + 10, grouped(mark + 0), kFaint, 100, Shape::Anchor::middle, 11);
  }
  for (double mark = std::ceil(((low + high) / 2 - kHeight / 2 * size) / step) * step; y(mark) >= top;
       mark += step) {
    drawing.box(kPictureMargin + 80, y(mark), kRight, y(mark) + 1, mark == 0 ? kEdge : kLine);
    drawing.text(kPictureMargin + 74, y(mark), grouped(mark + 0), kFaint, 80, Shape::Anchor::end, 11);
  }
  std::vector<Point> behind;
  std::vector<Point> ahead;
  const auto at = timeline.at("at_ns").get<std::int64_t>();
  for (std::size_t i = 0; i < course.dots; ++i) {
    const auto place = [&](std::size_t which) {
      const Json& curve = curves[moving[which]];
      return (curve.at("least")[i].get<double>() + curve.at("greatest")[i].get<double>()) / 2;
    };
    const auto time = course.from_ns + (course.to_ns - course.from_ns) * static_cast<std::int64_t>(i) /
                                           static_cast<std::int64_t>(course.dots);
    (time <= at ? behind : ahead).push_back({x(place(0)), y(place(1))});
  }
  if (!behind.empty()) ahead.insert(ahead.begin(), behind.back());
  drawing.line(ahead, kBed, 1.5);
  const Point now = behind.empty() ? ahead.front() : behind.back();
  drawing.line(std::move(behind), kAccent, 2);
  drawing.line({now}, kInk, 9);
  drawing.text(kPictureMargin, top + kHeight + 28,
               names[moving[0]] + " to the right, " + names[moving[1]] + " upwards, in pulses", kInk);
  return top + kHeight + 36;
}

double draw_bus(Drawing& drawing, double top, const Asker& ask) {
  constexpr std::size_t kShown = 40;
  const Json frames = require_reply(ask, {{"do", "frames"}, {"last", kShown}, {"raw", true}}).at("frames");
  if (frames.empty()) drawing.text(kPictureMargin, top + kRow / 2, "No traffic on the lines yet.", kFaint);
  for (const Json& frame : frames) {
    const std::string remark = frame.value("remark", "");
    const bool is_request = frame.value("way", "") == "in";
    const Colour colour = frame.value("exception", false) || !remark.empty() ? kBad : kInk;
    const double y = top + kRow / 2;
    drawing.text(130, y, seconds_of(frame.at("time_ns").get<std::int64_t>()), kFaint, 200,
                 Shape::Anchor::end);
    drawing.text(144, y, frame.value("line", ""), kFaint, 100);
    drawing.line({{is_request ? 262.0 : 250.0, y}}, is_request ? kAccent : kOn, 6);
    drawing.line({{250, y}, {262, y}}, is_request ? kAccent : kOn, 1.5);
    drawing.text(is_request ? 280 : 296, y,
                 frame.value("text", "") + (remark.empty() ? "" : " (" + remark + ")"), colour, kRight - 380);
    if (frame.contains("latency_ns")) {
      const double ms = frame.at("latency_ns").get<double>() / 1e6;
      drawing.text(kRight, y, grouped(ms) + " ms", kFaint, 100, Shape::Anchor::end);
    }
    top += kRow;
    drawing.box(kPictureMargin, top, kRight, top + 1, kLine);
  }
  return top + (frames.empty() ? kRow : 0);
}

}  // namespace understudy::emulator::page
