// Logs of other programs, a line at a time. A row of kLogs describes each program's lines.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "base/text/lines.h"
#include "base/text/one_line.h"
#include "emulator/box/capture/capture.h"
#include "emulator/box/capture/log_pattern.h"
#include "emulator/box/capture/piece_readers.h"

namespace understudy::emulator::box {

namespace {

/// What the lines of a program's log look like.
struct LogRow {
  std::string_view name;
  std::array<std::pair<std::string_view, Side>, 6> patterns{};  // Side::unknown: what the line tells
  bool bytes_follow = false;  // they are in the lines after the one that the pattern describes
};
constexpr Side kTold = Side::unknown;
constexpr std::array kLogs{
    LogRow{"a log of socat -x", {{{"{dir} {time} length={*}", kTold}}}, true},
    LogRow{"debug output of libmodbus", {{{"{bytes}", kTold}, {"{time} {bytes}", kTold}}}},
    LogRow{"debug output of pymodbus",
           {{{"{time}{*}SEND: {hex}", Side::one},
             {"{time}{*}RECV: {hex}", Side::other},
             {"{time}{*}send: {hex}{*}", Side::one},
             {"{time}{*}recv: {hex}{*}", Side::other},
             {"{*}SEND: {hex}", Side::one},
             {"{*}RECV: {hex}", Side::other}}}},
    LogRow{"a table of Saleae Logic 2",
           {{{"\"{name}\",\"data\",{time},{*},{hex},{*}", kTold},
             {"\"{name}\",\"data\",{time},{*},{hex}", kTold},
             {"{name},data,{time},{*},{hex},{*}", kTold},
             {"{name},data,{time},{*},{hex}", kTold}}}},
    LogRow{"a table of Saleae Logic", {{{"{time},{hex},{*}", kTold}, {"{time},{name},{hex}", kTold}}}},
    LogRow{"a trace of sigrok-cli",
           {{{"{\"ph\": \"B\", \"ts\": {us}, \"pid\": \"{*}\", \"tid\": \"{name}\", \"name\": \"{hex}\"}{*}",
              kTold}}}},
    LogRow{"a decode of sigrok-cli",
           {{{"{sample}-{*} {*}: {hex}", kTold}, {"uart-1: {hex}", kTold}, {"uart: {hex}", kTold}}}},
    LogRow{"a log of interceptty", {{{"{dir} {hex} ({*})", kTold}, {"{time} {dir} {hex} ({*})", kTold}}}},
};

/// The patterns of a log, ready to use.
struct Log {
  std::string name;
  std::vector<std::pair<LogPattern, Side>> patterns{};
  bool bytes_follow = false;

  std::optional<LogLine> match(std::string_view text) const {
    for (const auto& [pattern, side] : patterns) {
      auto line = pattern.match(text);
      if (!line) continue;
      if (side != kTold) line->side = side;
      return line;
    }
    return {};
  }
};

Log log_of(const LogRow& row) {
  Log log{.name = std::string(row.name), .bytes_follow = row.bytes_follow};
  for (const auto& [text, side] : row.patterns)
    if (!text.empty()) log.patterns.emplace_back(LogPattern(text, !row.bytes_follow), side);
  return log;
}

/// Takes the log with most lines in the beginning of the file.
std::optional<Log> recognized(std::string_view head) {
  constexpr std::size_t kLinesToTell = 200;
  std::optional<Log> best;
  std::size_t max = 0;
  for (const LogRow& row : kLogs) {
    Log log = log_of(row);
    std::size_t count = 0;
    std::size_t seen = 0;
    for (const TextLine line : TextLines(head)) {
      if (++seen > kLinesToTell) break;
      if (log.match(line.text)) ++count;
    }
    if (count > max) {
      max = count;
      best = std::move(log);
    }
  }
  return best;
}

constexpr std::size_t kShownOfLine = 80;

class LogReader {
 public:
  LogReader(Log log, std::string_view head, const std::string& path, const CaptureSettings& settings,
            const PieceSink& sink)
      : log_(std::move(log)), path_(path), settings_(settings), sink_(sink) {
    for (const TextLine text : TextLines(head)) {
      const auto line = log_.match(text.text);
      if (!line) continue;
      if (!line->name.empty()) side_of(line->name);
      if (line->at && *line->at % std::chrono::seconds(1) >= std::chrono::milliseconds(1))
        has_nanoseconds_ = true;
    }
  }

  void read(std::istream& file) {
    for (std::string text; std::getline(file, text);) {
      ++number_;
      if (first_line_.empty()) first_line_ = text.substr(0, kShownOfLine);
      if (auto line = log_.match(text)) {
        has_matched_ = true;
        hand_on();
        take(*line);
      } else if (piece_ && log_.bytes_follow) {
        add_bytes(text);
      }
    }
    hand_on();
    if (!has_matched_ && !settings_.pattern.empty()) throw no_match();
  }

 private:
  CaptureReadError no_match() const {
    return CaptureReadError(path_ + ": none of its " + std::to_string(number_) + " lines fits --pattern " +
                            quoted(settings_.pattern) + "; expected a pattern of whole lines such as " +
                            quoted(first_line_));
  }

  void take(LogLine& line) {
    CapturedPiece piece{
        .at = time_of(line), .side = line.side, .bytes = std::move(line.bytes), .place = number_};
    // A single channel hears both directions.
    if (!line.name.empty()) piece.side = side_of(line.name);
    piece_ = std::move(piece);
    if (!log_.bytes_follow) hand_on();
  }

  void hand_on() {
    if (piece_) sink_(std::move(*piece_));
    piece_.reset();
  }

  void add_bytes(std::string_view text) { take_hex(text, piece_->bytes); }

  Side side_of(const std::string& name) {
    auto found = std::ranges::find(names_, name);
    if (found == names_.end()) found = names_.insert(names_.end(), name);
    if (names_.size() < 2) return Side::unknown;
    return found == names_.begin() ? Side::one : Side::other;
  }

  std::optional<SimTime> time_of(const LogLine& line) {
    if (line.sample) {
      if (!settings_.sample_rate)
        throw CaptureReadError(
            path_ + ":" + std::to_string(number_) +
            ": counts samples; expected --sample-rate with how many there are in a second, such "
            "as 1000000");
      const double nanoseconds = static_cast<double>(*line.sample) / *settings_.sample_rate * 1e9;
      constexpr double kLatest = 9e18;
      return SimTime{static_cast<std::int64_t>(std::min(nanoseconds, kLatest))};
    }
    if (!line.at) return {};
    SimTime at = *line.at;
    // socat 1.7 prints microseconds as if they were nanoseconds.
    if (log_.bytes_follow && !has_nanoseconds_) {
      const SimTime part = at % std::chrono::seconds(1);
      at += part * 999;
    }
    if (line.is_time_of_day) {
      if (last_of_day_ && at + std::chrono::hours(12) < *last_of_day_) midnights_ += std::chrono::hours(24);
      last_of_day_ = at;
      at += midnights_;
    }
    return at;
  }

  Log log_;
  const std::string& path_;
  const CaptureSettings& settings_;
  const PieceSink& sink_;
  std::size_t number_ = 0;
  std::string first_line_;  // its beginning, for a message; not empty, if any is not
  bool has_matched_ = false;
  std::optional<CapturedPiece> piece_;
  std::vector<std::string> names_;
  bool has_nanoseconds_ = false;
  std::optional<SimTime> last_of_day_;
  SimTime midnights_{0};
};

}  // namespace

std::string log_format(const std::string& head) {
  const std::optional<Log> log = recognized(head);
  return log ? log->name : "";
}

std::string read_log_pieces(std::istream& file, const std::string& head, const std::string& path,
                            const CaptureSettings& settings, const PieceSink& sink) {
  std::optional<Log> log;
  if (settings.pattern.empty()) {
    log = recognized(head);
  } else {
    log = Log{.name = "a log with --pattern"};
    try {
      log->patterns.emplace_back(LogPattern(settings.pattern), kTold);
    } catch (const std::invalid_argument& error) {
      throw CaptureReadError("--pattern: " + std::string(error.what()));
    }
  }
  if (!log)
    throw CaptureReadError(
        path +
        ": is not a known capture; expected one of `serve --capture`, pcap, pcapng, a "
        "log of socat -x, libmodbus, pymodbus, Saleae or sigrok-cli, or --pattern with what "
        "its lines look like");
  std::string name = log->name;
  LogReader(std::move(*log), head, path, settings, sink).read(file);
  return name;
}

}  // namespace understudy::emulator::box
