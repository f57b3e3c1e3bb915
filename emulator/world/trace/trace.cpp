#include "emulator/world/trace/trace.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/device/axes.h"
#include "emulator/device/model.h"
#include "emulator/device/terminals.h"
#include "emulator/world/expression/number.h"
#include "emulator/world/names/names.h"
#include "emulator/world/plant/plant.h"
#include "emulator/world/probe/probes.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

namespace {

using SignalKind = TraceSignal::Kind;

void add_axis(const std::string& axis, bool has_duty, const PlantSetup& machine,
              std::vector<TraceSignal>& signals) {
  for (const auto& [word, kind] :
       {std::pair{"pulses", SignalKind::whole}, std::pair{"speed", SignalKind::real},
        std::pair{"position", SignalKind::whole}, std::pair{"home", SignalKind::bit},
        std::pair{"lower_limit", SignalKind::bit}, std::pair{"upper_limit", SignalKind::bit}}) {
    signals.push_back({.name = axis + "." + word, .kind = kind});
  }
  if (machine.near_home) signals.push_back({.name = axis + ".near_home", .kind = SignalKind::bit});
  if (machine.mark) signals.push_back({.name = axis + ".mark", .kind = SignalKind::bit});
  if (has_duty) signals.push_back({.name = axis + ".pwm", .kind = SignalKind::whole});
}

}  // namespace

std::vector<TraceSignal> trace_signals(const World& world, const std::vector<std::string>& also) {
  std::vector<TraceSignal> signals;
  const Probes probes(world);
  const auto kind_of = [&](const std::string& name) {
    return probes.may_be_a_fraction(probes.resolve(name).handle) ? SignalKind::real : SignalKind::whole;
  };
  for (std::size_t d = 0; d < world.device_count(); ++d) {
    const KnownDevice& device = world.known()[d];
    for (std::size_t a = 0; a < device.model->axes.size(); ++a) {
      if (!world.device(d).axes()->has_axis(static_cast<int>(a))) continue;
      add_axis(device.name + "." + std::string(device.model->axes[a].name),
               world.device(d).axes()->duty_percent(static_cast<int>(a)).has_value(),
               world.machine(d, static_cast<int>(a)), signals);
    }
    for (const TerminalView& view : terminal_views(world.device(d))) {
      if (view.kind == TerminalRow::Kind::dip_switch) continue;
      const bool is_bit = view.what == TerminalView::What::level && has_two_levels(view.kind);
      signals.push_back(
          {.name = device.name + "." + view.name, .kind = is_bit ? SignalKind::bit : SignalKind::whole});
    }
    for (const std::string_view word : device.model->state_registers) {
      const std::string name = device.name + "." + std::string(word);
      const bool has_registers = device.model->registers != nullptr;
      signals.push_back({.name = name, .kind = has_registers ? kind_of(name) : SignalKind::real});
    }
    const Axes* const axes = world.device(d).axes();
    if (axes != nullptr && !axes->pulse_formats().empty())
      signals.push_back({.name = device.name + ".pulse_format", .kind = SignalKind::whole});
    signals.push_back({.name = device.name + ".power", .kind = SignalKind::bit});
  }
  for (const std::string& name : also) {
    const bool is_present = std::any_of(signals.begin(), signals.end(),
                                        [&](const TraceSignal& signal) { return signal.name == name; });
    if (!is_present) signals.push_back({.name = name, .kind = kind_of(name)});
  }
  return signals;
}

Trace::Trace(World& world, const std::vector<TraceSignal>& signals, std::unique_ptr<TraceFormat> format)
    : world_(world),
      probes_(world),
      values_(signals.size()),
      is_new_(signals.size()),
      format_(std::move(format)) {
  for (const TraceSignal& signal : signals) handles_.push_back(probes_.resolve(signal.name).handle);
  format_->begin(signals);
  sample(world_.now());
  world_.add_watcher(*this);
}

Trace::~Trace() {
  world_.remove_watcher(*this);
  if (tick_at(world_.now()) > last_row_) format_->end(world_.now(), values_);
}

void Trace::on_tick(Tick tick) { sample(time_of(tick)); }

Tick Trace::next_poll(Tick done) const {
  Tick next = kNever;
  for (const std::int32_t handle : handles_) next = std::min(next, probes_.next_change(handle, done));
  return next;
}

void Trace::sample(SimTime at) {
  bool anything = false;
  for (std::size_t i = 0; i < handles_.size(); ++i) {
    const Number value = probes_.value(handles_[i]);
    is_new_[i] = !has_begun_ || value != values_[i];
    if (!is_new_[i]) continue;
    values_[i] = value;
    anything = true;
  }
  has_begun_ = true;
  if (!anything) return;
  format_->row(at, values_, is_new_);
  last_row_ = tick_at(at);
}

}  // namespace understudy::emulator::world
