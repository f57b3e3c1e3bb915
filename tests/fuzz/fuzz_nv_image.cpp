// Any text as a memory file is refused, or it is an image that reads the same when it is written again; and a
// device that accepts it has a memory that it accepts back.
#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "emulator/device/device.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/memory/persistent_memory.h"
#include "emulator/models/models.h"
#include "tests/fuzz/fuzzing.h"

namespace {

using namespace understudy;
using fuzzing::require;

constexpr std::size_t kLongest = 8192;

/// One device of each model, without power, which gets one memory after another.
emulator::Device* device_of(const std::string& name) {
  static std::map<std::string, std::unique_ptr<emulator::Device>> devices = [] {
    std::map<std::string, std::unique_ptr<emulator::Device>> made;
    for (const emulator::Model* model : emulator::models::all_models()) {
      emulator::DeviceSettings settings;
      settings.name = "device";
      auto device = emulator::make_device(*model, settings);
      device->switch_power(false);
      made.emplace(model->name, std::move(device));
    }
    return made;
  }();
  const auto found = devices.find(name);
  return found == devices.end() ? nullptr : found->second.get();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > kLongest) return 0;
  try {
    const emulator::NvImage image = emulator::parse_nv_image(std::string(fuzzing::text_of(data, size)));
    require(emulator::parse_nv_image(emulator::to_json(image)) == image, "an image reads as it was written");
    emulator::Device* device = device_of(image.model);
    if (device == nullptr) return 0;
    device->memory()->load_nv(image);
    const emulator::NvImage kept = device->memory()->nv_image();
    device->memory()->load_nv(kept);
    require(device->memory()->nv_image() == kept, "a memory takes back what it has given");
  } catch (const emulator::NvError& error) {
    require(error.what()[0] != '\0', "an error says something");
  }
  return 0;
}
