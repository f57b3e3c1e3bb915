// A reply that is made in pieces. Devices wait while a reply is made: one that takes long pauses between its
// parts, and goes on when what was due meanwhile is done (EventLoop::do_in_pieces).
//
//   Telling list_message(Daemon& daemon, Json message) {
//     const Pause pause(daemon);
//     ReplyText text;
//     for (...) {
//       text.element(...);
//       co_await pause;
//     }
//     co_return text.take();
//   }
//
// The world goes on in a pause: what must be of one moment is read between two of them. No pointer into what
// may be gone then is kept across one.
#pragma once

#include <coroutine>
#include <exception>
#include <string>
#include <utility>

namespace understudy::emulator::serve {

class Daemon;

class Telling {
 public:
  struct promise_type {
    // Declared, so that it is not made of a coroutine's arguments, as an aggregate would be.
    promise_type() = default;
    Telling get_return_object() { return Telling(Handle::from_promise(*this)); }
    std::suspend_always initial_suspend() noexcept { return {}; }
    std::suspend_always final_suspend() noexcept { return {}; }
    void return_value(std::string text) { reply = std::move(text); }
    void unhandled_exception() { error = std::current_exception(); }

    std::string reply;
    std::exception_ptr error;
  };

  Telling(Telling&& other) noexcept : handle_(std::exchange(other.handle_, {})) {}
  Telling& operator=(Telling&&) = delete;
  Telling(const Telling&) = delete;
  Telling& operator=(const Telling&) = delete;
  ~Telling() {
    if (handle_) handle_.destroy();
  }

  /// Goes on until it pauses or is done. True: the reply is there. Throws what the verb has thrown.
  bool go_on() {
    handle_.resume();
    if (handle_.promise().error) std::rethrow_exception(handle_.promise().error);
    return handle_.done();
  }
  std::string take_reply() { return std::move(handle_.promise().reply); }

 private:
  using Handle = std::coroutine_handle<promise_type>;
  explicit Telling(Handle handle) : handle_(handle) {}

  Handle handle_;
};

/// Pauses only if the time for a piece is over.
class Pause {
 public:
  explicit Pause(Daemon& daemon) : daemon_(daemon) {}
  bool await_ready() const;
  void await_suspend(std::coroutine_handle<> /*telling*/) const noexcept {}
  void await_resume() const noexcept {}

 private:
  Daemon& daemon_;
};

}  // namespace understudy::emulator::serve
