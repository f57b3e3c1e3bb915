#include "emulator/dap/bench_link.h"

#include <poll.h>
#include <sys/socket.h>
#include <sys/types.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "base/files/descriptor.h"
#include "base/text/one_line.h"
#include "emulator/serve/control/server.h"

namespace understudy::emulator::dap {

namespace {

constexpr int kAgainMs = 50;

std::string line_of(const Json& message) {
  return message.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

Json judged_reply(const std::string& line) {
  Json reply = Json::parse(line, nullptr, false);
  if (!reply.is_object() || !reply.contains("ok"))
    throw RequestError(
        "the socket is not an Understudy socket; expected the control socket of `understudy serve`");
  if (reply["ok"] != true) throw RequestError(one_line(reply.value("error", std::string("refused"))));
  return reply;
}

Json SocketLink::ask(const Json& message) const {
  try {
    return judged_reply(serve::ask_control(socket_, line_of(message)));
  } catch (const serve::ControlError& error) {
    throw GoneError(one_line(error.what()));
  }
}

void SocketLink::begin(const Json& message) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (socket_.size() >= sizeof address.sun_path) throw RequestError(socket_ + ": the path is too long");
  socket_.copy(static_cast<char*>(address.sun_path), socket_.size());
  awaited_ = Descriptor(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  received_.clear();
  const std::string line = line_of(message) + "\n";
  const bool is_sent =
      awaited_.get() >= 0 &&
      connect(awaited_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 &&
      send(awaited_.get(), line.data(), line.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(line.size());
  if (is_sent) return;
  awaited_ = Descriptor();
  throw GoneError(socket_ + ": no daemon answers; expected a running `understudy serve`");
}

std::optional<Json> SocketLink::take_reply() {
  std::array<char, 4096> some{};
  const ssize_t got = recv(awaited_.get(), some.data(), some.size(), MSG_DONTWAIT);
  if (got < 0 && (errno == EAGAIN || errno == EINTR)) return std::nullopt;
  if (got <= 0) {
    awaited_ = Descriptor();
    throw GoneError("the bench has ended");
  }
  received_.append(some.data(), static_cast<std::size_t>(got));
  if (!received_.ends_with('\n')) return std::nullopt;
  awaited_ = Descriptor();
  return judged_reply(received_);
}

void SocketLink::pause() {
  ask({{"do", "pause"}});
  while (awaited_.get() >= 0) {
    pollfd wait{.fd = awaited_.get(), .events = POLLIN, .revents = 0};
    if (poll(&wait, 1, kAgainMs) == 0) ask({{"do", "pause"}});  // `pause` came before the advance began
    try {
      take_reply();
    } catch (const GoneError&) {
      throw;
    } catch (const RequestError&) {  // nobody needs the reply any more
    }
  }
}

}  // namespace understudy::emulator::dap
