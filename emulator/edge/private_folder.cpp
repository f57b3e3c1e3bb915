#include "emulator/edge/private_folder.h"

#include <stdlib.h>

#include <filesystem>

#include "pty/port_link.h"

namespace understudy::emulator {

PrivateFolder::~PrivateFolder() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove(path_, ignored);
}

const std::string& PrivateFolder::path() {
  if (path_.empty()) {
    std::string folder = std::string(kPrivateFolders) + "XXXXXX";
    if (mkdtemp(folder.data()) == nullptr) {
      throw pty::PortError(folder + ": cannot be made; expected a writable /tmp");
    }
    path_ = folder;
  }
  return path_;
}

}  // namespace understudy::emulator
