// The part of a device's state that every model has: its power, its inputs, its time.
#include <tuple>
#include <utility>

#include "base/state/state_bytes.h"
#include "emulator/device/device.h"

namespace understudy::emulator {

struct Device::CommonFields {
  /// Model, settings and choices are what it was made from; the log is its user's.
  static auto of(Like<Device> auto& device, auto visit) {
    auto& [model, now, powered, inputs_changed, choices, inputs, settings, log, mentioned] = device;
    return visit(inputs, powered, now);
  }
};

std::vector<std::byte> Device::save_state() const {
  constexpr std::size_t kExpectedBytes = 32 * 1024;
  StateWriter writer(kExpectedBytes);
  CommonFields::of(*this, [&](const auto&... field) { (writer.write<CommonFields>(field), ...); });
  write_own_state(writer);
  return writer.take();
}

std::function<void()> Device::read_state(std::span<const std::byte> bytes) {
  StateReader reader(bytes);
  auto restored = CommonFields::of(*this, [](const auto&... field) { return std::tuple(field...); });
  std::apply([&](auto&... field) { (reader.read<CommonFields>(field), ...); }, restored);
  const auto& inputs = std::get<std::vector<std::int32_t>>(restored);
  demand_state(inputs.size() == model_.terminals.size(), "its terminals are different");
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    demand_within(inputs[i], model_.terminals[i].lowest, model_.terminals[i].highest);
  }
  demand_within(std::get<Tick>(restored), 0, tick_at(kHorizon));
  auto put_own = read_own_state(reader);
  reader.demand_end();
  return [this, restored = std::move(restored), put_own = std::move(put_own)] {
    CommonFields::of(*this, [&](auto&... field) { std::tie(field...) = restored; });
    inputs_changed_ = true;
    put_own();
  };
}

std::uint64_t Device::state_hash() const { return hash_of(save_state()); }

}  // namespace understudy::emulator
