// A small Modbus master over a serial port, for hosts with planted faults.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace understudy::planted {

using Words = std::vector<std::uint16_t>;

class Line {
 public:
  /// Opens the port of the bench.
  Line();
  ~Line();
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;

  int station = 1;
  int timeout_ms = 200;
  bool flushes = true;  // drops bytes that have arrived before a request

  /// Each of these sends a request once. Nothing or false: no valid answer arrived in time.
  std::optional<Words> read(int first, int count);
  std::optional<int> read_one(int address);
  bool write(int address, int value);
  bool write(int first, const Words& words);

  /// Repeats the request until it is answered.
  int surely_read(int address);
  Words surely_read(int first, int count);
  void surely_write(int address, int value);
  void surely_write(int first, const Words& words);

  /// Returns true if a request failed because the port disappeared.
  bool is_lost() const { return is_lost_; }
  /// Opens the port again as soon as it exists.
  void reopen();
  void throw_away();

 private:
  std::optional<std::vector<std::uint8_t>> ask(std::vector<std::uint8_t> request, std::size_t size);
  void open_port();

  int port_ = -1;
  bool is_lost_ = false;
};

void sleep_ms(int milliseconds);
/// Returns the time since the machine was started.
std::int64_t now_ms();

}  // namespace understudy::planted
