// Children of a host: the bench must know of them before time may advance again.
#include <spawn.h>
#include <sys/types.h>
#include <unistd.h>

#include "pty/host_time/shim.h"

using namespace understudy::host_time;

UNDERSTUDY_EXPORT pid_t fork() noexcept {
  const pid_t child = UNDERSTUDY_REAL(fork)();  // in the child, channel.cpp greets the bench
  if (child > 0 && is_active()) tell_child(child);
  return child;
}

/// A child that shares our memory until it becomes another program could not greet the bench.
UNDERSTUDY_EXPORT pid_t vfork() noexcept { return fork(); }

UNDERSTUDY_EXPORT int posix_spawn(pid_t* child, const char* path, const posix_spawn_file_actions_t* actions,
                                  const posix_spawnattr_t* attributes, char* const* words,
                                  char* const* environment) {
  pid_t number = -1;
  const int error = UNDERSTUDY_REAL(posix_spawn)(&number, path, actions, attributes, words, environment);
  if (error == 0 && is_active()) tell_child(number);
  if (child != nullptr) *child = number;
  return error;
}

UNDERSTUDY_EXPORT int posix_spawnp(pid_t* child, const char* file, const posix_spawn_file_actions_t* actions,
                                   const posix_spawnattr_t* attributes, char* const* words,
                                   char* const* environment) {
  pid_t number = -1;
  const int error = UNDERSTUDY_REAL(posix_spawnp)(&number, file, actions, attributes, words, environment);
  if (error == 0 && is_active()) tell_child(number);
  if (child != nullptr) *child = number;
  return error;
}
