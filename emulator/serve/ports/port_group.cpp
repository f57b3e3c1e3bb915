#include "emulator/serve/ports/port_group.h"

#include <grp.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>

#include "base/text/parse_integer.h"
#include "pty/port_link.h"

namespace understudy::emulator::serve {

std::optional<gid_t> find_group(const std::string& name) {
  if (const group* const found = getgrnam(name.c_str())) return found->gr_gid;
  const auto number = parse_integer(name);
  if (!number || *number < 0 || *number >= UINT32_MAX) return std::nullopt;  // the last number means "none"
  return static_cast<gid_t>(*number);
}

void share_port(const std::string& path, gid_t group) {
  constexpr mode_t kOwnerAndGroup = S_IRUSR | S_IWUSR | S_IRGRP | S_IWGRP;
  // The group must be set first, because the old group must not gain access.
  if (chown(path.c_str(), static_cast<uid_t>(-1), group) != 0 || chmod(path.c_str(), kOwnerAndGroup) != 0) {
    throw pty::PortError(path + ": cannot be given to group " + std::to_string(group) + ": " +
                         std::strerror(errno) + "; expected a group that you are a member of");
  }
}

}  // namespace understudy::emulator::serve
