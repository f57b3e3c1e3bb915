#include "emulator/serve/ports/private_folder.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "base/files/descriptor.h"
#include "pty/port_link.h"

namespace understudy::emulator::serve {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLettersOfMkdtemp = 6;

Descriptor locked(const std::string& folder) {
  Descriptor lock(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  return lock && ::flock(lock.get(), LOCK_EX | LOCK_NB) == 0 ? std::move(lock) : Descriptor();
}

bool is_private_folder(const std::string& path, const std::string& beginning) {
  struct stat status = {};
  return path.size() == beginning.size() + kLettersOfMkdtemp && path.starts_with(beginning) &&
         std::all_of(path.end() - kLettersOfMkdtemp, path.end(),
                     [](unsigned char c) { return std::isalnum(c) != 0; }) &&
         ::lstat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode) && status.st_uid == ::geteuid() &&
         (status.st_mode & 077) == 0;
}

/// Returns the time of the last change of the folder and its content, or the latest possible time if it is
/// unknown.
std::chrono::seconds last_change(const fs::path& folder) {
  struct stat status = {};
  if (::lstat(folder.c_str(), &status) != 0) return std::chrono::seconds::max();
  std::chrono::seconds last{status.st_mtim.tv_sec};
  if (!S_ISDIR(status.st_mode)) return last;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    last = std::max(last, last_change(entry.path()));
  }
  return error ? std::chrono::seconds::max() : last;
}

}  // namespace

void remove_left_overs(const std::string& beginning, std::chrono::seconds kept) {
  const std::chrono::seconds now{::time(nullptr)};
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(beginning).parent_path(), error)) {
    const std::string path = entry.path().string();
    // The folder with the user's number contains the control sockets, and belongs to no process.
    if (path == beginning + std::to_string(::geteuid()) || !is_private_folder(path, beginning)) continue;
    const Descriptor lock = locked(path);
    if (lock && last_change(path) < now - kept) fs::remove_all(path, error);
  }
}

PrivateFolder::~PrivateFolder() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove(path_, ignored);
}

const std::string& PrivateFolder::path() {
  if (path_.empty()) {
    std::string folder = std::string(kPrivateFolders) + "XXXXXX";
    if (mkdtemp(folder.data()) == nullptr) {
      throw pty::PortError(folder + ": cannot be created; expected a writable /tmp");
    }
    path_ = folder;
    lock_ = locked(folder);
  }
  return path_;
}

}  // namespace understudy::emulator::serve
