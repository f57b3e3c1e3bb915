#include "base/files/text_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/files/content_kind.h"
#include "base/files/descriptor.h"
#include "base/files/output_file.h"
#include "base/text/lines.h"
#include "base/text/parse_integer.h"

namespace understudy {

namespace {

/// Opens a regular file, or sets `why`. It never blocks, unlike opening a pipe that has no writer.
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

constexpr std::string_view kBeside = ".new";

/// Returns the name of a temporary file next to `path`: "a.json.new", then "a.json.new-2".
std::string name_beside(const std::string& path, int number) {
  return path + std::string(kBeside) + (number == 1 ? "" : "-" + std::to_string(number));
}

/// Returns true if `rest` is a suffix that name_beside() appends to a file's name.
bool is_beside(std::string_view rest) {
  if (!rest.starts_with(kBeside)) return false;
  rest.remove_prefix(kBeside.size());
  return rest.empty() || (rest.starts_with("-") && parse_integer(rest.substr(1)).value_or(0) > 1);
}

bool is_still_there(int file, const std::string& name) {
  struct stat opened = {};
  struct stat named = {};
  return ::fstat(file, &opened) == 0 && ::lstat(name.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

/// Creates a new file next to `path`, and keeps it locked while it is written. An unlocked file was left by a
/// writer that was killed.
Descriptor make_beside(const std::string& path, mode_t mode, std::string& name) {
  for (int number = 1;; ++number) {
    name = name_beside(path, number);
    Descriptor file(::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode));
    if (!file && errno != EEXIST) return file;
    // Another process may have cleaned up the file before it was locked.
    if (file && ::flock(file.get(), LOCK_EX | LOCK_NB) == 0 && is_still_there(file.get(), name)) return file;
  }
}

/// Writes the contents and waits until they are on the disk. Returns 0 or the error number.
int write_whole(int file, const std::string& contents) {
  const int error = write_all(file, contents);
  return error == 0 && ::fsync(file) != 0 ? errno : error;
}

void remove_if_left(const std::string& name, ContentKind kind) {
  const Descriptor file(::open(name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  struct stat status = {};
  const bool is_one = file && ::fstat(file.get(), &status) == 0 && S_ISREG(status.st_mode) &&
                      ::flock(file.get(), LOCK_EX | LOCK_NB) == 0 && is_still_there(file.get(), name);
  if (!is_one) return;
  if (is_of_kind(kind, head_of_file(name))) ::unlink(name.c_str());
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
    // The file may grow while it is read, so its previous size is not a limit.
    if (bytes.size() + static_cast<std::size_t>(size) > kMaxTextBytes) {
      text.why = "is larger than " + std::to_string(kMaxTextBytes >> 20) + " MiB";
      return text;
    }
    bytes.append(piece.data(), static_cast<std::size_t>(size));
  }
  if (bytes.starts_with(kByteOrderMark)) bytes.erase(0, kByteOrderMark.size());
  text.emplace(std::move(bytes));
  return text;
}

std::string head_of_file(const std::string& path) {
  std::string why;
  const Descriptor file = open_regular(path, why);
  std::string head(kSniffedBytes, '\0');
  const ssize_t size = file ? ::pread(file.get(), head.data(), head.size(), 0) : 0;
  head.resize(static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
  return head;
}

std::string why_not_readable(const std::string& path) {
  std::string why;
  open_regular(path, why);
  return why;
}

std::string replace_text_file(const std::string& path, const std::string& contents, ContentKind kind) {
  std::string target;
  try {
    target = output_target(path);
    require_replaceable(target, kind);
  } catch (const OutputError& error) {
    return error.what();
  }
  const std::optional<FileAccess> access = access_of(target);
  std::string beside;
  // Other users must not read the new file before it has the mode of the file that it replaces.
  const Descriptor file = make_beside(target, access ? 0600 : 0644, beside);
  if (!file) return std::strerror(errno);
  int error = write_whole(file.get(), contents);
  if (access) give_access(file.get(), *access);
  if (error == 0 && std::rename(beside.c_str(), target.c_str()) != 0) error = errno;
  if (error == 0) return "";
  unlink(beside.c_str());
  return std::strerror(error);
}

void remove_left_beside(const std::string& path, ContentKind kind) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path file(path);
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const std::string own_name = file.filename().string();
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const std::string name = it->path().filename().string();
    if (name.starts_with(own_name) && is_beside(std::string_view(name).substr(own_name.size()))) {
      remove_if_left(it->path().string(), kind);
    }
  }
}

}  // namespace understudy
