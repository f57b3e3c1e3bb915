#include "emulator/world/snapshot.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "base/state/difference.h"
#include "base/state/fields.h"
#include "base/state/state_bytes.h"
#include "base/state/state_error.h"
#include "emulator/device/model.h"
#include "emulator/world/check_fault.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/faults/kinds.h"
#include "emulator/world/faults/trigger.h"
#include "emulator/world/plant/plant.h"
#include "emulator/world/state_fields.h"
#include "emulator/world/view/world_view.h"
#include "emulator/world/world.h"
#include "pty/line.h"

namespace understudy::emulator::world {

namespace {

using PlantStates = std::vector<std::vector<PlantAxis::State>>;
using LineStates = std::vector<pty::Line::State>;

using OfWorld = StateOf<World>;
/// The world's own fields as values.
using WorldValues = CopiedFields<World>;

enum : std::size_t { kSentPulses, kInputs, kSupplies, kFaults, kNextFault, kDisturbed, kNow, kDone, kTurns };
constexpr auto kFieldNames =
    OfWorld::fields.apply([](const auto&... named) { return std::array{named.name...}; });
static_assert(kFieldNames == std::array<std::string_view, 9>{"sent_pulses", "inputs", "supplies", "faults",
                                                             "next_fault", "disturbed", "now", "done",
                                                             "input_turns"});

// --- saving ----------------------------------------------------------------------------------------

WorldState::Part world_part(const World& world) {
  StateWriter writer(1024);
  writer.write(world);
  for (const auto& axes : OfWorld::plants(world)) {
    for (const PlantAxis& plant : axes) writer.write(plant.save());
  }
  return {"world", writer.take()};
}

/// How a line treats its hosts. This is a setting, not state, but two worlds with different settings have
/// different futures.
struct Hearing {
  bool is_strict = false;         // requires the silence between frames
  bool enforces_settings = true;  // ignores hosts with a different speed
};
Hearing hearing_of(const WorldLine& line) {
  return {.is_strict = line.framing.strict, .enforces_settings = line.line.options().enforce_settings};
}

WorldState::Part line_part(const WorldLine& line) {
  StateWriter writer(1024);
  writer.write(hearing_of(line).is_strict);
  writer.write(hearing_of(line).enforces_settings);
  writer.write(line.line.save());
  for (const auto& station : line.stations) station->write_state(writer);
  return {"line " + line.line.name(), writer.take()};
}

WorldState::Part edge_part(const World& world) {
  StateWriter writer(256);
  writer.write(OfWorld::ticks(world));
  for (std::size_t i = 0; i < world.line_count(); ++i) writer.write(world.line(i).line.save().edge);
  return {std::string(kEdgePart), writer.take()};
}

// --- reading, which changes nothing ----------------------------------------------------------------

void check_inputs(const World& world, const WorldValues& values) {
  const auto& inputs = std::get<kInputs>(values);
  require_state(inputs.size() == world.device_count(), "its devices are different");
  for (std::size_t d = 0; d < inputs.size(); ++d) {
    const auto terminals = world.device(d).model().terminals;
    require_state(inputs[d].size() == terminals.size(), "its terminals are different");
    for (std::size_t i = 0; i < terminals.size(); ++i) {
      if (terminals[i].kind == TerminalRow::Kind::counted_in) continue;
      require_within(inputs[d][i].external, terminals[i].lowest, terminals[i].highest);
    }
  }
}

void check_pulses(const World& world, const WorldValues& values) {
  const auto& sent_pulses = std::get<kSentPulses>(values);
  require_state(sent_pulses.size() == world.device_count(), "its devices are different");
  for (std::size_t d = 0; d < sent_pulses.size(); ++d) {
    require_state(sent_pulses[d].size() == world.device(d).model().axes.size(), "its axes are different");
    for (const std::int64_t pulses : sent_pulses[d]) require_reach(pulses);
  }
}

/// Returns at how many places a device of this model can have the fault.
std::size_t places_of(const Model& model, const Fault& fault) {
  switch (fault_kind(fault.kind).place) {
    case FaultKindRow::Place::axis: return model.axes.size();
    case FaultKindRow::Place::wheel: return fault.of_input ? model.terminals.size() : model.axes.size();
    case FaultKindRow::Place::input: return model.terminals.size();
    case FaultKindRow::Place::line: return model.line.ports.size();
    case FaultKindRow::Place::device_or_line: return fault.on_line ? model.line.ports.size() : 1;
    case FaultKindRow::Place::device: break;
  }
  return 1;
}

void check_turns(const World& world, const WorldValues& values) {
  for (const auto& turn : std::get<kTurns>(values)) {
    require_state(turn.device < world.device_count(), "a turn belongs to no device");
    const auto terminals = world.device(turn.device).model().terminals;
    const auto place = static_cast<std::size_t>(turn.terminal);
    const bool is_counted = turn.terminal >= 0 && place < terminals.size() &&
                            terminals[place].kind == TerminalRow::Kind::counted_in;
    require_state(is_counted, "a turn belongs to no counted input");
    require_reach(turn.counts);
    require_within(turn.ticks, 1, tick_at(kForever));
    require_within(turn.ticks_left, 1, turn.ticks);
  }
}

/// Checks that the fault could have been injected.
void check_fault_value(const World& world, const Fault& fault) {
  require_state(fault.device < world.device_count(), "a fault belongs to no device");
  const Model& model = world.device(fault.device).model();
  require_state(fault.place >= 0 && static_cast<std::size_t>(fault.place) < places_of(model, fault),
                "a fault has no place");
  require_state(!is_done_at_once(fault.kind) || waits(fault), "a push has a duration");
  for (const Tick ticks : {fault.over_ticks, fault.period_ticks}) {
    require_state(ticks >= 0 && ticks <= tick_at(kForever), "a fault lasts beyond the end of simulated time");
  }
  require_state(find_fault(world.known(), fault_text(world.known(), fault)) == fault,
                "a fault contradicts itself");
  check_fault(world, fault);
}

void check_faults(const World& world, const WorldValues& values) {
  for (const auto& [number, armed] : std::get<kFaults>(values)) {
    require_state(number < std::get<kNextFault>(values),
                  "a fault has a number that has not been assigned yet");
    check_fault_value(world, armed.fault);
    const FaultCourse& course = armed.course;
    for (const std::int64_t count : {course.seen, course.matched, course.hits}) {
      require_state(count >= 0, "a fault counter is negative");
      require_reach(count);
    }
  }
}

WorldValues read_values(const World& world, StateReader& reader) {
  WorldValues values = copy_fields(world);
  std::apply([&](auto&... field) { (reader.read(field), ...); }, values);
  check_inputs(world, values);
  require_state(std::get<kSupplies>(values).size() == world.device_count(), "its devices are different");
  check_pulses(world, values);
  check_faults(world, values);
  check_turns(world, values);
  const SimTime now = std::get<kNow>(values);
  require_state(now >= SimTime{0} && now <= kHorizon, "its time is after the end of simulated time");
  require_state(std::get<kDone>(values) == tick_at(now), "its ticks do not match its time");
  return values;
}

PlantStates read_machines(const World& world, StateReader& reader) {
  PlantStates machines;
  for (const auto& axes : OfWorld::plants(world)) {
    auto& states = machines.emplace_back(axes.size());
    for (PlantAxis::State& state : states) {
      reader.read(state);
      PlantAxis::check(state);
    }
  }
  return machines;
}

void read_hearing(const WorldLine& line, StateReader& reader) {
  Hearing hearing;
  reader.read(hearing.is_strict);
  reader.read(hearing.enforces_settings);
  const Hearing ours = hearing_of(line);
  if (hearing.is_strict != ours.is_strict) {
    throw StateError(hearing.is_strict
                         ? "was saved with strict framing; expected a bench with strict framing"
                         : "was saved with tolerant framing; expected a bench without strict framing");
  }
  if (hearing.enforces_settings != ours.enforces_settings) {
    throw StateError(hearing.enforces_settings ? "was saved by a bench that ignores hosts with another "
                                                 "speed; expected a bench that also ignores them"
                                               : "was saved by a bench that accepts hosts with any speed; "
                                                 "expected a bench that also accepts them");
  }
}

/// Reads the parts of a state one after another. Their names must be those of this world's parts.
class Parts {
 public:
  explicit Parts(const WorldState& state) : state_(state) {}

  /// Calls `read` with the next part. Errors contain the part's name.
  template <class Read>
  auto read(const std::string& name, Read read) {
    if (next_ == state_.parts.size() || state_.parts[next_].name != name) {
      throw StateError(name + ": is missing");
    }
    try {
      const WorldState::Part& part = state_.parts[next_++];
      return read(StateReader(part.bytes, part.texts));
    } catch (const std::runtime_error& error) {
      throw StateError(name + ": " + error.what());
    } catch (const std::invalid_argument& error) {
      throw StateError(name + ": " + error.what());
    }
  }
  void require_end() const {
    if (next_ != state_.parts.size())
      throw StateError(state_.parts[next_].name + ": is not part of this world");
  }

 private:
  const WorldState& state_;
  std::size_t next_ = 0;
};

void or_else(std::string& found, std::string next) {
  if (found.empty()) found = std::move(next);
}

std::string difference_of_worlds(const World& world, StateReader& reader_a, StateReader& reader_b) {
  const WorldValues values_a = read_values(world, reader_a);
  const WorldValues values_b = read_values(world, reader_b);
  std::string found = difference_of_copies<World>(values_a, values_b, "world");
  const PlantStates machines_a = read_machines(world, reader_a);
  const PlantStates machines_b = read_machines(world, reader_b);
  for (std::size_t d = 0; d < machines_a.size(); ++d) {
    const Device& device = world.device(d);
    for (std::size_t i = 0; i < machines_a[d].size(); ++i) {
      or_else(found,
              first_difference(machines_a[d][i], machines_b[d][i],
                               device.name() + "." + std::string(device.model().axes[i].name) + ".machine"));
    }
  }
  return found;
}

std::string difference_of_lines(const WorldLine& line, StateReader& reader_a, StateReader& reader_b) {
  read_hearing(line, reader_a);
  read_hearing(line, reader_b);
  std::string found = difference_of_saved<pty::Line::State>(reader_a, reader_b, line.line.name());
  for (const auto& station : line.stations) {
    or_else(found,
            station->difference(reader_a, reader_b, line.line.name() + "." + station->device().name()));
  }
  return found;
}

std::string difference_of_edges(const World& world, StateReader& reader_a, StateReader& reader_b) {
  std::string found = difference_of_saved<std::remove_cvref_t<decltype(OfWorld::ticks(world))>>(
      reader_a, reader_b, "world.ticks");
  for (std::size_t i = 0; i < world.line_count(); ++i) {
    or_else(found,
            difference_of_saved<pty::Line::Edge>(reader_a, reader_b, world.line(i).line.name() + ".edge"));
  }
  return found;
}

}  // namespace

WorldState save(const World& world) {
  WorldState state{.time = world.now(), .parts = {}};
  state.parts.reserve(2 + world.device_count() + world.line_count());
  state.parts.push_back(world_part(world));
  for (std::size_t i = 0; i < world.device_count(); ++i) {
    WorldState::Part part{.name = "device " + world.device(i).name(), .bytes = {}};
    part.bytes = world.device(i).save_state(part.texts);
    state.parts.push_back(std::move(part));
  }
  for (std::size_t i = 0; i < world.line_count(); ++i) state.parts.push_back(line_part(world.line(i)));
  state.parts.push_back(edge_part(world));
  return state;
}

std::function<void()> read_state(World& world, const WorldState& state) {
  Parts parts(state);
  auto own = parts.read("world", [&](StateReader reader) {
    WorldValues of_world = read_values(world, reader);
    PlantStates of_machines = read_machines(world, reader);
    reader.require_end();
    return std::pair(std::move(of_world), std::move(of_machines));
  });
  std::vector<std::function<void()>> put_devices;
  for (std::size_t i = 0; i < world.device_count(); ++i) {
    put_devices.push_back(parts.read("device " + world.device(i).name(), [&](const StateReader& reader) {
      return world.device(i).read_state(reader);
    }));
  }
  LineStates lines(world.line_count());
  std::vector<std::function<void()>> put_stations;
  for (std::size_t i = 0; i < world.line_count(); ++i) {
    const WorldLine& line = world.line(i);
    parts.read("line " + line.line.name(), [&](StateReader reader) {
      read_hearing(line, reader);
      reader.read(lines[i]);
      for (const auto& station : line.stations) put_stations.push_back(station->read_state(reader));
      reader.require_end();
    });
  }
  auto ticks = parts.read(std::string(kEdgePart), [&](StateReader reader) {
    auto of_world = OfWorld::ticks(world);
    reader.read(of_world);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      reader.read(lines[i].edge);
      world.line(i).line.check(lines[i]);
    }
    reader.require_end();
    return of_world;
  });
  parts.require_end();

  return [&world, values = std::move(own.first), machines = std::move(own.second),
          put_devices = std::move(put_devices), lines = std::move(lines),
          put_stations = std::move(put_stations), ticks = std::move(ticks)] {
    assign_fields(world, values);
    OfWorld::ticks(world) = ticks;
    OfWorld::rearm(world);
    for (std::size_t d = 0; d < machines.size(); ++d) {
      for (std::size_t a = 0; a < machines[d].size(); ++a) {
        OfWorld::plants(world)[d][a].restore(machines[d][a]);
      }
    }
    for (std::size_t i = 0; i < put_devices.size(); ++i) {
      put_devices[i]();
      world.device(i).set_now(tick_at(world.now()));
    }
    for (const auto& put_station : put_stations) put_station();
    for (std::size_t i = 0; i < lines.size(); ++i) {
      OfWorld::line(world, i).restore(lines[i]);
      OfWorld::line(world, i).due_changed();
    }
    OfWorld::notify(world);
  };
}

void restore(World& world, const WorldState& state) { read_state(world, state)(); }

std::string difference(const World& world, const WorldState& a, const WorldState& b) {
  Parts of_a(a);
  Parts of_b(b);
  // All parts are read although only the first difference is returned, because an invalid part must always be
  // refused.
  std::string first;
  const auto look = [&](const std::string& name, auto differ) {
    of_a.read(name, [&](const StateReader& of_first) {
      of_b.read(name, [&](const StateReader& of_second) {
        std::string found = differ(of_first, of_second);
        if (first.empty()) first = std::move(found);
      });
    });
  };
  const auto look_with_readers = [&](const std::string& name, auto differ) {
    look(name, [&](StateReader reader_a, StateReader reader_b) {
      std::string found = differ(reader_a, reader_b);
      reader_a.require_end();
      reader_b.require_end();
      return found;
    });
  };
  look_with_readers("world", [&](StateReader& reader_a, StateReader& reader_b) {
    return difference_of_worlds(world, reader_a, reader_b);
  });
  for (std::size_t i = 0; i < world.device_count(); ++i) {
    const Device& device = world.device(i);
    look("device " + device.name(), [&](const StateReader& of_first, const StateReader& of_second) {
      const std::string found = device.state_difference(of_first, of_second);
      return found.empty() ? found : device.name() + "." + found;
    });
  }
  for (std::size_t i = 0; i < world.line_count(); ++i) {
    const WorldLine& line = world.line(i);
    look_with_readers("line " + line.line.name(), [&](StateReader& reader_a, StateReader& reader_b) {
      return difference_of_lines(line, reader_a, reader_b);
    });
  }
  look_with_readers(std::string(kEdgePart), [&](StateReader& reader_a, StateReader& reader_b) {
    return difference_of_edges(world, reader_a, reader_b);
  });
  of_a.require_end();
  of_b.require_end();
  return first;
}

std::uint64_t hash(const World& world) {
  std::uint64_t sum = hash_of({});
  for (const WorldState::Part& part : save(world).parts) {
    if (part.name != kEdgePart) sum = hash_of(part.bytes, sum);
  }
  return sum;
}

}  // namespace understudy::emulator::world
