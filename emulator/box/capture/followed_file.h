// A file that another program still writes: at its end, reading waits for more.
#pragma once

#include <array>
#include <functional>
#include <streambuf>
#include <string>

#include "base/files/descriptor.h"

namespace understudy::emulator::box {

class FollowedFile : public std::streambuf {
 public:
  /// Reading ends when `is_over` returns true. The file may appear later.
  FollowedFile(std::string path, std::function<bool()> is_over);

  /// Waits for the first bytes of the file and returns them without consuming them. Returns none if reading
  /// is over.
  std::string head();

 protected:
  int_type underflow() override;

 private:
  std::string path_;
  std::function<bool()> is_over_;
  Descriptor file_;
  std::array<char, 4096> part_{};
};

}  // namespace understudy::emulator::box
