// A serial port over telnet: clients can set the speed, parity, data bits and stop bits. A table has a row
// for each command. Source: RFC 2217.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "emulator/serve/ports/client_protocol.h"
#include "emulator/serve/ports/telnet.h"
#include "pty/line_settings.h"

namespace understudy::emulator::serve {

class Rfc2217 final : public ClientProtocol {
 public:
  /// Hosts that set nothing have the settings of `line`.
  explicit Rfc2217(const pty::LineSettings& line);

  bool has_room() const override { return reader_.has_room() && to_client_.size() < kMaxUnsaid; }
  bool receive_from_client(std::span<const std::uint8_t> bytes) override;
  Bytes take_for_line(std::size_t room) override;
  std::optional<pty::HostSettings> settings() const override;
  bool discards_input() override;
  bool discards_output() override;
  bool listens() const override { return !is_suspended_; }
  void receive_from_line(std::span<const std::uint8_t> bytes) override;
  Bytes take_for_client() override;

  struct Row;

 private:
  static constexpr std::size_t kMaxUnsaid = 4096;

  void execute(const telnet::Command& command);
  void execute_com_port(std::span<const std::uint8_t> body);
  void answer(std::uint8_t code, std::span<const std::uint8_t> value);
  void answer(std::uint8_t code, std::uint8_t value) { answer(code, std::span(&value, 1)); }
  void report_modem_state();

  // The functions in the table's rows. Each gets the received value.
  void report_signature(std::span<const std::uint8_t> value);
  void set_baud(std::span<const std::uint8_t> value);
  void set_data_bits(std::span<const std::uint8_t> value);
  void set_parity(std::span<const std::uint8_t> value);
  void set_stop_bits(std::span<const std::uint8_t> value);
  void control(std::span<const std::uint8_t> value);
  void notify_line_state(std::span<const std::uint8_t> value);
  void notify_modem_state(std::span<const std::uint8_t> value);
  void suspend(std::span<const std::uint8_t> value);
  void resume(std::span<const std::uint8_t> value);
  void mask_line_state(std::span<const std::uint8_t> value);
  void mask_modem_state(std::span<const std::uint8_t> value);
  void purge(std::span<const std::uint8_t> value);

  telnet::Reader reader_;
  telnet::Options options_;
  Bytes to_client_;
  pty::LineSettings settings_;
  // The codes of SET-CONTROL: none, off, on, on, none.
  std::uint8_t flow_ = 1;
  std::uint8_t break_ = 6;
  std::uint8_t dtr_ = 8;
  std::uint8_t rts_ = 11;
  std::uint8_t inbound_flow_ = 14;
  bool is_suspended_ = false;
  bool has_reported_modem_state_ = false;
  bool breaks_ = false;  // the next thing on the line is a break
  bool takes_back_ = false;
  bool throws_away_ = false;
};

}  // namespace understudy::emulator::serve
