// Writes to a slow destination, such as a file, without blocking the caller: a helper thread writes the
// contents of a bounded queue.
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
  /// Writes one whole piece. Returns 0 or an error number. After an error, nothing more is written. It is
  /// called on the helper thread.
  using Write = std::function<int(std::string_view piece)>;

  /// At most `capacity` bytes are queued, and at most as many are being written.
  BackgroundWriter(std::size_t capacity, Write write);
  ~BackgroundWriter();  // calls finish()
  BackgroundWriter(const BackgroundWriter&) = delete;
  BackgroundWriter& operator=(const BackgroundWriter&) = delete;

  enum class Outcome { taken, full, failed };
  /// Queues the whole piece, or nothing if there is no room. It never waits for the disk.
  Outcome append(std::string_view piece);

  /// Waits until every queued piece is written, then ends the thread. Do not append anything afterwards.
  void finish();

  struct Failure {
    int error = 0;           // the error of the write that failed; 0: no write has failed
    std::uint64_t lost = 0;  // pieces that were queued but not written because of the error
  };
  Failure failure() const;

 private:
  struct Pieces {
    std::string bytes;
    std::vector<std::size_t> sizes;
  };

  void run();
  /// Writes pieces until a write fails. Returns the number of pieces written.
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
