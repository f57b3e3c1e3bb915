#include "emulator/play/report/camera.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/device/axes.h"
#include "emulator/device/model.h"
#include "emulator/device/terminals.h"
#include "emulator/play/report/footage.h"
#include "emulator/play/results/result.h"
#include "emulator/world/names/names.h"
#include "emulator/world/plant/plant.h"
#include "emulator/world/speech/modbus_words.h"
#include "emulator/world/world.h"
#include "pty/capture.h"

namespace understudy::emulator::play {

namespace {

using SignalKind = SeenSignal::Kind;

// A scene keeps this many frames from its beginning, and as many from its end.
constexpr std::size_t kFramesKept = 300;
constexpr double kMillivolts = 1000;

}  // namespace

Camera::Camera(world::World& world) : world_(world), probes_(world) {
  for (std::size_t d = 0; d < world.device_count(); ++d) {
    const world::KnownDevice& device = world.known()[d];
    for (std::size_t a = 0; a < device.model->axes.size(); ++a) {
      if (!world.device(d).axes()->has_axis(static_cast<int>(a))) continue;
      const std::string axis = device.name + "." + std::string(device.model->axes[a].name);
      add_sight(axis + ".position", SignalKind::position);
      add_sight(axis + ".pulses", SignalKind::pulses);
      add_sight(axis + ".speed", SignalKind::speed);
      if (world.device(d).axes()->duty_percent(static_cast<int>(a)))
        add_sight(axis + ".pwm", SignalKind::duty);
      for (const char* word : {".home", ".lower_limit", ".upper_limit", ".alarm"}) {
        add_sight(axis + word, SignalKind::bit);
      }
      const world::PlantSetup& machine = world.machine(d, static_cast<int>(a));
      if (machine.near_home) add_sight(axis + ".near_home", SignalKind::bit);
      if (machine.mark) add_sight(axis + ".mark", SignalKind::bit);
    }
    for (const TerminalSight& sight : terminal_sights(world.device(d))) {
      if (sight.kind == TerminalRow::Kind::dip_switch) continue;
      const bool is_bit = sight.what == TerminalSight::What::level && has_two_levels(sight.kind);
      const SignalKind kind = is_in_millivolts(sight.kind) ? SignalKind::voltage
                              : is_bit                     ? SignalKind::bit
                                                           : SignalKind::level;
      add_sight(device.name + "." + sight.name, kind);
    }
    add_sight(device.name + ".power", SignalKind::bit);
  }
  world_.add_watcher(*this);
  world_restored(0);
}

Camera::~Camera() {
  world_.remove_watcher(*this);
  ignore_lines();
}

void Camera::add_sight(const std::string& name, SignalKind kind) {
  sights_.push_back({kind, name, probes_.resolve(name).handle, Envelope()});
}

void Camera::watch_lines() {
  requests_.assign(world_.line_count(), {});
  for (std::size_t i = 0; i < world_.line_count(); ++i) {
    framers_.push_back(world_.line(i).packets(i, [this](const pty::CapturedPacket& packet) { add(packet); }));
    world_.add_observer(i, *framers_.back());
  }
}

void Camera::ignore_lines() {
  for (std::size_t i = 0; i < framers_.size(); ++i) world_.remove_observer(i, *framers_[i]);
  framers_.clear();
}

void Camera::world_restored(std::size_t steps) {
  ignore_lines();  // what they were hearing is gone
  end_scene();
  watch_lines();
  scene_.first_step = steps;
  scene_.begin = scene_.end = world_.now();
  on_tick(tick_at(world_.now()));
}

void Camera::on_tick(Tick tick) {
  for (Sight& sight : sights_) {
    const double value = probes_.value(sight.handle).real();
    sight.values.add(tick, sight.kind == SignalKind::voltage ? value / kMillivolts : value);
  }
  scene_.end = std::max(scene_.end, time_of(tick));
}

Tick Camera::next_look(Tick done) const {
  Tick next = kNever;
  for (const Sight& sight : sights_) next = std::min(next, probes_.next_change(sight.handle, done));
  return next;
}

void Camera::on_rest(Tick last) {
  for (Sight& sight : sights_) sight.values.stay(last);
  scene_.end = std::max(scene_.end, time_of(last));
}

void Camera::add(const pty::CapturedPacket& packet) {
  const bool is_from_host = packet.way == pty::Way::from_host;
  const bool is_frame = !packet.bytes.empty();
  const world::WorldLine& line = world_.line(packet.line);
  auto& request = requests_[packet.line];
  SeenFrame frame{.time = packet.time,
                  .line = line.line.name(),
                  .is_from_host = is_from_host,
                  .text = !is_frame      ? std::string()
                          : is_from_host ? line.request_text(packet.bytes)
                                         : line.reply_text(request, packet.bytes),
                  .bytes = world::hex_text(packet.bytes),
                  .remark = pty::comment_of(packet),
                  .is_struck = !packet.faults.empty()};
  if (is_frame && is_from_host) {
    request.assign(packet.bytes.begin(), packet.bytes.end());
  } else if (is_frame) {
    request.clear();
  }
  scene_.frames.push_back(std::move(frame));
  // In lumps, so that a long run does not move them for each one that comes.
  if (scene_.frames.size() < 4 * kFramesKept) return;
  const auto first = scene_.frames.begin() + kFramesKept;
  scene_.frames.erase(first, scene_.frames.end() - kFramesKept);
  scene_.frames_left_out += 2 * kFramesKept;
}

void Camera::end_scene() {
  Scene scene = std::exchange(scene_, {});
  std::vector<Sight> sights = std::exchange(sights_, {});
  for (const Sight& sight : sights) {
    SeenSignal signal{.name = sight.name,
                      .kind = sight.kind,
                      .least = sight.values.least(),
                      .greatest = sight.values.greatest()};
    for (const Envelope::Point& point : sight.values.points()) {
      signal.points.push_back({point.tick, point.value});
    }
    scene.signals.push_back(std::move(signal));
    sights_.push_back({sight.kind, sight.name, sight.handle, Envelope()});
  }
  if (scene.frames.size() > 2 * kFramesKept) {
    const std::size_t more = scene.frames.size() - 2 * kFramesKept;
    const auto first = scene.frames.begin() + kFramesKept;
    scene.frames.erase(first, first + static_cast<std::ptrdiff_t>(more));
    scene.frames_left_out += more;
  }
  scene.left_out_at = kFramesKept;
  // What was not a frame is given once that is plain, which may be after the next one.
  std::stable_sort(scene.frames.begin(), scene.frames.end(),
                   [](const SeenFrame& a, const SeenFrame& b) { return a.time < b.time; });
  const bool is_empty = scene.begin == scene.end && scene.frames.empty();
  if (!is_empty) footage_.scenes.push_back(std::move(scene));
}

void Camera::finish(ScenarioResult& result) {
  for (const auto& framer : framers_) framer->finish();
  scene_.end = std::max(scene_.end, world_.now());
  end_scene();
  result.footage = std::make_shared<const Footage>(std::move(footage_));
}

}  // namespace understudy::emulator::play
