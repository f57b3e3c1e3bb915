// libmodbus as the master on a serial port: what a real host would see of it.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "emulator/edge/event_loop.h"
#include "emulator/scenario/stage.h"
#include "pty/line_settings.h"

struct _modbus;

namespace understudy::emulator {

class LibmodbusHost {
 public:
  /// `timeout`: from a request's end to the first byte of its reply; `silence`: before each request. Throws
  /// pty::PortError.
  LibmodbusHost(const std::string& port, const pty::LineSettings& settings, WallTime timeout,
                WallTime silence);
  ~LibmodbusHost();
  LibmodbusHost(const LibmodbusHost&) = delete;
  LibmodbusHost& operator=(const LibmodbusHost&) = delete;

  HostReply read_registers(int station, std::uint16_t first, int count);
  HostReply write_registers(int station, std::uint16_t first, std::span<const std::uint16_t> words);
  /// Bytes as they are, past libmodbus; see Stage::exchange(). `sending`: how long they are on the line.
  std::vector<std::uint8_t> exchange(std::span<const std::uint8_t> bytes, std::size_t wanted,
                                     WallTime sending, WallTime within);

  /// Lines of text, past libmodbus; see Stage::converse().
  std::vector<std::string> converse(const std::optional<std::string>& text, const LinesWanted& wanted,
                                    WallTime sending, WallTime within);
  void say(const std::string& text);

 private:
  void write_all(std::span<const std::uint8_t> bytes);
  LinesHeard lines_heard() const;
  struct Close {
    void operator()(_modbus* context) const;
  };
  void begin_request(int station);
  HostReply judge(int result);
  void keep_silence() const;
  std::size_t read_some(std::vector<std::uint8_t>& bytes, WallTime until) const;

  std::string port_;
  std::unique_ptr<_modbus, Close> context_;
  WallTime silence_;
  WallTime quiet_since_{0};
  std::vector<std::uint8_t> unread_;  // of lines of text
};

}  // namespace understudy::emulator
