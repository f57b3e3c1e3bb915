#include "emulator/serve/daemon/nv_keeper.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "base/files/content_kind.h"
#include "base/files/file_error.h"
#include "base/files/text_file.h"
#include "emulator/device/memory/nv_entry_error.h"
#include "emulator/device/memory/nv_file.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/memory/persistent_memory.h"
#include "emulator/device/model.h"
#include "emulator/serve/loop/event_loop.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/world.h"
#include "pty/port_link.h"

namespace understudy::emulator::serve {

namespace {

/// Returns the canonical path of a memory's file.
std::filesystem::path file_of(const world::DeviceSetup& device) {
  return std::filesystem::weakly_canonical(std::filesystem::absolute(device.nv_path));
}

void require_own_files(const world::Bench& bench) {
  std::map<std::filesystem::path, std::string> owners;
  for (const world::DeviceSetup& device : bench.devices) {
    if (device.nv_path.empty()) continue;
    const auto [owner, is_free] = owners.emplace(file_of(device), device.settings.name);
    if (!is_free) {
      throw NvError(device.nv_path + ": nv: is the memory of '" + owner->second + "' and of '" +
                    device.settings.name + "'; expected a file for each");
    }
  }
}

void make_folder(const std::string& folder) {
  if (folder.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (std::filesystem::is_directory(folder)) return;
  if (std::filesystem::exists(folder))
    throw NvError("--nv: " + folder + " is not a folder; expected a folder");
  throw std::system_error(error, "--nv: " + folder + " cannot be created");
}

/// Reads a memory and reports all errors in it.
void read_memory(world::DeviceSetup& device, world::Diagnostics& diagnostics) {
  bool is_asked = diagnostics.attempt([&] {
    // While the file does not exist, the bench may set the content of the memory.
    if (auto image = read_nv_file(device.nv_path)) device.settings.nv = std::move(image);
  });
  while (is_asked) {
    is_asked = false;
    diagnostics.attempt([&] {
      try {
        make_device(*device.model, device.settings);
      } catch (const NvEntryError& refused) {
        is_asked = take_away(refused, *device.settings.nv);
        throw FileError({diagnostic_of(refused, device.nv_path)});
      } catch (const NvError& error) {
        throw FileError({diagnostic_of(error, device.nv_path)});
      }
    });
  }
}

}  // namespace

void read_memories(world::Bench& bench, const std::string& folder) {
  make_folder(folder);
  for (world::DeviceSetup& device : bench.devices) {
    if (device.nv_path.empty() && !folder.empty()) {
      device.nv_path = folder + "/" + device.settings.name + ".json";
    }
  }
  require_own_files(bench);
  world::Diagnostics diagnostics;
  diagnostics.require([&] {
    for (world::DeviceSetup& device : bench.devices) {
      if (!device.nv_path.empty()) read_memory(device, diagnostics);
    }
  });
}

NvKeeper::NvKeeper(const world::Bench& bench, const world::World& world,
                   std::function<void(const std::string&)> log)
    : world_(world), log_(std::move(log)) {
  for (std::size_t i = 0; i < bench.devices.size(); ++i) {
    const world::DeviceSetup& device = bench.devices[i];
    if (device.nv_path.empty() || world.device(i).memory() == nullptr) continue;
    claim(device);
    files_.push_back({.device = i, .path = device.nv_path});
    files_.back().written = world.device(i).memory()->memory_revision();
    const bool is_present = device.settings.nv && std::filesystem::exists(device.nv_path);
    if (!is_present || !holds_the_same(*device.settings.nv, world.device(i).memory()->nv_image())) {
      write(files_.back());
    }
  }
}

/// Claims the file of a memory. A memory that cannot be written needs no claim.
void NvKeeper::claim(const world::DeviceSetup& device) {
  try {
    claims_.emplace_back(file_of(device).string());
  } catch (const std::system_error&) {
    return;
  }
  if (!claims_.back()) {
    throw pty::PortError(device.nv_path +
                         ": nv: another running understudy uses this memory; expected a separate file, or a "
                         "separate folder with --nv, for each");
  }
  // No other program writes this file, so temporary files next to it were left by a killed process.
  remove_left_beside(file_of(device).string(), ContentKind::nv_image);
}

NvKeeper::~NvKeeper() {
  for (File& file : files_) {
    if (is_behind(file)) write(file);
  }
  writer_.flush();
  for (const std::string& news : writer_.take_news()) log_(news);
}

bool NvKeeper::is_behind(const File& file) const {
  return world_.device(file.device).memory()->memory_revision() != file.written;
}

void NvKeeper::write(File& file) {
  file.written = world_.device(file.device).memory()->memory_revision();
  writer_.write(file.path, world_.device(file.device).memory()->content_now());
}

void NvKeeper::world_restored() {
  for (File& file : files_) file.written.reset();
}

void NvKeeper::poll(WallTime now) {
  if (files_.empty()) return;
  looked_ = now;
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

std::optional<WallTime> NvKeeper::next_poll() const {
  // The results of writes must be polled, because they do not wake the daemon.
  if (!due_ && !writer_.is_idle()) return looked_ + NvWriter::kCoalesce;
  return due_;
}

}  // namespace understudy::emulator::serve
