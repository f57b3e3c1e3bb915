// Connects to a control socket. Only web.cpp includes this file, because Asio is slow to compile.
#pragma once

#include <sys/un.h>

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/write.hpp>
#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "emulator/page/web.h"

namespace understudy::emulator::page {

class UnixWire final : public ControlWire {
 public:
  UnixWire(boost::asio::io_context& io, std::string path, std::size_t max)
      : link_(std::make_shared<Link>(io, std::move(path), max)) {}
  ~UnixWire() override { link_->end(); }
  void ask(std::string message, Answered answered) override {
    link_->ask(std::move(message), std::move(answered));
  }

 private:
  struct Link : std::enable_shared_from_this<Link> {
    Link(boost::asio::io_context& io, std::string to, std::size_t max)
        : socket(io), path(std::move(to)), longest(max) {}

    void ask(std::string message, Answered answered) {
      asked.push_back({std::move(message) + "\n", std::move(answered)});
      if (asked.size() > 1) return;
      if (is_connected) return write();
      connect();
    }

    void connect() {
      if (path.size() >= sizeof(sockaddr_un::sun_path)) return fail();
      socket.async_connect(boost::asio::local::stream_protocol::endpoint(path),
                           [self = shared_from_this()](boost::system::error_code error) {
                             if (self->is_over) return;
                             if (error) return self->fail();
                             self->is_connected = true;
                             self->write();
                           });
    }

    void write() {
      boost::asio::async_write(socket, boost::asio::buffer(asked.front().message),
                               [self = shared_from_this()](boost::system::error_code error, std::size_t) {
                                 if (self->is_over) return;
                                 if (error) return self->fail();
                                 self->read();
                               });
    }

    void read() {
      boost::asio::async_read_until(
          socket, boost::asio::dynamic_buffer(input, longest), '\n',
          [self = shared_from_this()](boost::system::error_code error, std::size_t count) {
            if (self->is_over) return;
            if (error) return self->fail();
            std::string reply = self->input.substr(0, count - 1);
            self->input.erase(0, count);
            const Answered answered = std::move(self->asked.front().answered);
            self->asked.pop_front();
            if (!self->asked.empty()) self->write();
            answered(std::move(reply));
          });
    }

    /// Drops all unanswered messages; the next message connects again. The senders are notified later,
    /// because ask() may not have returned yet.
    void fail() {
      boost::system::error_code ignored;
      socket.close(ignored);
      is_connected = false;
      input.clear();
      boost::asio::post(socket.get_executor(),
                        [self = shared_from_this(), failed = std::exchange(asked, {})] {
                          for (const Asked& one : failed) {
                            if (!self->is_over) one.answered(std::nullopt);
                          }
                        });
    }

    void end() {
      is_over = true;
      boost::system::error_code ignored;
      socket.close(ignored);
      asked.clear();
    }

    struct Asked {
      std::string message;
      Answered answered;
    };
    boost::asio::basic_stream_socket<boost::asio::local::stream_protocol,
                                     boost::asio::io_context::executor_type>
        socket;
    std::string path;
    std::size_t longest;
    std::string input;
    std::deque<Asked> asked;
    bool is_connected = false;
    bool is_over = false;
  };

  std::shared_ptr<Link> link_;
};

}  // namespace understudy::emulator::page
