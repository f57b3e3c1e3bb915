#include "emulator/play/report/run_logger.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/device/axes.h"
#include "emulator/device/model.h"
#include "emulator/device/terminals.h"
#include "emulator/play/report/run_log.h"
#include "emulator/play/results/result.h"
#include "emulator/world/names/names.h"
#include "emulator/world/plant/plant.h"
#include "emulator/world/protocol/modbus_words.h"
#include "emulator/world/world.h"
#include "pty/capture.h"

namespace understudy::emulator::play {

namespace {

using SignalKind = SeenSignal::Kind;

// This many frames are kept from the beginning of a stretch, and as many from its end.
constexpr std::size_t kFramesKept = 300;
constexpr double kMillivolts = 1000;
// Waits are merged if the picture, which has this many dots, cannot show them separately.
constexpr int kDots = 1000;

/// Merges the waits of a thread that are within one dot.
void thin(Stretch& stretch) {
  const SimTime dot = (stretch.end - stretch.begin) / kDots;
  std::map<std::size_t, std::size_t> last;  // by thread
  std::vector<SeenWait> some;
  for (SeenWait& wait : stretch.waits) {
    wait.longest = wait.end - wait.begin;
    const auto [found, is_first] = last.try_emplace(wait.thread, some.size());
    SeenWait* const before = is_first ? nullptr : &some[found->second];
    if (before == nullptr || wait.end - before->begin > dot) {
      found->second = some.size();
      some.push_back(std::move(wait));
      continue;
    }
    before->end = wait.end;
    ++before->count;
    if (wait.longest <= before->longest) continue;
    before->longest = wait.longest;
    before->text = std::move(wait.text);
  }
  stretch.waits = std::move(some);
}

}  // namespace

RunLogger::RunLogger(world::World& world) : world_(world), probes_(world) {
  for (std::size_t d = 0; d < world.device_count(); ++d) {
    const world::KnownDevice& device = world.known()[d];
    for (std::size_t a = 0; a < device.model->axes.size(); ++a) {
      if (!world.device(d).axes()->has_axis(static_cast<int>(a))) continue;
      const std::string axis = device.name + "." + std::string(device.model->axes[a].name);
      add_signal(axis + ".position", SignalKind::position);
      add_signal(axis + ".pulses", SignalKind::pulses);
      add_signal(axis + ".speed", SignalKind::speed);
      if (world.device(d).axes()->duty_percent(static_cast<int>(a)))
        add_signal(axis + ".pwm", SignalKind::duty);
      for (const char* word : {".home", ".lower_limit", ".upper_limit", ".alarm"}) {
        add_signal(axis + word, SignalKind::bit);
      }
      const world::PlantSetup& machine = world.machine(d, static_cast<int>(a));
      if (machine.near_home) add_signal(axis + ".near_home", SignalKind::bit);
      if (machine.mark) add_signal(axis + ".mark", SignalKind::bit);
    }
    for (const TerminalView& observed : terminal_views(world.device(d))) {
      if (observed.kind == TerminalRow::Kind::dip_switch) continue;
      const bool is_bit = observed.what == TerminalView::What::level && has_two_levels(observed.kind);
      const SignalKind kind = is_in_millivolts(observed.kind) ? SignalKind::voltage
                              : is_bit                        ? SignalKind::bit
                                                              : SignalKind::level;
      add_signal(device.name + "." + observed.name, kind);
    }
    add_signal(device.name + ".power", SignalKind::bit);
  }
  world_.add_watcher(*this);
  world_restored(0);
}

RunLogger::~RunLogger() {
  world_.remove_watcher(*this);
  ignore_lines();
}

void RunLogger::add_signal(const std::string& name, SignalKind kind) {
  signals_.push_back({kind, name, probes_.resolve(name).handle, Envelope()});
}

void RunLogger::watch_lines() {
  requests_.clear();
  for (std::size_t i = 0; i < world_.line_count(); ++i) {
    framers_.push_back(world_.line(i).packets(i, [this](const pty::CapturedPacket& packet) { add(packet); }));
    world_.add_observer(i, *framers_.back());
  }
}

void RunLogger::ignore_lines() {
  for (std::size_t i = 0; i < framers_.size(); ++i) world_.remove_observer(i, *framers_[i]);
  framers_.clear();
}

void RunLogger::world_restored(std::size_t steps) {
  ignore_lines();  // frames that were being received are lost
  end_stretch();
  watch_lines();
  stretch_.first_step = steps;
  stretch_.begin = stretch_.end = world_.now();
  on_tick(tick_at(world_.now()));
}

void RunLogger::on_tick(Tick tick) {
  for (ObservedSignal& observed : signals_) {
    const double value = probes_.value(observed.handle).real();
    observed.values.add(tick, observed.kind == SignalKind::voltage ? value / kMillivolts : value);
  }
  stretch_.end = std::max(stretch_.end, time_of(tick));
}

Tick RunLogger::next_poll(Tick done) const {
  Tick next = kNever;
  for (const ObservedSignal& observed : signals_)
    next = std::min(next, probes_.next_change(observed.handle, done));
  return next;
}

void RunLogger::on_rest(Tick last) {
  for (ObservedSignal& observed : signals_) observed.values.stay(last);
  stretch_.end = std::max(stretch_.end, time_of(last));
}

/// Removes and returns the request to which a reply belongs. A reply without its number, or a line of text,
/// belongs to the last request.
RunLogger::Request RunLogger::taken_request(const pty::CapturedPacket& reply) {
  const auto is_answered = [&](const Request& request) {
    const bool is_named = reply.last_character != 0 && !reply.is_text;
    return request.line == reply.line && (!is_named || request.last_character == reply.last_character);
  };
  const auto found = std::find_if(requests_.rbegin(), requests_.rend(), is_answered);
  if (found == requests_.rend()) return {};
  Request request = std::move(*found);
  requests_.erase(std::next(found).base());
  return request;
}

void RunLogger::add(const pty::CapturedPacket& packet) {
  constexpr std::size_t kMaxUnanswered = 64;
  const bool is_from_host = packet.direction == pty::Direction::from_host;
  const world::WorldLine& line = world_.line(packet.line);
  SeenFrame frame{.time = packet.time,
                  .line = line.line.name(),
                  .is_from_host = is_from_host,
                  .text = {},
                  .bytes = world::hex_text(packet.bytes),
                  .remark = pty::comment_of(packet),
                  .is_struck = !packet.faults.empty()};
  if (!packet.bytes.empty() && is_from_host) {
    frame.text = line.request_text(packet.bytes);
    if (requests_.size() == kMaxUnanswered) requests_.pop_front();
    requests_.push_back({packet.line,
                         packet.last_character,
                         line.device_addressed(packet.bytes),
                         {packet.bytes.begin(), packet.bytes.end()}});
  } else if (!packet.bytes.empty()) {
    const Request request = taken_request(packet);
    const Device* const to = request.bytes.empty() ? line.device_addressed(packet.bytes) : request.to;
    frame.text = line.protocol.reply_text(line.stations, to, request.bytes, packet.bytes);
  }
  stretch_.frames.push_back(std::move(frame));
  // Frames are removed in groups, so that in a long run, they need not be moved for each new frame.
  if (stretch_.frames.size() < 4 * kFramesKept) return;
  const auto first = stretch_.frames.begin() + kFramesKept;
  stretch_.frames.erase(first, stretch_.frames.end() - kFramesKept);
  stretch_.frames_left_out += 2 * kFramesKept;
}

void RunLogger::end_stretch() {
  Stretch stretch = std::exchange(stretch_, {});
  std::vector<ObservedSignal> observed_signals = std::exchange(signals_, {});
  for (const ObservedSignal& observed : observed_signals) {
    SeenSignal signal{.name = observed.name,
                      .kind = observed.kind,
                      .min = observed.values.min(),
                      .max = observed.values.max()};
    for (const Envelope::Point& point : observed.values.points()) {
      signal.points.push_back({point.tick, point.value});
    }
    stretch.signals.push_back(std::move(signal));
    signals_.push_back({observed.kind, observed.name, observed.handle, Envelope()});
  }
  if (stretch.frames.size() > 2 * kFramesKept) {
    const std::size_t more = stretch.frames.size() - 2 * kFramesKept;
    const auto first = stretch.frames.begin() + kFramesKept;
    stretch.frames.erase(first, first + static_cast<std::ptrdiff_t>(more));
    stretch.frames_left_out += more;
  }
  stretch.left_out_at = kFramesKept;
  thin(stretch);
  // Bytes that are not a frame are reported when that is certain, which may be after the next frame.
  std::stable_sort(stretch.frames.begin(), stretch.frames.end(),
                   [](const SeenFrame& a, const SeenFrame& b) { return a.time < b.time; });
  const bool is_empty = stretch.begin == stretch.end && stretch.frames.empty();
  if (!is_empty) run_log_.stretches.push_back(std::move(stretch));
}

void RunLogger::finish(ScenarioResult& result) {
  for (const auto& framer : framers_) framer->finish();
  stretch_.end = std::max(stretch_.end, world_.now());
  end_stretch();
  result.run_log = std::make_shared<const RunLog>(std::move(run_log_));
}

}  // namespace understudy::emulator::play
