// A page with simulated benches, and browsers that are only sockets.
#pragma once

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "emulator/page/page.h"
#include "tests/emulator/page/test_browser.h"

namespace understudy::emulator::page {

/// Answers each line on a control socket with a function's result, in its own thread.
class MadeUpBench {
 public:
  using Answer = std::function<std::string(const TestJson& message)>;

  MadeUpBench(std::string path, Answer answer) : path_(std::move(path)), answer_(std::move(answer)) {
    listener_ = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path_.c_str(), sizeof(address.sun_path) - 1);
    unlink(path_.c_str());
    EXPECT_EQ(bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0);
    EXPECT_EQ(listen(listener_, 64), 0);
    thread_ = std::thread([this] { run(); });
  }
  ~MadeUpBench() {
    is_over_ = true;
    thread_.join();
    close(listener_);
    unlink(path_.c_str());
  }

  /// Returns all `look` messages so far.
  int looks() const { return looks_; }
  std::vector<TestJson> asked() {
    const std::lock_guard lock(mutex_);
    return asked_;
  }

 private:
  void run() {
    std::vector<std::pair<int, std::string>> clients;
    while (!is_over_) {
      std::vector<pollfd> all{{listener_, POLLIN, 0}};
      for (const auto& client : clients) all.push_back({client.first, POLLIN, 0});
      if (poll(all.data(), all.size(), 10) <= 0) continue;
      for (std::size_t i = 1; i < all.size(); ++i) {
        if ((all[i].revents & (POLLIN | POLLHUP)) == 0) continue;
        char bytes[65536];
        const ssize_t count = recv(all[i].fd, bytes, sizeof(bytes), 0);
        auto& [descriptor, text] = clients[i - 1];
        if (count <= 0) {
          close(descriptor);
          descriptor = -1;
          continue;
        }
        text.append(bytes, static_cast<std::size_t>(count));
        for (std::size_t end; (end = text.find('\n')) != std::string::npos; text.erase(0, end + 1)) {
          const TestJson message = TestJson::parse(text.substr(0, end));
          if (message["do"] == "look") {
            ++looks_;
          } else {
            const std::lock_guard lock(mutex_);
            asked_.push_back(message);
          }
          const std::string reply = answer_(message) + "\n";
          if (reply.size() > 1) send(descriptor, reply.data(), reply.size(), MSG_NOSIGNAL);
        }
      }
      std::erase_if(clients, [](const auto& client) { return client.first < 0; });
      if (all[0].revents != 0) clients.emplace_back(accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC), "");
    }
    for (const auto& client : clients) close(client.first);
  }

  std::string path_;
  Answer answer_;
  int listener_ = -1;
  std::atomic<bool> is_over_ = false;
  std::atomic<int> looks_ = 0;
  std::mutex mutex_;
  std::vector<TestJson> asked_;
  std::thread thread_;
};

struct PageRig {
  explicit PageRig(std::function<void(PageOptions&)> change = {}) : page(options(change)) {
    thread = std::thread([this] { page.run(false); });
  }
  ~PageRig() {
    page.stop();
    thread.join();
    std::filesystem::remove_all(folder);
  }
  PageOptions options(const std::function<void(PageOptions&)>& change) {
    EXPECT_NE(mkdtemp(folder.data()), nullptr);
    PageOptions made;
    made.sockets = {socket()};
    if (change) change(made);
    return made;
  }
  std::string socket() const { return folder + "/control"; }

  /// Returns a browser that has sent the token and was welcomed.
  std::unique_ptr<TestBrowser> browser() {
    auto made = std::make_unique<TestBrowser>(page.port());
    EXPECT_TRUE(made->open_socket(page.port()));
    made->say({{"token", page.token()}});
    hello = made->hear();
    EXPECT_EQ(hello.value("is", ""), "hello");
    return made;
  }

  std::string folder = "/tmp/understudy-page-XXXXXX";
  Page page;
  std::thread thread;
  TestJson hello;
};

}  // namespace understudy::emulator::page
