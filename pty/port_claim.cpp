#include "pty/port_claim.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "base/files/descriptor.h"

namespace understudy::pty {
namespace {

std::string lock_of(const std::filesystem::path& link) {
  return (link.parent_path() / ("." + link.filename().string() + ".lock")).string();
}

[[noreturn]] void fail(int error, const std::string& path) {
  throw std::system_error(error, std::generic_category(), path);
}

/// Opens the lock file, creating it if needed.
Descriptor open_lock(const std::string& path) {
  constexpr int kClaimFlags = O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC;
  while (true) {
    // Opening and creating are two calls: in /tmp the kernel would refuse O_CREAT on another user's file,
    // which root may lock.
    Descriptor lock(::open(path.c_str(), kClaimFlags));
    if (!lock && errno == ENOENT)
      lock = Descriptor(::open(path.c_str(), kClaimFlags | O_CREAT | O_EXCL, 0600));
    if (!lock && errno == EEXIST) continue;
    if (!lock) fail(errno, path);
    struct stat status = {};
    if (::fstat(lock.get(), &status) != 0) fail(errno, path);
    if (!S_ISREG(status.st_mode) || status.st_size != 0) fail(EEXIST, path);  // another file, not a lock
    return lock;
  }
}

/// Returns true if the file still exists: the previous owner may have removed it since it was opened.
bool is_still_there(const Descriptor& lock, const std::string& path) {
  struct stat ours = {};
  struct stat there = {};
  return ::fstat(lock.get(), &ours) == 0 && ::lstat(path.c_str(), &there) == 0 &&
         ours.st_dev == there.st_dev && ours.st_ino == there.st_ino;
}

}  // namespace

PortClaim::PortClaim(const std::string& link) : path_(lock_of(link)) {
  while (true) {
    Descriptor lock = open_lock(path_);
    if (::flock(lock.get(), LOCK_EX | LOCK_NB) != 0) {
      if (errno == EWOULDBLOCK) return;
      fail(errno, path_);
    }
    if (!is_still_there(lock, path_)) continue;
    lock_ = std::move(lock);
    return;
  }
}

PortClaim::~PortClaim() {
  if (lock_) ::unlink(path_.c_str());  // still locked: no other process can have claimed it
}

PortClaim::PortClaim(PortClaim&& other) noexcept
    : path_(std::move(other.path_)), lock_(std::move(other.lock_)) {}

PortClaim& PortClaim::operator=(PortClaim&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(lock_, other.lock_);
  return *this;
}

}  // namespace understudy::pty
