#include "emulator/box/capture/followed_file.h"

#include <fcntl.h>
#include <sys/types.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <string>
#include <thread>
#include <utility>

namespace understudy::emulator::box {

namespace {

/// A signal does not end it, so it is short.
constexpr std::chrono::milliseconds kGrowthPause{20};

}  // namespace

FollowedFile::FollowedFile(std::string path, std::function<bool()> is_over)
    : path_(std::move(path)), is_over_(std::move(is_over)) {}

std::string FollowedFile::head() {
  if (underflow() == traits_type::eof()) return "";
  return {gptr(), egptr()};
}

FollowedFile::int_type FollowedFile::underflow() {
  if (gptr() != egptr()) return traits_type::to_int_type(*gptr());
  while (!is_over_()) {
    if (!file_) file_ = Descriptor(::open(path_.c_str(), O_RDONLY | O_CLOEXEC));
    const ssize_t size = file_ ? ::read(file_.get(), part_.data(), part_.size()) : 0;
    if (size > 0) {
      setg(part_.data(), part_.data(), part_.data() + size);
      return traits_type::to_int_type(*gptr());
    }
    std::this_thread::sleep_for(kGrowthPause);
  }
  return traits_type::eof();
}

}  // namespace understudy::emulator::box
