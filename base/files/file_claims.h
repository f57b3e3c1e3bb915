// Which files a command reads, and which it writes: an output may be neither another output nor anything that
// is read, or a slip of the hand would cost the user a file. Asked before anything is opened;
// base/files/output_file.h knows what else may not be written.
#pragma once

#include <sys/types.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace understudy {

/// A file, and what it means to whoever claims it: "the bench itself", "what --junit writes".
struct FileClaim {
  std::string path;
  std::string what;
};

/// A file is the same file however its path is spelled, through links of both kinds, and even before it
/// exists. Anything that is not a regular file is left out: nothing in it can be lost. For a link or a socket
/// that we make, the path itself is claimed: replacing it would cut us off.
class FileClaims {
 public:
  /// The first claim on a file stands.
  void add(const FileClaim& claim);
  void add(const std::vector<FileClaim>& claims);
  void add_place(const FileClaim& claim);
  /// Why the path cannot be written: "is the bench itself; expected another path". Empty if it can.
  std::string objection_to(const std::string& path) const;
  /// Like the above, for files in a folder of which only the `endings` are known beforehand.
  std::string objection_to_folder(const std::string& folder, const std::vector<std::string>& endings) const;

 private:
  std::map<std::pair<dev_t, ino_t>, std::string> of_files_;  // those that are there; what they are
  std::map<std::string, std::string> of_paths_;              // all, by where their paths lead
  std::map<std::string, std::string> of_places_;             // what stands there, wherever that leads
};

}  // namespace understudy
