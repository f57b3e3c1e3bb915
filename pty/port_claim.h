// Says of a port's link, for as long as we serve it, that it is served: so that another run does not take it
// for a stale one. (And of a memory's file that it is kept.) It is a lock on an empty file beside the link,
// `.NAME.lock`: only who may make the link may claim it, whoever else is on the machine. The kernel lets go
// of the lock with the process; a file that a killed one has left is taken over by the next.
#pragma once

#include <string>

#include "base/files/descriptor.h"

namespace understudy::pty {

class PortClaim {
 public:
  PortClaim() = default;  // of nothing
  /// Tries to claim the link of that absolute path. Throws std::system_error if whether it is in use cannot
  /// be told.
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
