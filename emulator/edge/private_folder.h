#pragma once

#include <string>

namespace understudy::emulator {

/// What its path begins with.
inline constexpr const char* kPrivateFolders = "/tmp/understudy-";

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
};

}  // namespace understudy::emulator
