#include "emulator/device/device.h"
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/choices.h"
#include "base/prefetch.h"
#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "base/text/suggestion.h"
#include "emulator/device/model.h"
#include "emulator/device/named_values.h"
#include "emulator/device/program_error.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/user_program.h"
#include "pty/line_settings.h"

namespace understudy::emulator {

Device::Device(const Model& model, DeviceSettings settings)
    : model_(model),
      choices_(resolve_choices(model.choices, settings.choices)),
      decisions_(model.choices.size(), model.transitions),
      inputs_(model.terminals.size(), 0),
      settings_(std::move(settings)) {}

Tick Device::next_event_tick(Tick done, Tick /*limit*/, const ClearTravel& /*ahead*/) const {
  return next_active_tick(done);
}

void Device::fast_forward_to(Tick /*done*/, Tick /*tick*/, const ClearTravel& /*ahead*/,
                             std::span<std::int64_t> /*pulses*/) {}

pty::LineSettings Device::line_settings(std::size_t port) const {
  const PortRow& row = model_.line.ports[port];
  const int chosen = port < settings_.bauds.size() ? settings_.bauds[port] : 0;
  pty::LineSettings line = row.settings;
  line.baud = chosen != 0 ? chosen : row.bauds.front();
  return line;
}

std::optional<int> Device::station_number() const {
  const auto& numbers = model_.line.station_numbers;
  if (!numbers) return std::nullopt;
  if (numbers->kept_in.empty()) return settings_.address.value_or(1);
  const RegisterBank& bank = *register_bank();
  return static_cast<int>(read_value(bank, bank.find(numbers->kept_in).value()));
}

void Device::sample_inputs(Tick /*tick*/) {}
void Device::run_interpreters(Tick /*tick*/) {}
void Device::step_motion(Tick /*tick*/) {}
void Device::update_outputs(Tick /*tick*/) {}
Tick Device::next_active_tick(Tick /*done*/) const { return kNever; }

void Device::prefetch(Tick /*tick*/) const {
  // This prefetches only the first line of the device itself, because its settings are large and no tick
  // reads them.
  prefetch_line(this);
  if (inputs_changed_) understudy::prefetch(inputs_.data(), inputs_.size() * sizeof inputs_[0]);
}

void Device::switch_power(bool on) {
  if (on == powered_) return;
  powered_ = on;
  inputs_changed_ = true;
  if (on) {
    power_up();
  } else {
    power_down();
  }
}

void Device::warn_not_implemented(std::string_view what, std::string_view why) const {
  if (!log_ || mentioned_.contains(what)) return;
  mentioned_.emplace(what);
  log_(name() + ": " + std::string(what) + " is not modelled: " + std::string(why));
}

void load_program(Device& device, std::string_view text) {
  UserProgram* const program = device.user_program();
  if (program == nullptr) throw ProgramError(std::vector{no_program(device.model())});
  program->load_program(text);
}

std::string why_no_value(const Device& device, std::string_view name) {
  const NamedValues* const values = device.named_values();
  const std::vector<std::string> names = values != nullptr ? values->names() : std::vector<std::string>();
  return device.name() + " has no value called " + quoted(name) + suggestion(name, names);
}

}  // namespace understudy::emulator
