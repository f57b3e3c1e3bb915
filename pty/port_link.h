// Keeps a port's path stable: a symbolic link leads to a pseudo-terminal, whose number changes from run to
// run.
#pragma once

#include <stdexcept>
#include <string>

#include "pty/port_claim.h"

namespace understudy::pty {

/// Thrown if a port could not be opened. The message is one line that names the path and what was expected.
struct PortError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Returns the text of a kernel error, with the number of files that this program may open if that is the
/// cause.
std::string port_trouble(int error);

class PortLink {
 public:
  PortLink() = default;  // no link

  /// Links `path` to `target`. It replaces a stale link: a symbolic link that dangles, or one to a /dev/pts
  /// entry (left by a run that was killed; its number may belong to another program by now). It throws
  /// PortError for a link that another run serves, and for anything else at `path`.
  PortLink(const std::string& path, std::string target);
  /// Removes the link, unless it belongs to another process by now.
  ~PortLink();
  /// Links the same path to another target, in one step. It does nothing if there is no link, or if the link
  /// belongs to another process by now. Throws PortError.
  void point_to(const std::string& target);
  PortLink(PortLink&& other) noexcept;
  PortLink& operator=(PortLink&& other) noexcept;

 private:
  std::string absolute_path_;  // the working directory may change before the link is removed
  std::string target_;         // empty: no link
  PortClaim claim_;            // marks the link as in use
};

}  // namespace understudy::pty
