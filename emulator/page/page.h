// The live page: it observes running benches through their control sockets and shows them in browsers
// (docs/page.md). It queries each socket at most 30 times per second, once for all browsers. The bench
// continues to run if the page fails.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/page/page_bench.h"
#include "emulator/page/web.h"

namespace understudy::emulator::page {

struct PageOptions {
  WebAddress address;
  std::vector<std::string> sockets;  // control sockets, one per bench
  std::vector<std::string> hosts;    // names of this machine besides the loopback names
  bool is_read_only = false;
  std::string folder;  // a folder with the page's files; empty: the files in the program
  WebLimits limits{};
  std::size_t browsers = 16;  // the maximum number of browsers with the token
};

struct BrowserMessage;

class Page final : private WebEvents {
 public:
  /// Opens the port. Throws WebError.
  explicit Page(const PageOptions& options);
  ~Page();
  Page(const Page&) = delete;
  Page& operator=(const Page&) = delete;

  /// Returns the URL for a browser, with the token.
  std::string address() const;
  std::uint16_t port() const { return web_.port(); }
  const std::string& token() const { return token_; }
  void run(bool watch_signals) { web_.run(watch_signals); }
  void stop() { web_.stop(); }

 private:
  struct Browser {
    bool is_known = false;                    // the browser has sent the token
    std::map<std::size_t, Watching> watched;  // by bench
    std::size_t asked = 0;                    // the number of replies that it is waiting for
  };

  std::optional<WebFile> file(std::string_view path) override;
  std::optional<WebFile> built_in(std::string_view name);
  void opened(BrowserId browser) override;
  void received(BrowserId browser, std::string_view text) override;
  void closed(BrowserId browser) override;
  void drained(BrowserId browser) override;

  void take(BrowserId browser, std::string_view text);
  void watch(Browser& whose, BrowserMessage message);
  void greet(BrowserId browser);
  void show(std::size_t bench);
  void show_to(BrowserId browser, Browser& whose, std::size_t bench);
  void send_state(std::size_t bench);
  void watched_changed(std::size_t bench);
  void send(BrowserId browser, std::string text);

  PageOptions options_;
  std::map<std::string, WebFile, std::less<>> files_;  // built in, by name; created on first request
  std::string token_;
  std::map<BrowserId, Browser> browsers_;
  Web web_;
  std::vector<std::unique_ptr<PageBench>> benches_;  // last: their wires end before the web does
};

}  // namespace understudy::emulator::page
