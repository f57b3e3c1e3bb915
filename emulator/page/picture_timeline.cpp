// Draws the timeline: time from left to right, and a lane for each thing that changes.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "emulator/page/drawing.h"
#include "emulator/page/picture_parts.h"
#include "emulator/page/story_data.h"

namespace understudy::emulator::page {

namespace {

constexpr double kLabels = 176;  // the width of the labels, left of the time
constexpr double kEnd = kPictureWidth - kPictureMargin;
constexpr double kRuler = 22;
constexpr std::size_t kMaxAxes = 8;
constexpr std::size_t kMaxSignals = 120;
constexpr std::size_t kMaxShown = 24;  // signals that change

/// Draws one lane after another over a stretch of time.
class Lanes {
 public:
  Lanes(Drawing& drawing, double top, std::int64_t from, std::int64_t to)
      : drawing_(drawing), top_(top), y_(top), from_(from), to_(to) {}

  double x(std::int64_t time) const {
    const double part = static_cast<double>(time - from_) / static_cast<double>(to_ - from_);
    return kLabels + part * (kEnd - kLabels);
  }

  void ruler() {
    constexpr double kSecond = 1e9;
    const double step = round_step(static_cast<double>(to_ - from_) / kSecond / 10);
    const auto places = static_cast<int>(std::clamp(-std::floor(std::log10(step) + 1e-9), 0.0, 9.0));
    for (double mark = std::ceil(static_cast<double>(from_) / kSecond / step) * step;
         mark * kSecond <= static_cast<double>(to_) + 1; mark += step) {
      const double at = x(static_cast<std::int64_t>(mark * kSecond));
      std::string text = std::to_string(mark);
      text.resize(text.find('.') + (places > 0 ? 1 + static_cast<std::size_t>(std::min(places, 6)) : 0));
      drawing_.text(std::clamp(at, kLabels + 20, kEnd - 24), y_ + 8, text + " s", kFaint, 100,
                    Shape::Anchor::middle, 11);
      marks_.push_back(at);
    }
    y_ += kRuler;
  }

  void curve(const std::string& label, const Json& curve, double height, Colour colour) {
    const auto [low, high] = range_of(curve);
    if (high < low) return;
    drawing_.text(kPictureMargin, y_ + 11, label, kInk, kLabels - kPictureMargin - 8);
    drawing_.text(kPictureMargin, y_ + 26, low == high ? grouped(low) : grouped(low) + " to " + grouped(high),
                  kFaint, kLabels - kPictureMargin - 8, Shape::Anchor::begin, 11);
    trace(curve, low, high, height, colour);
    end(height);
  }

  void level(const std::string& label, const Json& curve) {
    constexpr double kHeight = 20;
    const auto [low, high] = range_of(curve);
    drawing_.text(kPictureMargin, y_ + kHeight / 2, label, kInk, kLabels - kPictureMargin - 8);
    trace(curve, low, high, kHeight, kOn);
    end(kHeight);
  }

  void spans(const std::string& label, const std::vector<Json>& spans) {
    constexpr double kHeight = 24;
    drawing_.text(kPictureMargin, y_ + kHeight / 2, label, kInk, kLabels - kPictureMargin - 8);
    for (std::size_t i = 0; i < spans.size(); ++i) {
      const double next = i + 1 < spans.size() ? x(time(spans[i + 1], "begin_ns")) : kEnd;
      span(spans[i], kHeight, next);
    }
    end(kHeight);
  }

  /// Draws the marks that cross all lanes.
  void finish(std::int64_t at, const Json& timeline) {
    for (const double mark : marks_) drawing_.box(mark, top_ + kRuler, mark + 1, y_, faded(kEdge, 0.25));
    if (timeline.contains("story")) {
      const double failed = x(timeline.at("story").at("time_ns").get<std::int64_t>());
      drawing_.box(failed - 1, top_ + kRuler, failed + 1, y_, kBad);
    }
    drawing_.box(x(at) - 1, top_ + kRuler, x(at) + 1, y_, kAccent);
  }
  double bottom() const { return y_; }

 private:
  static std::int64_t time(const Json& span, const char* key) { return span.at(key).get<std::int64_t>(); }

  void end(double height) {
    y_ += height;
    drawing_.box(kPictureMargin, y_ - 1, kEnd, y_, kLine);
  }

  void trace(const Json& curve, double low, double high, double height, Colour colour) {
    const double room = height - 12;
    const double size = high > low ? high - low : 2;
    const double base = high > low ? low : low - 1;
    const Json& min = curve.at("least");
    const Json& max = curve.at("greatest");
    const double wide = (kEnd - kLabels) / static_cast<double>(min.size());
    std::vector<Point> points;
    const auto add = [&](double at, double value) {
      const Point point{at, y_ + 6 + room * (1 - (value - base) / size)};
      // Only the ends of a straight level are kept.
      const bool is_more =
          points.size() > 1 && points.back().y == point.y && points[points.size() - 2].y == point.y;
      if (is_more) points.back() = point;
      if (!is_more) points.push_back(point);
    };
    for (std::size_t i = 0; i < min.size(); ++i) {
      if (!min[i].is_number()) continue;
      const double begin = kLabels + static_cast<double>(i) * wide;
      const bool is_falling =
          i > 0 && min[i - 1].is_number() && max[i - 1].get<double>() > max[i].get<double>();
      add(begin, (is_falling ? max : min)[i].get<double>());
      if (max[i] != min[i]) add(begin, (is_falling ? min : max)[i].get<double>());
      add(begin + wide, (is_falling ? min : max)[i].get<double>());
    }
    drawing_.line(std::move(points), colour, 1.5);
  }

  static Colour colour_of(const Json& span) {
    const std::string kind = span.value("kind", "");
    if (span.value("bad", false) && kind != "power") return kBad;
    if (kind == "frame") return kAccent;
    if (kind == "program") return kProgram;
    return kind == "power" ? kEdge : kind == "event" && span.value("what", "") == "write" ? kOn : kFaint;
  }

  void span(const Json& span, double height, double next) {
    const double begin = x(time(span, "begin_ns"));
    const Colour colour = colour_of(span);
    const double middle = y_ + height / 2;
    if (span.value("kind", "") == "event" || span.value("kind", "") == "failed") {
      drawing_.line({{begin, middle}}, colour, 8);
      if (next - begin > 50)
        drawing_.text(begin + 9, middle, words_of(span), kInk, next - begin - 14, Shape::Anchor::begin, 11);
      return;
    }
    const double end = std::max(begin + 1.5, x(time(span, "end_ns")));
    drawing_.box(begin, y_ + 3, end, y_ + height - 4, faded(colour, span.contains("waits_for") ? 0.2 : 0.45));
    drawing_.box(begin, y_ + 3, begin + 1.5, y_ + height - 4, colour);
    if (end - begin > 40)
      drawing_.text(begin + 5, middle, words_of(span), kInk, end - begin - 8, Shape::Anchor::begin, 11);
  }

  static std::string words_of(const Json& span) {
    const std::string kind = span.value("kind", "");
    const auto word = [&](const char* key) { return span.value(key, std::string()); };
    std::string text = word("text");
    if (kind == "frame") {
      text += (text.empty() ? "" : " \xE2\x86\x92 ") + word("reply");
      if (!word("remark").empty()) text += " (" + word("remark") + ")";
    } else if (kind == "program") {
      text = "line " + std::to_string(span.value("line", 0)) + ": " +
             text.substr(std::min(text.size(), text.find_first_not_of(' ')));
      if (!word("waits_for").empty()) text += " waits for " + word("waits_for");
    } else if (kind == "event" && text.empty()) {
      text = word("what") + " " + (word("name").empty() ? word("device") : word("name"));
      if (!word("value").empty()) text += " = " + word("value");
    }
    const auto count = span.value("count", std::uint64_t{1});
    return count > 1 ? std::to_string(count) + ": " + text : text;
  }

  Drawing& drawing_;
  double top_;
  double y_;
  std::int64_t from_;
  std::int64_t to_;
  std::vector<double> marks_;
};

/// Returns the inputs and outputs that have levels, by their whole names, with their functions.
std::vector<std::pair<std::string, std::string>> signals_of(const Asker& ask) {
  std::vector<std::pair<std::string, std::string>> signals;
  const Json bench = require_reply(ask, {{"do", "bench"}}).at("bench");
  for (const Json& device : bench.at("devices")) {
    const std::string name = device.at("name").get<std::string>();
    const Json reported = require_reply(ask, {{"do", "bench"}, {"device", name}}).at("device");
    for (const Json& terminal : reported.at("terminals")) {
      const std::string kind = terminal.value("kind", "");
      if (!kind.starts_with("digital") && kind != "pulse_out") continue;
      const Json functions = terminal.value("functions", Json::array());
      const std::string whole = name + "." + terminal.at("name").get<std::string>();
      if (signals.size() < kMaxSignals)
        signals.emplace_back(whole,
                             functions.empty() ? whole : whole + " " + functions[0].get<std::string>());
    }
  }
  return signals;
}

void draw_spans(Lanes& lanes, const Asker& ask, const Course& course) {
  std::map<int, std::map<std::string, std::vector<Json>>> sorted;  // by kind, by lane
  for (const Json& span : spans_of(ask, course)) {
    const std::string kind = span.value("kind", "");
    const int order = kind == "frame"     ? 0
                      : kind == "program" ? 1
                      : kind == "fault"   ? 2
                      : kind == "power"   ? 3
                                          : 4;
    sorted[order][span.value("lane", "")].push_back(span);
  }
  for (auto& [order, by_lane] : sorted)
    for (auto& [lane, spans] : by_lane) lanes.spans(order == 1 ? lane + " program" : lane, spans);
}

}  // namespace

double draw_timeline(Drawing& drawing, double top, const Asker& ask, const Json& timeline) {
  const auto time = [&](const char* key) { return timeline.at(key).get<std::int64_t>(); };
  const Course course{.from_ns = time("begin_ns"),
                      .to_ns = std::max(time("end_ns"), time("begin_ns") + 1'000'000),
                      .dots = static_cast<std::uint64_t>(kEnd - kLabels)};
  std::vector<std::string> names;
  std::vector<StoryAxis> axes = axes_of(ask);
  if (axes.size() > kMaxAxes) axes.resize(kMaxAxes);
  for (const StoryAxis& axis : axes)
    for (const char* const what : {".position", ".speed"}) names.push_back(axis.name + what);
  const auto signals = signals_of(ask);
  for (const auto& [name, label] : signals) names.push_back(name);
  const std::vector<Json> curves = curves_of(ask, names, course);

  Lanes lanes(drawing, top, course.from_ns, course.to_ns);
  lanes.ruler();
  const auto varies = [](const Json& curve) {
    const auto [low, high] = range_of(curve);
    return low < high;
  };
  const bool is_still =
      std::none_of(curves.begin(), curves.begin() + static_cast<std::ptrdiff_t>(2 * axes.size()), varies);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (!is_still && !varies(curves[2 * i]) && !varies(curves[2 * i + 1])) continue;
    lanes.curve(axes[i].name + " position", curves[2 * i], 66, kAccent);
    lanes.curve(axes[i].name + " speed", curves[2 * i + 1], 44, kSpeed);
  }
  draw_spans(lanes, ask, course);
  std::size_t shown = 0;
  for (std::size_t i = 0; i < signals.size() && shown < kMaxShown; ++i) {
    const Json& curve = curves[2 * axes.size() + i];
    if (!varies(curve)) continue;
    lanes.level(signals[i].second, curve);
    ++shown;
  }
  lanes.finish(time("at_ns"), timeline);
  return lanes.bottom();
}

}  // namespace understudy::emulator::page
