#include "emulator/serve/host_time/host_tasks.h"

#include <dirent.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/files/descriptor.h"
#include "base/text/one_line.h"

namespace understudy::emulator::serve {

namespace {

std::string folder_of(int process) { return "/proc/" + std::to_string(process) + "/task"; }

// The files of this many threads stay open. A process may open about a thousand files.
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

/// Returns the state letter after the name, which is in parentheses and may contain any characters.
char state_in(std::string_view stat) {
  const std::size_t end = stat.rfind(')');
  return end == std::string_view::npos || end + 2 >= stat.size() ? 'X' : stat[end + 2];
}

/// Returns the third number of schedstat.
std::uint64_t runs_in(std::string_view schedstat) {
  const std::size_t space = schedstat.rfind(' ');
  return space == std::string_view::npos ? 0 : std::strtoull(schedstat.data() + space, nullptr, 10);
}

/// Returns true if a thread sleeps until it is woken, is stopped by a signal, or has ended.
bool is_asleep(char state) { return state == 'S' || state == 'T' || state == 'Z' || state == 'X'; }

Descriptor open_process(int process) {
  return Descriptor(static_cast<int>(syscall(SYS_pidfd_open, process, 0)));
}

bool has_ended(const Descriptor& process) {
  pollfd entry{.fd = process.get(), .events = POLLIN, .revents = 0};
  return poll(&entry, 1, 0) > 0;
}

std::string name_of(int process) {
  Buffer buffer{};
  const std::string_view name =
      read_small(open_to_read("/proc/" + std::to_string(process) + "/comm"), buffer);
  return one_line(std::string(name.substr(0, name.find('\n'))));
}

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

HostTasks::HostTasks(EventLoop& loop, std::function<void(int)> ended)
    : loop_(loop), ended_(std::move(ended)) {
  for_each_task(::getpid(), [this](int task) {
    for (const int child : children_of(task)) others_.insert(child);
  });
}

HostTasks::~HostTasks() {
  for (const auto& [process, descriptor] : processes_) loop_.unwatch(descriptor.get());
}

void HostTasks::add(int process) {
  if (knows(process)) return;
  Descriptor descriptor = open_process(process);
  if (descriptor) watch_end(process, std::move(descriptor));  // otherwise it has ended already
}

void HostTasks::watch_end(int process, Descriptor descriptor) {
  loop_.watch(descriptor.get(), EventLoop::readable, [this, process](std::uint32_t) {
    const auto found = processes_.find(process);
    if (found == processes_.end()) return;
    loop_.unwatch(found->second.get());
    processes_.erase(found);
    finds_orphans();
    ended_(process);
  });
  processes_.emplace(process, std::move(descriptor));
}

void HostTasks::set_command(int process) {
  command_ = Descriptor(static_cast<int>(syscall(SYS_pidfd_open, process, 0)));
}

bool HostTasks::has_command_ended() const { return command_ && has_ended(command_); }

void HostTasks::note_ends() {
  std::vector<int> ended;
  for (const auto& [process, descriptor] : processes_) {
    if (has_ended(descriptor)) ended.push_back(process);
  }
  for (const int process : ended) {
    const auto found = processes_.find(process);
    if (found == processes_.end()) continue;
    loop_.unwatch(found->second.get());
    processes_.erase(found);
    ended_(process);
  }
}

std::vector<int> HostTasks::children_of(int task) {
  Descriptor& file = files_[task].children;
  std::string numbers;
  Buffer buffer{};
  const auto read = [&] {
    return ::pread(file.get(), buffer.data(), buffer.size(), static_cast<off_t>(numbers.size()));
  };
  ssize_t size = file ? read() : -1;
  if (size < 0) {  // it is new, or the number was that of a thread that has ended
    file = open_to_read(folder_of(task) + "/" + std::to_string(task) + "/children");
    size = file ? read() : -1;
  }
  for (; size > 0; size = read()) numbers.append(buffer.data(), static_cast<std::size_t>(size));
  std::vector<int> children;
  const char* next = numbers.c_str();
  for (char* end = nullptr;; next = end) {
    const long number = std::strtol(next, &end, 10);
    if (end == next) return children;
    children.push_back(static_cast<int>(number));
  }
}

/// Adds the children of a thread that are unknown and have not ended. Returns true if there were any.
bool HostTasks::finds_children(int task) {
  bool have_come = false;
  for (const int child : children_of(task)) {
    if (knows(child) || others_.contains(child)) continue;
    Descriptor descriptor = open_process(child);
    if (!descriptor || has_ended(descriptor)) continue;
    watch_end(child, std::move(descriptor));
    have_come = true;
  }
  return have_come;
}

/// Adds processes whose parent has ended, because they are our children now.
bool HostTasks::finds_orphans() {
  bool have_come = false;
  for_each_task(::getpid(), [&](int task) { have_come = finds_children(task) || have_come; });
  return have_come;
}

/// Adds unknown processes that these threads have started since all slept. Only a thread that has run can
/// have started one, or has one that another thread has left behind.
bool HostTasks::finds_strangers(const Tasks& tasks) {
  const bool has_one_gone =
      std::ranges::any_of(asleep_, [&](const auto& each) { return !tasks.contains(each.first); });
  bool has_one_run = has_one_gone;
  bool have_come = false;
  for (const auto& [task, now] : tasks) {
    const auto before = asleep_.find(task);
    if (!has_one_gone && before != asleep_.end() && before->second == now) continue;
    has_one_run = true;
    have_come = finds_children(task) || have_come;
  }
  return (has_one_run && finds_orphans()) || have_come;
}

/// The folder of threads has two links, and one more for each thread.
bool HostTasks::is_one_thread() {
  if (processes_.size() != 1) return false;
  const int process = processes_.begin()->first;
  struct stat status {};
  return ::stat(folder_of(process).c_str(), &status) == 0 && status.st_nlink == 3 && !finds_children(process);
}

HostTasks::Task HostTasks::look_at(int process, int task) {
  Buffer buffer{};
  Files& files = files_[task];
  std::string_view stat = files.stat ? read_small(files.stat, buffer) : "";
  if (stat.empty()) {  // the thread is new, or has the number of a thread that has ended
    const std::string folder = folder_of(process) + "/" + std::to_string(task);
    files = {open_to_read(folder + "/stat"), open_to_read(folder + "/schedstat"), {}};
    stat = read_small(files.stat, buffer);
  }
  const char state = state_in(stat);
  const std::uint64_t runs = runs_in(read_small(files.schedstat, buffer));
  if (files_.size() > kMaxOpen) files_.erase(task);
  return {state, runs};
}

/// Reads the states of all threads. Returns false if a thread other than `except` does not sleep.
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

/// A thread that sleeps, and has not run since it slept at the last check, has slept all the time. If this
/// applies to all threads except the speaker, none of them can have been woken. Otherwise all threads are
/// checked twice: between the two checks, there was a moment at which all of them slept.
bool HostTasks::are_all_asleep(std::optional<int> speaker) {
  Tasks before;
  if (!read_tasks(before, speaker)) return false;
  if (speaker) asleep_.erase(*speaker);
  const bool have_slept = before == asleep_;
  if (speaker) before[*speaker] = look_at(*speaker, *speaker);
  if (have_slept) {
    if (speaker && finds_children(*speaker)) return false;
    // If something wakes the speaker later, it will have run more often than now.
    if (speaker) asleep_[*speaker] = {'S', before[*speaker].runs};
    return true;
  }
  Tasks after;
  if (!read_tasks(after, std::nullopt) || before != after || finds_strangers(after)) return false;
  std::erase_if(files_, [&](const auto& files) { return !after.contains(files.first); });
  asleep_ = std::move(after);
  return true;
}

std::optional<std::string> HostTasks::running_one() {
  std::optional<std::string> found;
  for (const auto& known : processes_) {
    const int process = known.first;
    int number = 0;
    for_each_task(process, [&](int task) {
      ++number;
      if (found || look_at(process, task).state != 'R') return;
      found = "thread " + std::to_string(number) + " of " + name_of(process) + " (process " +
              std::to_string(process) + ")";
    });
  }
  return found;
}

std::optional<std::string> HostTasks::left_one() {
  finds_orphans();
  for (const auto& [process, descriptor] : processes_) {
    if (!has_ended(descriptor)) return name_of(process) + " (process " + std::to_string(process) + ")";
  }
  return std::nullopt;
}

}  // namespace understudy::emulator::serve
