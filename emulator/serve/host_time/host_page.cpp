#include "emulator/serve/host_time/host_page.h"

#include <fcntl.h>
#include <linux/futex.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <string>
#include <system_error>

#include "base/files/descriptor.h"
#include "base/simulated_time.h"
#include "pty/host_time/protocol.h"

namespace understudy::emulator::serve {

HostPage::HostPage(const std::string& path) : path_(path) {
  const Descriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
  if (!file || ::ftruncate(file.get(), sizeof(host_time::Page)) != 0)
    throw std::system_error(errno, std::generic_category(), path);
  void* const mapped =
      ::mmap(nullptr, sizeof(host_time::Page), PROT_READ | PROT_WRITE, MAP_SHARED, file.get(), 0);
  if (mapped == MAP_FAILED) throw std::system_error(errno, std::generic_category(), path);
  page_ = static_cast<host_time::Page*>(mapped);
  page_->version = host_time::kVersion;
  std::fill(std::begin(page_->lines), std::end(page_->lines), -1);
}

HostPage::~HostPage() {
  ::munmap(page_, sizeof(host_time::Page));
  ::unlink(path_.c_str());
}

void HostPage::set_now(SimTime now) {
  __atomic_store_n(&page_->now_ns, std::int64_t{now.count()}, __ATOMIC_RELEASE);
}

void HostPage::wake(int thread) {
  std::uint32_t& word = page_->words[static_cast<std::uint32_t>(thread) % host_time::kWords];
  __atomic_fetch_add(&word, 1, __ATOMIC_ACQ_REL);
  ::syscall(SYS_futex, &word, FUTEX_WAKE, INT32_MAX, nullptr, nullptr, 0);
}

void HostPage::set_line(std::size_t line, int terminal) {
  if (line >= host_time::kMaxLines) return;
  page_->lines[line] = terminal;
  page_->line_count = std::max(page_->line_count, static_cast<std::uint32_t>(line + 1));
}

void HostPage::set_door(std::size_t door, std::uint16_t port, const std::string& address) {
  host_time::Door& place = page_->doors[door];
  place.port = port;
  const std::size_t size = std::min(address.size(), sizeof place.address - 1);
  std::copy_n(address.begin(), size, place.address);
  page_->door_count = std::max(page_->door_count, static_cast<std::uint32_t>(door + 1));
}

}  // namespace understudy::emulator::serve
