// The control socket: a Unix stream socket that only its owner may open. A message is a line, so is its
// reply; what they say is for messages.h.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>

#include "emulator/edge/event_loop.h"

namespace understudy::emulator {

/// The socket could not be had: one line that names the path and what was expected.
struct ControlError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class ControlServer {
 public:
  using Reply = std::function<void(const std::string& line)>;  // may be called later, once
  using Handler = std::function<void(const std::string& line, const Reply& reply)>;

  /// A dead socket at `path` is replaced, anything else that is there is left alone. Throws ControlError.
  ControlServer(EventLoop& loop, std::string path, Handler handler);
  ~ControlServer();
  ControlServer(const ControlServer&) = delete;
  ControlServer& operator=(const ControlServer&) = delete;

  const std::string& path() const { return path_; }

 private:
  struct Client;
  void accept_clients();
  void on_client(int descriptor, std::uint32_t ready);
  void serve_lines(const std::shared_ptr<Client>& client);
  void send(const std::shared_ptr<Client>& client, const std::string& line);
  bool write_out(Client& client);
  void drop(int descriptor);

  EventLoop& loop_;
  std::string path_;
  Handler handler_;
  int listener_ = -1;
  std::uint64_t inode_ = 0;  // of our socket
  std::map<int, std::shared_ptr<Client>> clients_;
};

/// Where a daemon's socket is when nobody says otherwise: in $XDG_RUNTIME_DIR, or in a private folder
/// below /tmp.
std::string default_control_path();

/// Sends one message and waits for its reply, without the line's end. Throws ControlError.
std::string ask_control(const std::string& path, const std::string& message);

}  // namespace understudy::emulator
