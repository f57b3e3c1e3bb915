#include "base/files/output_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "base/files/content_kind.h"
#include "base/files/descriptor.h"

namespace understudy {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxLinks = 40;  // the limit of Linux
constexpr mode_t kPermissions = 0777;

std::string error_text(int error) { return std::generic_category().message(error); }

/// Decides as Linux does when fs.protected_symlinks and fs.protected_regular are set.
bool is_left_by_a_stranger(const fs::path& place, const struct stat& status) {
  struct stat folder = {};
  if (::stat(place.parent_path().c_str(), &folder) != 0) return true;
  const bool anybody_may_write = (folder.st_mode & S_ISVTX) != 0 && (folder.st_mode & S_IWOTH) != 0;
  return anybody_may_write && status.st_uid != ::geteuid() && status.st_uid != folder.st_uid;
}

/// Throws if the path contains another user's link in a folder that everyone can write to.
void require_own_path(const fs::path& absolute) {
  fs::path so_far;
  for (const fs::path& step : absolute.parent_path()) {
    so_far /= step;
    struct stat status = {};
    if (::lstat(so_far.c_str(), &status) != 0) return;  // opening the file reports the error
    if (S_ISLNK(status.st_mode) && is_left_by_a_stranger(so_far, status)) {
      throw OutputError(
          so_far.string() +
          ": it is another user's link in a folder that everyone can write to; expected a path of your own");
    }
  }
}

/// Returns the beginning of an open file. Throws OutputError.
std::string head_of(int file) {
  std::string head(kSniffedBytes, '\0');
  const ssize_t size = ::pread(file, head.data(), head.size(), 0);
  if (size < 0) throw OutputError("it cannot be read: " + error_text(errno));
  head.resize(static_cast<std::size_t>(size));
  return head;
}

void require_kind(int file, ContentKind kind) {
  if (const std::string why = why_not_replaceable_by(kind, head_of(file)); !why.empty()) {
    throw OutputError(why);
  }
}

}  // namespace

std::string kind_of_file(mode_t mode) {
  if (S_ISREG(mode)) return "a regular file";
  if (S_ISDIR(mode)) return "a directory";
  if (S_ISSOCK(mode)) return "a socket";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISLNK(mode)) return "a link";
  return "a device";
}

std::string output_target(const std::string& path) {
  std::error_code error;
  fs::path target = fs::absolute(path, error);
  for (int links = 0; links <= kMaxLinks; ++links) {
    require_own_path(target);
    struct stat status = {};
    if (::lstat(target.c_str(), &status) != 0) {
      if (errno == ENOENT) return target.string();  // free; if a folder is missing, open() reports it
      throw OutputError(error_text(errno));
    }
    if (S_ISREG(status.st_mode) && is_left_by_a_stranger(target, status)) {
      throw OutputError(
          "it is another user's file in a folder that everyone can write to; expected a path of your own");
    }
    if (S_ISREG(status.st_mode)) return target.string();
    if (!S_ISLNK(status.st_mode)) {
      throw OutputError("it is " + kind_of_file(status.st_mode) +
                        "; expected a regular file, or a free path");
    }
    if (is_left_by_a_stranger(target, status)) {
      throw OutputError(
          "it is another user's link in a folder that everyone can write to; expected a path of your own");
    }
    target = target.parent_path() / fs::read_symlink(target, error);  // an absolute link replaces everything
    if (error) throw OutputError(error.message());
  }
  throw OutputError(error_text(ELOOP));
}

void require_replaceable(const std::string& target, ContentKind kind) {
  const Descriptor file(::open(target.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  if (file) return require_kind(file.get(), kind);
  if (errno != ENOENT) throw OutputError("it cannot be read: " + error_text(errno));
}

std::string why_not_writable(const std::string& path, ContentKind kind) {
  try {
    require_replaceable(output_target(path), kind);
    return "";
  } catch (const OutputError& error) {
    return error.what();
  }
}

std::string why_not_openable(const std::string& path, ContentKind kind) {
  if (std::string why = why_not_writable(path, kind); !why.empty()) return why;
  const fs::path target = output_target(path);
  std::error_code error;
  const bool is_there = fs::exists(target, error);
  const int refused =
      is_there ? ::access(target.c_str(), W_OK) : ::access(target.parent_path().c_str(), W_OK | X_OK);
  return refused == 0 ? "" : error_text(errno);
}

std::optional<FileAccess> access_of(const std::string& path) {
  struct stat status = {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return FileAccess{.owner = status.st_uid, .group = status.st_gid, .mode = status.st_mode & kPermissions};
}

void give_access(int file, const FileAccess& access) {
  struct stat status = {};
  if (::fstat(file, &status) != 0) return;
  const bool is_same = status.st_uid == access.owner && status.st_gid == access.group;
  const bool has_owner = is_same || ::fchown(file, access.owner, access.group) == 0 ||
                         ::fchown(file, static_cast<uid_t>(-1), access.group) == 0;
  // Permissions of the old group must not apply to a different group.
  const mode_t mode = has_owner ? access.mode : access.mode & ~static_cast<mode_t>(S_IRWXG);
  [[maybe_unused]] const int ignored = ::fchmod(file, mode);
}

void give_access(const std::string& path, const FileAccess& access) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  if (file) give_access(file.get(), access);
}

void make_like(const std::string& path, const FileAccess& access) {
  const Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
  if (file) give_access(file.get(), access);
}

OutputFile::OutputFile(const std::string& path, ContentKind kind)
    : target_(output_target(path)),
      file_(
          ::open(target_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC, 0666)) {
  if (!file_) throw OutputError(error_text(errno));
  struct stat status = {};
  if (::fstat(file_.get(), &status) != 0) throw OutputError(error_text(errno));
  if (!S_ISREG(status.st_mode)) throw OutputError("it is not a regular file; expected one, or a free path");
  if (::flock(file_.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    throw OutputError("another program is writing it; expected another path");
  }
  require_kind(file_.get(), kind);
}

void OutputFile::begin(std::string_view head) {
  written_ = 0;
  if (::ftruncate(file_.get(), 0) != 0 || ::lseek(file_.get(), 0, SEEK_SET) != 0) {
    throw OutputError(error_text(errno));
  }
  if (const int error = write(head); error != 0) throw OutputError(error_text(error));
}

void OutputFile::continue_at(std::uint64_t size) {
  const auto end = static_cast<off_t>(size);
  if (::ftruncate(file_.get(), end) != 0 || ::lseek(file_.get(), end, SEEK_SET) != end) {
    throw OutputError(error_text(errno));
  }
  written_ = size;
}

int OutputFile::write(std::string_view piece) {
  const std::uint64_t end = written_ + piece.size();
  while (!piece.empty()) {
    const ssize_t size = ::write(file_.get(), piece.data(), piece.size());
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) {
      const int error = errno;
      [[maybe_unused]] const int ignored = ::ftruncate(file_.get(), static_cast<off_t>(written_));
      return error;
    }
    piece.remove_prefix(static_cast<std::size_t>(size));
  }
  written_ = end;
  return 0;
}

}  // namespace understudy
