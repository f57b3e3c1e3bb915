// Two Simple2-R3 on one line at 19200 8E1, and a host that sends a frame every 100 ms.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "emulator/models/models.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

using Bytes = std::vector<std::uint8_t>;

/// Computes the checksum bit by bit, as in the standard's appendix.
inline Bytes with_crc(Bytes bytes) {
  unsigned crc = 0xFFFF;
  for (const unsigned byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? crc >> 1 ^ 0xA001 : crc >> 1;
  }
  bytes.push_back(static_cast<std::uint8_t>(crc & 0xFF));
  bytes.push_back(static_cast<std::uint8_t>(crc >> 8));
  return bytes;
}

inline std::string hex(std::span<const std::uint8_t> bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) {
    constexpr std::string_view kDigits = "0123456789ABCDEF";
    text += text.empty() ? "" : " ";
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

/// Makes a fault from words: "drop feeder nth=3 when=\"a > 5\"".
inline FaultText fault_words(const std::string& text) {
  FaultText fault{};
  std::vector<std::string> words{""};
  bool is_quoted = false;
  for (const char c : text) {
    if (c == '"') {
      is_quoted = !is_quoted;
    } else if (c == ' ' && !is_quoted) {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  fault.kind = words[0];
  fault.place = words.size() > 1 ? words[1] : "";
  for (std::size_t i = 2; i < words.size(); ++i) {
    const std::size_t equals = words[i].find('=');
    fault.fields.emplace_back(words[i].substr(0, equals), words[i].substr(equals + 1));
  }
  return fault;
}

struct Answer {
  SimTime after{0};  // from the request's first start bit to the end of the reply's first character
  Bytes bytes{};
  bool operator==(const Answer&) const = default;
};
inline std::ostream& operator<<(std::ostream& out, const Answer& answer) {
  return out << hex(answer.bytes) << " after " << format_duration(answer.after);
}

inline const std::string kFaultyLine =
    "understudy: 1\n"
    "lines:\n"
    "  rs485:\n"
    "    baud: 19200\n"
    "    stations:\n"
    "      - { name: feeder, model: simple2-r3, address: 1 }\n"
    "      - { name: turner, model: simple2-r3, address: 2 }\n";

class FaultyLine {
 public:
  static constexpr SimTime kEvery = std::chrono::milliseconds(100);

  explicit FaultyLine(const std::string& more = "", const WorldOptions& options = {}, std::uint64_t seed = 0)
      : world_(seeded(parse_bench(models::all_models(), kFaultyLine + more, "faulty.yaml", "."), seed),
               options, {}) {}

  World& world() { return world_; }
  std::size_t inject(const std::string& text) {
    return world_.inject(find_fault(world_.known(), fault_words(text)));
  }
  const FaultCourse& course(std::size_t number) const { return world_.faults().at(number).course; }

  /// Sends the frame at the next multiple of 100 ms, and collects what is received until the next one.
  Answer ask(const Bytes& frame) {
    const SimTime begin = (world_.now() / kEvery + 1) * kEvery;
    world_.advance_to(begin);
    const pty::Line& line = world_.line(0).line;
    world_.receive(0, frame, begin);
    Answer answer;
    while (world_.now() < begin + kEvery - std::chrono::milliseconds(1)) {
      const SimTime next =
          std::min(world_.next_due().value_or(kForever), begin + kEvery - std::chrono::milliseconds(1));
      world_.advance_to(std::max(next, world_.now()));
      const auto came = line.output();
      if (!came.empty() && answer.bytes.empty()) answer.after = world_.now() - begin;
      answer.bytes.insert(answer.bytes.end(), came.begin(), came.end());
      world_.take_output(0, came.size());
    }
    return answer;
  }
  std::vector<Answer> ask_all(const std::vector<Bytes>& frames) {
    std::vector<Answer> answers;
    for (const Bytes& frame : frames) answers.push_back(ask(frame));
    return answers;
  }

 private:
  static Bench seeded(Bench bench, std::uint64_t seed) {
    if (seed != 0) bench.seed = seed;
    return bench;
  }

  World world_;
};

// From the specification's wire examples.
inline const Bytes kAskFeeder{0x01, 0x03, 0x00, 0x01, 0x00, 0x01, 0xD5, 0xCA};
inline const Bytes kFeederSays{0x01, 0x03, 0x02, 0xC0, 0x01, 0x29, 0x84};
inline const Bytes kSetSpeed{0x01, 0x06, 0x10, 0x02, 0x00, 0xC8, 0x2D, 0x5C};
inline const Bytes kSetMove{0x01, 0x10, 0x10, 0x00, 0x00, 0x05, 0x0A, 0x7D, 0x00, 0x00,
                            0x00, 0x00, 0xC8, 0x00, 0x05, 0x00, 0x05, 0xB3, 0xF7};
inline const Bytes kSetMoveDone{0x01, 0x10, 0x10, 0x00, 0x00, 0x05, 0x04, 0xCA};
inline const Bytes kSwitchServoOn{0x01, 0x06, 0x10, 0x14, 0x00, 0x01, 0x0C, 0xCE};
inline const Bytes kMove{0x01, 0x06, 0x10, 0x05, 0x00, 0x01, 0x5C, 0xCB};
inline const Bytes kAskTurner{0x02, 0x03, 0x00, 0x01, 0x00, 0x01, 0xD5, 0xF9};
inline const Bytes kTurnerSays{0x02, 0x03, 0x02, 0xC0, 0x01, 0x6D, 0x84};

// A request of 8 characters at 19200 8E1 ends after 8 * 11 bits = 4,583,333 ns; the device waits 750 us, and
// the reply's first character takes 572,916 ns.
inline constexpr SimTime kUsual{4'583'333 + 750'000 + 572'916};

}  // namespace understudy::emulator::world
