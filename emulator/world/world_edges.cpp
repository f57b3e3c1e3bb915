// Informs devices that handle edges between ticks at which positions of an axis its machine's switches change
// inputs. The edges are sent again whenever they change: when the machine loses or regains pulses or is
// pushed, when a switch goes on or off, or when an input is held, stuck, or driven by a wire.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "emulator/device/axes.h"
#include "emulator/device/machine_edges.h"
#include "emulator/world/plant/plant.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

/// Returns the edges as positions in the device's count.
MachineEdges World::edges_of(std::size_t device, std::size_t axis) const {
  MachineEdges edges;
  const PlantAxis& plant = plants_[device][axis];
  // It is not known how far the machine will move, so only the levels at the end of a tick count.
  if (!plant.steps_all()) return edges;
  const std::int64_t origin = plant.position_pulses() - axes_[device]->place_pulses(static_cast<int>(axis));
  if (plant.has_encoder() && !plant.setup().has_wheel) {
    const PlantSetup& setup = plant.setup();
    edges.encoder = {.counts = setup.encoder_counts_per_revolution,
                     .pulses = setup.pulses_per_revolution,
                     .origin = setup.position_pulses - origin,
                     .reversed = setup.encoder_reversed,
                     .surplus = plant.faults().encoder_noise_counts};
    if (setup.travel) {
      edges.encoder.first = setup.travel->first - origin;
      edges.encoder.last = setup.travel->last - origin;
    }
  }
  for (const ContactWire& wire : contacts_[device]) {
    const Input& input = inputs_[device][static_cast<std::size_t>(wire.input)];
    if (wire.axis != axis || input.stuck || input.external != 0 || input.wired) continue;
    if (wire.contact == Contact::index) {
      const IndexSetup& index = *plant.setup().index;
      edges.index = {
          .input = wire.input, .at = index.at - origin, .width = index.width, .period = index.period};
      if (const auto& stops = plant.setup().travel) {
        edges.index.first = stops->first - origin;
        edges.index.last = stops->last - origin;
      }
    } else if (const auto switch_setup = plant.switch_of(wire.contact)) {
      edges.spans[edges.span_count++] = {.input = wire.input,
                                         .level_inside = !switch_setup->opens,
                                         .first = switch_setup->on.first - origin,
                                         .last = switch_setup->on.last - origin,
                                         .slack = switch_setup->hysteresis_pulses};
    }
  }
  return edges;
}

void World::begin_edges() {
  const auto asks = [](const Axes* axes) { return axes != nullptr && axes->meets_edges(); };
  if (std::none_of(axes_.begin(), axes_.end(), asks)) return;
  for (std::size_t d = 0; d < devices_.size(); ++d) {
    sent_edges_.emplace_back(asks(axes_[d]) ? plants_[d].size() : 0);
    for (std::size_t a = 0; a < sent_edges_[d].size(); ++a) plants_[d][a].check_between_ticks();
    send_edges(d);
  }
}

void World::send_edges(std::size_t device) {
  if (!meets_edges(device)) return;
  for (std::size_t a = 0; a < sent_edges_[device].size(); ++a) {
    SentEdges& sent = sent_edges_[device][a];
    const MachineEdges edges = edges_of(device, a);
    const auto axis = static_cast<int>(a);
    sent.origin = plants_[device][a].position_pulses() - axes_[device]->place_pulses(axis);
    if (sent.is_sent && sent.edges == edges) continue;
    sent.is_sent = true;
    sent.edges = edges;
    axes_[device]->set_edges(axis, edges);
  }
}

void World::resend_edges(std::size_t device) {
  if (device >= sent_edges_.size()) return;
  for (SentEdges& sent : sent_edges_[device]) sent.is_sent = false;
  send_edges(device);
}

/// Sends the edges again if the machine has lost or gained pulses. Called after ticks in which no switch has
/// changed.
void World::check_positions(std::size_t device) {
  for (std::size_t a = 0; a < sent_edges_[device].size(); ++a) {
    const std::int64_t place = axes_[device]->place_pulses(static_cast<int>(a));
    if (plants_[device][a].position_pulses() - place == sent_edges_[device][a].origin) continue;
    return send_edges(device);
  }
}

/// Adds the part of each turn that belongs to this tick. Called at the beginning of the tick.
void World::turn_inputs() {
  __extension__ using Wide = __int128;
  const auto turned = [](const InputTurn& turn) {
    return static_cast<std::int64_t>(Wide{turn.counts} * (turn.ticks - turn.ticks_left) / turn.ticks);
  };
  for (InputTurn& turn : input_turns_) {
    const std::int64_t before = turned(turn);
    --turn.ticks_left;
    // The count wraps like that of a 32-bit counter.
    std::int32_t& counts = inputs_[turn.device][static_cast<std::size_t>(turn.terminal)].external;
    counts = static_cast<std::int32_t>(static_cast<std::uint32_t>(counts) +
                                       static_cast<std::uint32_t>(turned(turn) - before));
    apply_input(turn.device, turn.terminal);
  }
  std::erase_if(input_turns_, [](const InputTurn& turn) { return turn.ticks_left == 0; });
}

}  // namespace understudy::emulator::world
