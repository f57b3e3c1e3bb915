// Keeps the memory files of devices up to date with the simulated memories.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "emulator/device/memory/nv_file.h"
#include "emulator/serve/loop/pacer.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/world.h"
#include "pty/port_claim.h"

namespace understudy::emulator::serve {

/// Assigns a file in `folder` to every device without a memory file, and reads existing files into the
/// settings. Creates the folder if it does not exist. If `folder` is empty, these devices get no file. Throws
/// FileError with all mistakes in the files, NvError if a file or the folder cannot be used, or
/// std::system_error.
void read_memories(world::Bench& bench, const std::string& folder);

class NvKeeper {
 public:
  /// `world` must be the world of this bench. Memories that differ from their files are written now. Throws
  /// pty::PortError if another process uses one of these files.
  NvKeeper(const world::Bench& bench, const world::World& world, std::function<void(const std::string&)> log);
  ~NvKeeper();  // writes changes, and waits for them
  NvKeeper(const NvKeeper&) = delete;
  NvKeeper& operator=(const NvKeeper&) = delete;

  /// Passes changes to the helper thread, at most once per NvWriter::kCoalesce.
  void poll(WallTime now);
  /// Returns when to call poll() again, if there are changes to pass on or results to collect.
  std::optional<WallTime> next_poll() const;
  /// Call this after a restore: all files must be written again, whatever the revisions of the memories are.
  void world_restored();

 private:
  struct File {
    std::size_t device = 0;
    std::string path;
    std::optional<std::uint64_t> written{};  // the revision in the file; nothing: the memory must be written
  };
  void claim(const world::DeviceSetup& device);
  bool is_behind(const File& file) const;
  void write(File& file);

  const world::World& world_;
  std::function<void(const std::string&)> log_;
  std::vector<File> files_;
  std::vector<pty::PortClaim> claims_;  // for the files: two daemons would overwrite each other's changes
  std::optional<WallTime> due_;
  WallTime handed_over_{0};
  WallTime looked_{0};
  NvWriter writer_;
};

}  // namespace understudy::emulator::serve
