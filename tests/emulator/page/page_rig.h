// A page with benches that are made up, and browsers that are no more than sockets.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
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

namespace understudy::emulator::page {

using TestJson = nlohmann::json;

/// What answers on a control socket: each line by a function, on a thread of its own.
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

  /// All looks so far.
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

/// A connection to the page.
class TestBrowser {
 public:
  explicit TestBrowser(std::uint16_t port, const char* address = "127.0.0.1") {
    descriptor_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    inet_pton(AF_INET, address, &to.sin_addr);
    is_connected_ = connect(descriptor_, reinterpret_cast<sockaddr*>(&to), sizeof(to)) == 0;
  }
  ~TestBrowser() { hang_up(); }
  TestBrowser(const TestBrowser&) = delete;
  TestBrowser& operator=(const TestBrowser&) = delete;

  bool is_connected() const { return is_connected_; }
  int descriptor() const { return descriptor_; }
  void hang_up() {
    if (descriptor_ >= 0) close(descriptor_);
    descriptor_ = -1;
  }
  void write(const std::string& bytes) { ::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL); }

  /// All that comes until the page closes, or nothing for this long.
  std::string read_all(int patience_ms = 3'000) {
    while (fill(patience_ms)) {
    }
    return std::exchange(input_, {});
  }

  /// "HTTP/1.1 101": the first line of the answer, without its reason. `head`: all lines but the last empty
  /// one.
  std::string ask(const std::string& head) {
    write(head + "\r\n");
    std::size_t end = 0;
    while ((end = input_.find("\r\n\r\n")) == std::string::npos && fill(3'000)) {
    }
    if (end == std::string::npos) return {};
    head_ = input_.substr(0, end);
    input_.erase(0, end + 4);
    return head_.substr(0, 12);
  }
  const std::string& head() const { return head_; }

  bool open_socket(std::uint16_t port, const std::string& origin_port = "") {
    const std::string at = std::to_string(port);
    return ask("GET /ws HTTP/1.1\r\nHost: localhost:" + at +
               "\r\nOrigin: http://localhost:" + (origin_port.empty() ? at : origin_port) +
               "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
               "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n") == "HTTP/1.1 101";
  }

  /// A frame as RFC 6455 has it, masked with zeros.
  static std::string frame(const std::string& payload, int opcode = 1) {
    std::string bytes(1, static_cast<char>(0x80 | opcode));
    if (payload.size() < 126) {
      bytes += static_cast<char>(0x80 | payload.size());
    } else if (payload.size() < 65536) {
      bytes += static_cast<char>(0x80 | 126);
      bytes += static_cast<char>(payload.size() >> 8);
      bytes += static_cast<char>(payload.size());
    } else {
      bytes += static_cast<char>(0x80 | 127);
      for (int shift = 56; shift >= 0; shift -= 8) bytes += static_cast<char>(payload.size() >> shift);
    }
    return bytes + std::string(4, '\0') + payload;
  }
  void say(const TestJson& message) { write(frame(message.dump())); }

  /// The next message; null after a close frame (then `why` is its reason) or an end, or when nothing comes.
  TestJson hear(int patience_ms = 3'000) {
    while (true) {
      if (input_.size() >= 2) {
        std::size_t size = static_cast<unsigned char>(input_[1]);
        std::size_t begin = 2;
        const auto big = [&](int bytes) {
          size = 0;
          for (int i = 0; i < bytes; ++i)
            size = size << 8 | static_cast<unsigned char>(input_[2 + static_cast<std::size_t>(i)]);
          begin = 2 + static_cast<std::size_t>(bytes);
        };
        if (size == 126 && input_.size() >= 4) big(2);
        if (size == 127 && input_.size() >= 10) big(8);
        if (begin + size <= input_.size()) {
          const int opcode = input_[0] & 15;
          const std::string payload = input_.substr(begin, size);
          input_.erase(0, begin + size);
          if (opcode == 8) {
            why_ = payload.size() > 2 ? payload.substr(2) : "";
            return nullptr;
          }
          if (opcode == 1) return TestJson::parse(payload);
          continue;
        }
      }
      if (!fill(patience_ms)) return nullptr;
    }
  }
  const std::string& why() const { return why_; }

  /// The next of that kind.
  TestJson hear_one(const std::string& is, int patience_ms = 3'000) {
    while (true) {
      TestJson message = hear(patience_ms);
      if (message.is_null() || message["is"] == is) return message;
    }
  }

 private:
  bool fill(int patience_ms) {
    pollfd one{descriptor_, POLLIN, 0};
    if (descriptor_ < 0 || poll(&one, 1, patience_ms) <= 0) return false;
    char bytes[65536];
    const ssize_t count = recv(descriptor_, bytes, sizeof(bytes), 0);
    if (count <= 0) return false;
    input_.append(bytes, static_cast<std::size_t>(count));
    return true;
  }

  int descriptor_ = -1;
  bool is_connected_ = false;
  std::string input_;
  std::string head_;
  std::string why_;
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

  /// One that has brought the token, and been greeted.
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
