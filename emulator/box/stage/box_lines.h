// The lines of a bench whose controllers are real: their ports, open for a whole run.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "emulator/box/asking/modbus_exchange.h"
#include "emulator/box/wire/port_name.h"
#include "emulator/box/wire/wire.h"
#include "emulator/device/model.h"
#include "emulator/world/protocol/received_lines.h"
#include "pty/line_settings.h"

namespace understudy::emulator::box {

/// A host on one real line.
class LineHost {
 public:
  /// Opens the port and finds the settings at which a controller of the model answers. Only reads are sent.
  /// Throws BoxError and WireError.
  LineHost(const PortName& port, const Model& model, int station, WallTime timeout);

  /// Sends a frame of Modbus after `gap` of silence, and returns the reply, both with their checksums.
  Asked ask(const Bytes& request, WallTime gap);
  /// Sends raw bytes. Returns the bytes received until there are `wanted`, or `within` has passed.
  Bytes exchange(const Bytes& bytes, std::size_t wanted, WallTime within, WallTime gap);

  void send_text(const std::string& text, WallTime gap);
  std::vector<std::string> exchange_text(const std::optional<std::string>& text,
                                         const world::LinesWanted& wanted, WallTime within, WallTime gap);

  const pty::LineSettings& settings() const { return settings_; }
  /// Asks for something that every controller of the model has, twice.
  bool is_answering();
  /// Called again and again while it waits; may throw.
  void set_heartbeat(std::function<void()> heartbeat) { heartbeat_ = std::move(heartbeat); }

 private:
  void find_settings();
  bool answers(bool& is_noisy, int& other_station);
  void receive_until(Bytes& bytes, WallTime until);
  bool receive_rest(Bytes& bytes);
  void settle();
  void wait(WallTime gap);

  PortName port_;
  const Model& model_;
  int station_;
  std::unique_ptr<Wire> wire_;
  WallTime timeout_;
  pty::LineSettings settings_;
  std::optional<ModbusExchange> exchange_;
  Bytes unread_;  // of text
  WallTime quiet_since_{0};
  bool is_unsettled_ = false;  // the rest of an unexpected reply may still arrive
  std::function<void()> heartbeat_;
};

/// The ports of `--on LINE=PORT`.
class BoxLines {
 public:
  static constexpr const char* kAnyLine = "*";

  BoxLines(std::map<std::string, PortName> ports, WallTime timeout)
      : ports_(std::move(ports)), timeout_(timeout) {}

  /// The name "*" stands for every line.
  bool has(const std::string& line) const { return ports_.contains(line) || ports_.contains(kAnyLine); }
  /// Opens the port when it is used for the first time. Throws BoxError and WireError.
  LineHost& host(const std::string& line, const Model& model, int station);
  /// Returns true if something answers on every line that was opened.
  bool are_answering();

 private:
  std::map<std::string, PortName> ports_;
  WallTime timeout_;
  std::map<std::string, std::unique_ptr<LineHost>> hosts_;
};

}  // namespace understudy::emulator::box
