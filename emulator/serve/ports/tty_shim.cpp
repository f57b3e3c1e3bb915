#include "emulator/serve/ports/tty_shim.h"

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

namespace understudy::emulator::serve {

namespace fs = std::filesystem;

std::string library_path(const std::string& name) {
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& beside :
       {folder, folder.parent_path()}) {  // either the build folder or the installed folder
    const fs::path path = beside / "lib/understudy" / name;
    if (fs::exists(path, error)) return path.string();
  }
  throw NoTtyShim(folder.string() + ": " + name +
                  " is missing; expected it in lib/understudy or ../lib/understudy");
}

std::string preload_with(const std::string& name) {
  const std::string path = library_path(name);
  if (path.find_first_of(" :") != std::string::npos) {
    throw NoTtyShim(
        path +
        ": LD_PRELOAD does not allow spaces or colons in paths; expected the program in another folder");
  }
  const char* const others = std::getenv("LD_PRELOAD");
  return others == nullptr || *others == '\0' ? path : path + ":" + others;
}

}  // namespace understudy::emulator::serve
