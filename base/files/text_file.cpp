#include "base/files/text_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <utility>

#include "base/files/descriptor.h"
#include "base/files/output_file.h"

namespace understudy {

namespace {

/// Opens a regular file, or says why not. It never waits: a pipe without a writer would.
Descriptor open_regular(const std::string& path, std::string& why) {
  Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  struct stat status = {};
  if (!file || ::fstat(file.get(), &status) != 0) {
    why = std::string("cannot be read (") + std::strerror(errno) + ")";
  } else if (!S_ISREG(status.st_mode)) {
    why = "is not a regular file";
    file = Descriptor();
  }
  return file;
}

int write_all(int file, const std::string& contents) {
  for (std::size_t done = 0; done < contents.size();) {
    const ssize_t written = ::write(file, contents.data() + done, contents.size() - done);
    if (written >= 0) {
      done += static_cast<std::size_t>(written);
    } else if (errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

/// Writes to a new file and waits for the disk; 0, or the error.
int write_whole(int file, const std::string& contents) {
  int error = write_all(file, contents);
  if (error == 0 && ::fsync(file) != 0) error = errno;
  if (::close(file) != 0 && error == 0) error = errno;
  return error;
}

/// A new file under the first free name beside `path`; its descriptor, or -1.
int make_beside(const std::string& path, std::string& name) {
  int file = -1;
  for (int i = 1; file < 0; ++i) {
    name = path + ".new" + (i == 1 ? "" : "-" + std::to_string(i));
    file = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
    if (file < 0 && errno != EEXIST) break;
  }
  return file;
}

}  // namespace

FileText read_text_file(const std::string& path) {
  FileText text;
  const Descriptor file = open_regular(path, text.why);
  return file ? read_text_of(file.get()) : text;
}

FileText read_text_of(int descriptor) {
  FileText text;
  std::string bytes;
  std::array<char, std::size_t{1} << 16> piece{};
  while (true) {
    const ssize_t size = ::read(descriptor, piece.data(), piece.size());
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) {
      text.why = std::string("cannot be read (") + std::strerror(errno) + ")";
      return text;
    }
    if (size == 0) break;
    // It may grow while it is read, so that its size beforehand says little.
    if (bytes.size() + static_cast<std::size_t>(size) > kMostTextBytes) {
      text.why = "is larger than " + std::to_string(kMostTextBytes >> 20) + " MiB";
      return text;
    }
    bytes.append(piece.data(), static_cast<std::size_t>(size));
  }
  text.emplace(std::move(bytes));
  return text;
}

std::string why_not_readable(const std::string& path) {
  std::string why;
  open_regular(path, why);
  return why;
}

std::string replace_text_file(const std::string& path, const std::string& contents) {
  std::string target;
  try {
    target = output_target(path);
  } catch (const OutputError& error) {
    return error.what();
  }
  std::string beside;
  const int file = make_beside(target, beside);
  if (file < 0) return std::strerror(errno);
  int error = write_whole(file, contents);
  if (error == 0 && std::rename(beside.c_str(), target.c_str()) != 0) error = errno;
  if (error == 0) return "";
  unlink(beside.c_str());
  return std::strerror(error);
}

}  // namespace understudy
