// Implements `tap`: listens on a line with one or two adapters, and writes a capture. Sends nothing.
#include <poll.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "base/files/file_claims.h"
#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/box/capture/capture.h"
#include "emulator/box/capture/rtu_frames.h"
#include "emulator/box/wire/port_name.h"
#include "emulator/box/wire/wire.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/interruption.h"
#include "emulator/command_line/log.h"
#include "emulator/command_line/output_paths.h"
#include "emulator/serve/loop/event_loop.h"
#include "pty/capture.h"
#include "pty/capture_file.h"
#include "pty/line_settings.h"

namespace understudy::emulator::command_line {

namespace {

/// A signal also ends a wait, unless it arrives just before the wait.
constexpr int kTapWaitMs = 100;

/// Returns true if both texts refer to the same port, perhaps with different settings or through a link.
bool is_same_port(const std::string& one, const std::string& other) {
  const std::string first = one.substr(0, one.find(','));
  const std::string second = other.substr(0, other.find(','));
  std::error_code error;
  return first == second || std::filesystem::equivalent(first, second, error);
}

/// Real time that never runs backwards, even if the system clock is set back.
class RunningClock {
 public:
  SimTime now() const { return at_begin_ + SimTime{serve::wall_now() - begin_}; }

 private:
  SimTime at_begin_ =
      std::chrono::duration_cast<SimTime>(std::chrono::system_clock::now().time_since_epoch());
  box::WallTime begin_ = serve::wall_now();
};

/// Reads the bytes of one adapter.
class Adapter {
 public:
  Adapter(const std::string& port, pty::Direction direction) : name_(parsed(port)), direction_(direction) {
    settings_ = name_.framing.value_or(pty::LineSettings());
    settings_.baud = name_.baud.value_or(settings_.baud);
    wire_ = box::open_wire(name_, box::WireUse::listen);
    if (name_.has_settings()) wire_->set_line(settings_);
  }

  int descriptor() const { return wire_->descriptor(); }
  int baud() const { return settings_.baud; }
  std::string place() const {
    return one_line(name_.place) + (name_.has_settings() ? " at " + pty::to_string(settings_) : "");
  }

  /// Reads the available bytes, and writes them to the capture with their estimated times.
  void take(const RunningClock& clock, pty::CaptureFile& file) {
    box::Bytes bytes;
    if (!wire_->receive(bytes, box::WallTime{0})) return;
    const SimTime now = clock.now();
    const SimTime sending{settings_.duration_of(static_cast<std::int64_t>(bytes.size()))};
    const SimTime began = std::max(last_, now - sending);
    last_ = now;
    file.add({.line = 0, .direction = direction_, .time = began, .bytes = bytes});
    bytes_ += bytes.size();
    frames_.add({.at = began, .line = {}, .bytes = std::move(bytes)});
    count_frames();
  }

  std::string summary() const {
    std::string text = one_line(name_.place) + ": " + std::to_string(bytes_) + " bytes, " +
                       std::to_string(found_) + " Modbus frames";
    if (dropped_ != 0) text += ", " + std::to_string(dropped_) + " bytes outside frames";
    if (found_ == 0 && bytes_ != 0)
      text += "; unless it is a text line, check the speed and framing (" + pty::to_string(settings_) + ")";
    return text;
  }

 private:
  static box::PortName parsed(const std::string& port) {
    try {
      box::PortName name = box::parse_port_name(port);
      if (name.is_modbus_tcp())
        throw UsageError(
            "tap: " + quoted(port) +
            ": a gateway does not pass on other masters' requests; expected a serial port, or a capture by "
            "tcpdump");
      return name;
    } catch (const box::PortNameError& error) {
      throw UsageError("tap: " + std::string(error.what()));
    }
  }

  void count_frames() {
    while (true) {
      const bool is_frame = frames_.next(nullptr, false).has_value();
      const std::size_t dropped = frames_.take_dropped();
      found_ += is_frame ? 1 : 0;
      dropped_ += dropped;
      if (!is_frame && dropped == 0) return;
    }
  }

  box::PortName name_;
  pty::Direction direction_;
  pty::LineSettings settings_;
  std::unique_ptr<box::Wire> wire_;
  SimTime last_{0};
  box::FrameFinder frames_{box::FrameRole::either};
  std::size_t bytes_ = 0;
  std::size_t found_ = 0;
  std::size_t dropped_ = 0;
};

void listen_until_interrupted(std::vector<Adapter>& adapters, pty::CaptureFile& file) {
  const RunningClock clock;
  std::vector<pollfd> waited;
  for (const Adapter& adapter : adapters)
    waited.push_back({.fd = adapter.descriptor(), .events = POLLIN, .revents = 0});
  while (!is_interrupted()) {
    if (::poll(waited.data(), waited.size(), kTapWaitMs) <= 0) continue;
    for (std::size_t i = 0; i < adapters.size(); ++i)
      if (waited[i].revents != 0) adapters[i].take(clock, file);
  }
}

}  // namespace

int tap_line(const TapArguments& arguments) {
  if (arguments.output.ends_with(".pcap"))
    throw UsageError(
        "--output: " + arguments.output +
        ": this old format is not supported; expected .pcapng, or another ending for a text log");
  if (arguments.line.find_first_of(" \t\n") != std::string::npos)
    throw UsageError("--line: " + quoted(arguments.line) + " is not a name; expected one word");
  if (arguments.ports.size() == 2 && is_same_port(arguments.ports[0], arguments.ports[1]))
    throw UsageError("tap: " + quoted(arguments.ports[1]) +
                     " is the same port as the first; expected one port for each direction");
  FileClaims claims;
  pty::CaptureFile file(require_output(claims, "--output", arguments.output), log_line);
  std::vector<Adapter> adapters;
  const bool is_alone = arguments.ports.size() == 1;
  for (const std::string& port : arguments.ports)
    adapters.emplace_back(port, is_alone           ? pty::Direction::unknown
                                : adapters.empty() ? pty::Direction::from_one
                                                   : pty::Direction::from_other);
  watch_for_interruption();
  file.begin({{.name = arguments.line, .baud = adapters.front().baud(), .is_tapped = true}});
  for (const Adapter& adapter : adapters) std::printf("listening: %s\n", adapter.place().c_str());
  std::fflush(stdout);
  listen_until_interrupted(adapters, file);
  file.finish();
  for (const Adapter& adapter : adapters) std::printf("%s\n", adapter.summary().c_str());
  std::printf("next: understudy compare %s --bench BENCH\n", arguments.output.c_str());
  return file.failure().empty() ? kExitWell : kExitNoResource;
}

}  // namespace understudy::emulator::command_line
