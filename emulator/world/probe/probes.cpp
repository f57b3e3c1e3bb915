#include "emulator/world/probe/probes.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/simulated_time.h"
#include "emulator/device/axes.h"
#include "emulator/device/device.h"
#include "emulator/device/named_values.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/row.h"
#include "emulator/device/terminals.h"
#include "emulator/world/expression/expression.h"
#include "emulator/world/expression/number.h"
#include "emulator/world/names/names.h"
#include "emulator/world/plant/plant.h"
#include "emulator/world/probe/peaks.h"
#include "emulator/world/probe/probe_names.h"
#include "emulator/world/stations/line_station.h"

namespace understudy::emulator::world {

namespace {

std::int64_t output_value(const Device& device, const ProbeNames::Probe& probe) {
  if (probe.unit == Unit::millivolts) return device.terminals()->analog_level(probe.place);
  return device.terminals()->output(probe.place) ? 1 : 0;
}

}  // namespace

std::optional<std::size_t> Probes::device_read(std::int32_t handle) const {
  const Probe& probe = names_.probe(handle);
  if (probe.what != What::reg && probe.what != What::named) return std::nullopt;
  return probe.device;
}

Tick Probes::next_change(std::int32_t handle, Tick done) const {
  const Probe& probe = names_.probe(handle);
  if (probe.what == What::time) return done + 1;
  if (probe.what != What::reg && probe.what != What::named) return kNever;
  const Device& device = view_.device(probe.device);
  if (!device.powered()) return kNever;
  return probe.what == What::reg ? understudy::emulator::next_change(*device.register_bank(), probe.reg, done)
                                 : device.named_values()->next_change(probe.value_name, done);
}

Tick Probes::next_change(const Expression& condition, Tick done) const {
  Tick next = kNever;
  for (const Expression::Name& name : condition.names)
    next = std::min(next, next_change(name.number.handle, done));
  return next;
}

bool Probes::may_be_a_fraction(std::int32_t handle) const {
  const Probe& probe = names_.probe(handle);
  switch (probe.what) {
    case What::reg: return probe.reg.is_real();
    case What::named: return !value(handle).is_whole();
    case What::speed:
    case What::greatest_speed:
    case What::greatest_acceleration: return true;
    default: return false;
  }
}

std::uint64_t Probes::count_of_stations(std::size_t device, std::uint64_t StationCounters::*counter) const {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < view_.line_count(); ++i) {
    for (const auto& station : view_.line(i).stations) {
      if (&station->device() == &view_.device(device)) sum += station->counters().*counter;
    }
  }
  return sum;
}

double Probes::peak_value(const Probe& probe) const {
  if (peaks_ == nullptr) throw NameError(probe.name + " exists only in scenarios");
  const Peaks::Peak& peak = peaks_->peak(probe.device, probe.place);
  return probe.what == What::greatest_speed ? peak.greatest_pps : peak.greatest_pps2;
}

Number Probes::value(std::int32_t handle) const {
  const Probe& probe = names_.probe(handle);
  const auto count = [](std::uint64_t number) { return Number(static_cast<std::int64_t>(number)); };
  switch (probe.what) {
    case What::time: return view_.now().count();
    case What::bytes_in: return count(view_.line(probe.device).line.counters().bytes_in);
    case What::bytes_out: return count(view_.line(probe.device).line.counters().bytes_out);
    case What::collisions: return count(view_.line(probe.device).line.counters().collisions);
    default: break;
  }
  const Device& device = view_.device(probe.device);
  switch (probe.what) {
    case What::reg: {
      if (!device.powered()) return 0;
      const Value value = read_value(*device.register_bank(), probe.reg);
      return probe.reg.is_real() ? finite_number(number_of(probe.reg, value)) : Number(value);
    }
    case What::named:
      return device.powered()
                 ? finite_number(device.named_values()->value_named(probe.value_name).value_or(0))
                 : Number(0);
    case What::input: return device.input(probe.place);
    case What::output: return output_value(device, probe);
    case What::output_pulses: return device.terminals()->output_pulses(probe.place);
    case What::terminal_group: return value_of(device, *probe.group);
    case What::power: return device.powered() ? 1 : 0;
    case What::pulse_format: return static_cast<std::int64_t>(device.axes()->pulse_format_number());
    case What::pulses: return view_.sent_pulses(probe.device, probe.place);
    case What::target:
      return view_.sent_pulses(probe.device, probe.place) + device.axes()->pulses_to_come(probe.place);
    case What::speed: return device.axes()->speed_pps(probe.place);
    case What::servo: return device.axes()->servo_on(probe.place).value_or(false) ? 1 : 0;
    case What::pwm: return device.axes()->duty_percent(probe.place).value_or(0);
    case What::greatest_speed:
    case What::greatest_acceleration: return peak_value(probe);
    case What::requests: return count(count_of_stations(probe.device, &StationCounters::requests));
    case What::replies: return count(count_of_stations(probe.device, &StationCounters::replies));
    case What::exceptions: return count(count_of_stations(probe.device, &StationCounters::exceptions));
    default: break;
  }
  const PlantAxis& plant = view_.plant(probe.device, probe.place);
  switch (probe.what) {
    case What::position: return plant.position_pulses();
    case What::lost: return plant.lost_pulses();
    case What::encoder: return plant.encoder_counts();
    case What::home: return plant.at_home() ? 1 : 0;
    case What::upper_limit: return plant.at_upper_limit() ? 1 : 0;
    case What::lower_limit: return plant.at_lower_limit() ? 1 : 0;
    case What::near_home: return plant.at_near_home() ? 1 : 0;
    case What::mark: return plant.at_mark() ? 1 : 0;
    case What::index: return plant.at_index() ? 1 : 0;
    case What::ready: return plant.ready() ? 1 : 0;
    case What::alarm: return plant.in_alarm() ? 1 : 0;
    default: return 0;
  }
}

}  // namespace understudy::emulator::world
