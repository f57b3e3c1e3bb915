// Input from a telnet client: commands, options, subnegotiations and bytes, complete or not. However it is
// cut into pieces, and however little room the line has, the line gets the same bytes with the same settings
// and the client the same replies; nothing grows without bound, and the output is well-formed telnet.
//
// The first byte says how the input is cut.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "emulator/serve/ports/rfc2217.h"
#include "pty/line_settings.h"
#include "tests/fuzz/fuzzing.h"

namespace {

using namespace understudy;
using emulator::serve::Rfc2217;
using fuzzing::require;
using Bytes = Rfc2217::Bytes;

constexpr std::size_t kLongest = 8192;
constexpr std::size_t kMaxAnswers = 64 * 1024;

struct Outcome {
  std::vector<std::pair<std::uint8_t, pty::LineSettings>>
      line;  // each byte, with the host's settings at that time
  Bytes answers;
  bool operator==(const Outcome&) const = default;
};

pty::LineSettings settings_of(const Rfc2217& port) {
  const std::optional<pty::HostSettings> host = port.settings();
  require(host && host->data_bits && host->parity, "the settings are known");
  require(host->baud > 0 && host->baud <= 4'000'000, "the speed is one");
  require(*host->data_bits >= 5 && *host->data_bits <= 8, "so many data bits are possible");
  require(host->stop_bits == 1 || host->stop_bits == 2, "so many stop bits are possible");
  return {.baud = host->baud,
          .data_bits = *host->data_bits,
          .parity = *host->parity,
          .stop_bits = host->stop_bits};
}

void serve_line(Rfc2217& port, std::size_t room, Outcome& outcome) {
  for (bool continues = true; continues;) {
    const Bytes taken = port.take_for_line(room);
    require(taken.size() <= room, "no more is taken than there is room for");
    for (const std::uint8_t byte : taken) outcome.line.emplace_back(byte, settings_of(port));
    const bool discards_input = port.discards_input();
    const bool discards_output = port.discards_output();
    continues = !taken.empty() || discards_input || discards_output;
  }
  const Bytes answers = port.take_for_client();
  require(answers.size() <= kMaxAnswers, "answers are bounded");
  outcome.answers.insert(outcome.answers.end(), answers.begin(), answers.end());
}

Outcome outcome_of(std::span<const std::uint8_t> sent, std::size_t piece, std::size_t room) {
  Rfc2217 port(pty::LineSettings{});
  Outcome outcome;
  for (std::size_t at = 0; at < sent.size(); at += piece) {
    require(port.has_room(), "what is served makes room");
    require(port.receive_from_client(sent.subspan(at, std::min(piece, sent.size() - at))),
            "nobody is let go");
    serve_line(port, room, outcome);
  }
  return outcome;
}

/// Only commands and replies, because nothing came from the line: each begins with 255 and ends where it
/// should.
void require_telnet(std::span<const std::uint8_t> sent) {
  std::size_t at = 0;
  while (at < sent.size()) {
    require(at + 1 < sent.size() && sent[at] == 255, "a command begins with 255");
    const std::uint8_t verb = sent[at + 1];
    if (verb >= 251 && verb <= 254) {
      at += 3;
    } else if (verb == 250) {
      at += 2;
      while (at + 1 < sent.size() && !(sent[at] == 255 && sent[at + 1] == 240)) at += sent[at] == 255 ? 2 : 1;
      at += 2;
    } else {
      require(verb == 241, "nothing else is said");
      at += 2;
    }
  }
  require(at == sent.size(), "each answer is whole");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0 || size > kLongest) return 0;
  const std::span<const std::uint8_t> sent(data + 1, size - 1);
  // A whole break is dropped if the line has no room for it, so it has some.
  const Outcome whole = outcome_of(sent, 4096, 4096);
  require_telnet(whole.answers);
  require(outcome_of(sent, 1 + data[0] % 16, 1 + data[0] / 16) == whole, "pieces make no difference");
  return 0;
}
