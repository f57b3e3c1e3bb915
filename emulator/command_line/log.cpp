#include "emulator/command_line/log.h"

#include <poll.h>
#include <sys/types.h>
#include <unistd.h>

#include <climits>
#include <string>

#include "base/text/one_line.h"

namespace understudy::emulator::command_line {

/// Prints a line without waiting for standard error. If the reader of standard error stalls, lines are lost,
/// but the devices are not delayed.
void log_line(const std::string& text) {
  std::string line = "understudy: " + one_line(text) + "\n";
  // A writable pipe has room for at least PIPE_BUF bytes. A longer line could block.
  if (line.size() > PIPE_BUF) {
    line.resize(PIPE_BUF);
    line.back() = '\n';
  }
  pollfd standard_error{.fd = STDERR_FILENO, .events = POLLOUT, .revents = 0};
  if (poll(&standard_error, 1, 0) == 1 && (standard_error.revents & POLLOUT) != 0) {
    [[maybe_unused]] const ssize_t ignored = write(STDERR_FILENO, line.data(), line.size());
  }
}

}  // namespace understudy::emulator::command_line
