#include "emulator/serve/host_time/host_tasks.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>

#include "base/files/descriptor.h"
#include "base/text/one_line.h"

namespace understudy::emulator::serve {

namespace {

std::string folder_of(int process) { return "/proc/" + std::to_string(process) + "/task"; }

/// Returns the beginning of a small file, or an empty text.
std::string_view read_small(const std::string& path, std::array<char, 512>& buffer) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file) return {};
  const ssize_t size = ::read(file.get(), buffer.data(), buffer.size() - 1);
  return size > 0 ? std::string_view(buffer.data(), static_cast<std::size_t>(size)) : std::string_view();
}

/// Returns the letter after the name, which is in parentheses and may contain any characters.
char state_in(std::string_view stat) {
  const std::size_t end = stat.rfind(')');
  return end == std::string_view::npos || end + 2 >= stat.size() ? 'X' : stat[end + 2];
}

/// Returns the third number of schedstat.
std::uint64_t runs_in(std::string_view schedstat) {
  const std::size_t space = schedstat.rfind(' ');
  return space == std::string_view::npos ? 0 : std::strtoull(schedstat.data() + space, nullptr, 10);
}

/// Returns true if a thread sleeps until another thread or something outside wakes it, or has ended.
bool is_asleep(char state) { return state == 'S' || state == 'Z' || state == 'X'; }

template <class Act>
void for_each_task(int process, Act act) {
  const std::unique_ptr<DIR, int (*)(DIR*)> folder(opendir(folder_of(process).c_str()), closedir);
  if (!folder) return;
  while (const dirent* const entry = readdir(folder.get())) {
    const int task = std::atoi(entry->d_name);
    if (task > 0) act(task);
  }
}

}  // namespace

HostTasks::~HostTasks() {
  for (const auto& [process, descriptor] : processes_) loop_.unwatch(descriptor.get());
}

void HostTasks::add(int process) {
  if (knows(process)) return;
  Descriptor descriptor(static_cast<int>(syscall(SYS_pidfd_open, process, 0)));
  if (!descriptor) return;  // it has ended already
  loop_.watch(descriptor.get(), EventLoop::readable, [this, process](std::uint32_t) {
    const auto found = processes_.find(process);
    if (found == processes_.end()) return;
    loop_.unwatch(found->second.get());
    processes_.erase(found);
    ended_(process);
  });
  processes_.emplace(process, std::move(descriptor));
}

bool HostTasks::is_alive(int process) const {
  std::array<char, 512> buffer{};
  const std::string_view stat = read_small("/proc/" + std::to_string(process) + "/stat", buffer);
  const std::size_t end = stat.rfind(')');
  if (!knows(process) || end == std::string_view::npos) return false;
  // After the name: the state, five numbers, and the flags.
  std::istringstream fields{std::string(stat.substr(end + 1))};
  char state = 'X';
  std::int64_t ignored = 0;
  std::uint64_t flags = 0;
  fields >> state;
  for (int i = 0; i < 5; ++i) fields >> ignored;
  fields >> flags;
  constexpr std::uint64_t kExiting = 0x4;  // PF_EXITING
  return state != 'Z' && state != 'X' && (flags & kExiting) == 0;
}

/// The folder of threads has two links, and one more for each thread.
bool HostTasks::is_one_thread() const {
  if (processes_.size() != 1) return false;
  struct stat status {};
  return ::stat(folder_of(processes_.begin()->first).c_str(), &status) == 0 && status.st_nlink == 3;
}

/// Returns false if any thread is awake.
bool HostTasks::read_tasks(Tasks& tasks, const std::set<int>& waiting) const {
  bool are_asleep = true;
  std::array<char, 512> buffer{};
  for (const auto& known : processes_) {
    const int process = known.first;
    for_each_task(process, [&](int task) {
      if (!are_asleep || waiting.contains(task)) return;
      const std::string folder = folder_of(process) + "/" + std::to_string(task);
      Task seen;
      seen.state = state_in(read_small(folder + "/stat", buffer));
      are_asleep = is_asleep(seen.state);
      if (are_asleep) seen.runs = runs_in(read_small(folder + "/schedstat", buffer));
      tasks[task] = seen;
    });
  }
  return are_asleep;
}

/// Checks twice. A thread that slept both times and has not run in between slept the whole time, so there was
/// a moment at which all threads slept.
bool HostTasks::are_all_asleep(const std::set<int>& waiting) const {
  Tasks before;
  Tasks after;
  return read_tasks(before, waiting) && read_tasks(after, waiting) && before == after;
}

std::optional<std::string> HostTasks::running_one() const {
  std::array<char, 512> buffer{};
  std::optional<std::string> found;
  for (const auto& known : processes_) {
    const int process = known.first;
    int number = 0;
    for_each_task(process, [&](int task) {
      ++number;
      const std::string folder = folder_of(process) + "/" + std::to_string(task);
      if (found || state_in(read_small(folder + "/stat", buffer)) != 'R') return;
      std::string_view name = read_small("/proc/" + std::to_string(process) + "/comm", buffer);
      name = name.substr(0, name.find('\n'));
      found = "thread " + std::to_string(number) + " of " + one_line(std::string(name)) + " (process " +
              std::to_string(process) + ")";
    });
  }
  return found;
}

}  // namespace understudy::emulator::serve
