// A reply that is created in pieces. Devices have to wait while a reply is being created, so a long reply
// pauses between its parts, and continues when other due work is done (EventLoop::do_in_pieces).
//
//   ReplyTask list_message(Daemon& daemon, Json message) {
//     const Pause pause(daemon);
//     ReplyText text;
//     for (...) {
//       text.element(...);
//       co_await pause;
//     }
//     co_return text.take();
//   }
//
// The world runs during a pause, so read data that must belong to the same moment between two pauses, and do
// not keep pointers to objects that may disappear across a pause.
#pragma once

#include <coroutine>
#include <exception>
#include <string>
#include <utility>

namespace understudy::emulator::serve {

class Daemon;

class ReplyTask {
 public:
  struct promise_type {
    // This constructor is declared so that it is not called with the arguments of the coroutine, as it would
    // be for an aggregate.
    promise_type() = default;
    ReplyTask get_return_object() { return ReplyTask(Handle::from_promise(*this)); }
    std::suspend_always initial_suspend() noexcept { return {}; }
    std::suspend_always final_suspend() noexcept { return {}; }
    void return_value(std::string text) { reply = std::move(text); }
    void unhandled_exception() { error = std::current_exception(); }

    std::string reply;
    std::exception_ptr error;
  };

  ReplyTask(ReplyTask&& other) noexcept : handle_(std::exchange(other.handle_, {})) {}
  ReplyTask& operator=(ReplyTask&&) = delete;
  ReplyTask(const ReplyTask&) = delete;
  ReplyTask& operator=(const ReplyTask&) = delete;
  ~ReplyTask() {
    if (handle_) handle_.destroy();
  }

  /// Continues until it pauses or is done. Returns true if the reply is complete. Rethrows exceptions from
  /// the verb.
  bool resume() {
    handle_.resume();
    if (handle_.promise().error) std::rethrow_exception(handle_.promise().error);
    return handle_.done();
  }
  std::string take_reply() { return std::move(handle_.promise().reply); }

 private:
  using Handle = std::coroutine_handle<promise_type>;
  explicit ReplyTask(Handle handle) : handle_(handle) {}

  Handle handle_;
};

/// Pauses only if the time for a piece is used up.
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
