// Reads and writes the part of a device's state that all models have: inputs, power and time.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "base/state/difference.h"
#include "base/state/fields.h"
#include "base/state/shared_text.h"
#include "base/state/state_bytes.h"
#include "base/state/state_error.h"
#include "emulator/device/device.h"
#include "emulator/device/model.h"

namespace understudy {

template <>
struct StateOf<emulator::Device> {
  using Value = emulator::Device;
  static constexpr auto fields =
      FieldList{field<&Value::inputs_>(), field<&Value::powered_>(), field<&Value::now_>()};
  static constexpr std::size_t members = 10;
  /// These members are not part of the state: the device is created from its model, settings and choices; the
  /// log and the list of mentioned items belong to the user; coverage reads the decisions; and the flag for
  /// changed inputs only saves work.
  static constexpr std::size_t apart = 7;
  static void name_all(Value& all) {  // does not compile if the members change
    [[maybe_unused]] auto& [model, now, powered, inputs_changed, choices, decisions, inputs, settings, log,
                            mentioned] = all;
  }
};

}  // namespace understudy

namespace understudy::emulator {

namespace {

using Common = CopiedFields<Device>;

/// Reads the state that all models have, and checks that it belongs to a device of this model.
void read_common(const Model& model, StateReader& reader, Common& common) {
  std::apply([&](auto&... field) { (reader.read(field), ...); }, common);
  const auto& inputs = std::get<std::vector<std::int32_t>>(common);
  require_state(inputs.size() == model.terminals.size(), "its terminals are different");
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (model.terminals[i].kind == TerminalRow::Kind::counted_in) continue;  // the count wraps
    require_within(inputs[i], model.terminals[i].lowest, model.terminals[i].highest);
  }
  require_within(std::get<Tick>(common), 0, tick_at(kHorizon));
}

}  // namespace

namespace {
constexpr std::size_t kExpectedBytes = 32 * 1024;
}

std::vector<std::byte> Device::save_state() const {
  StateWriter writer(kExpectedBytes);
  writer.write(*this);
  write_own_state(writer);
  return writer.take();
}

std::vector<std::byte> Device::save_state(std::vector<SharedText>& shared) const {
  StateWriter writer(kExpectedBytes, &shared);
  writer.write(*this);
  write_own_state(writer);
  return writer.take();
}

std::function<void()> Device::read_state(std::span<const std::byte> bytes) {
  return read_state(StateReader(bytes));
}

std::function<void()> Device::read_state(StateReader reader) {
  Common restored = copy_fields(*this);
  read_common(model_, reader, restored);
  auto put_own = read_own_state(reader);
  reader.require_end();
  return [this, restored = std::move(restored), put_own = std::move(put_own)] {
    assign_fields(*this, restored);
    inputs_changed_ = true;
    put_own();
  };
}

std::uint64_t Device::state_hash() const {
  SharedTexts shared;  // the bytes contain only the digests
  return hash_of(save_state(shared));
}

bool Device::same_state(const Device& other) const {
  std::vector<SharedText> shared;
  return &model_ == &other.model_ && save_state(shared) == other.save_state(shared);
}

std::string Device::state_difference(std::span<const std::byte> a, std::span<const std::byte> b) const {
  return state_difference(StateReader(a), StateReader(b));
}

std::string Device::state_difference(StateReader a, StateReader b) const {
  Common common_a = copy_fields(*this);
  Common common_b = common_a;
  read_common(model_, a, common_a);
  read_common(model_, b, common_b);
  const std::string own = own_difference(a, b);
  a.require_end();
  b.require_end();
  const std::string common = difference_of_copies<Device>(common_a, common_b, "");
  return common.empty() ? own : common;
}

}  // namespace understudy::emulator
