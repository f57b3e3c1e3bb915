#include "emulator/command_line/new_files.h"

#include <fcntl.h>
#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <exception>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/files/descriptor.h"
#include "base/files/file_error.h"
#include "base/files/growing_file.h"

namespace understudy::emulator::command_line {

namespace {

bool is_present(const std::string& path) {
  std::error_code error;
  return std::filesystem::symlink_status(path, error).type() != std::filesystem::file_type::not_found;
}

/// Writes a new file. Never overwrites a file. Throws FileError if a file with that name exists.
void write_new(const NewFile& file) {
  const Descriptor made(::open(file.path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  const auto refuse = [&file](int error) {
    if (error == EEXIST) throw FileError(file.path + ": file: already exists; expected a new file");
    throw GrowingFileError(file.path + ": file: cannot be written (" + std::strerror(error) +
                           "); expected a new file");
  };
  if (!made) refuse(errno);
  for (std::string_view rest = file.text; !rest.empty();) {
    const ssize_t size = ::write(made.get(), rest.data(), rest.size());
    if (size < 0 && errno != EINTR) {
      const int error = errno;
      ::unlink(file.path.c_str());
      refuse(error);
    }
    if (size > 0) rest.remove_prefix(static_cast<std::size_t>(size));
  }
}

}  // namespace

void require_new(const std::vector<NewFile>& files) {
  for (const NewFile& file : files) {
    if (is_present(file.path))
      throw FileError(file.path + ": file: already exists; expected a folder without it");
  }
}

// If a file cannot be written, the previously written files are removed.
void write_all(const std::vector<NewFile>& files) {
  std::size_t written = 0;
  try {
    for (; written < files.size(); ++written) write_new(files[written]);
  } catch (const std::exception&) {
    for (std::size_t i = 0; i < written; ++i) ::unlink(files[i].path.c_str());
    throw;
  }
}

}  // namespace understudy::emulator::command_line
