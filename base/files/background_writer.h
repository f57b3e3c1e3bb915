// Writes to a slow destination, such as a file, without making its owner wait: a helper thread writes, and
// the queue is bounded.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace understudy {

class BackgroundWriter {
 public:
  /// Writes one whole piece. Returns 0, or an error number; after an error nothing more is written. Called
  /// on the helper thread.
  using Write = std::function<int(std::string_view piece)>;

  /// At most `capacity` bytes wait in the queue; at most the same number is being written.
  BackgroundWriter(std::size_t capacity, Write write);
  ~BackgroundWriter();  // finishes
  BackgroundWriter(const BackgroundWriter&) = delete;
  BackgroundWriter& operator=(const BackgroundWriter&) = delete;

  enum class Outcome { taken, full, failed };
  /// Takes the whole piece, or none of it. Never waits for the disk.
  Outcome append(std::string_view piece);

  /// Waits until every piece taken is written, then ends the thread. Nothing may be appended afterwards.
  void finish();

  struct Failure {
    int error = 0;           // the error of the write that failed; 0: none has
    std::uint64_t lost = 0;  // pieces that were taken, but not written because of the error
  };
  Failure failure() const;

 private:
  struct Pieces {
    std::string bytes;
    std::vector<std::size_t> sizes;
  };

  void run();
  /// Writes pieces until one fails; returns how many were written.
  std::size_t write(const Pieces& pieces, int& error) const;

  const std::size_t capacity_;
  const Write write_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Pieces waiting_;
  Failure failure_;
  bool is_finishing_ = false;
  std::thread thread_;  // declared last, because it uses all other members
};

}  // namespace understudy
