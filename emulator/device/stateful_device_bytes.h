// What stateful_device.h declares; it needs the fields of the state. One source of a model includes this.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "base/state/difference.h"
#include "base/state/state_bytes.h"
#include "emulator/device/device.h"
#include "emulator/device/stateful_device.h"

namespace understudy::emulator {

template <typename Itself, typename State>
bool StatefulDevice<Itself, State>::same_state(const Device& other) const {
  const auto* const that = dynamic_cast<const Itself*>(&other);
  return that != nullptr && &that->model() == &this->model() && that->now() == this->now() &&
         that->settled() == itself().settled();
}

template <typename Itself, typename State>
void StatefulDevice<Itself, State>::write_own_state(StateWriter& writer) const {
  writer.write(itself().settled());
}

template <typename Itself, typename State>
std::function<void()> StatefulDevice<Itself, State>::read_own_state(StateReader& reader) {
  const auto restored = std::make_shared<State>();
  reader.read(*restored);
  check_restored(*restored);
  return [this, restored] { state_ = *restored; };
}

template <typename Itself, typename State>
std::string StatefulDevice<Itself, State>::own_difference(StateReader& a, StateReader& b) const {
  return difference_of_saved<State>(a, b);
}

}  // namespace understudy::emulator
