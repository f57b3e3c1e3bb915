#include "tests/planted_hosts/line.h"

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <vector>

namespace understudy::planted {

namespace {

constexpr std::uint8_t kRead = 3;
constexpr std::uint8_t kWriteOne = 6;
constexpr std::uint8_t kWriteMany = 16;

void append_word(std::vector<std::uint8_t>& bytes, int word) {
  bytes.push_back(static_cast<std::uint8_t>(word >> 8));
  bytes.push_back(static_cast<std::uint8_t>(word));
}

std::uint16_t crc_of(const std::vector<std::uint8_t>& bytes, std::size_t size) {
  std::uint16_t value = 0xFFFF;
  for (std::size_t i = 0; i < size; ++i) {
    value ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit)
      value = static_cast<std::uint16_t>((value & 1) != 0 ? (value >> 1) ^ 0xA001 : value >> 1);
  }
  return value;
}

}  // namespace

void sleep_ms(int milliseconds) {
  const timespec length{milliseconds / 1000, milliseconds % 1000 * 1'000'000L};
  nanosleep(&length, nullptr);
}

std::int64_t now_ms() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * 1000 + time.tv_nsec / 1'000'000;
}

Line::Line() { open_port(); }

Line::~Line() {
  if (port_ >= 0) close(port_);
}

void Line::open_port() {
  const char* const path = std::getenv("UNDERSTUDY_PORT");
  port_ = open(path != nullptr ? path : "", O_RDWR | O_NOCTTY);
  termios settings{};
  if (port_ < 0 || tcgetattr(port_, &settings) != 0) return;
  cfmakeraw(&settings);
  cfsetspeed(&settings, B19200);
  tcsetattr(port_, TCSANOW, &settings);
  is_lost_ = false;
}

void Line::reopen() {
  close(port_);
  is_lost_ = true;
  while (is_lost_) {
    sleep_ms(50);
    open_port();
  }
}

void Line::throw_away() { tcflush(port_, TCIFLUSH); }

std::optional<std::vector<std::uint8_t>> Line::ask(std::vector<std::uint8_t> request, std::size_t size) {
  if (flushes) throw_away();
  const std::uint16_t crc = crc_of(request, request.size());
  append_word(request, crc << 8 | crc >> 8);
  is_lost_ = is_lost_ || ::write(port_, request.data(), request.size()) < 0;
  std::vector<std::uint8_t> answer;
  std::array<std::uint8_t, 256> bytes{};
  while (!is_lost_ && answer.size() < size) {
    pollfd entry{port_, POLLIN, 0};
    if (poll(&entry, 1, timeout_ms) <= 0) return std::nullopt;
    const ssize_t count = ::read(port_, bytes.data(), size - answer.size());
    is_lost_ = count <= 0;
    if (count > 0) answer.insert(answer.end(), bytes.begin(), bytes.begin() + count);
  }
  const bool is_good = answer.size() == size && answer[0] == request[0] && answer[1] == request[1] &&
                       crc_of(answer, size - 2) == (answer[size - 2] | answer[size - 1] << 8);
  return is_good ? std::optional(answer) : std::nullopt;
}

std::optional<Words> Line::read(int first, int count) {
  std::vector<std::uint8_t> request{static_cast<std::uint8_t>(station), kRead};
  append_word(request, first);
  append_word(request, count);
  const auto answer = ask(request, 5 + 2 * static_cast<std::size_t>(count));
  if (!answer) return std::nullopt;
  Words words;
  for (std::size_t i = 3; i + 2 < answer->size() - 1; i += 2)
    words.push_back(static_cast<std::uint16_t>((*answer)[i] << 8 | (*answer)[i + 1]));
  return words;
}

std::optional<int> Line::read_one(int address) {
  const auto words = read(address, 1);
  return words ? std::optional<int>(words->front()) : std::nullopt;
}

bool Line::write(int address, int value) {
  std::vector<std::uint8_t> request{static_cast<std::uint8_t>(station), kWriteOne};
  append_word(request, address);
  append_word(request, value);
  return ask(request, 8).has_value();
}

bool Line::write(int first, const Words& words) {
  std::vector<std::uint8_t> request{static_cast<std::uint8_t>(station), kWriteMany};
  append_word(request, first);
  append_word(request, static_cast<int>(words.size()));
  request.push_back(static_cast<std::uint8_t>(2 * words.size()));
  for (const std::uint16_t word : words) append_word(request, word);
  return ask(request, 8).has_value();
}

int Line::surely_read(int address) { return surely_read(address, 1).front(); }

Words Line::surely_read(int first, int count) {
  while (true) {
    if (const auto words = read(first, count)) return *words;
    if (is_lost_) reopen();
  }
}

void Line::surely_write(int address, int value) {
  while (!write(address, value)) {
    if (is_lost_) reopen();
  }
}

void Line::surely_write(int first, const Words& words) {
  while (!write(first, words)) {
    if (is_lost_) reopen();
  }
}

}  // namespace understudy::planted
