#include "pty/port_link.h"

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "base/files/output_file.h"
#include "pty/port_claim.h"

namespace understudy::pty {
namespace {

/// Returns the target of a symbolic link, or an empty string if `path` is not one.
std::string link_target(const std::string& path) {
  std::array<char, PATH_MAX> target{};
  const ssize_t size = ::readlink(path.c_str(), target.data(), target.size());
  return size > 0 ? std::string(target.data(), static_cast<std::size_t>(size)) : std::string();
}

const std::string kExpected = ", not a link that understudy made; expected a free path or a stale link";

/// Throws if `absolute_path` exists and is not a symbolic link.
void require_link_or_nothing(const std::string& path, const std::string& absolute_path) {
  struct stat status = {};
  if (::lstat(absolute_path.c_str(), &status) != 0 || S_ISLNK(status.st_mode)) return;
  throw PortError(path + ": is " + kind_of_file(status.st_mode) + kExpected);
}

/// Throws if the link at `absolute_path` may not be replaced.
void require_stale(const std::string& path, const std::string& absolute_path) {
  require_link_or_nothing(path, absolute_path);
  const std::string target = link_target(absolute_path);
  if (target.starts_with("/dev/pts/")) return;
  struct stat status = {};
  const bool dangles = ::stat(absolute_path.c_str(), &status) != 0 && (errno == ENOENT || errno == ENOTDIR);
  if (!dangles) throw PortError(path + ": is a link to " + target + kExpected);
}

/// Creates a link under the first free name next to `name` and returns that name, or an empty string with
/// errno set if it fails.
std::string make_link_beside(const std::string& name, const std::string& target) {
  for (int i = 1;; ++i) {
    const std::string fresh = name + ".new" + (i == 1 ? "" : "-" + std::to_string(i));
    if (::symlink(target.c_str(), fresh.c_str()) == 0) return fresh;
    if (errno != EEXIST) return "";
  }
}

/// Creates a link, or replaces one in one step, so that the path never lacks a link. Returns 0 or the error
/// number.
int replace_link(const std::string& path, const std::string& target) {
  const std::string fresh = make_link_beside(path, target);
  if (fresh.empty()) return errno;
  if (::rename(fresh.c_str(), path.c_str()) == 0) return 0;
  const int error = errno;
  ::unlink(fresh.c_str());
  return error;
}

PortError cannot_link(const std::string& path, int error) {
  return PortError(path + ": the link cannot be created: " + port_trouble(error) +
                   "; expected a writable directory");
}

void require_directory(const std::string& path, const std::filesystem::path& absolute_path) {
  const std::filesystem::path parent = absolute_path.parent_path();
  std::error_code error;
  if (std::filesystem::is_directory(parent, error)) return;
  const bool exists = std::filesystem::exists(parent, error);
  throw PortError(path + ": " + parent.string() + (exists ? " is not a directory" : " does not exist") +
                  "; expected an existing directory");
}

}  // namespace

std::string port_trouble(int error) {
  const std::string printed = std::generic_category().message(error);
  rlimit files = {};
  if (error != EMFILE || ::getrlimit(RLIMIT_NOFILE, &files) != 0) return printed;
  return printed + "; `ulimit -n` is " + std::to_string(files.rlim_cur) + ", and each port needs 3";
}

PortLink::PortLink(const std::string& path, std::string target) {
  const std::filesystem::path absolute_path = std::filesystem::absolute(path);
  require_directory(path, absolute_path);
  const std::string name = absolute_path.string();
  require_link_or_nothing(path, name);
  std::error_code ignored;
  const auto canonical_parent = std::filesystem::canonical(absolute_path.parent_path(), ignored);
  try {
    claim_ = PortClaim((canonical_parent / absolute_path.filename()).string());
  } catch (const std::system_error& error) {
    if (error.code().value() == EMFILE) throw PortError(path + ": " + port_trouble(EMFILE));
    throw PortError(path + ": cannot tell whether the link is in use: " + error.what() +
                    "; expected to be able to create and lock that file");
  }
  if (!claim_) {
    throw PortError(path +
                    ": is the link of another running understudy; expected a free path or a stale link");
  }
  // A free path is taken in one step that never replaces anything.
  if (::symlink(target.c_str(), name.c_str()) != 0) {
    if (errno != EEXIST) throw cannot_link(path, errno);
    require_stale(path, name);
    if (const int error = replace_link(name, target)) throw cannot_link(path, error);
  }
  absolute_path_ = name;
  target_ = std::move(target);
}

PortLink::~PortLink() {
  if (!target_.empty() && link_target(absolute_path_) == target_) ::unlink(absolute_path_.c_str());
}

void PortLink::point_to(const std::string& target) {
  if (target_.empty() || link_target(absolute_path_) != target_) return;
  if (const int error = replace_link(absolute_path_, target)) throw cannot_link(absolute_path_, error);
  target_ = target;
}

PortLink::PortLink(PortLink&& other) noexcept
    : absolute_path_(std::move(other.absolute_path_)),
      target_(std::exchange(other.target_, {})),
      claim_(std::move(other.claim_)) {}

PortLink& PortLink::operator=(PortLink&& other) noexcept {
  std::swap(absolute_path_, other.absolute_path_);
  std::swap(target_, other.target_);
  std::swap(claim_, other.claim_);
  return *this;
}

}  // namespace understudy::pty
