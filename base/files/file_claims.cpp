#include "base/files/file_claims.h"

#include <sys/stat.h>
#include <sys/types.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace understudy {

namespace {

namespace fs = std::filesystem;

constexpr int kMaxLinksFollowed = 40;  // the limit of Linux

/// Returns the file that is created or written when the path is opened.
std::string target_of(const std::string& path) {
  std::error_code error;
  fs::path target = fs::absolute(path, error);
  for (int i = 0; i < kMaxLinksFollowed && fs::is_symlink(target, error); ++i) {
    target =
        target.parent_path() / fs::read_symlink(target, error);  // an absolute link replaces the whole path
  }
  const fs::path canonical = fs::weakly_canonical(target, error);
  return (error ? target.lexically_normal() : canonical).string();
}

/// Returns the path with its folder resolved. The last component is not followed if it is a link.
std::string place_of(const std::string& path) {
  std::error_code error;
  const fs::path absolute = fs::absolute(path, error).lexically_normal();
  return (fs::weakly_canonical(absolute.parent_path(), error) / absolute.filename()).string();
}

struct Found {
  bool is_present = false;
  bool is_special = false;  // exists, but is not a regular file
  std::pair<dev_t, ino_t> file{};
};

Found find(const std::string& path) {
  struct stat status = {};
  if (::stat(path.c_str(), &status) != 0) return {};
  return {.is_present = true, .is_special = !S_ISREG(status.st_mode), .file = {status.st_dev, status.st_ino}};
}

std::string objection(const std::string& what) { return "is " + what + "; expected another path"; }

}  // namespace

void FileClaims::add(const FileClaim& claim) {
  const Found found = find(claim.path);
  if (claim.path.empty() || found.is_special) return;
  if (found.is_present) of_files_.emplace(found.file, claim.what);
  of_paths_.emplace(target_of(claim.path), claim.what);
}

void FileClaims::add(const std::vector<FileClaim>& claims) {
  for (const FileClaim& claim : claims) add(claim);
}

void FileClaims::add_place(const FileClaim& claim) {
  if (!claim.path.empty()) of_places_.emplace(place_of(claim.path), claim.what);
}

std::string FileClaims::objection_to(const std::string& path) const {
  if (path.empty()) return "";
  if (const auto it = of_places_.find(place_of(path)); it != of_places_.end()) return objection(it->second);
  const Found found = find(path);
  if (found.is_special) return "";
  if (found.is_present) {
    if (const auto it = of_files_.find(found.file); it != of_files_.end()) return objection(it->second);
  }
  const auto it = of_paths_.find(target_of(path));
  return it == of_paths_.end() ? "" : objection(it->second);
}

std::string FileClaims::objection_to_folder(const std::string& folder,
                                            const std::vector<std::string>& endings) const {
  const fs::path target = target_of(folder);
  for (const auto& [path, what] : of_paths_) {
    const fs::path file(path);
    const bool is_among_them =
        file.parent_path() == target &&
        std::any_of(endings.begin(), endings.end(),
                    [&name = path](const std::string& ending) { return name.ends_with(ending); });
    if (is_among_them) {
      return "holds " + file.filename().string() + ", which is " + what + "; expected another folder";
    }
  }
  return "";
}

}  // namespace understudy
