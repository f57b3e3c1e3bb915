#include "pty/port_claim.h"

#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <system_error>

namespace understudy::pty {

Descriptor claim_link(const std::string& canonical_path) {
  Descriptor claim(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (!claim) throw std::system_error(errno, std::generic_category(), "socket");
  sockaddr_un address = {};
  address.sun_family = AF_UNIX;
  // A name that begins with a zero byte is abstract. Paths are longer than names may be: their FNV-1a hash.
  std::uint64_t hash = 0xCBF29CE484222325;
  for (const char c : canonical_path) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3;
  const std::string name = std::string(1, '\0') + "understudy link " + std::to_string(hash);
  std::copy(name.begin(), name.end(), address.sun_path);
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
  if (::bind(claim.get(), reinterpret_cast<const sockaddr*>(&address), size) == 0) return claim;
  if (errno != EADDRINUSE) throw std::system_error(errno, std::generic_category(), "bind");
  return Descriptor();
}

}  // namespace understudy::pty
