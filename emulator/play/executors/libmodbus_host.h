// Uses libmodbus as the master on a serial port, like a real host.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "emulator/play/executors/executor.h"
#include "emulator/serve/loop/event_loop.h"
#include "pty/line_settings.h"

struct _modbus;  // NOLINT(bugprone-reserved-identifier): libmodbus uses this name

namespace understudy::emulator::play {

class LibmodbusHost {
 public:
  /// `timeout` is the time from the end of a request to the first byte of its reply. `silence` is left before
  /// each request. Throws pty::PortError.
  LibmodbusHost(const std::string& port, const pty::LineSettings& settings, serve::WallTime timeout,
                serve::WallTime silence);
  ~LibmodbusHost();
  LibmodbusHost(const LibmodbusHost&) = delete;
  LibmodbusHost& operator=(const LibmodbusHost&) = delete;

  HostReply read(int station, Table table, std::uint16_t first, int count);
  HostReply write(int station, Table table, std::uint16_t first, std::span<const std::uint16_t> words);
  HostReply write_message(int station, std::uint16_t first, std::span<const std::uint16_t> words);
  /// Exchanges raw bytes without libmodbus; see Executor::exchange(). `sending` is the time that the line
  /// needs to transmit the bytes.
  std::vector<std::uint8_t> exchange(std::span<const std::uint8_t> bytes, std::size_t wanted,
                                     serve::WallTime sending, serve::WallTime within);

  /// Returns all bytes that are available when the next byte arrives. Empty: no byte arrived within that
  /// time.
  std::vector<std::uint8_t> receive(serve::WallTime within);

  /// Exchanges lines of text without libmodbus; see Executor::exchange_text().
  std::vector<std::string> exchange_text(const std::optional<std::string>& text,
                                         const world::LinesWanted& wanted, serve::WallTime sending,
                                         serve::WallTime within);
  void send_text(const std::string& text);

 private:
  void write_all(std::span<const std::uint8_t> bytes);
  world::ReceivedLines received_lines() const;
  struct Close {
    void operator()(_modbus* context) const;
  };
  void begin_request(int station);
  HostReply judge(int result);
  void keep_silence() const;
  int read_bits(Table table, std::uint16_t first, std::vector<std::uint16_t>& words);
  int write_bits(std::uint16_t first, std::span<const std::uint16_t> words);
  std::size_t read_some(std::vector<std::uint8_t>& bytes, serve::WallTime until) const;

  std::string port_;
  std::unique_ptr<_modbus, Close> context_;
  serve::WallTime silence_;
  serve::WallTime quiet_since_{0};
  std::vector<std::uint8_t> unread_;  // received characters of text lines
};

}  // namespace understudy::emulator::play
