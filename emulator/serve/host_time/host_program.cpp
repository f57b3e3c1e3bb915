#include "emulator/serve/host_time/host_program.h"

#include <elf.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <ios>
#include <sstream>
#include <string>
#include <vector>

#include "base/text/one_line.h"

namespace understudy::emulator::serve {

namespace {

constexpr std::size_t kHead = 64 * 1024;  // the headers of a program are within its first bytes

std::string head_of(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string head(kHead, '\0');
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(stream.gcount()));
  return head;
}

/// Returns the program after "#!", or an empty text.
std::string interpreter_of(const std::string& head) {
  if (!head.starts_with("#!")) return {};
  std::istringstream line(head.substr(2, head.find('\n') - 2));
  std::string interpreter;
  line >> interpreter;
  return interpreter;
}

/// Returns true if the dynamic linker loads the program.
bool is_dynamic(const std::string& head) {
  Elf64_Ehdr header;
  std::memcpy(&header, head.data(), sizeof header);
  for (std::size_t i = 0; i < header.e_phnum; ++i) {
    const std::size_t at = header.e_phoff + i * header.e_phentsize;
    if (at + sizeof(Elf64_Phdr) > head.size()) return true;  // beyond the part that was read
    Elf64_Phdr part;
    std::memcpy(&part, head.data() + at, sizeof part);
    if (part.p_type == PT_INTERP) return true;
  }
  return false;
}

std::string why_not(const std::string& file, int depth) {
  struct stat status {};
  if (file.empty() || depth > 4 || ::stat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
  const std::string head = head_of(file);
  if (const std::string interpreter = interpreter_of(head); !interpreter.empty())
    return why_not(interpreter, depth + 1);
  if (head.size() < sizeof(Elf64_Ehdr) || !head.starts_with(ELFMAG)) return {};
  const std::string name = one_line(file);
  const std::string own = head_of("/proc/self/exe");
  const bool is_ours =
      head[EI_CLASS] == own[EI_CLASS] &&
      head.compare(offsetof(Elf64_Ehdr, e_machine), 2, own, offsetof(Elf64_Ehdr, e_machine), 2) == 0;
  if (!is_ours) {
    return name + " is for a different processor" + (head[EI_CLASS] == ELFCLASS32 ? " (32 bits)" : "") +
           " and cannot load our library; expected a program for this processor";
  }
  if (!is_dynamic(head))
    return name +
           " is statically linked and calls the kernel itself; expected a program that is linked with "
           "libc.so";
  const bool is_another = ((status.st_mode & S_ISUID) != 0 && status.st_uid != geteuid()) ||
                          ((status.st_mode & S_ISGID) != 0 && status.st_gid != getegid());
  if (is_another)
    return name +
           " runs as another user (setuid or setgid), so it does not load our library; expected a copy "
           "without these bits";
  return {};
}

}  // namespace

std::string program_file(const std::string& command) {
  if (command.find('/') != std::string::npos) return command;
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "/usr/local/bin:/usr/bin:/bin");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::string file = (folder.empty() ? "." : folder) + "/" + command;
    if (access(file.c_str(), X_OK) == 0) return file;
  }
  return {};
}

bool can_be_started(const std::string& command) {
  const std::string file = program_file(command);
  return !file.empty() && access(file.c_str(), X_OK) == 0;
}

std::string why_not_in_host_time(const std::string& command) { return why_not(program_file(command), 0); }

}  // namespace understudy::emulator::serve
