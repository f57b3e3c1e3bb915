#include "emulator/serve/host_time/host_library.h"

#include <elf.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/statvfs.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>

#include "base/files/descriptor.h"
#include "base/text/one_line.h"
#include "emulator/serve/ports/tty_shim.h"
#include "pty/host_time/protocol.h"

namespace understudy::emulator::serve {

void require_host_library(const std::string& path) {
  const auto refuse = [&](const std::string& why) {
    throw NoTtyShim("--host-time: " + one_line(path) + " " + why);
  };
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat status {};
  if (!file || ::fstat(file.get(), &status) != 0)
    refuse(std::string("cannot be read: ") + std::strerror(errno) + "; expected a file that hosts may read");
  struct statvfs system {};
  if (::fstatvfs(file.get(), &system) == 0 && (system.f_flag & ST_NOEXEC) != 0)
    refuse(
        "is on a file system where no program may run (noexec), so no host can load it; expected a different "
        "file system");
  std::string text;
  if (S_ISREG(status.st_mode)) {
    std::ifstream stream(path, std::ios::binary);
    text.assign(std::istreambuf_iterator<char>(stream), {});
  }
  const bool is_ours = text.starts_with(ELFMAG) && text.find(UNDERSTUDY_HOST_TIME_MARK) != std::string::npos;
  if (!is_ours) refuse("is not the library of this version; expected the one that comes with this program");
}

}  // namespace understudy::emulator::serve
