#include "emulator/serve/control/server.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/types.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "base/files/descriptor.h"
#include "base/text/one_line.h"
#include "emulator/serve/loop/event_loop.h"
#include "emulator/serve/loop/listener.h"

namespace understudy::emulator::serve {

namespace {

// A program that fills a device fits in one message, and in one reply.
constexpr std::size_t kLongestMessage = 4 * 1024 * 1024;
constexpr std::size_t kMaxUnread = 8 * 1024 * 1024;
constexpr std::size_t kMaxClients = 256;

sockaddr_un address_of(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof(address.sun_path)) {
    throw ControlError(quoted(path) + ": is not a path for a socket; expected 1 to " +
                       std::to_string(sizeof(address.sun_path) - 1) + " characters");
  }
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  return address;
}

int connect_to(const std::string& path) {
  const sockaddr_un address = address_of(path);
  const int descriptor = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0) throw ControlError(path + ": " + std::strerror(errno));
  if (connect(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) < 0) {
    const int error = errno;
    close(descriptor);
    errno = error;
    return -1;
  }
  return descriptor;
}

/// If nothing answers at `path`, removes the socket there to make room for ours.
void remove_dead_socket(const std::string& path) {
  struct stat status {};
  if (lstat(path.c_str(), &status) < 0) return;
  if (!S_ISSOCK(status.st_mode)) throw ControlError(path + ": is not a socket; expected a free path");
  const int descriptor = connect_to(path);
  if (descriptor >= 0) {
    close(descriptor);
    throw ControlError(path + ": another understudy uses it; expected a free path");
  }
  if (errno == ECONNREFUSED) unlink(path.c_str());
}

}  // namespace

struct ControlServer::Client {
  Descriptor socket;
  bool is_awaiting = false;           // a reply has not been sent yet, and nothing is read until then
  bool has_finished_sending = false;  // the client has closed its sending side
  std::string input;                  // an incomplete message
  std::string output;
  std::size_t sent = 0;  // bytes of `output` that have been sent
};

ControlServer::ControlServer(EventLoop& loop, std::string path, Handler handler)
    : loop_(loop), path_(std::move(path)), handler_(std::move(handler)) {
  const sockaddr_un address = address_of(path_);
  remove_dead_socket(path_);
  Descriptor listener(socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!listener) throw ControlError(path_ + ": " + std::strerror(errno));
  // No other user may be able to open the socket, even for a moment.
  const mode_t before = umask(0177);
  const bool bound = bind(listener.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
  const int error = errno;
  umask(before);
  if (!bound || listen(listener.get(), 64) < 0) {
    throw ControlError(path_ + ": cannot be created: " + std::strerror(bound ? errno : error) +
                       "; expected a free path in a writable folder");
  }
  struct stat status {};
  if (lstat(path_.c_str(), &status) == 0) inode_ = status.st_ino;
  listener_ = std::make_unique<Listener>(
      loop_, std::move(listener), [this](Descriptor client) { admit(std::move(client)); },
      EventLoop::Rank::later);
}

ControlServer::~ControlServer() {
  while (!clients_.empty()) drop(clients_.begin()->first);
  listener_.reset();
  // Another daemon's socket may have this path by now.
  struct stat status {};
  if (lstat(path_.c_str(), &status) == 0 && status.st_ino == inode_) unlink(path_.c_str());
}

void ControlServer::admit(Descriptor socket) {
  if (clients_.size() >= kMaxClients) return;
  auto client = std::make_shared<Client>();
  client->socket = std::move(socket);
  const int descriptor = client->socket.get();
  clients_[descriptor] = client;
  loop_.watch(
      descriptor, EventLoop::readable,
      [this, descriptor](std::uint32_t ready) { on_client(descriptor, ready); }, EventLoop::Rank::later);
}

/// Handles one message per call. Further messages stay in the socket, so that other clients are also served.
void ControlServer::on_client(int descriptor, std::uint32_t ready) {
  const std::shared_ptr<Client> client = clients_.at(descriptor);
  if ((ready & EventLoop::writable) != 0 && !write_out(*client)) return drop(descriptor);
  if ((ready & EventLoop::readable) == 0) return;
  if (client->is_awaiting || client->has_finished_sending)
    return drop(descriptor);  // reading is disabled, so this event is a hang-up
  std::array<char, 4096> bytes;
  ssize_t count = recv(descriptor, bytes.data(), bytes.size(), MSG_PEEK);
  if (count > 0) {
    const void* const end = std::memchr(bytes.data(), '\n', static_cast<std::size_t>(count));
    if (end != nullptr) count = static_cast<const char*>(end) + 1 - bytes.data();
    count = recv(descriptor, bytes.data(), static_cast<std::size_t>(count), 0);
  }
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return;
  if (count < 0) return drop(descriptor);
  if (count == 0) {
    client->has_finished_sending = true;
    if (!write_out(*client)) drop(descriptor);
    return;
  }
  client->input.append(bytes.data(), static_cast<std::size_t>(count));
  const bool is_whole = client->input.back() == '\n';
  if (client->input.size() > kLongestMessage + (is_whole ? 1 : 0)) {
    send(client,
         R"({"ok":false,"error":"the message is too long; expected a line of at most 4194304 bytes"})");
    return drop(descriptor);
  }
  if (is_whole) serve(client);
}

void ControlServer::serve(const std::shared_ptr<Client>& client) {
  std::string line = std::exchange(client->input, {});
  line.pop_back();
  client->is_awaiting = true;
  handler_(line, [this, weak = std::weak_ptr<Client>(client)](const std::string& reply) {
    const auto alive = weak.lock();
    if (!alive) return;
    alive->is_awaiting = false;
    send(alive, reply);
  });
  // This also changes the awaited events, because nothing is read until the reply is sent.
  if (client->socket && client->is_awaiting) write_out(*client);
}

void ControlServer::send(const std::shared_ptr<Client>& client, const std::string& line) {
  if (!client->socket) return;
  // The contents of a device may exceed the maximum size of a reply.
  const bool is_too_long = line.size() >= kMaxUnread;
  client->output += is_too_long ? R"({"ok":false,"error":"the reply is longer than 8388608 bytes"})" : line;
  client->output += "\n";
  if (!write_out(*client) || client->output.size() - client->sent > kMaxUnread) drop(client->socket.get());
}

/// Returns false if the client is finished.
bool ControlServer::write_out(Client& client) {
  while (client.sent < client.output.size()) {
    const ssize_t count = ::send(client.socket.get(), client.output.data() + client.sent,
                                 client.output.size() - client.sent, MSG_NOSIGNAL);
    if (count < 0) {
      if (errno == EINTR) continue;
      if (errno != EAGAIN) return false;
      break;
    }
    client.sent += static_cast<std::size_t>(count);
  }
  if (client.sent == client.output.size()) {
    client.sent = 0;
    client.output = {};  // frees the memory of a large reply
  }
  if (client.has_finished_sending && client.output.empty()) return false;
  // Messages that follow an unanswered message stay in the socket.
  const std::uint32_t read = client.has_finished_sending || client.is_awaiting ? 0U : EventLoop::readable;
  const std::uint32_t write = client.output.empty() ? 0U : EventLoop::writable;
  loop_.change_interest(client.socket.get(), read | write);
  return true;
}

void ControlServer::drop(int descriptor) {
  const auto it = clients_.find(descriptor);
  if (it == clients_.end()) return;
  loop_.unwatch(descriptor);
  it->second->socket.close();  // closes it even if other objects still refer to the client
  clients_.erase(it);
  listener_->try_again();
}

bool is_answered(const std::string& path) {
  const int descriptor = connect_to(path);
  if (descriptor < 0) return false;
  close(descriptor);
  return true;
}

std::string ask_control(const std::string& path, const std::string& message,
                        std::optional<std::chrono::milliseconds> patience) {
  const int descriptor = connect_to(path);
  if (descriptor < 0) {
    throw ControlError(path + ": no answer (" + std::strerror(errno) +
                       "); expected the control socket of a running `understudy serve`");
  }
  if (patience) {
    const timeval time{patience->count() / 1000, (patience->count() % 1000) * 1000};
    setsockopt(descriptor, SOL_SOCKET, SO_RCVTIMEO, &time, sizeof(time));
    setsockopt(descriptor, SOL_SOCKET, SO_SNDTIMEO, &time, sizeof(time));
  }
  std::string reply;
  const std::string line = message + "\n";
  std::size_t sent = 0;
  while (sent < line.size()) {
    const ssize_t count = ::send(descriptor, line.data() + sent, line.size() - sent, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) break;  // there may still be a reply that contains the reason
    sent += static_cast<std::size_t>(count);
  }
  std::array<char, 4096> bytes;
  while (reply.empty() || reply.back() != '\n') {
    const ssize_t count = recv(descriptor, bytes.data(), bytes.size(), 0);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    reply.append(bytes.data(), static_cast<std::size_t>(count));
  }
  close(descriptor);
  if (reply.empty() || reply.back() != '\n')
    throw ControlError(path + ": the daemon closed the connection before it answered");
  reply.pop_back();
  return reply;
}

}  // namespace understudy::emulator::serve
