// A file that a command writes once all is over: results, a page.
#pragma once

#include <cerrno>
#include <fstream>
#include <string>
#include <system_error>

namespace understudy::emulator {

/// Opened before anything is played, so that a wrong path is told at once.
class ResultFile {
 public:
  /// Nothing is written if the path is empty.
  ResultFile(const char* flag, const std::string& path) : flag_(flag), path_(path) {
    if (path_.empty()) return;
    file_.open(path_, std::ios::binary | std::ios::trunc);
    demand_good();
  }
  bool is_wanted() const { return !path_.empty(); }
  void write(const std::string& text) {
    file_ << text << std::flush;
    demand_good();
  }

 private:
  void demand_good() const {
    if (file_.good()) return;
    throw std::system_error(errno, std::generic_category(), flag_ + ": " + path_ + " cannot be written");
  }
  std::string flag_;
  std::string path_;
  std::ofstream file_;
};

}  // namespace understudy::emulator
