// The TCP addresses of the bench (docs/host-time.md). A socket that connects to one is replaced by a local
// socket to the bench: its bytes arrive as soon as they are written, and no other program sees the address.
// Calls of the host are answered as if it were still a TCP socket.
#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <unistd.h>

#include <initializer_list>

#include "pty/host_time/shim.h"

using namespace understudy::host_time;

namespace {

/// Returns the number of the door, or -1.
int door_at(const sockaddr* address, socklen_t size) {
  char text[INET6_ADDRSTRLEN] = "";
  bool is_here = false;
  in_port_t port = 0;
  if (address->sa_family == AF_INET && size >= sizeof(sockaddr_in)) {
    sockaddr_in four;
    memcpy(&four, address, sizeof four);
    port = ntohs(four.sin_port);
    is_here = ntohl(four.sin_addr.s_addr) >> IN_CLASSA_NSHIFT == IN_LOOPBACKNET ||
              four.sin_addr.s_addr == INADDR_ANY;
    inet_ntop(AF_INET, &four.sin_addr, text, sizeof text);
  } else if (address->sa_family == AF_INET6 && size >= sizeof(sockaddr_in6)) {
    sockaddr_in6 six;
    memcpy(&six, address, sizeof six);
    port = ntohs(six.sin6_port);
    if (IN6_IS_ADDR_V4MAPPED(&six.sin6_addr)) {
      is_here = six.sin6_addr.s6_addr[12] == IN_LOOPBACKNET;
      inet_ntop(AF_INET, &six.sin6_addr.s6_addr[12], text, sizeof text);
    } else {
      is_here = IN6_IS_ADDR_LOOPBACK(&six.sin6_addr) || IN6_IS_ADDR_UNSPECIFIED(&six.sin6_addr);
      inet_ntop(AF_INET6, &six.sin6_addr, text, sizeof text);
    }
  } else {
    return -1;
  }
  const Page& bench = the_page();
  for (uint32_t i = 0; i < bench.door_count; ++i) {
    const Door& door = bench.doors[i];
    const bool is_same = door.address[0] == '\0' ? is_here : strcmp(door.address, text) == 0;
    if (door.port == port && is_same) return static_cast<int>(i);
  }
  return -1;
}

bool is_stream(int descriptor) {
  int type = 0;
  socklen_t size = sizeof type;
  return UNDERSTUDY_REAL(getsockopt)(descriptor, SOL_SOCKET, SO_TYPE, &type, &size) == 0 &&
         type == SOCK_STREAM;
}

/// Replaces the host's socket with a local one that is connected to the bench. Returns as connect() does.
int connect_to_door(int descriptor, int door) {
  if (is_door(descriptor, nullptr)) {
    errno = EISCONN;
    return -1;
  }
  sockaddr_un address = {};
  address_of_door(door, &address);
  const int flags = fcntl(descriptor, F_GETFL);
  const int close_flags = fcntl(descriptor, F_GETFD);
  const int local = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (local < 0) return -1;
  for (const int limit : {SO_RCVTIMEO, SO_SNDTIMEO}) {
    timeval length = {};
    socklen_t length_size = sizeof length;
    if (UNDERSTUDY_REAL(getsockopt)(descriptor, SOL_SOCKET, limit, &length, &length_size) == 0)
      UNDERSTUDY_REAL(setsockopt)(local, SOL_SOCKET, limit, &length, length_size);
  }
  if (UNDERSTUDY_REAL(connect)(local, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      dup3(local, descriptor, (close_flags & FD_CLOEXEC) != 0 ? O_CLOEXEC : 0) < 0) {
    UNDERSTUDY_REAL(syscall)(SYS_close, local);
    errno = ECONNREFUSED;
    return -1;
  }
  UNDERSTUDY_REAL(syscall)(SYS_close, local);
  if (flags >= 0) fcntl(descriptor, F_SETFL, flags);
  return 0;
}

/// Returns an address of this machine as getpeername() does.
void put_address(in_addr_t host, uint16_t port, sockaddr* place, socklen_t* size) {
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = host;
  memcpy(place, &address, *size < sizeof address ? *size : sizeof address);
  *size = sizeof address;
}

/// Waits until a read of the socket would not block. Returns false, with errno set, if it must not be tried.
bool wait_for_socket(int descriptor, int number, int flags) {
  const int modes = fcntl(descriptor, F_GETFL);
  if ((flags & MSG_DONTWAIT) != 0 || modes < 0 || (modes & O_NONBLOCK) != 0) return true;
  timeval length = {};
  socklen_t size = sizeof length;
  UNDERSTUDY_REAL(getsockopt)(descriptor, SOL_SOCKET, SO_RCVTIMEO, &length, &size);
  const int64_t length_ns = ns_of(length);
  Wait wait;
  wait.add_line(number);
  wait.is_restartable = length_ns <= 0;
  if (length_ns > 0) wait.until_ns = after(length_ns);
  while (true) {
    pollfd entry = {descriptor, POLLIN, 0};
    if (UNDERSTUDY_REAL(poll)(&entry, 1, 0) != 0) return true;
    if (now_ns() >= wait.until_ns) {
      errno = EAGAIN;
      return false;
    }
    if (wait_for(wait) == Woken::by_signal) {
      errno = EINTR;
      return false;
    }
  }
}

/// Returns true for one end of a socketpair(). Its other end is a process of the host; other sockets may lead
/// elsewhere, for example to the control socket of the bench, and are waited for in real time.
bool is_of_a_pair(int descriptor) {
  sockaddr_storage peer = {};
  socklen_t size = sizeof peer;
  const int error = errno;
  const int result = UNDERSTUDY_REAL(getpeername)(descriptor, reinterpret_cast<sockaddr*>(&peer), &size);
  errno = error;
  return result == 0 && peer.ss_family == AF_UNIX && size == sizeof(sa_family_t);
}

/// Waits until a read of a socket that is no door would not block, if the socket has a timeout (SO_RCVTIMEO):
/// the kernel would count it in real time. Returns false, with errno set, if the read must not be tried.
bool wait_for_peer(int descriptor, int flags) {
  if (!is_of_a_pair(descriptor)) return true;
  timeval length = {};
  socklen_t size = sizeof length;
  const int error = errno;
  const int result = UNDERSTUDY_REAL(getsockopt)(descriptor, SOL_SOCKET, SO_RCVTIMEO, &length, &size);
  errno = error;
  const int64_t length_ns = result == 0 ? ns_of(length) : 0;
  if (length_ns <= 0 || (flags & MSG_DONTWAIT) != 0) return true;
  const int modes = fcntl(descriptor, F_GETFL);
  if (modes < 0 || (modes & O_NONBLOCK) != 0) return true;
  pollfd entry = {descriptor, POLLIN, 0};
  const timespec time = time_of(length_ns);
  const int ready = ppoll(&entry, 1, &time, nullptr);
  if (ready == 0) errno = EAGAIN;
  return ready > 0;
}

/// Receives bytes; with MSG_WAITALL, until all have arrived.
ssize_t receive(int descriptor, int number, void* place, size_t size, int flags, sockaddr* from,
                socklen_t* from_size) {
  size_t done = 0;
  do {
    if (!wait_for_socket(descriptor, number, flags)) return done > 0 ? static_cast<ssize_t>(done) : -1;
    const ssize_t got = UNDERSTUDY_REAL(recvfrom)(descriptor, static_cast<char*>(place) + done, size - done,
                                                  flags & ~MSG_WAITALL, nullptr, nullptr);
    if (got <= 0) return done > 0 ? static_cast<ssize_t>(done) : got;
    done += static_cast<size_t>(got);
  } while ((flags & (MSG_WAITALL | MSG_PEEK)) == MSG_WAITALL && done < size);
  if (from != nullptr && from_size != nullptr) getpeername(descriptor, from, from_size);
  return static_cast<ssize_t>(done);
}

}  // namespace

namespace understudy::host_time {

bool is_door(int descriptor, int* number) {
  if (the_page().door_count == 0) return false;
  sockaddr_un peer;
  socklen_t size = sizeof peer;
  const int error = errno;
  const int result = UNDERSTUDY_REAL(getpeername)(descriptor, reinterpret_cast<sockaddr*>(&peer), &size);
  errno = error;
  if (result != 0 || peer.sun_family != AF_UNIX || size <= offsetof(sockaddr_un, sun_path)) return false;
  const int door = number_of_door(peer);
  if (door < 0) return false;
  if (number != nullptr) *number = kFirstDoor + door;
  return true;
}

bool wait_for_connection(int descriptor) {
  int number = -1;
  return is_door(descriptor, &number) ? wait_for_socket(descriptor, number, 0) : wait_for_peer(descriptor, 0);
}

}  // namespace understudy::host_time

UNDERSTUDY_EXPORT int connect(int descriptor, const sockaddr* address, socklen_t size) {
  const int door = is_active() && address != nullptr && is_stream(descriptor) ? door_at(address, size) : -1;
  return door < 0 ? UNDERSTUDY_REAL(connect)(descriptor, address, size) : connect_to_door(descriptor, door);
}

UNDERSTUDY_EXPORT int getpeername(int descriptor, sockaddr* place, socklen_t* size) noexcept {
  int number = -1;
  if (!is_active() || !is_door(descriptor, &number))
    return UNDERSTUDY_REAL(getpeername)(descriptor, place, size);
  const Door& door = the_page().doors[number - kFirstDoor];
  in_addr_t host = htonl(INADDR_LOOPBACK);
  if (door.address[0] != '\0') inet_pton(AF_INET, door.address, &host);
  put_address(host, door.port, place, size);
  return 0;
}

UNDERSTUDY_EXPORT int getsockname(int descriptor, sockaddr* place, socklen_t* size) noexcept {
  constexpr uint16_t kFirstFree = 49'152;
  if (!is_active() || !is_door(descriptor, nullptr))
    return UNDERSTUDY_REAL(getsockname)(descriptor, place, size);
  put_address(htonl(INADDR_LOOPBACK), static_cast<uint16_t>(kFirstFree + descriptor), place, size);
  return 0;
}

/// A local socket lacks TCP's options, such as TCP_NODELAY. Setting one succeeds and has no effect.
UNDERSTUDY_EXPORT int setsockopt(int descriptor, int level, int name, const void* value,
                                 socklen_t size) noexcept {
  const int result = UNDERSTUDY_REAL(setsockopt)(descriptor, level, name, value, size);
  const bool is_of_tcp = result != 0 && level != SOL_SOCKET && is_active() && is_door(descriptor, nullptr);
  return is_of_tcp ? 0 : result;
}

UNDERSTUDY_EXPORT int getsockopt(int descriptor, int level, int name, void* value, socklen_t* size) noexcept {
  const bool is_ours = is_active() && is_door(descriptor, nullptr);
  if (is_ours && level == SOL_SOCKET && name == SO_DOMAIN && *size >= sizeof(int)) {
    const int domain = AF_INET;
    memcpy(value, &domain, sizeof domain);
    return 0;
  }
  const int result = UNDERSTUDY_REAL(getsockopt)(descriptor, level, name, value, size);
  if (result == 0 || level == SOL_SOCKET || !is_ours) return result;
  memset(value, 0, *size);
  return 0;
}

UNDERSTUDY_EXPORT ssize_t recv(int descriptor, void* place, size_t size, int flags) {
  int number = -1;
  if (!is_active()) return UNDERSTUDY_REAL(recv)(descriptor, place, size, flags);
  if (!is_door(descriptor, &number))
    return wait_for_peer(descriptor, flags) ? UNDERSTUDY_REAL(recv)(descriptor, place, size, flags) : -1;
  return receive(descriptor, number, place, size, flags, nullptr, nullptr);
}

UNDERSTUDY_EXPORT ssize_t __recv_chk(int descriptor, void* place, size_t size, size_t room, int flags) {
  if (size > room) abort();
  return recv(descriptor, place, size, flags);
}

UNDERSTUDY_EXPORT ssize_t recvfrom(int descriptor, void* place, size_t size, int flags, sockaddr* from,
                                   socklen_t* from_size) {
  int number = -1;
  const bool is_ours = is_active() && is_door(descriptor, &number);
  if (is_active() && !is_ours && !wait_for_peer(descriptor, flags)) return -1;
  if (!is_ours) return UNDERSTUDY_REAL(recvfrom)(descriptor, place, size, flags, from, from_size);
  return receive(descriptor, number, place, size, flags, from, from_size);
}

UNDERSTUDY_EXPORT ssize_t __recvfrom_chk(int descriptor, void* place, size_t size, size_t room, int flags,
                                         sockaddr* from, socklen_t* from_size) {
  if (size > room) abort();
  return recvfrom(descriptor, place, size, flags, from, from_size);
}

UNDERSTUDY_EXPORT ssize_t recvmsg(int descriptor, msghdr* message, int flags) {
  int number = -1;
  const bool is_ours = is_active() && is_door(descriptor, &number);
  if (is_ours && !wait_for_socket(descriptor, number, flags)) return -1;
  if (is_active() && !is_ours && !wait_for_peer(descriptor, flags)) return -1;
  return UNDERSTUDY_REAL(recvmsg)(descriptor, message, flags);
}
