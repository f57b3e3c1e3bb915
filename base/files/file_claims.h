// Records which files a command reads and which it writes. An output must differ from all other outputs and
// from all files that are read. Otherwise, a typing error would destroy a file. Commands check this before
// they open anything. base/files/output_file.h has the other rules about outputs.
#pragma once

#include <sys/types.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace understudy {

/// A file and its role in the command: "the bench itself", "what --junit writes".
struct FileClaim {
  std::string path;
  std::string what;
};

/// Recognizes when two paths lead to the same file, through symbolic and hard links, and even before the file
/// exists. Special files are ignored, because they have no content to lose. For a link or a socket that the
/// program creates, the path itself is claimed, because replacing it would disconnect its users.
class FileClaims {
 public:
  /// Claims a file. If it is already claimed, the first claim stays.
  void add(const FileClaim& claim);
  void add(const std::vector<FileClaim>& claims);
  void add_place(const FileClaim& claim);
  /// Returns why the path cannot be written: "is the bench itself; expected another path". Empty if it can.
  std::string objection_to(const std::string& path) const;
  /// Like objection_to(), for all files in `folder` whose names end in one of `endings`.
  std::string objection_to_folder(const std::string& folder, const std::vector<std::string>& endings) const;

 private:
  std::map<std::pair<dev_t, ino_t>, std::string> of_files_;  // existing files, and their roles
  std::map<std::string, std::string> of_paths_;   // all files by their resolved paths, and their roles
  std::map<std::string, std::string> of_places_;  // unresolved paths of links and sockets, and their roles
};

}  // namespace understudy
