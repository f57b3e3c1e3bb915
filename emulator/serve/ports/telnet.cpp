#include "emulator/serve/ports/telnet.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace understudy::emulator::serve::telnet {

namespace {

constexpr std::uint8_t kReturn = '\r';
constexpr std::uint8_t kLineFeed = '\n';

bool has_option(std::uint8_t verb) { return verb >= kSubnegotiation && verb != kIac; }

}  // namespace

void Reader::drop(std::size_t count) {
  received_.erase(received_.begin(), received_.begin() + static_cast<std::ptrdiff_t>(count));
}

void Reader::take_data(Bytes& taken, std::size_t max, bool is_binary) {
  std::size_t at = 0;
  while (!is_skipping_ && taken.size() < max && at < received_.size()) {
    const std::uint8_t byte = received_[at];
    const bool is_escaped = byte == kIac && at + 1 < received_.size() && received_[at + 1] == kIac;
    if (byte == kIac && !is_escaped) break;
    at += is_escaped ? 2 : 1;
    if (!is_binary && was_return_ && byte == 0) {
      was_return_ = false;
      continue;
    }
    was_return_ = byte == kReturn;
    taken.push_back(byte);
  }
  drop(at);
}

std::optional<Command> Reader::take_command() {
  if (is_skipping_) return skip_subnegotiation() ? std::optional(Command{}) : std::nullopt;
  if (received_.size() < 2 || received_[0] != kIac || received_[1] == kIac) return std::nullopt;
  Command command{.verb = received_[1], .option = 0, .body = {}};
  if (!has_option(command.verb)) {
    drop(2);
    return command;
  }
  if (received_.size() < 3) return std::nullopt;
  command.option = received_[2];
  if (command.verb == kSubnegotiation) return take_subnegotiation();
  drop(3);
  return command;
}

/// Skips a subnegotiation. Returns false if its end has not been received yet. Drops all skipped bytes except
/// one whose meaning depends on the next byte.
bool Reader::skip_subnegotiation() {
  std::size_t at = 0;
  while (at + 1 < received_.size()) {
    if (received_[at] != kIac) {
      ++at;
    } else if (received_[at + 1] == kIac) {
      at += 2;
    } else {
      drop(received_[at + 1] == kSubnegotiationEnd ? at + 2 : at);
      is_skipping_ = false;
      return true;
    }
  }
  if (at < received_.size() && received_[at] != kIac) ++at;
  drop(at);
  return false;
}

/// Takes a subnegotiation. A command inside it ends the subnegotiation, which is then ignored.
std::optional<Command> Reader::take_subnegotiation() {
  Command command{.verb = kSubnegotiation, .option = received_[2], .body = {}};
  for (std::size_t at = 3; at + 1 < received_.size(); ++at) {
    if (at > kLongestSubnegotiation) {
      drop(3);
      is_skipping_ = true;
      return take_command();
    }
    if (received_[at] == kIac && received_[at + 1] != kIac) {
      const bool is_ended = received_[at + 1] == kSubnegotiationEnd;
      drop(is_ended ? at + 2 : at);
      return is_ended ? command : Command{};
    }
    command.body.push_back(received_[at]);
    if (received_[at] == kIac) ++at;
  }
  return std::nullopt;
}

Bytes Options::begin() {
  Bytes printed;
  for (Row& row : rows_) {
    printed.insert(printed.end(), {kIac, kDo, row.option});
    row.theirs = State::asked;
    if (row.option == kComPort) continue;  // the client must offer this option
    printed.insert(printed.end(), {kIac, kWill, row.option});
    row.ours = State::asked;
  }
  return printed;
}

Bytes Options::answer(const Command& command) {
  const bool is_about_us = command.verb == kDo || command.verb == kDont;
  const bool is_on = command.verb == kDo || command.verb == kWill;
  const std::uint8_t yes = is_about_us ? kWill : kDo;
  const std::uint8_t no = is_about_us ? kWont : kDont;
  auto* const row = std::ranges::find(rows_, command.option, &Row::option);
  if (row == rows_.end()) return is_on ? Bytes{kIac, no, command.option} : Bytes{};
  State& state = is_about_us ? row->ours : row->theirs;
  const State before = state;
  state = is_on ? State::on : State::off;
  // This is the client's answer to a request of ours, and is not answered.
  if (before == State::asked || before == state) return {};
  return {kIac, is_on ? yes : no, command.option};
}

void append_data(Bytes& sent, std::span<const std::uint8_t> bytes, bool is_binary) {
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    sent.push_back(bytes[i]);
    if (bytes[i] == kIac) sent.push_back(kIac);
    const bool is_end = i + 1 == bytes.size() || bytes[i + 1] != kLineFeed;
    if (!is_binary && bytes[i] == kReturn && is_end) sent.push_back(0);
  }
}

void append_subnegotiation(Bytes& sent, std::span<const std::uint8_t> body) {
  sent.insert(sent.end(), {kIac, kSubnegotiation});
  append_data(sent, body, true);
  sent.insert(sent.end(), {kIac, kSubnegotiationEnd});
}

}  // namespace understudy::emulator::serve::telnet
