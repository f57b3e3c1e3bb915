#include "emulator/serve/ports/rfc2217.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "emulator/serve/ports/telnet.h"
#include "pty/line_settings.h"

namespace understudy::emulator::serve {

using Value = std::span<const std::uint8_t>;

namespace {

constexpr std::uint8_t kFromServer = 100;  // added to a command's code in answers
constexpr std::string_view kSignature = "understudy";

// There are no modem lines. Clients that query them see a device that is present and ready.
constexpr std::uint8_t kModemReady = 0x10 | 0x20 | 0x80;  // clear to send, data set ready, carrier
constexpr std::uint8_t kLineEmpty = 0x20 | 0x40;          // nothing is waiting to be sent

constexpr std::uint32_t kFastest = 4'000'000;
constexpr std::uint8_t kSuspend = 8;
constexpr std::uint8_t kResume = 9;

}  // namespace

/// A client's command. A command with another size is ignored; `size` 0 means any size.
struct Rfc2217::Row {
  std::uint8_t code;
  std::size_t size;
  void (Rfc2217::*act)(Value);
};

Rfc2217::Rfc2217(const pty::LineSettings& line) : to_client_(options_.begin()), settings_(line) {}

bool Rfc2217::receive_from_client(Value bytes) {
  reader_.append(bytes);
  return true;
}

/// Returns bytes for the line. A command applies to the bytes after it, so the bytes before it are returned
/// first.
Rfc2217::Bytes Rfc2217::take_for_line(std::size_t room) {
  Bytes taken;
  while (true) {
    reader_.take_data(taken, room, options_.they_are_binary());
    if (!taken.empty()) break;
    const auto command = reader_.take_command();
    if (!command) break;
    execute(*command);
    // A receiver treats a break as a zero character without a stop bit.
    if (std::exchange(breaks_, false) && room > 0) return {0};
    if (takes_back_ || throws_away_) break;
  }
  return taken;
}

std::optional<pty::HostSettings> Rfc2217::settings() const {
  return pty::HostSettings{.baud = settings_.baud,
                           .stop_bits = settings_.stop_bits,
                           .data_bits = settings_.data_bits,
                           .parity = settings_.parity};
}

bool Rfc2217::discards_input() { return std::exchange(takes_back_, false); }
bool Rfc2217::discards_output() { return std::exchange(throws_away_, false); }

void Rfc2217::receive_from_line(Value bytes) {
  telnet::append_data(to_client_, bytes, options_.we_are_binary());
}

Rfc2217::Bytes Rfc2217::take_for_client() { return std::exchange(to_client_, {}); }

void Rfc2217::execute(const telnet::Command& command) {
  switch (command.verb) {
    case telnet::kWill:
    case telnet::kWont:
    case telnet::kDo:
    case telnet::kDont: {
      const Bytes sent = options_.answer(command);
      to_client_.insert(to_client_.end(), sent.begin(), sent.end());
      if (options_.has_com_port() && !std::exchange(has_reported_modem_state_, options_.has_com_port()))
        report_modem_state();
      break;
    }
    case telnet::kSubnegotiation:
      if (command.option == telnet::kComPort) execute_com_port(command.body);
      break;
    case telnet::kBreak: breaks_ = true; break;
    case telnet::kAreYouThere: to_client_.insert(to_client_.end(), {telnet::kIac, telnet::kNop}); break;
    default: break;  // commands about terminals and their users
  }
}

void Rfc2217::execute_com_port(Value body) {
  static constexpr std::array kRows{Row{0, 0, &Rfc2217::report_signature},
                                    Row{1, 4, &Rfc2217::set_baud},
                                    Row{2, 1, &Rfc2217::set_data_bits},
                                    Row{3, 1, &Rfc2217::set_parity},
                                    Row{4, 1, &Rfc2217::set_stop_bits},
                                    Row{5, 1, &Rfc2217::control},
                                    Row{6, 0, &Rfc2217::notify_line_state},
                                    Row{7, 0, &Rfc2217::notify_modem_state},
                                    Row{kSuspend, 0, &Rfc2217::suspend},
                                    Row{kResume, 0, &Rfc2217::resume},
                                    Row{10, 1, &Rfc2217::mask_line_state},
                                    Row{11, 1, &Rfc2217::mask_modem_state},
                                    Row{12, 1, &Rfc2217::purge}};
  if (body.empty()) return;
  const auto* const row = std::ranges::find(kRows, body[0], &Row::code);
  const Value value = body.subspan(1);
  if (row == kRows.end() || (row->size != 0 && value.size() != row->size)) return;
  (this->*row->act)(value);
}

void Rfc2217::answer(std::uint8_t code, Value value) {
  Bytes body{telnet::kComPort, static_cast<std::uint8_t>(code + kFromServer)};
  body.insert(body.end(), value.begin(), value.end());
  telnet::append_subnegotiation(to_client_, body);
}

/// Answers a request for the signature. A client's own signature is not answered.
void Rfc2217::report_signature(Value value) {
  if (!value.empty()) return;
  answer(0, Bytes(kSignature.begin(), kSignature.end()));
}

// The answers to these commands contain the resulting setting. The value 0 only queries the setting.

void Rfc2217::set_baud(Value value) {
  const std::uint32_t baud =
      std::uint32_t{value[0]} << 24 | std::uint32_t{value[1]} << 16 | std::uint32_t{value[2]} << 8 | value[3];
  if (baud > 0 && baud <= kFastest) settings_.baud = static_cast<int>(baud);
  const auto is = static_cast<std::uint32_t>(settings_.baud);
  answer(1, std::array{static_cast<std::uint8_t>(is >> 24), static_cast<std::uint8_t>(is >> 16),
                       static_cast<std::uint8_t>(is >> 8), static_cast<std::uint8_t>(is)});
}

void Rfc2217::set_data_bits(Value value) {
  if (value[0] >= 5 && value[0] <= 8) settings_.data_bits = value[0];
  answer(2, static_cast<std::uint8_t>(settings_.data_bits));
}

/// Sets the parity: 1 to 5 in the order of pty::Parity.
void Rfc2217::set_parity(Value value) {
  if (value[0] >= 1 && value[0] <= 5) settings_.parity = static_cast<pty::Parity>(value[0] - 1);
  answer(3, static_cast<std::uint8_t>(static_cast<std::uint8_t>(settings_.parity) + 1));
}

/// Sets the stop bits. One and a half stop bits (3) are for characters of five bits, which no device uses.
void Rfc2217::set_stop_bits(Value value) {
  if (value[0] == 1 || value[0] == 2) settings_.stop_bits = value[0];
  answer(4, static_cast<std::uint8_t>(settings_.stop_bits));
}

/// Handles five controls. Each has one code that queries it and others that set it. Only a break affects the
/// line: a port has no modem lines, and flow control hardly matters for so little output.
void Rfc2217::control(Value value) {
  const std::uint8_t wish = value[0];
  struct Range {
    std::uint8_t asks, last;
    std::uint8_t Rfc2217::*state;
  };
  static constexpr std::array kRanges{Range{0, 3, &Rfc2217::flow_}, Range{4, 6, &Rfc2217::break_},
                                      Range{7, 9, &Rfc2217::dtr_}, Range{10, 12, &Rfc2217::rts_},
                                      Range{13, 16, &Rfc2217::inbound_flow_}};
  constexpr std::uint8_t kBreakOn = 5;
  for (const Range& range : kRanges) {
    if (wish < range.asks || wish > range.last) continue;
    if (wish == kBreakOn && break_ != kBreakOn) breaks_ = true;
    if (wish != range.asks) this->*range.state = wish;
    return answer(5, this->*range.state);
  }
  answer(5, flow_);  // flow control by modem lines, which do not exist
}

void Rfc2217::report_modem_state() { answer(7, kModemReady); }
void Rfc2217::notify_line_state(Value) { answer(6, kLineEmpty); }
void Rfc2217::notify_modem_state(Value) { report_modem_state(); }

void Rfc2217::suspend(Value) { is_suspended_ = true; }
void Rfc2217::resume(Value) { is_suspended_ = false; }

void Rfc2217::mask_line_state(Value value) { answer(10, value); }

void Rfc2217::mask_modem_state(Value value) {
  answer(11, value);
  if (value[0] != 0) answer(7, static_cast<std::uint8_t>(kModemReady & value[0]));
}

/// Purges data. 1: data that the client has not received; 2: data that is not transmitted yet; 3: both.
void Rfc2217::purge(Value value) {
  throws_away_ = value[0] == 1 || value[0] == 3;
  takes_back_ = value[0] == 2 || value[0] == 3;
  answer(12, value);
}

}  // namespace understudy::emulator::serve
