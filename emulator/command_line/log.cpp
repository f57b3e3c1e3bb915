#include "emulator/command_line/log.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "emulator/one_line.h"

namespace understudy::emulator {

void log_line(const std::string& text) {
  static const auto logger = [] {
    auto made = spdlog::stderr_color_st("understudy");
    made->set_pattern("understudy: %v");
    return made;
  }();
  logger->info(one_line(text));
}

}  // namespace understudy::emulator
