// The stable path of a port: a symbolic link to a pseudo-terminal whose number changes from run to run.
#pragma once

#include <stdexcept>
#include <string>

#include "pty/port_claim.h"

namespace understudy::pty {

/// A port could not be opened: one line that names the path and what was expected.
struct PortError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class PortLink {
 public:
  PortLink() = default;  // no link

  /// Links `path` to `target`. What is there is replaced if it is a stale link: a symbolic link that
  /// dangles, or one to a /dev/pts entry (left by a run that was killed; its number may be another
  /// program's by now). A link that another run serves, and anything else, is left alone: throws PortError.
  PortLink(const std::string& path, std::string target);
  /// Removes the link, unless it now belongs to another process.
  ~PortLink();
  /// Links the same path to another target, in one step. Does nothing if there is no link, or if it now
  /// belongs to another process. Throws PortError.
  void point_to(const std::string& target);
  PortLink(PortLink&& other) noexcept;
  PortLink& operator=(PortLink&& other) noexcept;

 private:
  std::string absolute_path_;  // the working directory may change before the link is removed
  std::string target_;         // empty: no link
  PortClaim claim_;            // says that the link is in use
};

}  // namespace understudy::pty
