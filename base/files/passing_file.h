// A file for another program, which is there as long as its object.
#pragma once

#include <string>
#include <string_view>

namespace understudy {

class PassingFile {
 public:
  /// Creates a file in the system's folder for temporary files. Only the user can read it. `name` is the
  /// beginning of its name. Throws FileError.
  PassingFile(std::string_view name, std::string_view content);
  ~PassingFile();
  PassingFile(const PassingFile&) = delete;
  PassingFile& operator=(const PassingFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace understudy
