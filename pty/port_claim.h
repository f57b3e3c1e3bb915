// Marks a port's link as served while this process serves it, so that another run does not consider it stale.
// (It also marks a memory's file.) It is a lock on an empty file next to the link, `.NAME.lock`: only users
// who may create the link may claim it. The kernel releases the lock when the process ends; the next process
// takes over a file that a killed one left.
#pragma once

#include <string>

#include "base/files/descriptor.h"

namespace understudy::pty {

class PortClaim {
 public:
  PortClaim() = default;  // claims nothing
  /// Tries to claim the link at an absolute path. Throws std::system_error if it cannot find out whether the
  /// link is in use.
  explicit PortClaim(const std::string& link);
  ~PortClaim();  // releases it
  PortClaim(PortClaim&& other) noexcept;
  PortClaim& operator=(PortClaim&& other) noexcept;

  /// Returns false if another run serves the link.
  explicit operator bool() const { return static_cast<bool>(lock_); }

 private:
  std::string path_;
  Descriptor lock_;
};

}  // namespace understudy::pty
