// Keeps the files of the devices' memories up to date with the simulated memories.
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

/// Gives every device that has no file one in `folder`, which is made if it does not exist (if `folder` is
/// empty they stay without), and reads the existing files into the settings. Throws FileError with all that
/// is wrong with them, NvError where a file or the folder cannot be used, or std::system_error.
void read_memories(world::Bench& bench, const std::string& folder);

class NvKeeper {
 public:
  /// The world that was made from the bench. Memories that differ from their files are written now. Throws
  /// pty::PortError if another process keeps one of these files.
  NvKeeper(const world::Bench& bench, const world::World& world, std::function<void(const std::string&)> log);
  ~NvKeeper();  // writes what has changed, and waits for it
  NvKeeper(const NvKeeper&) = delete;
  NvKeeper& operator=(const NvKeeper&) = delete;

  /// Hands what has changed to the helper thread, at most once in NvWriter::kCoalesce.
  void look(WallTime now);
  /// When it needs to look again, if there is something to hand over or a result to collect.
  std::optional<WallTime> next_look() const;
  /// The world has another state: whatever their revisions, the files do not match its memories.
  void world_restored();

 private:
  struct File {
    std::size_t device = 0;
    std::string path;
    std::optional<std::uint64_t> written{};  // the memory's revision, if the file is of this memory
  };
  void claim(const world::DeviceSetup& device);
  bool is_behind(const File& file) const;
  void write(File& file);

  const world::World& world_;
  std::function<void(const std::string&)> log_;
  std::vector<File> files_;
  std::vector<pty::PortClaim> claims_;  // of the files: two daemons would undo each other's work
  std::optional<WallTime> due_;
  WallTime handed_over_{0};
  WallTime looked_{0};
  NvWriter writer_;
};

}  // namespace understudy::emulator::serve
