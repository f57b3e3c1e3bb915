// Calls that wait for descriptors, or read and write them.
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/epoll.h>
#include <sys/select.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <termios.h>
#include <unistd.h>

#include <climits>

#include "tests/calling_host/calls.h"

namespace calling_host {

namespace {

std::string text_of(const fd_set& set) {
  std::string text;
  for (int i = 0; i < FD_SETSIZE; ++i) {
    if (FD_ISSET(i, &set)) text += " " + std::to_string(i);
  }
  return "{" + text + " }";
}

/// A wait without end needs something that is ready.
void poll_some(Drawer& draw, const Descriptors& descriptors) {
  std::array<pollfd, 6> entries{};
  int count = draw.below(6);
  for (int i = 0; i < count; ++i) {
    const auto events = draw.one_of<short>({0, POLLIN, POLLOUT, POLLIN | POLLOUT, POLLPRI, -1});
    entries[static_cast<std::size_t>(i)] = {descriptors.any(draw), events,
                                            static_cast<short>(draw.below(64))};
  }
  const bool is_endless = draw.one_in(4);
  if (is_endless) entries[static_cast<std::size_t>(count++)] = {descriptors.ready(), POLLIN, 0};
  nfds_t asked = static_cast<nfds_t>(count);
  if (draw.one_in(12)) asked = draw.one_of<nfds_t>({ULONG_MAX, INT_MAX, 1UL << 31});
  std::string call = "(" + std::to_string(asked);
  for (int i = 0; i < count; ++i) {
    const pollfd& entry = entries[static_cast<std::size_t>(i)];
    call += ", " + std::to_string(entry.fd) + ":" + std::to_string(entry.events);
  }
  sigset_t mask;
  sigemptyset(&mask);
  if (draw.one_in(2)) {
    const int timeout = is_endless ? draw.one_of({-1, INT_MIN}) : draw.below(3);
    call = "poll" + call + ", " + std::to_string(timeout) + ")";
    tell(call, result_of([&] { return poll(entries.data(), asked, timeout); }));
  } else {
    const timespec length = draw.length();
    const sigset_t* const given = draw.one_in(2) ? &mask : nullptr;
    call = "ppoll" + call + ", " + (is_endless ? "none" : calling_host::text_of(length)) + ")";
    tell(call,
         result_of([&] { return ppoll(entries.data(), asked, is_endless ? nullptr : &length, given); }));
  }
  for (const pollfd& entry : entries) tell("  " + std::to_string(entry.revents));
}

void select_some(Drawer& draw, const Descriptors& descriptors) {
  std::array<fd_set, 3> sets{};
  int max = 0;
  for (fd_set& set : sets) {
    for (int i = draw.below(4); i > 0; --i) {
      const int descriptor = descriptors.any(draw);
      if (descriptor < 0 || descriptor >= FD_SETSIZE || (descriptor == 99 && !draw.one_in(4))) continue;
      FD_SET(descriptor, &set);
      max = std::max(max, descriptor + 1);
    }
  }
  const bool is_endless = draw.one_in(4);
  if (is_endless) {
    FD_SET(descriptors.ready(), sets.data());
    max = std::max(max, descriptors.ready() + 1);
  }
  if (draw.one_in(6)) max = is_endless ? FD_SETSIZE : draw.one_of({-1, INT_MIN, 0, 1, FD_SETSIZE});
  fd_set* reads = is_endless || !draw.one_in(3) ? sets.data() : nullptr;
  fd_set* writes = draw.one_in(2) ? &sets[1] : nullptr;
  fd_set* excepts = draw.one_in(2) ? &sets[2] : nullptr;
  std::string call = "(" + std::to_string(max);
  for (const fd_set& set : sets) call += ", " + text_of(set);
  if (draw.one_in(2)) {
    timeval length = draw.short_length();
    call = "select" + call + ", " +
           (is_endless ? "none" : std::to_string(length.tv_sec) + "." + std::to_string(length.tv_usec)) + ")";
    const long result =
        result_of([&] { return select(max, reads, writes, excepts, is_endless ? nullptr : &length); });
    tell(call, result);
    if (!is_endless && result == 0)
      tell("  rest " + std::to_string(length.tv_sec) + "." + std::to_string(length.tv_usec));
  } else {
    const timespec length = draw.length();
    call = "pselect" + call + ", " + (is_endless ? "none" : calling_host::text_of(length)) + ")";
    tell(call, result_of([&] {
           return pselect(max, reads, writes, excepts, is_endless ? nullptr : &length, nullptr);
         }));
  }
  for (const fd_set& set : sets) tell("  " + text_of(set));
}

}  // namespace

void poll_or_select(Drawer& draw, const Descriptors& descriptors) {
  return draw.one_in(2) ? poll_some(draw, descriptors) : select_some(draw, descriptors);
}

void wait_for_epoll(Drawer& draw, const Descriptors& descriptors) {
  std::array<epoll_event, 4> events{};
  const bool is_ready = draw.one_in(2);
  const int epoll = is_ready ? descriptors.ready_epoll() : descriptors.any(draw);
  const int count = draw.one_of({4, 1, 0, -1, INT_MIN});
  const int timeout = is_ready ? draw.one_of({-1, 0, INT_MIN}) : draw.below(3);
  const std::string call = "(" + std::to_string(epoll) + ", " + std::to_string(count) + ", ";
  switch (draw.below(3)) {
    case 0:
      return tell("epoll_wait" + call + std::to_string(timeout) + ")",
                  result_of([&] { return epoll_wait(epoll, events.data(), count, timeout); }));
    case 1:
      return tell("epoll_pwait" + call + std::to_string(timeout) + ")",
                  result_of([&] { return epoll_pwait(epoll, events.data(), count, timeout, nullptr); }));
    default: {
      const timespec length = draw.length();
      tell("epoll_pwait2" + call + text_of(length) + ")",
           result_of([&] { return epoll_pwait2(epoll, events.data(), count, &length, nullptr); }));
    }
  }
}

void read_or_write(Drawer& draw, const Descriptors& descriptors) {
  std::array<char, 16> place{};
  const int descriptor = descriptors.any(draw);
  pollfd entry{descriptor, POLLIN, 0};
  // A read that would wait is for other tests, and what is ready stays so.
  const bool is_harmless = poll(&entry, 1, 0) == 0 || (entry.revents & POLLNVAL) != 0;
  const std::string call = "(" + std::to_string(descriptor);
  switch (draw.below(6)) {
    case 0: return tell("read" + call + ", 0)", result_of([&] { return read(descriptor, place.data(), 0); }));
    case 1: {
      const iovec part{place.data(), 0};
      const int count = draw.one_of({1, 0, -1, IOV_MAX + 1, INT_MAX, INT_MIN});
      return tell("readv" + call + ", empty, " + std::to_string(count) + ")",
                  result_of([&] { return readv(descriptor, &part, count); }));
    }
    case 2: {
      if (!is_harmless) return tell("read" + call + ") is left out");
      const int flags = fcntl(descriptor, F_GETFL);
      fcntl(descriptor, F_SETFL, flags | O_NONBLOCK);
      tell("read" + call + ", 8)", result_of([&] { return read(descriptor, place.data(), 8); }));
      fcntl(descriptor, F_SETFL, flags);
      return;
    }
    case 3:
      return tell("write" + call + ", 0)", result_of([&] { return write(descriptor, place.data(), 0); }));
    case 4: return tell("tcdrain" + call + ")", result_of([&] { return tcdrain(descriptor); }));
    default: {
      termios settings{};
      const int when = draw.one_of({TCSANOW, TCSADRAIN, TCSAFLUSH, 77, -1});
      const bool is_terminal = tcgetattr(descriptor, &settings) == 0;
      tell("tcsetattr" + call + ", " + std::to_string(when) + ") of " +
               (is_terminal ? "a terminal" : "another"),
           result_of([&] { return tcsetattr(descriptor, when, &settings); }));
    }
  }
}

void use_a_socket(Drawer& draw, const Descriptors& descriptors) {
  std::array<char, 64> place{};
  const int descriptor = descriptors.any(draw);
  const std::string call = "(" + std::to_string(descriptor);
  auto* const address = reinterpret_cast<sockaddr*>(place.data());
  socklen_t size = draw.one_of<socklen_t>({sizeof place, 0, 2, 7});
  const int number = draw.one_of({SO_TYPE, SO_ERROR, SO_DOMAIN, 9999, -1});
  const int level = draw.one_of<int>({SOL_SOCKET, IPPROTO_TCP, -1});
  switch (draw.below(7)) {
    case 0:
      return tell("recv" + call + ", 8, DONTWAIT | PEEK)",
                  result_of([&] { return recv(descriptor, place.data(), 8, MSG_DONTWAIT | MSG_PEEK); }));
    case 1:
      return tell("recvfrom" + call + ")", result_of([&] {
                    return recvfrom(descriptor, place.data(), 8, MSG_DONTWAIT | MSG_PEEK, nullptr, nullptr);
                  }));
    case 2: {
      msghdr message{};
      return tell("recvmsg" + call + ")",
                  result_of([&] { return recvmsg(descriptor, &message, MSG_DONTWAIT | MSG_PEEK); }));
    }
    case 3:
      return tell("getpeername" + call + ", " + std::to_string(size) + ")",
                  result_of([&] { return getpeername(descriptor, address, &size); }));
    case 4:
      return tell("getsockopt" + call + ", " + std::to_string(level) + ", " + std::to_string(number) + ", " +
                      std::to_string(size) + ")",
                  result_of([&] { return getsockopt(descriptor, level, number, place.data(), &size); }));
    case 5:
      return tell("setsockopt" + call + ", " + std::to_string(level) + ", " + std::to_string(number) + ")",
                  result_of([&] { return setsockopt(descriptor, level, number, place.data(), size); }));
    default: {
      sockaddr_in nowhere{};
      nowhere.sin_family = draw.one_of<sa_family_t>({AF_INET, AF_INET6, 77});
      const auto given = draw.one_of<socklen_t>({sizeof nowhere, 0, 4, 1000});
      const bool is_bad =
          nowhere.sin_family != AF_INET || given != sizeof nowhere;  // else it changes the socket
      if (!is_bad) return tell("connect is left out");
      tell(
          "connect" + call + ", family " + std::to_string(nowhere.sin_family) + ", " + std::to_string(given) +
              ")",
          result_of([&] { return connect(descriptor, reinterpret_cast<const sockaddr*>(&nowhere), given); }));
    }
  }
}

}  // namespace calling_host
