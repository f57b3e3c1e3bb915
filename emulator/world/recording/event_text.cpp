#include "emulator/world/recording/event_text.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

#include "base/text/one_line.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/device/register_map/wire_words.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/recording/recording.h"
#include "emulator/world/world.h"
#include "pty/line_settings.h"

namespace understudy::emulator::world {

using What = RecordedEvent::What;

namespace {

/// Returns "Aaxis_Speed=200".
std::string write_text(const PreparedWrite& write, const RegisterBank& bank) {
  const bool low_word_first = bank.low_word_first();
  const Place place = bank.at(write.table, write.first);
  std::uint32_t bits = place ? wire_word(*place.row, write.words[0]) : write.words[0];
  if (write.count == 2 && place) {
    bits = bits_of_wire(*place.row, write.words[0], write.words[1], low_word_first);
  }
  if (place && (write.count == 2 || place.part == Place::Part::whole)) {
    return bank.map().unique_name(*place.row, place.index) + "=" +
           value_text(value_of(bits, place.row->type), place.row->type);
  }
  std::array<char, 8> address{};
  std::snprintf(address.data(), address.size(), "0x%04X", write.first);
  return address.data() + ("=" + std::to_string(bits));
}

std::string settings_text(const std::optional<pty::HostSettings>& settings) {
  if (!settings) return "as the line has it";
  return pty::to_string(*settings);
}

}  // namespace

std::string text_of(const RecordedEvent& event, const World& world) {
  const auto line = [&] { return world.line(event.where).line.name(); };
  const auto device = [&] { return world.known()[event.where].name; };
  switch (event.what) {
    case What::opened: return "a host opens " + line();
    case What::closed: return "the host closes " + line();
    case What::purged: return "the host discards unsent bytes on " + line();
    case What::settings: return "the host sets " + line() + ": " + settings_text(event.host);
    case What::input: {
      const auto& terminals = world.known()[event.where].model->terminals;
      const auto& terminal = terminals[static_cast<std::size_t>(event.place)];
      return "input " + device() + "." + std::string(terminal.name) + "=" + std::to_string(event.value);
    }
    case What::power: return "power " + device() + (event.value != 0 ? " on" : " off");
    case What::inject: return "inject " + to_text(world.known(), event.fault);
    case What::clear: return "clear " + std::to_string(event.value);
    case What::write:
      return "set " + device() + "." + write_text(event.write, *world.device(event.where).register_bank());
    case What::assign: {
      std::array<char, 32> value{};
      std::snprintf(value.data(), value.size(), "%.9g", event.real);
      return "set " + device() + "." + one_line(event.text) + "=" + value.data();
    }
    case What::program: return "program " + device();
    case What::command: return "command " + device() + ": " + one_line(event.text);
    case What::bytes:
    case What::departed:
    case What::nothing_more:
    case What::sent:
    case What::wait:
    case What::end: break;
  }
  return "";
}

}  // namespace understudy::emulator::world
