#include "emulator/command_line/log.h"

#include <poll.h>
#include <spdlog/logger.h>
#include <spdlog/sinks/base_sink.h>
#include <sys/types.h>
#include <unistd.h>

#include <climits>
#include <memory>
#include <string>

#include "base/text/one_line.h"

namespace understudy::emulator::command_line {

namespace {

/// Standard error, never waited for: a reader that stops reading costs lines, not the devices' time.
class UnblockingStandardError final : public spdlog::sinks::base_sink<spdlog::details::null_mutex> {
 protected:
  void sink_it_(const spdlog::details::log_msg& message) override {
    spdlog::memory_buf_t line;
    formatter_->format(message, line);
    // A pipe that is writable has room for PIPE_BUF bytes at least; a longer line could be waited for.
    if (line.size() > PIPE_BUF) {
      line.resize(PIPE_BUF);
      line[PIPE_BUF - 1] = '\n';
    }
    pollfd standard_error{.fd = STDERR_FILENO, .events = POLLOUT, .revents = 0};
    if (poll(&standard_error, 1, 0) == 1 && (standard_error.revents & POLLOUT) != 0) {
      [[maybe_unused]] const ssize_t ignored = write(STDERR_FILENO, line.data(), line.size());
    }
  }
  void flush_() override {}
};

}  // namespace

void log_line(const std::string& text) {
  static spdlog::logger logger = [] {
    spdlog::logger made("understudy", std::make_shared<UnblockingStandardError>());
    made.set_pattern("understudy: %v");
    return made;
  }();
  logger.info(one_line(text));
}

}  // namespace understudy::emulator::command_line
