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
  bool flushes = true;  // drops what has come before a request

  /// Each sends a request once. Nothing, or false: no good answer came in time.
  std::optional<Words> read(int first, int count);
  std::optional<int> read_one(int address);
  bool write(int address, int value);
  bool write(int first, const Words& words);

  /// Sends it again and again until it is answered.
  int surely_read(int address);
  Words surely_read(int first, int count);
  void surely_write(int address, int value);
  void surely_write(int first, const Words& words);

  /// A request failed because the port is gone.
  bool is_lost() const { return is_lost_; }
  /// Opens the port again as soon as it is there.
  void reopen();
  void throw_away();

 private:
  std::optional<std::vector<std::uint8_t>> ask(std::vector<std::uint8_t> request, std::size_t size);
  void open_port();

  int port_ = -1;
  bool is_lost_ = false;
};

void sleep_ms(int milliseconds);
/// The time since the start of the machine.
std::int64_t now_ms();

}  // namespace understudy::planted
