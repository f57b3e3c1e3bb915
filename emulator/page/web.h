// The page's way to browsers and to control sockets: HTTP and WebSocket on one port, lines of text on Unix
// sockets. One thread. What the messages say is known elsewhere (page.h); what a request may look like is
// known in access.h.
//
// Boost.Beast is slow to compile, so only web.cpp includes it.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "emulator/page/access.h"

namespace understudy::emulator::page {

/// The port cannot be opened: one line.
struct WebError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A browser's WebSocket, while it is open; numbers are never used again.
using BrowserId = std::uint64_t;

/// A file that browsers may have.
struct WebFile {
  std::string type;  // "text/html; charset=utf-8"
  std::string bytes;
};

/// What comes of what browsers do.
class WebEvents {
 public:
  virtual std::optional<WebFile> file(std::string_view path) = 0;
  virtual void opened(BrowserId browser) = 0;
  virtual void heard(BrowserId browser, std::string_view text) = 0;
  /// Also after close().
  virtual void closed(BrowserId browser) = 0;
  /// Everything that was sent is on its way.
  virtual void drained(BrowserId browser) = 0;

 protected:
  ~WebEvents() = default;
};

struct WebLimits {
  std::size_t strangers = 64;                 // connections of those who are not welcome yet
  std::size_t request_bytes = 8 * 1024;       // of a request's head; it has no body
  std::size_t message_bytes = 64 * 1024;      // of a browser's
  std::size_t waiting_bytes = 8 << 20;        // for a browser that does not read; it is closed then
  std::size_t reply_bytes = 16 << 20;         // of a control socket's
  std::chrono::milliseconds request{5'000};   // for a whole request
  std::chrono::milliseconds silence{30'000};  // of a browser that does not even answer pings
};

/// A control socket, connected when it is first asked. Replies come in the order of the messages.
class ControlWire {
 public:
  /// Nothing: nobody answers, or it broke off. Never called once the wire is gone.
  using Answered = std::function<void(std::optional<std::string> reply)>;
  virtual ~ControlWire() = default;
  virtual void ask(std::string message, Answered answered) = 0;
};

class Web {
 public:
  /// Opens the port (0: any). Throws WebError.
  Web(const WebAddress& address, const WebLimits& limits, WebEvents& events);
  ~Web();
  Web(const Web&) = delete;
  Web& operator=(const Web&) = delete;

  std::uint16_t port() const;
  /// Whose requests are served (access.h). None before it is set.
  void admit(WebAccess access);
  /// Until stop(), or SIGINT, SIGTERM, SIGHUP where it watches them.
  void run(bool watch_signals);
  /// From any thread.
  void stop();

  /// Nobody takes its place any more. Before that it is a stranger, as every connection is at first: of those
  /// there is a bounded number, and the newest one takes the place of the oldest.
  void welcome(BrowserId browser);
  void send(BrowserId browser, std::shared_ptr<const std::string> text);
  /// Bytes that were sent and are not on their way yet.
  std::size_t waiting(BrowserId browser) const;
  /// Says why, and closes. Harmless for one that is gone.
  void close(BrowserId browser, std::string_view why);
  void after(std::chrono::milliseconds time, std::function<void()> act);
  std::unique_ptr<ControlWire> wire(const std::string& socket);

 private:
  class Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace understudy::emulator::page
