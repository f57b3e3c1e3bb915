#include "emulator/edge/nv_keeper.h"

#include <algorithm>
#include <filesystem>

namespace understudy::emulator {

void read_memories(Bench& bench, const std::string& folder) {
  if (!folder.empty()) std::filesystem::create_directories(folder);
  for (DeviceSetup& device : bench.devices) {
    if (device.nv_path.empty() && !folder.empty()) {
      device.nv_path = folder + "/" + device.settings.name + ".json";
    }
    if (device.nv_path.empty()) continue;
    device.settings.nv = read_nv_file(device.nv_path);
    try {
      make_device(*device.model, device.settings);
    } catch (const NvError& error) {
      throw NvError(device.nv_path + ": " + error.what());
    }
  }
}

NvKeeper::NvKeeper(const Bench& bench, const World& world, std::function<void(const std::string&)> log)
    : world_(world), log_(std::move(log)) {
  for (std::size_t i = 0; i < bench.devices.size(); ++i) {
    const DeviceSetup& device = bench.devices[i];
    if (device.nv_path.empty()) continue;
    files_.push_back({.device = i, .path = device.nv_path});
    files_.back().written = world.device(i).kept_revision();
    const NvImage image = world.device(i).nv_image();
    if (!device.settings.nv || device.settings.nv->registers != image.registers) write(files_.back());
  }
}

NvKeeper::~NvKeeper() {
  for (File& file : files_) {
    if (is_behind(file)) write(file);
  }
  writer_.flush();
  for (const std::string& news : writer_.take_news()) log_(news);
}

bool NvKeeper::is_behind(const File& file) const {
  return world_.device(file.device).kept_revision() != file.written;
}

void NvKeeper::write(File& file) {
  file.written = world_.device(file.device).kept_revision();
  writer_.write(file.path, to_json(world_.device(file.device).nv_image()));
}

void NvKeeper::look(WallTime now) {
  if (files_.empty()) return;
  for (const std::string& news : writer_.take_news()) log_(news);
  const bool anything =
      std::any_of(files_.begin(), files_.end(), [&](const File& f) { return is_behind(f); });
  if (!anything) {
    due_.reset();
  } else if (!due_) {
    due_ = std::max(now, handed_over_ + NvWriter::kCoalesce);
  }
  if (!due_ || now < *due_) return;
  for (File& file : files_) {
    if (is_behind(file)) write(file);
  }
  handed_over_ = now;
  due_.reset();
}

std::optional<WallTime> NvKeeper::next_look() const { return due_; }

}  // namespace understudy::emulator
