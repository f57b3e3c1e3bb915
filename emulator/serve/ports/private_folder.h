#pragma once

#include <chrono>
#include <string>

#include "base/files/descriptor.h"

namespace understudy::emulator::serve {

/// What its path begins with.
inline constexpr const char* kPrivateFolders = "/tmp/understudy-";

/// How long what failures have left in such folders is kept.
inline constexpr std::chrono::hours kLeftOversKept{7 * 24};

/// Removes the folders of ours with that beginning in which nothing has changed for so long, and whose owner
/// is gone. What is not named as such a folder is, or another user's, is left alone.
void remove_left_overs(const std::string& beginning = kPrivateFolders,
                       std::chrono::seconds kept = kLeftOversKept);

/// A folder of its own below /tmp, made when it is first asked for and removed (empty) at the end.
class PrivateFolder {
 public:
  PrivateFolder() = default;
  ~PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;
  /// Throws pty::PortError.
  const std::string& path();

 private:
  std::string path_;
  Descriptor lock_;  // it has an owner who lives
};

}  // namespace understudy::emulator::serve
