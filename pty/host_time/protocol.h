// The messages between the bench and the preloaded library, when a host runs in simulated time
// (docs/host-time.md). Each waiting thread of the host has its own connection, with a packet for each
// message. A page of shared memory holds the present time, so that reading the clock costs no message.
//
// The library runs in other programs, so this header needs nothing but the kernel's types.
#pragma once

#include <stdint.h>

namespace understudy::host_time {

/// The library and the bench must be of one version: the library's greeting has this number.
inline constexpr uint32_t kVersion = 4;
/// The library has this text, so that the bench recognizes it before a host loads it. It has the version.
#define UNDERSTUDY_HOST_TIME_MARK "understudy host time, version 4"

/// The environment variable with the path of the socket. The page is next to it.
inline constexpr const char* kVariable = "UNDERSTUDY_HOST_TIME";
inline constexpr const char* kPageEnding = ".page";
/// The ending, before a number, of the paths of the sockets that represent the TCP addresses of the bench.
inline constexpr const char* kDoorEnding = ".door";

/// The dates that a host sees at simulated time 0. They are always the same, so that a host that writes dates
/// writes the same dates in each run: 2026-01-01 00:00:00 UTC, and an hour after the machine was started.
inline constexpr int64_t kDateAtBegin_s = 1'767'225'600;
inline constexpr int64_t kUptimeAtBegin_s = 3'600;

inline constexpr int64_t kNever = INT64_MAX;

inline constexpr uint32_t kMaxLines = 256;  // the most lines that a host can tell from other terminals
inline constexpr uint32_t kLinesInMessage = 6;
inline constexpr uint32_t kMaxDoors = 64;
/// Messages identify a door by this plus its number: no pseudo-terminal has such a high number.
inline constexpr int kFirstDoor = 1 << 20;
inline constexpr uint32_t kAnyLine = UINT32_MAX;

/// Threads that wait for each other cannot watch their connection. When the bench ends the wait of a thread,
/// it increments the word that the thread's number selects, and wakes it.
inline constexpr uint32_t kWords = 1024;

/// A TCP address of the bench. An empty address means this machine itself.
struct Door {
  uint16_t port;
  char address[46];  // as inet_ntop writes it
};

/// The shared page. The bench writes it while all threads of the host are waiting.
struct Page {
  uint32_t version;
  uint32_t line_count;
  int64_t now_ns;  // simulated time; read it atomically
  uint32_t words[kWords];
  int32_t lines[kMaxLines];  // the numbers of the pseudo-terminals; -1: a line without one
  uint32_t door_count;
  Door doors[kMaxDoors];
};

/// What the target of a watch is. The kernel's F_OWNER_... have these values.
enum WatchOwner : int64_t { owner_thread = 0, owner_process = 1, owner_group = 2 };

enum class MessageKind : uint32_t {
  // the host's thread
  hello = 1,  // the first message; `sequence` is the version; `value` is 1 from a program that begins
  child,      // `process` is a new child of this process; `value` is 1 if it is another program
  leaves,     // the process becomes another program, which greets the bench if it has the library
  stays,      // that has failed
  wait,       // until `until_ns`, or until something arrives on one of the lines
  cancel,     // the thread no longer waits: something else has woken it
  outside,    // the thread waits for something that is not simulated: time must stop; no answer
  inside,     // that wait is over; no answer
  timer,  // the timer `sequence` of this process: first at `until_ns`, then every `interval_ns`; no answer
  watch,  // the line in `lines` sends the signal `signal` to `target` when a byte arrives; 0: no longer; no
          // answer
  // the bench
  go,         // the wait `sequence` is over
  cancelled,  // no further message about the wait `sequence` will follow
};

struct Message {
  MessageKind what;
  uint32_t sequence;  // the number of the thread's wait, of the timer, the watched descriptor, or the version
  int64_t until_ns;   // simulated time; kNever: without limit
  int64_t interval_ns;
  int64_t value;  // of a timer: the value that comes with its signal; of a watch: see WatchOwner
  int32_t process;
  int32_t thread;
  int32_t target;  // of a timer: the thread that gets its signal; 0: any of the process
  int32_t signal;  // of a timer: the signal that it sends; 0: it counts in the descriptor of the message
  uint32_t is_for_drain;           // the wait ends when what was written to the line has left the wire
  uint32_t is_on_word;             // the thread watches its word of the page, not its connection
  uint32_t is_check;               // the thread asks again and again, without a wait of its own
  uint32_t has_others;             // the thread also waits for descriptors that are not lines
  uint32_t line_count;             // how many of `lines` it waits for, or kAnyLine
  int32_t lines[kLinesInMessage];  // numbers of pseudo-terminals and doors
};

}  // namespace understudy::host_time
