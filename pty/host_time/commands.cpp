// Commands that a host runs in a shell. libc starts them by a call that cannot be replaced, so the bench
// would not know of them before they greet.
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "pty/host_time/shim.h"

using namespace understudy::host_time;

namespace {

pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;

[[noreturn]] void become_shell(const char* command) {
  execl("/bin/sh", "sh", "-c", command, static_cast<char*>(nullptr));
  _exit(127);
}

/// Returns the status of a child, or -1.
int wait_for_end(pid_t child) {
  int status = -1;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return -1;
  }
  return status;
}

/// While commands of system() run, the process ignores these signals.
struct Ignored {
  int commands;
  struct sigaction interrupt;
  struct sigaction quit;
};
Ignored ignored;

void begin_ignoring() {
  struct sigaction ignore = {};
  ignore.sa_handler = SIG_IGN;
  pthread_mutex_lock(&mutex);
  if (ignored.commands++ == 0) {
    sigaction(SIGINT, &ignore, &ignored.interrupt);
    sigaction(SIGQUIT, &ignore, &ignored.quit);
  }
  pthread_mutex_unlock(&mutex);
}

void restore_ignored() {
  sigaction(SIGINT, &ignored.interrupt, nullptr);
  sigaction(SIGQUIT, &ignored.quit, nullptr);
}

void end_ignoring() {
  pthread_mutex_lock(&mutex);
  if (--ignored.commands == 0) restore_ignored();
  pthread_mutex_unlock(&mutex);
}

}  // namespace

UNDERSTUDY_EXPORT int system(const char* command) {
  if (!is_active() || command == nullptr) return UNDERSTUDY_REAL(system)(command);
  sigset_t blocked;
  sigset_t before;
  sigemptyset(&blocked);
  sigaddset(&blocked, SIGCHLD);
  begin_ignoring();
  pthread_sigmask(SIG_BLOCK, &blocked, &before);
  const pid_t child = fork();
  if (child == 0) {
    restore_ignored();
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    become_shell(command);
  }
  const int status = child < 0 ? -1 : wait_for_end(child);
  const int error = errno;
  end_ignoring();
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  errno = error;
  return status;
}

namespace {

constexpr int kMaxStreams = 64;
struct Stream {
  FILE* file;
  pid_t child;
};
Stream streams[kMaxStreams];

/// Returns the place of a file, or a free place for null. Returns null if there is none.
Stream* place_of(const FILE* file) {
  for (Stream& stream : streams) {
    if (stream.file == file) return &stream;
  }
  return nullptr;
}

/// Makes one end of a pipe the child's standard input or output, and closes those of other commands.
[[noreturn]] void become_command(const char* command, int end, int standard) {
  for (const Stream& stream : streams) {
    if (stream.file != nullptr) close(fileno(stream.file));
  }
  if (end == standard) {
    fcntl(end, F_SETFD, 0);
  } else {
    dup2(end, standard);
  }
  become_shell(command);
}

/// Returns the file of a command that has just been started in `place`, or null.
FILE* start(const char* command, const char* mode, Stream& place) {
  const bool reads = mode[0] == 'r';
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return nullptr;
  const int own = ends[reads ? 0 : 1];
  const int other = ends[reads ? 1 : 0];
  FILE* const file = fdopen(own, reads ? "r" : "w");
  const pid_t child = file == nullptr ? -1 : fork();
  if (child == 0) become_command(command, other, reads ? STDOUT_FILENO : STDIN_FILENO);
  close(other);
  if (child > 0) {
    place = {file, child};
    if (strchr(mode, 'e') == nullptr) fcntl(own, F_SETFD, 0);
    return file;
  }
  const int error = errno;
  if (file != nullptr) {
    fclose(file);
  } else {
    close(own);
  }
  errno = error;
  return nullptr;
}

}  // namespace

UNDERSTUDY_EXPORT FILE* popen(const char* command, const char* mode) {
  const bool is_good = (mode[0] == 'r' || mode[0] == 'w') && (mode[1] == '\0' || strcmp(mode + 1, "e") == 0);
  if (!is_active() || !is_good) return UNDERSTUDY_REAL(popen)(command, mode);
  pthread_mutex_lock(&mutex);
  Stream* const place = place_of(nullptr);
  FILE* const file = place != nullptr ? start(command, mode, *place) : nullptr;
  pthread_mutex_unlock(&mutex);
  return place != nullptr ? file : UNDERSTUDY_REAL(popen)(command, mode);
}

UNDERSTUDY_EXPORT int pclose(FILE* file) {
  pthread_mutex_lock(&mutex);
  Stream* const place = file != nullptr ? place_of(file) : nullptr;
  const pid_t child = place != nullptr ? place->child : -1;
  if (place != nullptr) *place = {};
  pthread_mutex_unlock(&mutex);
  if (place == nullptr) return UNDERSTUDY_REAL(pclose)(file);
  fclose(file);
  return wait_for_end(child);
}
