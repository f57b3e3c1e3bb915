#include "emulator/play/plot/trace_table.h"

#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>

#include "base/files/content_kind.h"
#include "base/files/file_error.h"
#include "base/files/text_file.h"
#include "base/simulated_time.h"
#include "base/text/one_line.h"

namespace understudy::emulator::play {

namespace {

/// Removes the text up to `end`, and `end` itself. Returns the text before `end`.
std::string_view take_until(std::string_view& text, char end) {
  const std::size_t at = text.find(end);
  const std::string_view part = text.substr(0, at);
  text.remove_prefix(at == std::string_view::npos ? text.size() : at + 1);
  return part;
}

template <typename T>
bool is_read(std::string_view text, T& number) {
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  return read.ec == std::errc{} && read.ptr == text.data() + text.size() && !text.empty();
}

}  // namespace

TraceTable parse_csv_trace(std::string_view text, const std::string& name) {
  std::size_t line_number = 0;
  const auto fail = [&](const std::string& what) {
    throw FileError(name + ":" + std::to_string(line_number) + ": " + what);
  };
  const auto next_line = [&] {
    ++line_number;
    std::string_view line = take_until(text, '\n');
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  };
  TraceTable table;
  std::string_view header = next_line();
  if (take_until(header, ',') != "time_ms")
    fail("is not a trace; expected a first line that begins with time_ms");
  while (!header.empty()) table.names.emplace_back(take_until(header, ','));
  table.columns.resize(table.names.size());
  while (!text.empty()) {
    std::string_view line = next_line();
    if (line.empty()) continue;
    const std::string_view time = take_until(line, ',');
    Tick tick = 0;
    if (!is_read(time, tick))
      fail("time_ms: " + quoted(time) + " is not a time; expected whole milliseconds");
    if (!table.ticks.empty() && tick <= table.ticks.back()) {
      fail("time_ms: " + quoted(time) + " is not later than the previous time; expected ascending times");
    }
    table.ticks.push_back(tick);
    for (std::size_t i = 0; i < table.names.size(); ++i) {
      if (line.empty()) {
        fail("has " + std::to_string(i) + " values; expected " + std::to_string(table.names.size()));
      }
      const std::string_view value = take_until(line, ',');
      if (!is_read(value, table.columns[i].emplace_back())) {
        fail(table.names[i] + ": " + quoted(value) + " is not a number; expected one");
      }
    }
    if (!line.empty()) fail("has too many values; expected " + std::to_string(table.names.size()));
  }
  return table;
}

TraceTable read_trace(const std::string& path) {
  const bool is_csv = path.ends_with(".csv");
  if (!is_csv && !path.ends_with(".vcd")) {
    throw FileError(path + ": is not a trace; expected FILE.csv or FILE.vcd");
  }
  const auto text = read_text_file(path);
  if (!text) throw FileError(path + ": " + text.why + "; expected a trace");
  if (const std::string why = is_another_kind(*text, ContentKind::trace); !why.empty()) {
    throw FileError(path + ": " + why);
  }
  TraceTable table = is_csv ? parse_csv_trace(*text, path) : parse_vcd_trace(*text, path);
  if (table.ticks.empty()) throw FileError(path + ": has no rows; expected at least one");
  return table;
}

}  // namespace understudy::emulator::play
