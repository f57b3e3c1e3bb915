// The part of telnet that a serial port needs: it separates bytes from commands, and negotiates options.
// Source: RFC 854, 855, 856, 858.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace understudy::emulator::serve::telnet {

using Bytes = std::vector<std::uint8_t>;

inline constexpr std::uint8_t kIac = 255;
enum Verb : std::uint8_t {
  kSubnegotiationEnd = 240,
  kNop = 241,
  kBreak = 243,
  kAreYouThere = 246,
  kSubnegotiation = 250,
  kWill = 251,
  kWont = 252,
  kDo = 253,
  kDont = 254,
};
enum Option : std::uint8_t { kBinary = 0, kSuppressGoAhead = 3, kComPort = 44 };

struct Command {
  std::uint8_t verb = kNop;
  std::uint8_t option = 0;  // the option of will, wont, do, dont and subnegotiation
  Bytes body;               // the part of a subnegotiation after its option
};

/// Separates received data and commands, in order.
class Reader {
 public:
  static constexpr std::size_t kMaxReceived = 4096;
  static constexpr std::size_t kLongestSubnegotiation = 256;  // bytes as sent; longer ones are ignored

  bool has_room() const { return received_.size() < kMaxReceived; }
  void append(std::span<const std::uint8_t> bytes) {
    received_.insert(received_.end(), bytes.begin(), bytes.end());
  }
  /// Adds bytes up to the next command, until there are `max`. In text mode, the 0 after a carriage return is
  /// omitted.
  void take_data(Bytes& taken, std::size_t max, bool is_binary);
  /// Returns the next command if no data precede it and it is complete. A malformed command becomes a kNop.
  std::optional<Command> take_command();

 private:
  bool skip_subnegotiation();
  std::optional<Command> take_subnegotiation();
  void drop(std::size_t count);

  Bytes received_;
  bool is_skipping_ = false;  // the subnegotiation is too long
  bool was_return_ = false;
};

/// The options of both sides. Only requests that change something are answered, so that the negotiation ends.
class Options {
 public:
  /// Returns requests for all wanted options.
  Bytes begin();
  /// Returns the answer to will, wont, do or dont; empty if nothing changes.
  Bytes answer(const Command& command);

  bool we_are_binary() const { return rows_[0].ours == State::on; }
  bool they_are_binary() const { return rows_[0].theirs == State::on; }
  /// Returns true if at least one side has agreed to the COM port option.
  bool has_com_port() const { return rows_[2].ours == State::on || rows_[2].theirs == State::on; }

 private:
  enum class State : std::uint8_t { off, asked, on };
  struct Row {
    std::uint8_t option;
    State ours = State::off;
    State theirs = State::off;
  };
  std::array<Row, 3> rows_{Row{kBinary}, Row{kSuppressGoAhead}, Row{kComPort}};
};

/// Appends bytes of the line, encoded for transmission.
void append_data(Bytes& sent, std::span<const std::uint8_t> bytes, bool is_binary);
/// Appends a subnegotiation, encoded for transmission. `body` begins with the option.
void append_subnegotiation(Bytes& sent, std::span<const std::uint8_t> body);

}  // namespace understudy::emulator::serve::telnet
