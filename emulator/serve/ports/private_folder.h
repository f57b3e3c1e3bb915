#pragma once

#include <chrono>
#include <string>

#include "base/files/descriptor.h"

namespace understudy::emulator::serve {

/// The prefix of the paths of private folders.
inline constexpr const char* kPrivateFolders = "/tmp/understudy-";

/// Files that failed runs leave in such folders are removed after this time.
inline constexpr std::chrono::hours kLeftOversKept{7 * 24};

/// Removes our folders with that prefix if their contents have not changed for this long and their processes
/// have ended. Does not touch folders with other names, or of other users.
void remove_left_overs(const std::string& beginning = kPrivateFolders,
                       std::chrono::seconds kept = kLeftOversKept);

/// A private folder below /tmp. It is created on first use, and removed at the end if it is empty.
class PrivateFolder {
 public:
  PrivateFolder() = default;
  ~PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;
  /// Returns the folder, and creates it on first use. Throws pty::PortError.
  const std::string& path();

 private:
  std::string path_;
  Descriptor lock_;  // locked while the owner is alive
};

}  // namespace understudy::emulator::serve
