// Declares the parts of the library that puts a host into simulated time. They run in another program's
// process, so they use only libc, and must work before its `main`, in signal handlers and after a fork.
#pragma once

#include <dlfcn.h>
#include <poll.h>
#include <signal.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>
#include <sys/un.h>
#include <time.h>

#include "pty/host_time/protocol.h"

#define UNDERSTUDY_EXPORT extern "C" __attribute__((visibility("default")))

namespace understudy::host_time {

/// Returns the function that a host would call without this library.
template <class Function>
Function* real_function(Function*& found, const char* name) {
  if (__builtin_expect(found == nullptr, 0)) found = reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
  return found;
}
/// real(poll)(...) calls libc's poll.
#define UNDERSTUDY_REAL(name)                                    \
  ([] {                                                          \
    static decltype(::name)* found = nullptr;                    \
    return ::understudy::host_time::real_function(found, #name); \
  }())

/// Returns true if this process runs in simulated time.
bool is_active();

int64_t now_ns();

constexpr int64_t kBillion = 1'000'000'000;

/// Returns what the clock shows at simulated time 0, or -1 if it does not measure elapsed time.
int64_t clock_begin_ns(clockid_t clock);
/// Returns true if the kernel lets programs wait by this clock: they cannot wait by coarse clocks or
/// processor time.
bool is_for_waits(clockid_t clock);
timespec time_of(int64_t ns);
/// Returns -1 if the time is not valid.
int64_t ns_of(const timespec& time);
int64_t ns_of(const timeval& time);
/// Returns now + length_ns, at most kNever.
int64_t after(int64_t length_ns);

const Page& the_page();

/// Returns true if the descriptor is a terminal of the bench. `number` is that of its pseudo-terminal.
bool is_line(int descriptor, int* number);

/// Returns true if the descriptor is a connection with a TCP address of the bench. `number`, which may be
/// null, is that of its door in messages.
bool is_door(int descriptor, int* number);
/// Call this before a read. If the read would wait for such a connection, or for another socket with a
/// timeout, this waits as the bench decides. Returns false, with errno set, if the read must not be tried.
bool wait_for_connection(int descriptor);
void address_of_door(int door, sockaddr_un* address);
/// Returns the number of the door that has this address, or -1.
int number_of_door(const sockaddr_un& address);

/// Call this before a read of up to `size` bytes: waits, as the bench decides, until the kernel would not
/// block it. Returns how many bytes it may ask for; 0: the time is up; -1, with errno set: a signal arrived.
ssize_t wait_to_read(int descriptor, size_t size);

enum class Woken : uint8_t { by_bench, by_descriptor, by_signal };

/// Describes what a thread is waiting for.
struct Wait {
  int64_t until_ns = kNever;
  uint32_t line_count = 0;  // or kAnyLine
  int32_t lines[kLinesInMessage] = {};
  bool is_for_drain = false;
  bool is_check = false;
  bool is_restartable = false;  // restarts after a signal with SA_RESTART; only without others and a mask
  pollfd* others = nullptr;     // descriptors that are not lines: they wake it too
  nfds_t other_count = 0;
  const sigset_t* mask = nullptr;  // the signal mask during the wait

  void add_line(int number) {
    if (line_count < kLinesInMessage) {
      lines[line_count++] = number;
    } else {
      line_count = kAnyLine;
    }
  }
};

/// Waits as the bench decides. After by_bench, check again: the time may be over, or a line may be ready.
Woken wait_for(const Wait& wait);

/// Waits until simulated time `until_ns`. Returns false if a signal has ended it. If that time has come
/// already, this is a check_again().
bool sleep_until(int64_t until_ns);

/// Call this for each wait of no length that has found nothing. Returns how long it must wait nevertheless, 0
/// at first: see checks.cpp.
int64_t length_of_check();
/// Sleeps for length_of_check(), for waits that no line can end.
void check_again();

/// Waits while the word has this value, until simulated time `until_ns`. Here by_descriptor means that
/// another thread has woken it. Spurious wake-ups are possible.
Woken wait_on_word(uint32_t* word, uint32_t value, bool is_shared, int64_t until_ns);

/// Enclose a wait of this thread for something outside the bench. Simulated time is stopped in between.
void begin_outside();
void end_outside();

/// Informs the bench of a timer's setting. The bench counts expirations in the descriptor, unless that is -1.
void tell_timer(Message message, int descriptor);
/// Informs the bench of a watch (watches.cpp).
void tell_watch(Message message);
/// Returns true if the descriptor is one of the timers in timers.cpp.
bool is_timer(int descriptor);
/// Forgets the parent's timers: a child process does not inherit them.
void forget_timers();

/// Informs the bench of a new child process. One that is another program greets the bench itself.
void tell_child(int process, bool is_another_program);
/// Informs the bench that this process is about to become another program, or that this has failed.
void tell_leaving();
void tell_staying();

}  // namespace understudy::host_time
