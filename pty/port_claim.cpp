#include "pty/port_claim.h"

#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <cstddef>

namespace understudy::pty {

Descriptor claim_port(const std::string& terminal) {
  Descriptor claim(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (!claim) return claim;
  sockaddr_un address = {};
  address.sun_family = AF_UNIX;
  // A name that begins with a zero byte is abstract.
  const std::string name = std::string(1, '\0') + "understudy serves " + terminal;
  if (name.size() > sizeof address.sun_path) return Descriptor();
  std::copy(name.begin(), name.end(), address.sun_path);
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
  if (::bind(claim.get(), reinterpret_cast<const sockaddr*>(&address), size) != 0) return Descriptor();
  return claim;
}

bool is_port_claimed(const std::string& terminal) { return !claim_port(terminal); }

}  // namespace understudy::pty
