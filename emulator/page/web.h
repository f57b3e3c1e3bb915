// Connects the page to browsers and to control sockets: HTTP and WebSocket on one port, lines of text on
// Unix sockets, one thread. page.h interprets the messages; access.h decides which requests are accepted.
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

/// Thrown if the port cannot be opened. The message is one line.
struct WebError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A browser's WebSocket while it is open. Numbers are never reused.
using BrowserId = std::uint64_t;

/// A file that browsers may request.
struct WebFile {
  std::string type;  // "text/html; charset=utf-8"
  std::string bytes;
  std::string gzipped;  // the same bytes, for browsers that take it
  std::string nonce{};  // of the scripts inside it; empty: it has none
};

/// Receives events of browsers.
class WebEvents {
 public:
  virtual std::optional<WebFile> file(std::string_view path) = 0;
  virtual void opened(BrowserId browser) = 0;
  virtual void received(BrowserId browser, std::string_view text) = 0;
  /// Called when a browser has disconnected, even after close().
  virtual void closed(BrowserId browser) = 0;
  /// Called when all queued data has been sent.
  virtual void drained(BrowserId browser) = 0;

 protected:
  ~WebEvents() = default;
};

struct WebLimits {
  std::size_t unauthenticated = 64;       // connections that are not authenticated yet
  std::size_t request_bytes = 8 * 1024;   // size of a request's head; it has no body
  std::size_t message_bytes = 64 * 1024;  // size of a browser's message
  std::size_t waiting_bytes = 8 << 20;  // queued for a browser that does not read; beyond this, it is closed
  std::size_t reply_bytes = 16 << 20;   // size of a control socket's reply
  std::chrono::milliseconds request{5'000};   // for a whole request
  std::chrono::milliseconds silence{30'000};  // of a browser that does not answer pings
};

/// A control socket, connected on first use. Replies come in the order of the messages.
class ControlWire {
 public:
  /// The reply is empty if the socket does not answer or disconnects. The function is never called after the
  /// wire is destroyed.
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
  /// Sets which requests are served (access.h). Before that call, none are.
  void admit(WebAccess access);
  /// Runs until stop(), or SIGINT, SIGTERM or SIGHUP if it watches signals.
  void run(bool watch_signals);
  /// Stops run(). It may be called on any thread.
  void stop();

  /// Marks a browser as authenticated, so no other connection can take its place. Every connection starts
  /// unauthenticated. The number of unauthenticated connections is limited; the newest one replaces the
  /// oldest.
  void authenticated(BrowserId browser);
  void send(BrowserId browser, std::shared_ptr<const std::string> text);
  /// Returns the number of bytes that are queued and not sent yet.
  std::size_t waiting(BrowserId browser) const;
  /// Sends the reason and closes the browser. It has no effect on a browser that has disconnected.
  void close(BrowserId browser, std::string_view why);
  void after(std::chrono::milliseconds time, std::function<void()> act);
  std::unique_ptr<ControlWire> wire(const std::string& socket);

 private:
  class Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace understudy::emulator::page
