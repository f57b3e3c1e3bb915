// A controller with hidden options, and a capture of its line.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "emulator/box/capture/capture.h"
#include "emulator/models/models.h"
#include "emulator/play/executors/free_executor.h"
#include "emulator/world/bench_file/bench_file.h"
#include "pty/rtu_crc.h"

namespace understudy::emulator::box {

using Requests = std::vector<std::vector<std::uint8_t>>;
using Options = std::map<std::string, std::string>;

inline world::Bench bench_of(const std::string& model, const Options& options = {},
                             const std::string& set = "", const std::string& firmware = "") {
  std::string choices;
  for (const auto& [id, option] : options) choices += (choices.empty() ? "" : ", ") + id + ": " + option;
  return world::parse_bench(
      models::all_models(),
      "understudy: 1\nlines:\n  line:\n    stations:\n      - name: box\n        model: " + model +
          "\n        choices: { " + choices + " }\n" +
          (firmware.empty() ? "" : "        firmware: " + firmware + "\n") +
          (set.empty() ? "" : "        set: { " + set + " }\n"),
      "bench.yaml", ".");
}

/// Adds the checksum.
inline std::vector<std::uint8_t> frame(std::vector<std::uint8_t> bytes) {
  pty::append_rtu_crc(bytes);
  return bytes;
}

/// Makes the contents of a capture of the line while a host sends requests.
class FakeBox : private pty::LineObserver {
 public:
  static Capture captured(const world::Bench& bench, const Requests& requests,
                          SimTime first_at = SimTime{0}) {
    FakeBox box(bench);
    box.executor_.advance(first_at);
    for (const auto& request : requests) {
      box.begins_ = true;
      box.capture_.exchanges.push_back({.at = SimTime{0}, .request = request, .place = ++box.place_});
      box.executor_.exchange(0, request, 256, std::chrono::milliseconds(60));
    }
    return box.capture_;
  }

 private:
  explicit FakeBox(const world::Bench& bench) : executor_(bench, {}) {
    executor_.with_world([&](world::World& world) { world.add_observer(0, *this); });
    capture_.path = "capture";
    capture_.notes.begins_at_power_up = true;
  }
  ~FakeBox() override {
    executor_.with_world([&](world::World& world) { world.remove_observer(0, *this); });
  }
  void on_start_bit(SimTime at) override {
    if (std::exchange(begins_, false)) capture_.exchanges.back().at = at;
  }
  void on_character(const pty::TimedByte&, bool) override {}
  void on_nothing_more() override {}
  void on_transmission(const pty::Transmission& transmission) override {
    Exchange& exchange = capture_.exchanges.back();
    if (!exchange.replied_at) exchange.replied_at = transmission.start;
    exchange.reply.insert(exchange.reply.end(), transmission.bytes.begin(), transmission.bytes.end());
  }
  std::optional<SimTime> due() const override { return std::nullopt; }
  void run(SimTime) override {}

  play::FreeExecutor executor_;
  Capture capture_;
  bool begins_ = false;
  std::size_t place_ = 0;
};

}  // namespace understudy::emulator::box
