#include "emulator/world/recording/recorder.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/access.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/recording/recording.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/snapshot_file.h"
#include "pty/line_observer.h"
#include "pty/line_settings.h"
#include "pty/station.h"

namespace understudy::emulator::world {

using What = RecordedEvent::What;

namespace {

/// Writes the header, and returns the function that writes the events.
std::function<void(RecordedEvent)> lines_for(const World& world, const RecordingHeader& header,
                                             std::function<void(std::string_view)> take) {
  take(to_line(header) + "\n");
  return [&world, take = std::move(take)](const RecordedEvent& event) {
    take(to_line(event, world.known()) + "\n");
  };
}

}  // namespace

/// Records the events of one line.
class Recorder::LineRecorder final : public pty::LineObserver {
 public:
  LineRecorder(Recorder& recorder, std::size_t number) : recorder_(recorder), number_(number) {
    recorder_.world_.add_observer(number_, *this);
    // A snapshot of a new world does not contain the settings that a host made before the recording began.
    if (const auto& set = recorder_.world_.line(number_).line.settings_of_host()) on_host_settings(set);
  }
  ~LineRecorder() override { recorder_.world_.remove_observer(number_, *this); }
  LineRecorder(const LineRecorder&) = delete;
  LineRecorder& operator=(const LineRecorder&) = delete;

  void on_start_bit(SimTime) override {}
  void on_character(const pty::TimedByte&, bool) override {}
  void on_nothing_more() override { note(What::nothing_more); }
  void on_receive(std::span<const std::uint8_t> bytes, bool is_departed) override {
    if (!bytes.empty()) note(is_departed ? What::departed : What::bytes, bytes);
  }
  void on_host_opened() override {
    settings_.reset();
    are_settings_known_ = false;
    note(What::opened);
  }
  void on_host_closed() override { note(What::closed); }
  void on_host_purged() override { note(What::purged); }
  void on_host_settings(const std::optional<pty::HostSettings>& settings) override {
    // The settings are reported again with each group of bytes.
    if (are_settings_known_ && settings == settings_) return;
    are_settings_known_ = true;
    settings_ = settings;
    RecordedEvent event{.what = What::settings, .where = number_};
    event.host = settings;
    recorder_.take(std::move(event));
  }
  void on_transmission(const pty::Transmission& transmission) override {
    note(What::sent, transmission.bytes);
  }
  std::optional<SimTime> due() const override { return std::nullopt; }
  void run(SimTime) override {}

 private:
  void note(What what, std::span<const std::uint8_t> bytes = {}) {
    RecordedEvent event{.what = what, .where = number_};
    event.bytes.assign(bytes.begin(), bytes.end());
    recorder_.take(std::move(event));
  }

  Recorder& recorder_;
  std::size_t number_;
  std::optional<pty::HostSettings> settings_;
  bool are_settings_known_ = false;
};

Recorder::Recorder(World& world, const RecordingHeader& header, std::function<void(std::string_view)> take)
    : Recorder(world, lines_for(world, header, std::move(take))) {}

Recorder::Recorder(World& world, std::function<void(RecordedEvent)> take)
    : world_(world), take_(std::move(take)) {
  for (std::size_t i = 0; i < world.line_count(); ++i)
    line_recorders_.push_back(std::make_unique<LineRecorder>(*this, i));
  world_.add_listener(*this);
}

Recorder::~Recorder() {
  end_with({}, {});
  world_.remove_listener(*this);
}

void Recorder::finish(RecordedFailure failed) {
  if (!is_finished_) end_with(to_text(save(world_), kBenchOfRecording), std::move(failed));
}

void Recorder::end_with(std::string state, RecordedFailure failed) {
  if (is_finished_) return;
  take({.what = What::end, .text = std::move(state), .failed = std::move(failed)});
  is_finished_ = true;
}

void Recorder::take(RecordedEvent event) {
  if (is_finished_) return;
  event.at = world_.now();
  take_(std::move(event));
}

void Recorder::on_input(std::size_t device, int terminal, std::int32_t level) {
  take({.what = What::input, .where = device, .place = terminal, .value = level});
}

void Recorder::on_power(std::size_t device, bool on) {
  take({.what = What::power, .where = device, .value = on ? 1 : 0});
}

void Recorder::on_inject(const Fault& fault) { take({.what = What::inject, .fault = fault}); }

void Recorder::on_clear_fault(std::size_t number) {
  take({.what = What::clear, .value = static_cast<std::int64_t>(number)});
}

void Recorder::on_write(std::size_t device, const PreparedWrite& write) {
  take({.what = What::write, .where = device, .write = write});
}

void Recorder::on_assign(std::size_t device, std::string_view name, double value) {
  take({.what = What::assign, .where = device, .text = std::string(name), .real = value});
}

void Recorder::on_program(std::size_t device, std::string_view text, bool is_refused) {
  take({.what = What::program, .where = device, .value = is_refused ? 1 : 0, .text = std::string(text)});
}

void Recorder::on_command(std::size_t device, std::string_view text) {
  take({.what = What::command, .where = device, .text = std::string(text)});
}

}  // namespace understudy::emulator::world
