#include "emulator/play/performing/asked_names.h"

#include <cstdint>
#include <string>
#include <string_view>

#include "emulator/world/expression/expression.h"
#include "emulator/world/probe/probe_names.h"

namespace understudy::emulator::play {

world::NamedNumber AskedNames::resolve(std::string_view name) const { return names_.resolve(name); }

AskedNames::Place AskedNames::place_of(std::int32_t handle) const {
  using What = world::ProbeNames::What;
  const world::ProbeNames::Probe& probe = names_.probe(handle);
  Place place;
  place.name = probe.name;
  if (probe.what == What::time) {
    place.is_time = true;
  } else if (probe.what == What::reg && probe.reg.place.row->access != Access::write) {
    place.reg = Target{.device = probe.device, .name = probe.name, .place = probe.reg};
  } else if (probe.what == What::named) {
    place.device = probe.device;
    place.query = "?" + probe.value_name;
  }
  return place;
}

}  // namespace understudy::emulator::play
