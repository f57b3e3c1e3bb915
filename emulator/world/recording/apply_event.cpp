// Applies the events of a recording to a world.
#include <cstddef>
#include <cstdint>

#include "emulator/device/program_error.h"
#include "emulator/world/recording/recording.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

using What = RecordedEvent::What;

namespace {

/// Loads a program that was loaded in the recording. If it was refused in the recording, it may also be
/// refused now.
void load_as_recorded(World& world, const RecordedEvent& event) {
  try {
    world.load_program(event.where, event.text);
  } catch (const ProgramError&) {
    if (event.value == 0) throw;
  }
}

}  // namespace

void apply(World& world, const RecordedEvent& event) {
  switch (event.what) {
    case What::opened: world.host_opened(event.where); break;
    case What::closed: world.host_closed(event.where); break;
    case What::settings: world.host_settings(event.where, event.host); break;
    case What::bytes: world.receive(event.where, event.bytes); break;
    case What::departed: world.receive_departed(event.where, event.bytes); break;
    case What::purged: world.host_purged(event.where); break;
    case What::nothing_more: world.nothing_more(event.where); break;
    case What::input:
      world.set_external_input(event.where, event.place, static_cast<std::int32_t>(event.value));
      break;
    case What::power: world.switch_power(event.where, event.value != 0); break;
    case What::inject: world.inject(event.fault); break;
    case What::clear: world.clear_fault(static_cast<std::size_t>(event.value)); break;
    case What::write: world.write(event.where, event.write); break;
    case What::assign: world.assign(event.where, event.text, event.real); break;
    case What::program: load_as_recorded(world, event); break;
    case What::command: world.command(event.where, event.text); break;
    case What::sent:
    case What::wait:
    case What::end: break;
  }
}

}  // namespace understudy::emulator::world
