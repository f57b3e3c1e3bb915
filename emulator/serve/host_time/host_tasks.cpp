#include "emulator/serve/host_time/host_tasks.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/files/descriptor.h"
#include "base/text/one_line.h"

namespace understudy::emulator::serve {

namespace {

std::string folder_of(int process) { return "/proc/" + std::to_string(process) + "/task"; }

// The files of so many threads stay open; a process may open about a thousand.
constexpr std::size_t kMaxOpen = 128;

using Buffer = std::array<char, 512>;

Descriptor open_to_read(const std::string& path) {
  return Descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
}

/// Returns the beginning of a small file, or an empty text.
std::string_view read_small(const Descriptor& file, Buffer& buffer) {
  const ssize_t size = ::pread(file.get(), buffer.data(), buffer.size() - 1, 0);
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

/// Returns true if a thread sleeps until another thread or something outside wakes it, is stopped by a
/// signal, or has ended.
bool is_asleep(char state) { return state == 'S' || state == 'T' || state == 'Z' || state == 'X'; }

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

/// The folder of threads has two links, and one more for each thread.
bool HostTasks::is_one_thread() const {
  if (processes_.size() != 1) return false;
  struct stat status {};
  return ::stat(folder_of(processes_.begin()->first).c_str(), &status) == 0 && status.st_nlink == 3;
}

HostTasks::Task HostTasks::look_at(int process, int task) {
  Buffer buffer{};
  Files& files = files_[task];
  std::string_view stat = files.stat ? read_small(files.stat, buffer) : "";
  if (stat.empty()) {  // it is new, or the number was that of a thread that has ended
    const std::string folder = folder_of(process) + "/" + std::to_string(task);
    files = {open_to_read(folder + "/stat"), open_to_read(folder + "/schedstat")};
    stat = read_small(files.stat, buffer);
  }
  const char state = state_in(stat);
  const std::uint64_t runs = runs_in(read_small(files.schedstat, buffer));
  if (files_.size() > kMaxOpen) files_.erase(task);
  return {state, runs};
}

/// Returns false if a thread, other than the one to be left out, does not sleep.
bool HostTasks::read_tasks(Tasks& tasks, std::optional<int> except) {
  bool are_asleep = true;
  for (const auto& known : processes_) {
    const int process = known.first;
    for_each_task(process, [&](int task) {
      if (!are_asleep || task == except) return;
      tasks[task] = look_at(process, task);
      are_asleep = is_asleep(tasks[task].state);
    });
  }
  return are_asleep;
}

/// A thread that sleeps, and has not run since it slept before, has slept all the time. If that is true of
/// all but the speaker, nobody can have woken anybody. Otherwise this looks at all of them twice: there was a
/// moment between the two looks at which all slept.
bool HostTasks::are_all_asleep(std::optional<int> speaker) {
  Tasks before;
  if (!read_tasks(before, speaker)) return false;
  if (speaker) asleep_.erase(*speaker);
  const bool have_slept = before == asleep_;
  if (speaker) before[*speaker] = look_at(*speaker, *speaker);
  if (have_slept) {
    // If something wakes the speaker later, it will have run more often than now.
    if (speaker) asleep_[*speaker] = {'S', before[*speaker].runs};
    return true;
  }
  Tasks after;
  if (!read_tasks(after, std::nullopt) || before != after) return false;
  std::erase_if(files_, [&](const auto& files) { return !after.contains(files.first); });
  asleep_ = std::move(after);
  return true;
}

std::optional<std::string> HostTasks::running_one() {
  Buffer buffer{};
  std::optional<std::string> found;
  for (const auto& known : processes_) {
    const int process = known.first;
    int number = 0;
    for_each_task(process, [&](int task) {
      ++number;
      if (found || look_at(process, task).state != 'R') return;
      std::string_view name = read_small(open_to_read("/proc/" + std::to_string(process) + "/comm"), buffer);
      name = name.substr(0, name.find('\n'));
      found = "thread " + std::to_string(number) + " of " + one_line(std::string(name)) + " (process " +
              std::to_string(process) + ")";
    });
  }
  return found;
}

}  // namespace understudy::emulator::serve
