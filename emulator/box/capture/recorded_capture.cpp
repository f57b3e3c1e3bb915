#include "emulator/box/capture/recorded_capture.h"

#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <utility>

#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/box/capture/capture.h"
#include "emulator/box/capture/exchange_builder.h"
#include "emulator/device/model.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/names/names.h"
#include "emulator/world/recording/recording.h"
#include "emulator/world/world.h"

namespace understudy::emulator::box {

namespace {

using What = world::RecordedEvent::What;

/// Returns what an event does to a device, bypassing its line; empty: nothing.
const char* deed_of(What what) {
  switch (what) {
    case What::power: return "power";
    case What::inject: return "a fault";
    case What::clear: return "the end of a fault";
    case What::write:
    case What::assign: return "a value that was set";
    case What::program: return "a program";
    case What::command: return "a command";
    case What::opened:
    case What::closed:
    case What::settings:
    case What::bytes:
    case What::departed:
    case What::purged:
    case What::nothing_more:
    case What::sent:
    case What::input:
    case What::wait:
    case What::end: break;
  }
  return "";
}

class Recording {
 public:
  Recording(ModelList models, std::istream& file, const std::string& path, const CaptureSettings& settings,
            const world::Bench& bench)
      : models_(models), file_(file), path_(path), settings_(settings), world_(bench, {}, {}) {}

  Capture read() {
    capture_.path = path_;
    capture_.notes.format = "a recording";
    read_header();
    const ExchangeSink sink = [this](Exchange exchange) {
      exchange.follows_loss = exchange.follows_loss || (beyond_at_ && exchange.at >= *beyond_at_);
      capture_.exchanges.push_back(std::move(exchange));
    };
    ExchangeBuilder builder(path_, settings_, capture_.notes, sink);
    const world::World recorded(recorded_, {}, {});
    while (next_line() && !file_.eof()) {
      try {
        take(world::parse_event(line_, recorded.known(), recorded.line_count()), recorded, builder);
      } catch (const world::RecordingError& error) {
        throw refuse(error.what());
      }
    }
    builder.finish();
    capture_.line = capture_.notes.line;
    return std::move(capture_);
  }

 private:
  CaptureReadError refuse(const std::string& what) const {
    return CaptureReadError(path_ + ":" + std::to_string(number_) + ": " + what);
  }

  bool next_line() {
    ++number_;
    return static_cast<bool>(std::getline(file_, line_));
  }

  void read_header() {
    if (!next_line()) throw refuse("recording: is empty; expected a header");
    try {
      const world::RecordingHeader header = world::parse_header(line_);
      recorded_ = world::parse_recorded_bench(models_, header.bench);
      is_whole_ = header.snapshot.empty();
    } catch (const world::RecordingError& error) {
      throw refuse(error.what());
    } catch (const world::BenchError& error) {
      throw refuse("bench: " + error.diagnostics().front().text);
    }
    capture_.notes.begins_at_power_up = capture_.notes.knows_beginning = is_whole_;
    if (settings_.line.empty() || recorded_.lines.size() == 1) return;
    std::string names;
    for (const world::LineSetup& line : recorded_.lines) {
      if (line.name == settings_.line) return;
      names += (names.empty() ? "" : ", ") + line.name;
    }
    throw refuse("has no line called " + quoted(settings_.line) + "; expected --line with one of " + names);
  }

  void take(const world::RecordedEvent& event, const world::World& recorded, ExchangeBuilder& builder) {
    if (event.what == What::input) return take_input(event, recorded);
    if (const std::string deed = deed_of(event.what); !deed.empty() && !beyond_at_) {
      beyond_at_ = event.at;
      capture_.notes.beyond_the_line = deed + " at " + format_duration(event.at);
    }
    const bool is_of_station = event.what == What::sent;
    if (!is_of_station && event.what != What::bytes && event.what != What::departed) return;
    const std::string& name = recorded.line_name(event.where);
    if (!settings_.line.empty() && recorded_.lines.size() > 1 && name != settings_.line) return;
    builder.add({.at = event.at,
                 .side = is_of_station ? Side::station : Side::host,
                 .line = name,
                 .bytes = event.bytes,
                 .place = number_,
                 .counts_from_power_up = is_whole_ && recorded_.lines.size() > 1});
  }

  void take_input(const world::RecordedEvent& event, const world::World& recorded) {
    const world::KnownDevice& device = recorded.known()[event.where];
    const std::string name =
        device.name + "." + std::string(device.model->terminals[static_cast<std::size_t>(event.place)].name);
    try {
      const world::InputName input = world::find_input(world_.known(), name);
      capture_.inputs.push_back({.at = event.at,
                                 .device = input.device,
                                 .terminal = input.terminal,
                                 .level = static_cast<std::int32_t>(event.value)});
    } catch (const world::NameError& error) {
      throw refuse("the bench has no input " + quoted(name) + "; expected one with the recorded devices");
    }
  }

  ModelList models_;
  std::istream& file_;
  const std::string& path_;
  const CaptureSettings& settings_;
  const world::World world_;  // of the bench that is compared
  world::Bench recorded_;
  bool is_whole_ = true;  // from power-up
  std::string line_;
  std::size_t number_ = 0;
  std::optional<SimTime> beyond_at_;  // when something first changed a device in another way
  Capture capture_;
};

}  // namespace

Capture read_recorded_capture(ModelList models, std::istream& file, const std::string& path,
                              const CaptureSettings& settings, const world::Bench& bench) {
  return Recording(models, file, path, settings, bench).read();
}

}  // namespace understudy::emulator::box
