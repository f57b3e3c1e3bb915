// Which files a command reads, and which it writes: what is written may be neither another output nor
// anything that is read, or a slip of the hand costs the user a file. Asked before anything is opened; what
// else may not be written is for base/files/output_file.h.
#pragma once

#include <sys/types.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace understudy {

/// A file, and what it is to whoever claims it: "the bench itself", "what --junit writes".
struct FileClaim {
  std::string path;
  std::string what;
};

/// A file is itself however its path is spelled, through links of both kinds, and also before it is there.
/// What is there but is not a regular file is left out: nothing in it can be lost. Of a link or a socket that
/// we make the place itself is claimed: whoever replaced it would cut us off.
class FileClaims {
 public:
  /// The first claim on a file stands.
  void add(const FileClaim& claim);
  void add(const std::vector<FileClaim>& claims);
  void add_place(const FileClaim& claim);
  /// Why the path cannot be written: "is the bench itself; expected a path of its own". Empty if it can.
  std::string objection_to(const std::string& path) const;
  /// The same for files in a folder of which only the `endings` are known beforehand.
  std::string objection_to_folder(const std::string& folder, const std::vector<std::string>& endings) const;

 private:
  std::map<std::pair<dev_t, ino_t>, std::string> of_files_;  // those that are there; what they are
  std::map<std::string, std::string> of_paths_;              // all, by where their paths lead
  std::map<std::string, std::string> of_places_;             // what stands there, wherever that leads
};

}  // namespace understudy
