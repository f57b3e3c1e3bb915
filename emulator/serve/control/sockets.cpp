#include "emulator/serve/control/sockets.h"

#include <signal.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/text/parse_integer.h"
#include "emulator/serve/control/server.h"

namespace understudy::emulator::serve {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnding = ".control";

std::string folder_path() {
  if (const char* runtime = std::getenv("XDG_RUNTIME_DIR"); runtime != nullptr && *runtime != '\0') {
    return std::string(runtime) + "/understudy";
  }
  return "/tmp/understudy-" + std::to_string(getuid());
}

/// Returns the process number in a socket's name, such as 1234 for "1234-2.control". Returns nothing for
/// other names.
std::optional<std::int64_t> process_of(const std::string& name) {
  if (!name.ends_with(kEnding)) return std::nullopt;
  const auto number = parse_integer(std::string_view(name).substr(0, name.find_first_of("-.")));
  return number && *number > 0 && *number <= INT32_MAX ? number : std::nullopt;
}

bool is_gone(std::int64_t process) { return kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH; }

}  // namespace

std::string control_folder() {
  std::string folder = folder_path();
  mkdir(folder.c_str(), 0700);
  struct stat status {};
  // If another user owned a folder with this name, that user could read the messages.
  if (lstat(folder.c_str(), &status) < 0 || !S_ISDIR(status.st_mode) || status.st_uid != getuid() ||
      (status.st_mode & 077) != 0) {
    throw ControlError(
        folder +
        ": is not your private folder; expected a folder that only you can access, or --control SOCKET");
  }
  return folder;
}

std::string own_control_path() {
  const std::string begin = control_folder() + "/" + std::to_string(getpid());
  for (int i = 1;; ++i) {
    std::string path = begin + (i == 1 ? "" : "-" + std::to_string(i)) + std::string(kEnding);
    struct stat status {};
    // The path may belong to another daemon of this process, or to an earlier process with the same number.
    if (lstat(path.c_str(), &status) < 0 || !is_answered(path)) return path;
  }
}

std::vector<std::string> live_control_sockets() {
  std::vector<std::string> live;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(control_folder(), error)) {
    const auto process = process_of(entry.path().filename().string());
    const std::string path = entry.path().string();
    if (!process || !entry.is_socket(error)) continue;
    if (is_answered(path)) {
      live.push_back(path);
    } else if (is_gone(*process)) {  // otherwise it may be about to listen
      unlink(path.c_str());
    }
  }
  std::sort(live.begin(), live.end());
  return live;
}

}  // namespace understudy::emulator::serve
