#include "emulator/play/plot/plot_script.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/files/file_error.h"
#include "base/text/one_line.h"
#include "base/text/suggestion.h"
#include "emulator/play/plot/trace_table.h"
#include "emulator/play/report/axis_scale.h"
#include "emulator/play/report/envelope.h"
#include "emulator/world/expression/number.h"

namespace understudy::emulator::play {

namespace {

// These sizes are in pixels.
constexpr int kPlotWidth = 1200;
constexpr int kTitleHeight = 46;
constexpr int kPlotTimeHeight = 56;
constexpr int kPlotPanelGap = 34;
constexpr int kPositionHeight = 230;
constexpr int kPanelHeight = 140;
constexpr int kPlotRowHeight = 20;
constexpr double kRowsBetween = 1.5;  // the distance between rows of bits, whose height is 1
constexpr std::size_t kMaxStretches = 3000;
constexpr int kPlotColours = 8;
constexpr const char* kColourOf[kPlotColours] = {"#0969da", "#bc4c00", "#1a7f37", "#8250df",
                                                 "#bf3989", "#0a7d88", "#9a6700", "#59636e"};

constexpr const char* kPosition = ".position";
constexpr const char* kPulses = ".pulses";

/// Quotes a text for gnuplot, which interprets texts in single quotes literally.
std::string in_quotes(const std::string& text) {
  std::string quoted = "'";
  for (const char c : one_line(text)) quoted += c == '\'' ? std::string("''") : std::string(1, c);
  return quoted + "'";
}

struct PlotPanel {
  std::string label;
  int height = 0;
  bool are_bits = false;
  bool are_steps = false;
  std::vector<std::size_t> columns;
};

bool varies(const std::vector<double>& column) {
  return std::adjacent_find(column.begin(), column.end(), std::not_equal_to<>()) != column.end();
}

bool is_bit(const std::vector<double>& column) {
  return std::all_of(column.begin(), column.end(), [](double value) { return value == 0 || value == 1; });
}

bool is_followed(const TraceTable& table, std::size_t column);

std::vector<PlotPanel> panels_of(const TraceTable& table, std::span<const std::string> also,
                                 const std::string& name) {
  PlotPanel positions{.label = "position [pulses]", .height = kPositionHeight, .columns = {}};
  PlotPanel speeds{.label = "speed [pulses/s]", .height = kPanelHeight, .columns = {}};
  PlotPanel duties{.label = "PWM duty [%]", .height = kPanelHeight, .are_steps = true, .columns = {}};
  PlotPanel bits{.label = "", .are_bits = true, .columns = {}};
  for (std::size_t i = 0; i < table.names.size(); ++i) {
    if (!varies(table.columns[i])) continue;
    if (table.names[i].ends_with(kPulses) && is_followed(table, i)) continue;
    if (table.names[i].ends_with(kPosition) || table.names[i].ends_with(kPulses)) {
      positions.columns.push_back(i);
    } else if (table.names[i].ends_with(".speed")) {
      speeds.columns.push_back(i);
    } else if (table.names[i].ends_with(".pwm")) {
      if (std::find(also.begin(), also.end(), table.names[i]) == also.end()) duties.columns.push_back(i);
    } else if (is_bit(table.columns[i])) {
      bits.columns.push_back(i);
    }
  }
  bits.height = kPlotRowHeight * static_cast<int>(bits.columns.size());
  std::vector<PlotPanel> panels;
  for (PlotPanel& panel : std::vector{positions, speeds, duties}) {
    if (!panel.columns.empty()) panels.push_back(std::move(panel));
  }
  for (const std::string& wanted : also) {
    const auto found = std::find(table.names.begin(), table.names.end(), wanted);
    if (found == table.names.end()) {
      throw FileError(name + ": no column is called " + quoted(wanted) + suggestion(wanted, table.names));
    }
    panels.push_back({.label = "",
                      .height = kPanelHeight,
                      .are_steps = true,
                      .columns = {static_cast<std::size_t>(found - table.names.begin())}});
  }
  if (!bits.columns.empty()) panels.push_back(std::move(bits));
  if (panels.empty()) throw FileError(name + ": none of its values change; expected at least one that does");
  return panels;
}

/// Returns a column as data for gnuplot, with the time in seconds.
std::string data_of(const TraceTable& table, std::size_t column) {
  Envelope envelope(kMaxStretches);
  for (std::size_t i = 0; i < table.ticks.size(); ++i) {
    // Rows between two changes are omitted.
    if (i > 0) envelope.add(table.ticks[i] - 1, table.columns[column][i - 1]);
    envelope.add(table.ticks[i], table.columns[column][i]);
  }
  std::string text = "$c" + std::to_string(column) + " << END\n";
  constexpr double kSecond = 1000;
  for (const Envelope::Point& point : envelope.points()) {
    text += world::number_text(static_cast<double>(point.tick) / kSecond) + " " +
            world::number_text(point.value) + "\n";
  }
  return text + "END\n";
}

/// Returns the colour of a column. All columns of an axis have the same colour.
std::string colour_of(const TraceTable& table, std::size_t column) {
  const auto axis_of = [](const std::string& name) { return name.substr(0, name.rfind('.')); };
  std::vector<std::string> axes;
  for (const std::string& name : table.names) {
    const bool is_new =
        name.ends_with(kPosition) && std::find(axes.begin(), axes.end(), axis_of(name)) == axes.end();
    if (is_new) axes.push_back(axis_of(name));
  }
  const auto found = std::find(axes.begin(), axes.end(), axis_of(table.names[column]));
  return kColourOf[(found == axes.end() ? 0 : found - axes.begin()) % kPlotColours];
}

/// Returns the range from the minimum to the maximum of the columns in a panel, with a margin.
std::string range_of(const TraceTable& table, const PlotPanel& panel) {
  double min = table.columns[panel.columns.front()].front();
  double max = min;
  for (const std::size_t column : panel.columns) {
    const auto [low, high] = std::minmax_element(table.columns[column].begin(), table.columns[column].end());
    min = std::min(min, *low);
    max = std::max(max, *high);
  }
  const AxisScale scale = scale_for(min, max, 5);
  return "set yrange [" + world::number_text(scale.low) + ":" + world::number_text(scale.high) + "]\n";
}

/// Returns true if a machine has followed all pulses, so that the pulses show nothing that the position does
/// not show.
bool is_followed(const TraceTable& table, std::size_t column) {
  const std::string& name = table.names[column];
  const std::string position = name.substr(0, name.rfind('.')) + kPosition;
  const auto found = std::find(table.names.begin(), table.names.end(), position);
  if (found == table.names.end()) return false;
  const auto& pulses = table.columns[column];
  const auto& positions = table.columns[static_cast<std::size_t>(found - table.names.begin())];
  for (std::size_t i = 0; i < pulses.size(); ++i) {
    if (pulses[i] - pulses[0] != positions[i] - positions[0]) return false;
  }
  return true;
}

std::string curves_of(const TraceTable& table, const PlotPanel& panel) {
  std::string text;
  for (std::size_t i = 0; i < panel.columns.size(); ++i) {
    const std::string block = "$c" + std::to_string(panel.columns[i]);
    text += i == 0 ? "plot " : ", \\\n  ";
    if (panel.are_bits) {
      const std::string base =
          fixed_number(kRowsBetween * static_cast<double>(panel.columns.size() - 1 - i), 1);
      text += block + " using 1:($2+" + base + ") notitle with fillsteps above y=" + base +
              " fs solid 0.2 noborder lc rgb '#4f5b66', " + block + " using 1:($2+" + base +
              ") notitle with steps lw 1 lc rgb '#4f5b66'";
      continue;
    }
    const std::string& name = table.names[panel.columns[i]];
    text += block + " using 1:2 title " + in_quotes(name) + " with " + (panel.are_steps ? "steps" : "lines") +
            (name.ends_with(kPulses) ? " dt (8,6)" : "") + " lw 1.6 lc rgb '" +
            colour_of(table, panel.columns[i]) + "'";
  }
  return text + "\n";
}

std::string marks_of_bits(const TraceTable& table, const PlotPanel& panel) {
  std::string text;
  for (std::size_t i = 0; i < panel.columns.size(); ++i) {
    const double base = kRowsBetween * static_cast<double>(panel.columns.size() - 1 - i);
    text +=
        (i == 0 ? "" : ", ") + in_quotes(table.names[panel.columns[i]]) + " " + fixed_number(base + 0.5, 1);
  }
  return text;
}

}  // namespace

std::string plot_script(const TraceTable& table, std::span<const std::string> also, PlotFormat format,
                        const std::string& output, const std::string& name) {
  const std::vector<PlotPanel> panels = panels_of(table, also, name);
  int height = kTitleHeight + kPlotTimeHeight;
  std::size_t longest = 0;
  for (const PlotPanel& panel : panels) {
    height += panel.height + kPlotPanelGap;
    if (!panel.are_bits) continue;
    for (const std::size_t column : panel.columns) longest = std::max(longest, table.names[column].size());
  }
  const std::string size = std::to_string(kPlotWidth) + "," + std::to_string(height);
  std::string script =
      "set encoding utf8\n"
      "set terminal " +
      (format == PlotFormat::png
           ? "pngcairo noenhanced background rgb 'white' size " + size + " font 'DejaVu Sans,10'"
           : "svg noenhanced background rgb 'white' size " + size + " dynamic font 'DejaVu Sans,12'") +
      "\nset output " + in_quotes(output) + "\n";
  for (const PlotPanel& panel : panels) {
    for (const std::size_t column : panel.columns) script += data_of(table, column);
  }
  constexpr double kSecond = 1000;
  const double begin = static_cast<double>(table.ticks.front()) / kSecond;
  const double end = static_cast<double>(std::max(table.ticks.back(), table.ticks.front() + 1)) / kSecond;
  const double left = std::max(100.0, 20 + 7.2 * static_cast<double>(longest)) / kPlotWidth;
  script += "set multiplot title " + in_quotes(name) + " noenhanced\n" + "set lmargin at screen " +
            fixed_number(left, 4) + "\nset rmargin at screen 0.985\n" + "set xrange [" +
            world::number_text(begin) + ":" + world::number_text(end) + "]\n" +
            "set grid lt 1 lw 0.8 lc rgb '#cfd6dd'\nset border lc rgb '#59636e'\nset tics nomirror\n"
            "set format x ''\n";
  double y = height - kTitleHeight;
  for (const PlotPanel& panel : panels) {
    const bool is_last = &panel == &panels.back();
    y -= kPlotPanelGap / 2.0;
    const double key_y = y + 4;
    script += "set tmargin at screen " + fixed_number(y / height, 4) + "\nset bmargin at screen " +
              fixed_number((y - panel.height) / height, 4) + "\n";
    y -= panel.height + kPlotPanelGap / 2.0;
    if (panel.are_bits) {
      const double top = kRowsBetween * static_cast<double>(panel.columns.size());
      script += "unset ylabel\nset yrange [-0.3:" + fixed_number(top, 1) + "]\nset ytics (" +
                marks_of_bits(table, panel) + ") scale 0\nset grid noy\n";
    } else {
      script += "set ylabel " + in_quotes(panel.label) + "\nset key at screen " + fixed_number(left, 4) +
                ", screen " + fixed_number(key_y / height, 4) +
                " left bottom horizontal Left reverse samplen 2\n" + range_of(table, panel);
    }
    if (is_last) script += "set format x '%g'\nset xlabel 'simulated time [s]'\n";
    script += curves_of(table, panel);
  }
  return script + "unset multiplot\n";
}

}  // namespace understudy::emulator::play
