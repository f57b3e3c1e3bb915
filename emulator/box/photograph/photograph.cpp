#include "emulator/box/photograph/photograph.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "base/text/one_line.h"
#include "emulator/box/asking/asked.h"
#include "emulator/box/photograph/photo_parts.h"
#include "emulator/box/wire/port_name.h"
#include "emulator/box/wire/wire.h"
#include "emulator/device/device.h"
#include "emulator/device/memory/nv_entry_error.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/modbus/modbus_ascii.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/register_map.h"
#include "pty/line_settings.h"

namespace understudy::emulator::box {

void PhotoWork::note(Asked asked) {
  photo.is_echoing = photo.is_echoing || asked.was_echoed;
  photo.exchanges.push_back(std::move(asked));
}

std::vector<pty::LineSettings> settings_to_try(const Model& model, const PortName& port) {
  std::vector<pty::LineSettings> all;
  for (const PortRow& row : model.line.ports) {
    for (const int baud : row.bauds) {
      pty::LineSettings line = port.framing.value_or(row.settings);
      line.baud = port.baud.value_or(baud);
      if (std::ranges::find(all, line) == all.end()) all.push_back(line);
    }
  }
  if (!port.has_settings()) all.resize(1);
  return all;
}

std::string silence_text(const PortName& port, const std::string& who,
                         const std::vector<pty::LineSettings>& tried, bool is_noisy, bool is_echoing) {
  std::string at;
  for (const pty::LineSettings& line : tried) at += (at.empty() ? " at " : ", ") + pty::to_string(line);
  if (!port.has_settings()) at.clear();
  std::string text = one_line(port.place) + ": " + who + " did not answer" + at;
  if (is_echoing) {
    text += "; the adapter echoes the request, but nothing else arrives";
  } else if (is_noisy) {
    text += "; bytes arrived that are not a reply: the speed or the protocol may differ";
  }
  return text + "; expected a controller that is on, wired, and set to one of them";
}

void settle_image(PhotoWork& work, NvImage image) {
  image.model = std::string(work.model.name);
  const Firmware firmware =
      work.settings.firmware != 0 ? work.settings.firmware : work.model.firmwares.back();
  image.firmware = version_text(firmware);
  DeviceSettings settings;
  settings.name = "photograph";
  settings.firmware = firmware;
  settings.modules = work.modules;
  while (true) {
    try {
      settings.nv = image;
      make_device(work.model, settings);
      break;
    } catch (const NvEntryError& refused) {
      if (!take_away(refused, image)) throw;
      work.photo.left_out.emplace_back(refused.name, refused.diagnostic);
    }
  }
  work.photo.image = std::move(image);
}

void require_rtu(const Model& model, const PortName& port) {
  if (!is_modbus_ascii(model) || port.is_modbus_tcp()) return;
  throw BoxError(
      one_line(port.place) + ": " + std::string(model.name) +
      " speaks Modbus ASCII, which is only emulated; expected a gateway (modbus-tcp://), or a model "
      "of Modbus RTU");
}

Photograph photograph(const Model& model, const PortName& port, const PhotoSettings& settings,
                      const PhotoProgress& progress) {
  require_rtu(model, port);
  const bool is_modbus = model.rtu.has_value();
  if (!is_modbus && port.is_modbus_tcp())
    throw BoxError(one_line(port.place) + ": carries Modbus, but " + std::string(model.name) +
                   " speaks text; expected rtu:// or rfc2217://, which carry any bytes");
  const std::unique_ptr<Wire> wire = open_wire(port);
  PhotoWork work{.model = model, .port = port, .settings = settings, .progress = progress, .wire = *wire};
  work.photo.model = std::string(model.name);
  work.photo.place = port.place;
  try {
    is_modbus ? photograph_registers(work) : photograph_text(work);
  } catch (const BoxError& error) {
    if (work.photo.values.empty()) throw;
    work.photo.ended = error.what();
  } catch (const WireError& error) {
    if (work.photo.values.empty()) throw;
    work.photo.ended = error.what();
  }
  return std::move(work.photo);
}

}  // namespace understudy::emulator::box
