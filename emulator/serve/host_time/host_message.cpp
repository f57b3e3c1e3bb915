#include "emulator/serve/host_time/host_message.h"

#include <sys/socket.h>
#include <sys/uio.h>

#include <array>
#include <cstring>

#include "base/files/descriptor.h"
#include "pty/host_time/protocol.h"

namespace understudy::emulator::serve {

ssize_t receive_message(int socket, host_time::Message& message, Descriptor& passed) {
  iovec part{&message, sizeof message};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
  msghdr header{};
  header.msg_iov = &part;
  header.msg_iovlen = 1;
  header.msg_control = control.data();
  header.msg_controllen = control.size();
  const ssize_t size = recvmsg(socket, &header, MSG_DONTWAIT | MSG_CMSG_CLOEXEC);
  const cmsghdr* const attached = size < 0 ? nullptr : CMSG_FIRSTHDR(&header);
  if (attached != nullptr && attached->cmsg_type == SCM_RIGHTS) {
    int descriptor = -1;
    std::memcpy(&descriptor, CMSG_DATA(attached), sizeof descriptor);
    passed = Descriptor(descriptor);
  }
  return size;
}

}  // namespace understudy::emulator::serve
