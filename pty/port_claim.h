// Marks a port's link as served for as long as we serve it, so that another run does not take it for a stale
// one. (Also used for a memory's file.) It is a lock on an empty file beside the link, `.NAME.lock`: only
// users who may make the link may claim it. The kernel releases the lock with the process; a file that a
// killed process left is taken over by the next one.
#pragma once

#include <string>

#include "base/files/descriptor.h"

namespace understudy::pty {

class PortClaim {
 public:
  PortClaim() = default;  // of nothing
  /// Tries to claim the link of that absolute path. Throws std::system_error if it cannot find out whether it
  /// is in use.
  explicit PortClaim(const std::string& link);
  ~PortClaim();  // lets go
  PortClaim(PortClaim&& other) noexcept;
  PortClaim& operator=(PortClaim&& other) noexcept;

  /// False: another run serves the link.
  explicit operator bool() const { return static_cast<bool>(lock_); }

 private:
  std::string path_;
  Descriptor lock_;
};

}  // namespace understudy::pty
