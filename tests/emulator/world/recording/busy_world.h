// A world in which everything happens, and its recording.
#pragma once

#include <memory>
#include <random>
#include <string>

#include "base/version.h"
#include "emulator/models/models.h"
#include "emulator/world/bench/bench_text.h"
#include "emulator/world/recording/recorder.h"
#include "emulator/world/snapshot_file.h"
#include "tests/emulator/world/two_devices.h"

namespace understudy::emulator::world {

class BusyWorld {
 public:
  explicit BusyWorld(std::uint64_t seed, const std::string& timing = "wire")
      : random_(seed),
        bench_(parse_bench(models::all_models(), two_devices(timing, 19200), "two.yaml", ".")),
        world_(bench_, {}, {}),
        header_{.version = std::string(program_version()),
                .bench = to_text(bench_),
                .options = {},
                .seed = seed,
                .snapshot = {}} {
    begin();
  }

  /// Hosts connect, write valid and invalid frames, whole or in pieces, and disconnect; inputs, power,
  /// faults, registers and programs change; time advances in irregular steps.
  void play(int events) {
    for (int i = 0; i < events; ++i) {
      world_.advance_to(world_.now() + SimTime{below(20) == 0 ? below(3'000'000'000) : below(30'000'000)});
      act();
    }
    world_.advance_to(world_.now() + std::chrono::seconds(1));
  }

  /// Discards what was recorded, and begins a new recording from a snapshot.
  void begin_again() {
    header_.snapshot = to_text(save(world_), bench_hash(bench_));
    recorder_.reset();
    text_.clear();
    begin();
  }

  World& world() { return world_; }
  /// Ends the recording and returns it.
  std::string finish() {
    recorder_->finish();
    return text_;
  }
  const std::string& text() const { return text_; }

 private:
  void begin() {
    recorder_ = std::make_unique<Recorder>(world_, header_, [this](std::string_view line) { text_ += line; });
  }

  std::int64_t below(std::int64_t count) {
    return static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(count));
  }

  Bytes frame() {
    const int station = static_cast<int>(below(4));
    switch (below(6)) {
      case 0: return write_request(station, 0x1014, 1);  // Aaxis_SVON
      case 1: return write_request(station, 0x1005, 1);  // Aaxis_Move_INC
      case 2: return read_request(station, 0x0E04, 2);   // Cord_A
      case 3:
        return write_request(station, 0x2000 + static_cast<int>(below(80)), static_cast<int>(below(500)));
      case 4: return read_request(station, 0, static_cast<int>(below(6)));
      default:
        return framed({0x01, 0x10, 0x10, 0x00, 0x00, 0x05, 0x0A, 0x01, 0x00, 0x00, 0x00, 0x00, 0xC8, 0x00,
                       0x05, 0x00, 0x05});
    }
  }

  void act() {
    const pty::Line& line = world_.line(0).line;
    switch (below(14)) {
      case 0: world_.host_closed(0); break;
      case 1:
        world_.host_opened(0);
        world_.host_settings(0, pty::HostSettings{.baud = below(4) == 0 ? 9600 : 19200, .stop_bits = 1});
        break;
      case 2: set_input(world_, below(2) == 0 ? "feeder.DIN_2" : "turner.DIN_10", below(2) == 0); break;
      case 3:
        world_.set_external_input(0, find_terminal(*world_.known()[0].model, "AIN_A"),
                                  static_cast<int>(below(10'000)));
        break;
      case 4: world_.switch_power(static_cast<std::size_t>(below(2)), below(3) != 0); break;
      case 5:
        world_.inject(find_fault(world_.known(),
                                 {"lost_steps", "feeder.A", {{"one_in", std::to_string(3 + below(5))}}}));
        break;
      case 6: world_.clear_fault(static_cast<std::size_t>(1 + below(3))); break;
      case 7: {
        PreparedWrite write{.table = Table::holding,
                            .first = 0x1002,
                            .words = {static_cast<std::uint16_t>(below(900)), 0},
                            .count = 1};
        world_.write(0, write);
        break;
      }
      case 8:
        world_.load_program(0, "again: Out DOUT_4 ON\n Delay_mSec 7\n VAR_Inc MEM1\n Jump again\n");
        break;
      case 9: world_.write(0, {.table = Table::holding, .first = 0x3000, .words = {0, 0}, .count = 1}); break;
      case 10: world_.nothing_more(0); break;
      default: {
        Bytes bytes = frame();
        if (below(8) == 0)
          bytes.resize(static_cast<std::size_t>(below(static_cast<std::int64_t>(bytes.size()))));
        if (below(8) == 0)
          world_.receive_departed(0, bytes);
        else
          world_.receive(0, bytes);
      }
    }
    world_.take_output(0, line.output().size());
  }

  std::mt19937_64 random_;
  Bench bench_;
  World world_;
  std::string text_;
  RecordingHeader header_;
  std::unique_ptr<Recorder> recorder_;
};

}  // namespace understudy::emulator::world
