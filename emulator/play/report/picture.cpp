#include "emulator/play/report/picture.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/play/report/axis_scale.h"
#include "emulator/play/report/picture_words.h"
#include "emulator/play/report/run_log.h"
#include "emulator/play/results/junit.h"

namespace understudy::emulator::play {

namespace {

using SignalKind = SeenSignal::Kind;

// These sizes are in the picture's own units. The browser scales the picture to the available space.
constexpr double kWidth = 1100;
constexpr double kLeft = 170;  // the position of the first moment
constexpr double kRight = 1085;
constexpr double kTop = 38;              // the marks of steps and of the failure are above this
constexpr double kNumberY = kTop - 10;   // the position of step numbers
constexpr double kFailureY = kTop - 26;  // a separate row above the numbers
constexpr double kLegendHeight = 24;
constexpr double kPanelGap = 14;
constexpr double kRowHeight = 19;
constexpr double kBitHeight = 11;
constexpr double kTimeHeight = 40;
constexpr double kCharacter = 6.65;  // the width of a character in a legend
constexpr std::size_t kLongestLabel = 24;
constexpr std::size_t kColours = 8;

std::string number(double value) { return fixed_number(value, 2); }

std::string attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + value + "\"";
}

std::string shortened(const std::string& name) {
  if (name.size() <= kLongestLabel) return name;
  return "\xE2\x80\xA6" + name.substr(name.size() - kLongestLabel + 1);
}

std::string text_at(double x, double y, const char* kind, const std::string& text) {
  return "<text" + attribute("class", kind) + attribute("x", number(x)) + attribute("y", number(y)) + ">" +
         xml_escaped(text) + "</text>\n";
}

std::string line_between(double x1, double y1, double x2, double y2, const char* kind) {
  return "<line" + attribute("class", kind) + attribute("x1", number(x1)) + attribute("y1", number(y1)) +
         attribute("x2", number(x2)) + attribute("y2", number(y2)) + "/>\n";
}

/// Returns the CSS class of a wait: for a line, in vain, or a sleep.
const char* wait_class(const SeenWait& wait) {
  if (wait.text.ends_with("in vain")) return "wait vain";
  return wait.text == "sleeps" ? "wait sleep" : "wait";
}

/// A line in a panel.
struct Curve {
  const SeenSignal* signal = nullptr;
  std::size_t colour = 0;
  bool is_dashed = false;
  bool is_stepped = false;  // each value lasts until the next one
};

struct Panel {
  std::string title;
  double height = 0;
  int marks = 6;
  bool has_zero = false;
  std::vector<Curve> curves;
};

/// Returns true if two signals are equal except for their initial values.
bool run_alike(const SeenSignal& a, const SeenSignal& b) {
  if (a.points.size() != b.points.size()) return false;
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    const bool is_alike = a.points[i].tick == b.points[i].tick &&
                          a.points[i].value - a.points[0].value == b.points[i].value - b.points[0].value;
    if (!is_alike) return false;
  }
  return true;
}

/// Returns panels with the positions and pulses of the axes that moved (or of all axes), the speeds of the
/// axes that moved, and the duty cycles and analog inputs that varied.
std::vector<Panel> panels_of(const Stretch& stretch, bool with_still_axes) {
  Panel positions{.title = "position [pulses]", .height = 190, .curves = {}};
  Panel speeds{.title = "speed [pulses/s]", .height = 120, .marks = 4, .has_zero = true, .curves = {}};
  Panel duties{.title = "PWM duty [%]", .height = 90, .marks = 3, .has_zero = true, .curves = {}};
  Panel voltages{.title = "analog inputs [V]", .height = 90, .marks = 3, .curves = {}};
  Panel levels{.title = "analog inputs", .height = 90, .marks = 3, .curves = {}};
  std::size_t axis = 0;
  for (std::size_t i = 0; i + 2 < stretch.signals.size(); ++i) {
    const SeenSignal& position = stretch.signals[i];
    if (position.kind != SignalKind::position) continue;
    const SeenSignal& pulses = stretch.signals[i + 1];
    const SeenSignal& speed = stretch.signals[i + 2];
    const std::size_t colour = axis++ % kColours;
    const bool is_still = !position.varies() && !pulses.varies() && !speed.varies();
    if (is_still && !with_still_axes) continue;
    positions.curves.push_back({.signal = &position, .colour = colour});
    if (!run_alike(position, pulses)) {
      positions.curves.push_back({.signal = &pulses, .colour = colour, .is_dashed = true});
    }
    if (!is_still) speeds.curves.push_back({.signal = &speed, .colour = colour});
  }
  const auto panel_of = [&](SignalKind kind) -> Panel* {
    switch (kind) {
      case SignalKind::duty: return &duties;
      case SignalKind::voltage: return &voltages;
      case SignalKind::level: return &levels;
      default: return nullptr;
    }
  };
  for (const SeenSignal& signal : stretch.signals) {
    Panel* const found = panel_of(signal.kind);
    if (found == nullptr || !signal.varies()) continue;
    Panel& panel = *found;
    panel.curves.push_back({.signal = &signal, .colour = panel.curves.size() % kColours, .is_stepped = true});
  }
  std::vector<Panel> panels;
  for (Panel& panel : std::vector{positions, speeds, duties, voltages, levels}) {
    if (!panel.curves.empty()) panels.push_back(std::move(panel));
  }
  return panels;
}

class Drawing {
 public:
  explicit Drawing(const Stretch& stretch) : begin_ms_(ms_of(stretch.begin)), end_ms_(ms_of(stretch.end)) {
    if (end_ms_ <= begin_ms_) end_ms_ = begin_ms_ + 1;
  }

  void add(const Panel& panel) {
    legend(panel);
    const double top = y_ + kLegendHeight;
    const double bottom = top + panel.height;
    double min = panel.has_zero ? 0 : panel.curves[0].signal->min;
    double max = panel.has_zero ? 0 : panel.curves[0].signal->max;
    for (const Curve& curve : panel.curves) {
      min = std::min(min, curve.signal->min);
      max = std::max(max, curve.signal->max);
    }
    const AxisScale scale = scale_for(min, max, panel.marks);
    const double per_unit = panel.height / (scale.high - scale.low);
    for (const double mark : scale.marks) {
      const double y = bottom - (mark - scale.low) * per_unit;
      body_ += line_between(kLeft, y, kRight, y, "grid");
      body_ += text_at(kLeft - 8, y + 4, "mark end", fixed_number(mark, scale.decimals));
    }
    frame(top, bottom);
    for (const Curve& curve : panel.curves) {
      const double base = curve.signal->min;
      const double base_y = bottom - (base - scale.low) * per_unit;
      body_ +=
          "<polyline" +
          attribute("class", "line k" + std::to_string(curve.colour) + (curve.is_dashed ? " dashed" : "") +
                                 (curve.is_stepped ? " stepped" : "")) +
          attribute("data-name", xml_escaped(curve.signal->name)) +
          attribute("data-base", plain_number(base)) + attribute("transform", matrix(per_unit, base_y)) +
          attribute("points", points_of(*curve.signal, base, curve.is_stepped)) + "/>\n";
    }
    y_ = bottom + kPanelGap;
  }

  void add_bits(const std::vector<const SeenSignal*>& bits) {
    if (bits.empty()) return;
    body_ += text_at(kLeft, y_ + 15, "title", "inputs, outputs, switches");
    const double top = y_ + kLegendHeight;
    double y = top;
    for (const SeenSignal* bit : bits) {
      y += kRowHeight;
      const double base = y - (kRowHeight - kBitHeight) / 2;
      body_ += text_at(kLeft - 8, base - 1, "label end", shortened(bit->name));
      body_ += "<polyline" + attribute("class", "bit stepped") +
               attribute("data-name", xml_escaped(bit->name)) + attribute("data-base", "0") +
               attribute("transform", matrix(kBitHeight, base)) +
               attribute("points", "0,0 " + points_of(*bit, 0, true) + " " + at(end_ms_) + ",0") + "/>\n";
    }
    frame(top, y + 2);
    y_ = y + 2 + kPanelGap;
  }

  /// Draws a row for each thread of a host in simulated time.
  void add_waits(const std::vector<SeenWait>& waits) {
    if (waits.empty()) return;
    std::map<std::size_t, std::string> rows;
    for (const SeenWait& wait : waits) rows[wait.thread];
    body_ += text_at(kLeft, y_ + 15, "title", "what the host waits for");
    const double top = y_ + kLegendHeight;
    double y = top;
    for (const auto& [thread, nothing] : rows) {
      y += kRowHeight;
      const double base = y - (kRowHeight - kBitHeight) / 2;
      body_ += text_at(kLeft - 8, base - 1, "label end",
                       thread == 1 ? "host" : "host, thread " + std::to_string(thread));
      for (const SeenWait& wait : waits) {
        if (wait.thread != thread) continue;
        const double begin = x_of(std::clamp(ms_of(wait.begin), begin_ms_, end_ms_));
        const double width = std::max(x_of(std::clamp(ms_of(wait.end), begin_ms_, end_ms_)) - begin, 0.5);
        body_ += "<rect class=\"" + std::string(wait_class(wait)) + "\"" + attribute("x", number(begin)) +
                 attribute("y", number(base - kBitHeight)) + attribute("width", number(width)) +
                 attribute("height", number(kBitHeight)) + "><title>" + xml_escaped(words_of(wait)) +
                 "</title></rect>\n";
      }
    }
    frame(top, y + 2);
    y_ = y + 2 + kPanelGap;
  }

  void add_time() {
    const double bottom = y_ - kPanelGap;
    constexpr double kLongInMs = 2000;
    const bool is_long = end_ms_ - begin_ms_ >= kLongInMs;
    const double unit = is_long ? 1000 : 1;
    const AxisScale scale = exact_scale_for(begin_ms_ / unit, end_ms_ / unit, 10);
    std::string lines;
    for (const double mark : scale.marks) {
      const double x = x_of(mark * unit);
      lines += through_frames(x, "grid");
      body_ += text_at(x, bottom + 16, "mark middle", fixed_number(mark, scale.decimals));
    }
    body_.insert(0, lines);
    body_ += text_at((kLeft + kRight) / 2, bottom + 33, "title middle",
                     is_long ? "simulated time [s]" : "simulated time [ms]");
    bottom_ = bottom;
    y_ = bottom + kTimeHeight;
  }

  /// Marks the faults that affected messages. If several of them are close together, marks only the first
  /// one.
  void add_strikes(const std::vector<SeenFrame>& frames) {
    constexpr double kApart = 4;
    double last = -kApart;
    for (const SeenFrame& frame : frames) {
      const double x = x_of(std::clamp(ms_of(frame.time), begin_ms_, end_ms_));
      if (!frame.is_struck || x - last < kApart) continue;
      last = x;
      body_ += "<g><title>" +
               xml_escaped(format_duration(frame.time) + " " + frame.line + ": " + frame.remark) +
               "</title>" + through_frames(x, "fault") + "</g>\n";
    }
  }

  void add_marks(const PictureMarks& marks) {
    constexpr double kRoomForNumber = 16;
    double last = -kRoomForNumber;
    for (std::size_t i = 0; i < marks.steps.size(); ++i) {
      const double x = x_of(std::clamp(ms_of(marks.steps[i].begin), begin_ms_, end_ms_));
      if (x - last < kRoomForNumber) continue;
      last = x;
      body_ += line_between(x, kTop - 6, x, kTop, "step") + through_frames(x, "step");
      body_ += text_at(x, kNumberY, "number middle", std::to_string(marks.first_number + i));
    }
    if (!marks.failed_at) return;
    const double x = x_of(std::clamp(ms_of(*marks.failed_at), begin_ms_, end_ms_));
    // The line begins below the numbers, so it does not cross any of them.
    body_ += line_between(x, kTop - 6, x, bottom_, "failure");
    const bool is_far_right = x > kRight - 150;
    body_ += text_at(is_far_right ? x - 5 : x + 5, kFailureY, is_far_right ? "failed end" : "failed",
                     "failed at " + format_duration(*marks.failed_at));
  }

  std::string finish(const Stretch& stretch, const PictureMarks& marks) const {
    return "<svg class=\"picture\"" + attribute("viewBox", "0 0 " + number(kWidth) + " " + number(y_)) +
           attribute("data-begin", plain_number(begin_ms_)) + attribute("data-end", plain_number(end_ms_)) +
           attribute("data-left", number(kLeft)) + attribute("data-right", number(kRight)) + " role=\"img\"" +
           attribute("aria-label", xml_escaped(picture_name(stretch, marks.of))) + ">\n<desc>" +
           xml_escaped(picture_words(stretch, marks.failed_at)) + "</desc>\n" + body_ +
           line_between(kLeft, kTop, kLeft, bottom_, "pointer") + "</svg>\n";
  }

 private:
  static double ms_of(SimTime time) { return static_cast<double>(time.count()) / 1e6; }
  double per_ms() const { return (kRight - kLeft) / (end_ms_ - begin_ms_); }
  double x_of(double ms) const { return kLeft + (ms - begin_ms_) * per_ms(); }
  std::string at(double ms) const { return plain_number(ms - begin_ms_); }

  /// Returns the transformation from milliseconds and amounts to the picture.
  std::string matrix(double per_unit, double base_y) const {
    return "matrix(" + plain_number(per_ms()) + " 0 0 " + plain_number(-per_unit) + " " + number(kLeft) +
           " " + number(base_y) + ")";
  }

  std::string points_of(const SeenSignal& signal, double base, bool is_stepped) const {
    std::string text;
    const SeenSignal::Point* before = nullptr;
    for (const SeenSignal::Point& point : signal.points) {
      // The first tick may be the one that precedes the stretch.
      const std::string x = at(std::max(ms_of(time_of(point.tick)), begin_ms_));
      if (is_stepped && before != nullptr && before->value != point.value) {
        text += " " + x + "," + plain_number(before->value - base);
      }
      text += (text.empty() ? "" : " ") + x + "," + plain_number(point.value - base);
      before = &point;
    }
    return text;
  }

  void legend(const Panel& panel) {
    body_ += text_at(kLeft, y_ + 15, "title", panel.title);
    double x = kLeft + static_cast<double>(panel.title.size() + 2) * kCharacter;
    for (const Curve& curve : panel.curves) {
      const std::string name = shortened(curve.signal->name);
      const double width = 30 + static_cast<double>(name.size() + 1) * kCharacter;
      if (x + width > kRight) {
        body_ += text_at(x, y_ + 15, "mark", "\xE2\x80\xA6");
        return;
      }
      const std::string kind = "line k" + std::to_string(curve.colour) + (curve.is_dashed ? " dashed" : "");
      body_ += line_between(x, y_ + 11, x + 22, y_ + 11, kind.c_str());
      body_ += text_at(x + 27, y_ + 15, "label", name);
      x += width;
    }
  }

  /// Draws a vertical line in each frame, so that it does not cross a legend.
  std::string through_frames(double x, const char* kind) const {
    std::string lines;
    for (const auto& [top, bottom] : frames_) lines += line_between(x, top, x, bottom, kind);
    return lines;
  }

  void frame(double top, double bottom) {
    frames_.emplace_back(top, bottom);
    body_ += "<rect class=\"frame\"" + attribute("x", number(kLeft)) + attribute("y", number(top)) +
             attribute("width", number(kRight - kLeft)) + attribute("height", number(bottom - top)) + "/>\n";
  }

  double begin_ms_;
  double end_ms_;
  double y_ = kTop - kPanelGap + 8;
  double bottom_ = 0;
  std::vector<std::pair<double, double>> frames_;  // the top and bottom of each panel
  std::string body_;
};

}  // namespace

std::string picture(const Stretch& stretch, const PictureMarks& marks) {
  std::vector<Panel> panels = panels_of(stretch, false);
  std::vector<const SeenSignal*> bits;
  for (const SeenSignal& signal : stretch.signals) {
    if (signal.kind == SignalKind::bit && signal.varies()) bits.push_back(&signal);
  }
  if (panels.empty() && bits.empty() && stretch.waits.empty()) {
    if (!marks.failed_at) return "";
    panels = panels_of(stretch, true);
  }
  Drawing drawing(stretch);
  for (const Panel& panel : panels) drawing.add(panel);
  drawing.add_bits(bits);
  drawing.add_waits(stretch.waits);
  drawing.add_time();
  drawing.add_strikes(stretch.frames);
  drawing.add_marks(marks);
  return drawing.finish(stretch, marks);
}

}  // namespace understudy::emulator::play
