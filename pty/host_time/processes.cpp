// Children of a host: the bench must know of them before time may move again. It must also know of processes
// that become other programs: those that do not load this library are in real time.
#include <alloca.h>
#include <spawn.h>
#include <stdarg.h>
#include <sys/types.h>
#include <unistd.h>

#include "pty/host_time/shim.h"

using namespace understudy::host_time;

UNDERSTUDY_EXPORT pid_t fork() noexcept {
  const pid_t child = UNDERSTUDY_REAL(fork)();  // in the child, channel.cpp greets the bench
  if (child > 0 && is_active()) tell_child(child, false);
  return child;
}

/// A child that shares our memory until it becomes another program could not greet the bench.
UNDERSTUDY_EXPORT pid_t vfork() noexcept { return fork(); }

UNDERSTUDY_EXPORT int posix_spawn(pid_t* child, const char* path, const posix_spawn_file_actions_t* actions,
                                  const posix_spawnattr_t* attributes, char* const* words,
                                  char* const* environment) {
  pid_t number = -1;
  const int error = UNDERSTUDY_REAL(posix_spawn)(&number, path, actions, attributes, words, environment);
  if (error == 0 && is_active()) tell_child(number, true);
  if (child != nullptr) *child = number;
  return error;
}

UNDERSTUDY_EXPORT int posix_spawnp(pid_t* child, const char* file, const posix_spawn_file_actions_t* actions,
                                   const posix_spawnattr_t* attributes, char* const* words,
                                   char* const* environment) {
  pid_t number = -1;
  const int error = UNDERSTUDY_REAL(posix_spawnp)(&number, file, actions, attributes, words, environment);
  if (error == 0 && is_active()) tell_child(number, true);
  if (child != nullptr) *child = number;
  return error;
}

// --- other programs --------------------------------------------------------------------------------

namespace {

decltype(::execve)* real_execve;
decltype(::execvpe)* real_execvpe;
decltype(::execveat)* real_execveat;
decltype(::fexecve)* real_fexecve;

/// A child of a process with threads must not search for functions, because another thread may have held the
/// lock for that.
__attribute__((constructor)) void find_functions() {
  real_function(real_execve, "execve");
  real_function(real_execvpe, "execvpe");
  real_function(real_execveat, "execveat");
  real_function(real_fexecve, "fexecve");
}

/// Calls one of the exec functions, which returns only if it has failed.
template <class Become>
int leave(Become become) {
  if (!is_active()) return become();
  tell_leaving();
  const int result = become();
  tell_staying();
  return result;
}

/// Counts the words of a call, which a null pointer ends, and stores them with it unless `words` is null.
size_t take_words(const char* word, va_list* list, char** words) {
  size_t count = 0;
  for (; word != nullptr; word = va_arg(*list, const char*), ++count) {
    if (words != nullptr) words[count] = const_cast<char*>(word);
  }
  if (words != nullptr) words[count] = nullptr;
  return count;
}

}  // namespace

UNDERSTUDY_EXPORT int execve(const char* path, char* const* words, char* const* environment) noexcept {
  return leave([&] { return real_function(real_execve, "execve")(path, words, environment); });
}

UNDERSTUDY_EXPORT int execvpe(const char* file, char* const* words, char* const* environment) noexcept {
  return leave([&] { return real_function(real_execvpe, "execvpe")(file, words, environment); });
}

UNDERSTUDY_EXPORT int execveat(int folder, const char* path, char* const* words, char* const* environment,
                               int flags) noexcept {
  return leave(
      [&] { return real_function(real_execveat, "execveat")(folder, path, words, environment, flags); });
}

UNDERSTUDY_EXPORT int fexecve(int descriptor, char* const* words, char* const* environment) noexcept {
  return leave([&] { return real_function(real_fexecve, "fexecve")(descriptor, words, environment); });
}

UNDERSTUDY_EXPORT int execv(const char* path, char* const* words) noexcept {
  return execve(path, words, environ);
}

UNDERSTUDY_EXPORT int execvp(const char* file, char* const* words) noexcept {
  return execvpe(file, words, environ);
}

// Stores the words of a call on the stack: this runs after forks.
#define UNDERSTUDY_TAKE_WORDS(first, list, words)                                                            \
  va_list list;                                                                                              \
  va_start(list, first);                                                                                     \
  char** const words = static_cast<char**>(alloca((take_words(first, &list, nullptr) + 1) * sizeof(char*))); \
  va_end(list);                                                                                              \
  va_start(list, first);                                                                                     \
  take_words(first, &list, words)

UNDERSTUDY_EXPORT int execl(const char* path, const char* first, ...) noexcept {
  UNDERSTUDY_TAKE_WORDS(first, list, words);
  va_end(list);
  return execve(path, words, environ);
}

UNDERSTUDY_EXPORT int execlp(const char* file, const char* first, ...) noexcept {
  UNDERSTUDY_TAKE_WORDS(first, list, words);
  va_end(list);
  return execvpe(file, words, environ);
}

UNDERSTUDY_EXPORT int execle(const char* path, const char* first, ...) noexcept {
  UNDERSTUDY_TAKE_WORDS(first, list, words);
  char* const* const environment = va_arg(list, char* const*);
  va_end(list);
  return execve(path, words, environment);
}
