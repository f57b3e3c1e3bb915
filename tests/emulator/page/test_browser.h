// A browser that is only a socket: HTTP, and the part of WebSocket (RFC 6455) that the page needs.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

namespace understudy::emulator::page {

using TestJson = nlohmann::json;

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

  /// Returns everything until the page closes, or until nothing is received for this long.
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

  /// Returns a frame of RFC 6455, masked with zeros.
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

  /// Returns the next message. Null after a close frame (`why` is then its reason), after an end, or if
  /// nothing is received.
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

  /// Returns the next message of that kind.
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

}  // namespace understudy::emulator::page
