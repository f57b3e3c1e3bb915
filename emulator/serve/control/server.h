// The control socket: a Unix stream socket that only its owner can open. Each message is one line, and so is
// its reply. messages.h interprets the messages.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "base/files/descriptor.h"
#include "emulator/serve/daemon/door.h"
#include "emulator/serve/loop/event_loop.h"
#include "emulator/serve/loop/listener.h"

namespace understudy::emulator::serve {

/// Thrown if the socket could not be opened. The message is one line with the path and what was expected.
struct ControlError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class ControlServer final : public Door {
 public:
  using Reply = std::function<void(const std::string& line)>;  // may be called later, but only once
  using Handler = std::function<void(const std::string& line, const Reply& reply)>;

  /// Replaces a dead socket at `path`, but no other file. Throws ControlError.
  ControlServer(EventLoop& loop, std::string path, Handler handler);
  ~ControlServer() override;
  ControlServer(const ControlServer&) = delete;
  ControlServer& operator=(const ControlServer&) = delete;

  const std::string& path() const override { return path_; }

 private:
  struct Client;
  void admit(Descriptor socket);
  void on_client(int descriptor, std::uint32_t ready);
  void serve(const std::shared_ptr<Client>& client);
  void send(const std::shared_ptr<Client>& client, const std::string& line);
  bool write_out(Client& client);
  void drop(int descriptor);

  EventLoop& loop_;
  std::string path_;
  Handler handler_;
  std::unique_ptr<Listener> listener_;
  std::uint64_t inode_ = 0;  // identifies our socket
  std::map<int, std::shared_ptr<Client>> clients_;
};

/// Returns true if a process is listening at that path.
bool is_answered(const std::string& path);

/// Sends a message and waits for its reply, at most for `patience` if that is set. Returns the reply without
/// its line ending. Throws ControlError.
std::string ask_control(const std::string& path, const std::string& message,
                        std::optional<std::chrono::milliseconds> patience = {});

}  // namespace understudy::emulator::serve
