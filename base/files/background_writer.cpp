#include "base/files/background_writer.h"

#include <signal.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string_view>
#include <thread>
#include <utility>

namespace understudy {
namespace {

// Pieces that arrive within this time are written together, so that a busy line costs few writes and
// wake-ups.
constexpr std::chrono::milliseconds kGathering{50};

/// Starts a thread that receives no signals: the event loop handles them.
std::thread start_without_signals(std::function<void()> body) {
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread thread(std::move(body));
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return thread;
}

}  // namespace

BackgroundWriter::BackgroundWriter(std::size_t capacity, Write write)
    : capacity_(capacity), write_(std::move(write)), thread_(start_without_signals([this] { run(); })) {}

BackgroundWriter::~BackgroundWriter() { finish(); }

BackgroundWriter::Outcome BackgroundWriter::append(std::string_view piece) {
  bool is_first = false;
  bool is_half_full = false;
  {
    const std::lock_guard lock(mutex_);
    if (failure_.error != 0) return Outcome::failed;
    const std::size_t before = waiting_.bytes.size();
    if (piece.size() > capacity_ - before) return Outcome::full;
    waiting_.bytes += piece;
    waiting_.sizes.push_back(piece.size());
    is_first = before == 0;
    is_half_full = before < capacity_ / 2 && waiting_.bytes.size() >= capacity_ / 2;
  }
  // The thread sleeps while the queue is empty. After the first piece, it waits a while for more.
  if (is_first || is_half_full) changed_.notify_one();
  return Outcome::taken;
}

void BackgroundWriter::finish() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    is_finishing_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

BackgroundWriter::Failure BackgroundWriter::failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
}

void BackgroundWriter::run() {
  Pieces writing;
  std::unique_lock lock(mutex_);
  while (failure_.error == 0) {
    changed_.wait(lock, [this] { return !waiting_.sizes.empty() || is_finishing_; });
    changed_.wait_for(lock, kGathering,
                      [this] { return waiting_.bytes.size() >= capacity_ / 2 || is_finishing_; });
    if (waiting_.sizes.empty()) return;  // finish() was called, and everything is written
    std::swap(waiting_, writing);
    lock.unlock();
    int error = 0;
    const std::size_t written = write(writing, error);
    lock.lock();
    if (error != 0) failure_ = {error, writing.sizes.size() - written + waiting_.sizes.size()};
    writing.bytes.clear();
    writing.sizes.clear();
  }
}

std::size_t BackgroundWriter::write(const Pieces& pieces, int& error) const {
  std::size_t at = 0;
  for (std::size_t i = 0; i < pieces.sizes.size(); ++i) {
    error = write_(std::string_view(pieces.bytes).substr(at, pieces.sizes[i]));
    if (error != 0) return i;
    at += pieces.sizes[i];
  }
  return pieces.sizes.size();
}

}  // namespace understudy
