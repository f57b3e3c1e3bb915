// Stations for the line's tests: one that answers requests, and one that sends on request.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "pty/line.h"
#include "pty/rtu_framer.h"
#include "tests/pty/wire_examples.h"

namespace understudy::pty {

/// Answers every frame to its own address with the bytes that the test sets.
class FakeSlave : public Station {
 public:
  FakeSlave(std::uint8_t address, Bytes reply,
            RtuFraming framing = {.silence = std::chrono::microseconds(750),
                                  .patience = std::chrono::milliseconds(10)})
      : framer_(framing), address_(address), reply_(std::move(reply)) {}

  LineSettings settings() const override { return listens_to; }
  void on_start_bit(SimTime at) override { framer_.start_bit(at); }
  void receive(const TimedByte& byte) override {
    received.push_back(byte);
    framer_.push(byte);
  }
  void on_other_station() override {
    ++others;
    framer_.reset();
  }
  void on_idle() override { framer_.give_up_waiting(); }
  std::optional<SimTime> due() const override { return framer_.due(); }
  void run(SimTime now, Transmitter& out) override {
    const auto frame = framer_.take(now);
    if (!frame || frame->bytes[0] != address_) return;
    served_at.push_back(now);
    out.answer(reply_, frame->last_character);
  }

  LineSettings listens_to;
  std::vector<TimedByte> received;
  std::vector<SimTime> served_at;
  int others = 0;

 protected:
  RtuFramer framer_;

 private:
  std::uint8_t address_;
  Bytes reply_;
};

/// Sends the given bytes at the given times.
class FakeTalker : public Station {
 public:
  LineSettings settings() const override { return {}; }
  void receive(const TimedByte& byte) override { received.push_back(byte.value); }
  void on_other_station() override { ++others; }
  std::optional<SimTime> due() const override {
    return says.empty() ? std::nullopt : std::optional(says.begin()->first);
  }
  void run(SimTime now, Transmitter& out) override {
    while (!says.empty() && says.begin()->first <= now) {
      for (const Bytes& bytes : says.begin()->second) out.transmit(bytes);
      says.erase(says.begin());
    }
  }

  std::map<SimTime, std::vector<Bytes>> says;
  Bytes received;
  int others = 0;
};

/// A line and its output, with times.
struct LineRig {
  explicit LineRig(LineOptions options = {})
      : line("rs485", options, [this](const std::string& what) { warnings.push_back(what); }) {}

  void send(const Bytes& bytes, SimTime now) { line.receive(bytes, now); }
  /// Runs from event to event, as the owner's loop does.
  void run(SimTime until) {
    while (line.due() && *line.due() <= until) {
      const SimTime due = *line.due();
      line.run(due);
      for (const std::uint8_t value : line.output()) {
        out.push_back(value);
        out_at.push_back(due);
      }
      line.take_output(line.output().size());
    }
  }

  std::vector<std::string> warnings;
  Line line;
  Bytes out;
  std::vector<SimTime> out_at;
};

}  // namespace understudy::pty
