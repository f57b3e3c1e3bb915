// The connection of a thread with the bench, and the page of shared memory.
#include <errno.h>
#include <fcntl.h>
#include <linux/futex.h>
#include <pthread.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/sysmacros.h>
#include <sys/un.h>
#include <unistd.h>

#include "pty/host_time/shim.h"
#include "pty/tty_shim.h"

namespace understudy::host_time {

namespace {

[[gnu::used]] const char mark[] = UNDERSTUDY_HOST_TIME_MARK;
const Page* page = nullptr;
sockaddr_un bench_address = {};

/// A thread's side of its connection. `inode` shows whether the descriptor is still ours: some programs close
/// all descriptors that they do not know.
struct Connection {
  int descriptor;
  ino_t inode;
  int32_t thread;  // whose it is: a child process begins with its parent's
  uint32_t sequence;
  const Message* outstanding;  // the wait that a signal handler interrupts
};
constexpr Connection kNone = {-1, 0, 0, 0, nullptr};
__thread Connection connection __attribute__((tls_model("initial-exec"))) = kNone;
pthread_key_t at_end_of_thread;
bool is_beginning = false;  // of this program, not of a thread or a child

// Above the descriptors that programs usually have, so that a program's own descriptors get the same numbers
// as without us.
constexpr int kLowestDescriptor = 200;

void report(const char* what) {
  char text[256];
  size_t size = 0;
  const auto add = [&](const char* part) {
    const size_t length = strnlen(part, sizeof text - size);
    memcpy(text + size, part, length);
    size += length;
  };
  add("understudy: host time: ");
  add(what);
  add("\n");
  [[maybe_unused]] const ssize_t written = write(2, text, size);
}

/// The bench has ended, so time will never advance again.
[[noreturn]] void give_up() {
  signal(SIGTERM, SIG_DFL);
  raise(SIGTERM);
  _exit(128 + SIGTERM);
}

void put(int descriptor, const Message& message) {
  while (send(descriptor, &message, sizeof message, MSG_NOSIGNAL) < 0) {
    if (errno != EINTR) give_up();
  }
}

void put_with_descriptor(int descriptor, Message& message, int passed) {
  iovec part = {&message, sizeof message};
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof passed)] = {};
  msghdr header = {};
  header.msg_iov = &part;
  header.msg_iovlen = 1;
  header.msg_control = control;
  header.msg_controllen = sizeof control;
  cmsghdr* const attached = CMSG_FIRSTHDR(&header);
  attached->cmsg_level = SOL_SOCKET;
  attached->cmsg_type = SCM_RIGHTS;
  attached->cmsg_len = CMSG_LEN(sizeof passed);
  memcpy(CMSG_DATA(attached), &passed, sizeof passed);
  while (sendmsg(descriptor, &header, MSG_NOSIGNAL) < 0) {
    if (errno != EINTR) give_up();
  }
}

int connect_to_bench() {
  int raw = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
  if (raw < 0) return -1;
  const int high = fcntl(raw, F_DUPFD_CLOEXEC, kLowestDescriptor);
  if (high >= 0) {
    UNDERSTUDY_REAL(syscall)(SYS_close, raw);
    raw = high;
  }
  while (true) {
    const int result =
        static_cast<int>(UNDERSTUDY_REAL(syscall)(SYS_connect, raw, &bench_address, sizeof bench_address));
    if (result == 0 || errno == EISCONN) return raw;
    if (errno != EINTR) break;
  }
  UNDERSTUDY_REAL(syscall)(SYS_close, raw);
  return -1;
}

int32_t own_number() { return static_cast<int32_t>(UNDERSTUDY_REAL(syscall)(SYS_gettid)); }

Message message_of(MessageKind what) {
  Message message = {};
  message.what = what;
  message.process = getpid();
  message.thread = own_number();
  return message;
}

bool is_connected() {
  struct stat status;
  return connection.descriptor >= 0 && fstat(connection.descriptor, &status) == 0 &&
         S_ISSOCK(status.st_mode) && status.st_ino == connection.inode;
}

void close_connection(void*) {
  if (is_connected()) UNDERSTUDY_REAL(syscall)(SYS_close, connection.descriptor);
  connection = kNone;
}

/// A child process has only the thread that forked. It needs a connection of its own.
void forget_parent() {
  close_connection(nullptr);
  forget_timers();
}

/// Returns the connection of this thread. Connects first if it has none.
int own_descriptor() {
  // libc does not call begin_anew_in_child() in a child that the host has forked by a system call.
  if (connection.descriptor >= 0 && connection.thread != own_number()) forget_parent();
  if (is_connected()) return connection.descriptor;
  struct stat status;
  const int fresh = connect_to_bench();
  if (fresh < 0 || fstat(fresh, &status) != 0) give_up();
  connection.descriptor = fresh;
  connection.inode = status.st_ino;
  pthread_setspecific(at_end_of_thread, &connection);
  Message hello = message_of(MessageKind::hello);
  connection.thread = hello.thread;
  hello.sequence = kVersion;
  hello.value = is_beginning ? 1 : 0;
  put(fresh, hello);
  return fresh;
}

void begin_anew_in_child() {
  if (page == nullptr) return;
  const int error = errno;
  forget_parent();
  own_descriptor();
  errno = error;
}

const Page* map_page(const char* socket_path) {
  char path[sizeof bench_address.sun_path + 16];
  const size_t length = strlen(socket_path);
  memcpy(path, socket_path, length);
  strcpy(path + length, kPageEnding);
  const int file = open(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) return nullptr;
  void* const mapped = mmap(nullptr, sizeof(Page), PROT_READ, MAP_SHARED, file, 0);
  UNDERSTUDY_REAL(syscall)(SYS_close, file);
  return mapped == MAP_FAILED ? nullptr : static_cast<const Page*>(mapped);
}

__attribute__((constructor)) void begin() {
  const char* const path = getenv(kVariable);
  if (path == nullptr || *path == '\0') return;
  if (strlen(path) >= sizeof bench_address.sun_path)
    return report("the path of the bench's socket is too long");
  bench_address.sun_family = AF_UNIX;
  strcpy(bench_address.sun_path, path);
  const Page* const mapped = map_page(path);
  if (mapped == nullptr)
    return report("the bench cannot be reached; expected to be started by `understudy exec --host-time`");
  if (mapped->version != kVersion)
    return report("the preloaded library and the bench have different versions");
  page = mapped;
  pthread_key_create(&at_end_of_thread, close_connection);
  pthread_atfork(nullptr, nullptr, begin_anew_in_child);
  is_beginning = true;
  own_descriptor();
  is_beginning = false;
}

Message receive_one(int descriptor) {
  Message message;
  while (true) {
    const ssize_t size = UNDERSTUDY_REAL(recv)(descriptor, &message, sizeof message, 0);
    if (size == static_cast<ssize_t>(sizeof message)) return message;
    if (size < 0 && errno == EINTR) continue;
    give_up();
  }
}

/// Tells the bench that something else has ended a wait. The bench may have ended it too in the meantime.
void cancel(int descriptor, const Message& wait) {
  Message message = wait;
  message.what = MessageKind::cancel;
  put(descriptor, message);
  while (true) {
    const Message answer = receive_one(descriptor);
    if (answer.what == MessageKind::cancelled && answer.sequence == wait.sequence) return;
  }
}

/// Blocks until the bench, a descriptor or a signal ends the wait.
Woken block(int descriptor, const Message& message, const Wait& wait) {
  constexpr nfds_t kFew = 16;
  pollfd few[kFew];
  pollfd* entries = few;
  if (wait.other_count >= kFew)
    entries = static_cast<pollfd*>(malloc((wait.other_count + 1) * sizeof(pollfd)));
  entries[0] = {descriptor, POLLIN, 0};
  for (nfds_t i = 0; i < wait.other_count; ++i) entries[i + 1] = wait.others[i];
  Woken woken = Woken::by_bench;
  while (true) {
    // With a plain recv, the kernel restarts the call after a signal if the handler has SA_RESTART.
    const bool is_plain = wait.is_restartable;
    const long result =
        is_plain ? 1 : UNDERSTUDY_REAL(ppoll)(entries, wait.other_count + 1, nullptr, wait.mask);
    if (result < 0) {
      cancel(descriptor, message);
      woken = Woken::by_signal;
      break;
    }
    if (!is_plain && entries[0].revents == 0) {
      cancel(descriptor, message);
      woken = Woken::by_descriptor;
      break;
    }
    Message answer;
    const ssize_t size = UNDERSTUDY_REAL(recv)(descriptor, &answer, sizeof answer, 0);
    if (size < 0 && errno == EINTR) {
      cancel(descriptor, message);
      woken = Woken::by_signal;
      break;
    }
    if (size != static_cast<ssize_t>(sizeof answer)) give_up();
    if (answer.what != MessageKind::go || answer.sequence != message.sequence)
      continue;  // this answer belongs to an earlier wait
    break;
  }
  if (entries != few) free(entries);
  return woken;
}

}  // namespace

bool is_active() { return page != nullptr; }

const Page& the_page() { return *page; }

void address_of_door(int door, sockaddr_un* address) {
  *address = bench_address;
  char* place = address->sun_path + strlen(address->sun_path);
  const char* const end = address->sun_path + sizeof address->sun_path - 3;
  for (const char* c = kDoorEnding; *c != '\0' && place < end; ++c) *place++ = *c;
  if (door >= 10) *place++ = static_cast<char>('0' + door / 10);
  *place++ = static_cast<char>('0' + door % 10);
  *place = '\0';
}

int number_of_door(const sockaddr_un& address) {
  sockaddr_un expected;
  for (uint32_t i = 0; i < page->door_count; ++i) {
    address_of_door(static_cast<int>(i), &expected);
    if (strncmp(expected.sun_path, address.sun_path, sizeof address.sun_path) == 0)
      return static_cast<int>(i);
  }
  return -1;
}

int64_t now_ns() { return __atomic_load_n(&page->now_ns, __ATOMIC_ACQUIRE); }

bool is_line(int descriptor, int* number) {
  const int terminal = shim::pseudo_terminal_number(descriptor);
  if (terminal < 0) return false;
  *number = terminal;
  for (uint32_t i = 0; i < page->line_count; ++i) {
    if (page->lines[i] == terminal) return true;
  }
  return false;
}

namespace {

/// Returns true if the bench has ended the wait.
bool is_over(int descriptor, const Message& message) {
  Message answer;
  while (UNDERSTUDY_REAL(recv)(descriptor, &answer, sizeof answer, MSG_DONTWAIT) ==
         static_cast<ssize_t>(sizeof answer)) {
    if (answer.what == MessageKind::go && answer.sequence == message.sequence) return true;
  }
  return false;
}

long wait_for_either(uint32_t* word, uint32_t value, bool is_shared, const uint32_t* own,
                     uint32_t own_value) {
  futex_waitv words[2] = {};
  words[0].uaddr = reinterpret_cast<uintptr_t>(word);
  words[0].val = value;
  words[0].flags = FUTEX_32 | (is_shared ? 0U : static_cast<unsigned>(FUTEX_PRIVATE_FLAG));
  words[1].uaddr = reinterpret_cast<uintptr_t>(own);
  words[1].val = own_value;
  words[1].flags = FUTEX_32;
  const long result = UNDERSTUDY_REAL(syscall)(SYS_futex_waitv, words, 2U, 0U, nullptr, CLOCK_MONOTONIC);
  if (result >= 0 || errno != ENOSYS) return result;
  const timespec soon = {0, 1'000'000};  // before Linux 5.16: checks both from time to time
  return UNDERSTUDY_REAL(syscall)(SYS_futex, word, is_shared ? FUTEX_WAIT : FUTEX_WAIT_PRIVATE, value, &soon,
                                  nullptr, 0);
}

}  // namespace

Woken wait_on_word(uint32_t* word, uint32_t value, bool is_shared, int64_t until_ns) {
  const int error = errno;
  Woken woken = Woken::by_descriptor;
  if (until_ns == kNever) {
    const long result = UNDERSTUDY_REAL(syscall)(SYS_futex, word, is_shared ? FUTEX_WAIT : FUTEX_WAIT_PRIVATE,
                                                 value, nullptr, nullptr, 0);
    if (result < 0 && errno == EINTR) woken = Woken::by_signal;
    errno = error;
    return woken;
  }
  const int descriptor = own_descriptor();
  Message message = message_of(MessageKind::wait);
  message.sequence = ++connection.sequence;
  message.until_ns = until_ns;
  message.is_on_word = message.has_others = 1;
  const uint32_t* const own = &page->words[static_cast<uint32_t>(message.thread) % kWords];
  uint32_t own_value = __atomic_load_n(own, __ATOMIC_ACQUIRE);
  const Message* const interrupted = connection.outstanding;
  connection.outstanding = &message;
  put(descriptor, message);
  while (true) {
    const long result = wait_for_either(word, value, is_shared, own, own_value);
    const bool is_signal = result < 0 && errno == EINTR;
    const bool is_changed = result == 0 || __atomic_load_n(word, __ATOMIC_ACQUIRE) != value;
    own_value = __atomic_load_n(own, __ATOMIC_ACQUIRE);
    if (is_over(descriptor, message)) {
      woken = Woken::by_bench;
      break;
    }
    if (!is_signal && !is_changed) continue;  // another thread uses the same word
    cancel(descriptor, message);
    if (is_signal) woken = Woken::by_signal;
    break;
  }
  connection.outstanding = interrupted;
  if (interrupted != nullptr) put(descriptor, *interrupted);
  errno = error;
  return woken;
}

Woken wait_for(const Wait& wait) {
  const int error = errno;
  const int descriptor = own_descriptor();
  Message message = message_of(MessageKind::wait);
  message.sequence = ++connection.sequence;
  message.until_ns = wait.until_ns;
  message.is_for_drain = wait.is_for_drain ? 1 : 0;
  message.is_check = wait.is_check ? 1 : 0;
  message.has_others = wait.other_count > 0 ? 1 : 0;
  message.line_count = wait.line_count;
  memcpy(message.lines, wait.lines, sizeof message.lines);
  const Message* const interrupted = connection.outstanding;
  connection.outstanding = &message;
  put(descriptor, message);
  const Woken woken = block(descriptor, message, wait);
  connection.outstanding = interrupted;
  if (interrupted != nullptr) put(descriptor, *interrupted);  // the wait that the handler has interrupted
  errno = error;
  return woken;
}

bool sleep_until(int64_t until_ns) {
  if (now_ns() >= until_ns) check_again();
  while (now_ns() < until_ns) {
    Wait wait;
    wait.until_ns = until_ns;
    if (wait_for(wait) == Woken::by_signal) return now_ns() >= until_ns;
  }
  return true;
}

void begin_outside() { put(own_descriptor(), message_of(MessageKind::outside)); }
void end_outside() { put(own_descriptor(), message_of(MessageKind::inside)); }

void tell_leaving() {
  const int error = errno;
  put(own_descriptor(), message_of(MessageKind::leaves));
  errno = error;
}

void tell_staying() {
  const int error = errno;
  put(own_descriptor(), message_of(MessageKind::stays));
  errno = error;
}

void tell_timer(Message message, int descriptor) {
  const Message own = message_of(message.what);
  message.process = own.process;
  message.thread = own.thread;
  const int error = errno;
  if (descriptor < 0) {
    put(own_descriptor(), message);
  } else {
    put_with_descriptor(own_descriptor(), message, descriptor);
  }
  errno = error;
}

void tell_watch(Message message) { tell_timer(message, -1); }

void tell_child(int process, bool is_another_program) {
  const int error = errno;
  Message message = message_of(MessageKind::child);
  message.process = process;
  message.value = is_another_program ? 1 : 0;
  put(own_descriptor(), message);
  errno = error;
}

}  // namespace understudy::host_time
