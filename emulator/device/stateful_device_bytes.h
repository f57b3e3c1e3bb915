// Defines the members that stateful_device.h declares, for which it needs the fields of the state. One source
// file of each model includes it.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "base/state/difference.h"
#include "base/state/state_bytes.h"
#include "emulator/device/stateful_device.h"

namespace understudy::emulator {

template <typename Itself, typename State>
void StatefulDevice<Itself, State>::write_own_state(StateWriter& writer) const {
  writer.write(static_cast<const Itself&>(*this).settled());
}

template <typename Itself, typename State>
std::function<void()> StatefulDevice<Itself, State>::read_own_state(StateReader& reader) {
  const auto restored = std::make_shared<State>();
  reader.read(*restored);
  check_restored(*restored);
  return [this, restored] { take_over(*restored); };
}

template <typename Itself, typename State>
std::string StatefulDevice<Itself, State>::own_difference(StateReader& a, StateReader& b) const {
  return difference_of_saved<State>(a, b);
}

}  // namespace understudy::emulator
