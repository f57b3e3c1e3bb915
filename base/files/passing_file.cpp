#include "base/files/passing_file.h"

#include <stdlib.h>
#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "base/files/descriptor.h"
#include "base/files/file_error.h"

namespace understudy {

PassingFile::PassingFile(std::string_view name, std::string_view content)
    : path_((std::filesystem::temp_directory_path() / (std::string(name) + "-XXXXXX")).string()) {
  const Descriptor file(::mkstemp(path_.data()));
  std::size_t written = 0;
  while (file.get() >= 0 && written < content.size()) {
    const ssize_t size = ::write(file.get(), content.data() + written, content.size() - written);
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) break;
    written += static_cast<std::size_t>(size);
  }
  if (file.get() >= 0 && written == content.size()) return;
  const std::string why = std::generic_category().message(errno);
  if (file.get() >= 0) ::unlink(path_.c_str());
  throw FileError(path_ + ": cannot be written: " + why);
}

PassingFile::~PassingFile() { ::unlink(path_.c_str()); }

}  // namespace understudy
