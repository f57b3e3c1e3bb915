// Runs libmodbus. No other file in this folder includes its header.
#include "emulator/play/executors/libmodbus_host.h"

#include <errno.h>
#include <modbus/modbus-rtu.h>
#include <modbus/modbus.h>
#include <poll.h>
#include <sys/types.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "emulator/device/register_map/row.h"
#include "emulator/play/executors/executor.h"
#include "emulator/serve/loop/event_loop.h"
#include "emulator/world/protocol/received_lines.h"
#include "pty/line_settings.h"
#include "pty/port_link.h"

namespace understudy::emulator::play {

namespace {

// The maximum pause between two bytes of a reply. It is long, because on a busy machine, bytes that are
// adjacent on the line may arrive with a delay.
constexpr serve::WallTime kLongestPause = std::chrono::milliseconds(200);

char letter_of(pty::Parity parity) {
  switch (parity) {
    case pty::Parity::odd: return 'O';
    case pty::Parity::even: return 'E';
    case pty::Parity::none:
    case pty::Parity::mark:  // no device has these two
    case pty::Parity::space: break;
  }
  return 'N';
}

template <typename Set>
void set_time(Set set, modbus_t* context, serve::WallTime time) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(time);
  const auto rest = std::chrono::duration_cast<std::chrono::microseconds>(time - seconds);
  set(context, static_cast<std::uint32_t>(seconds.count()), static_cast<std::uint32_t>(rest.count()));
}

}  // namespace

void LibmodbusHost::Close::operator()(_modbus* context) const {
  modbus_close(context);
  modbus_free(context);
}

LibmodbusHost::LibmodbusHost(const std::string& port, const pty::LineSettings& settings,
                             serve::WallTime timeout, serve::WallTime silence)
    : port_(port),
      context_(modbus_new_rtu(port.c_str(), settings.baud, letter_of(settings.parity), settings.data_bits,
                              settings.stop_bits)),
      silence_(silence) {
  if (!context_ || modbus_connect(context_.get()) != 0) {
    throw pty::PortError(port + ": " + modbus_strerror(errno) + "; expected a serial port at " +
                         pty::to_string(settings));
  }
  // libmodbus starts its timeout when it has written the request, but the line needs time to transmit it.
  set_time(modbus_set_response_timeout, context_.get(), timeout + settings.duration_of(256));
  set_time(modbus_set_byte_timeout, context_.get(), kLongestPause);
}

LibmodbusHost::~LibmodbusHost() = default;

void LibmodbusHost::keep_silence() const {
  const serve::WallTime rest = quiet_since_ + silence_ - serve::wall_now();
  if (rest > serve::WallTime{0}) std::this_thread::sleep_for(rest);
}

void LibmodbusHost::begin_request(int station) {
  modbus_set_slave(context_.get(), station);
  keep_silence();
  tcflush(modbus_get_socket(context_.get()), TCIFLUSH);  // late bytes do not belong to any request
  quiet_since_ = serve::wall_now();
}

HostReply LibmodbusHost::judge(int result) {
  HostReply reply;
  reply.kind = HostReply::Kind::good;
  if (result < 0) {
    const int error = errno;
    if (error == ETIMEDOUT) {
      reply.kind = HostReply::Kind::silence;
      return reply;
    }
    if (error > MODBUS_ENOBASE && error < EMBBADCRC) {
      reply.kind = HostReply::Kind::exception;
      reply.exception = error - MODBUS_ENOBASE;
    } else if (error >= EMBBADCRC) {
      reply.kind = HostReply::Kind::garbled;
    } else {
      throw pty::PortError(port_ + ": " + modbus_strerror(error) + "; expected a port that stays open");
    }
  }
  quiet_since_ = serve::wall_now();
  return reply;
}

int LibmodbusHost::read_bits(Table table, std::uint16_t first, std::vector<std::uint16_t>& words) {
  const auto read = table == Table::coil ? modbus_read_bits : modbus_read_input_bits;
  std::vector<std::uint8_t> bits(words.size());
  const int result = read(context_.get(), first, static_cast<int>(bits.size()), bits.data());
  words.assign(bits.begin(), bits.end());
  return result;
}

int LibmodbusHost::write_bits(std::uint16_t first, std::span<const std::uint16_t> words) {
  if (words.size() == 1) return modbus_write_bit(context_.get(), first, words[0]);
  std::vector<std::uint8_t> bits;
  for (const std::uint16_t word : words) bits.push_back(word != 0 ? 1 : 0);
  return modbus_write_bits(context_.get(), first, static_cast<int>(bits.size()), bits.data());
}

HostReply LibmodbusHost::read(int station, Table table, std::uint16_t first, int count) {
  begin_request(station);
  std::vector<std::uint16_t> words(static_cast<std::size_t>(count));
  const auto read_words = table == Table::input ? modbus_read_input_registers : modbus_read_registers;
  HostReply reply = judge(is_table_of_bits(table) ? read_bits(table, first, words)
                                                  : read_words(context_.get(), first, count, words.data()));
  if (reply.kind == HostReply::Kind::good) reply.words = std::move(words);
  return reply;
}

HostReply LibmodbusHost::write(int station, Table table, std::uint16_t first,
                               std::span<const std::uint16_t> words) {
  begin_request(station);
  if (table == Table::coil) return judge(write_bits(first, words));
  return judge(words.size() == 1 ? modbus_write_register(context_.get(), first, words[0])
                                 : modbus_write_registers(context_.get(), first,
                                                          static_cast<int>(words.size()), words.data()));
}

HostReply LibmodbusHost::write_message(int station, std::uint16_t first,
                                       std::span<const std::uint16_t> words) {
  begin_request(station);
  return judge(modbus_write_registers(context_.get(), first, static_cast<int>(words.size()), words.data()));
}

/// Reads the bytes that are available, or that arrive before `until`. Returns 0 if there are none.
std::size_t LibmodbusHost::read_some(std::vector<std::uint8_t>& bytes, serve::WallTime until) const {
  pollfd port{.fd = modbus_get_socket(context_.get()), .events = POLLIN, .revents = 0};
  const serve::WallTime rest = std::max(until - serve::wall_now(), serve::WallTime{0});
  const timespec patience{.tv_sec = rest.count() / 1'000'000'000, .tv_nsec = rest.count() % 1'000'000'000};
  if (ppoll(&port, 1, &patience, nullptr) <= 0) return 0;
  std::array<std::uint8_t, 512> part;
  const ssize_t size = ::read(port.fd, part.data(), part.size());
  if (size < 0 && (errno == EAGAIN || errno == EINTR)) return 0;
  if (size <= 0) throw pty::PortError(port_ + ": has hung up; expected a port that stays open");
  bytes.insert(bytes.end(), part.begin(), part.begin() + size);
  return static_cast<std::size_t>(size);
}

void LibmodbusHost::write_all(std::span<const std::uint8_t> bytes) {
  const int port = modbus_get_socket(context_.get());
  while (!bytes.empty()) {
    const ssize_t size = ::write(port, bytes.data(), bytes.size());
    if (size > 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(size));
      continue;
    }
    if (size < 0 && errno != EAGAIN && errno != EINTR)
      throw pty::PortError(port_ + ": " + modbus_strerror(errno) + "; expected a port that stays open");
    pollfd writable{.fd = port, .events = POLLOUT, .revents = 0};
    ::poll(&writable, 1, 100);
  }
}

world::ReceivedLines LibmodbusHost::received_lines() const {
  return world::lines_in({reinterpret_cast<const char*>(unread_.data()), unread_.size()});
}

void LibmodbusHost::send_text(const std::string& text) {
  keep_silence();
  tcflush(modbus_get_socket(context_.get()), TCIFLUSH);
  unread_.clear();
  const std::string line = text + '\r';
  write_all(std::vector<std::uint8_t>(line.begin(), line.end()));
  quiet_since_ = serve::wall_now();
}

std::vector<std::string> LibmodbusHost::exchange_text(const std::optional<std::string>& text,
                                                      const world::LinesWanted& wanted,
                                                      serve::WallTime sending, serve::WallTime within) {
  const serve::WallTime start = serve::wall_now();
  if (text) send_text(*text);
  const serve::WallTime deadline = (text ? std::max(start + sending, serve::wall_now()) : start) + within;
  world::ReceivedLines received = received_lines();
  while (!world::has_come(wanted, received) && serve::wall_now() < deadline) {
    read_some(unread_, deadline);
    received = received_lines();
  }
  // Bytes that follow an answer immediately belong to it, even if they are not expected, but at most one more
  // line.
  constexpr serve::WallTime kAtOnce = std::chrono::milliseconds(3);
  while (text && received.finished <= wanted.lines.size() && serve::wall_now() < deadline) {
    if (read_some(unread_, std::min(deadline, serve::wall_now() + kAtOnce)) == 0) break;
    received = received_lines();
  }
  const std::size_t wanted_lines = wanted.lines.size();
  if (!text && wanted_lines > 0 && received.finished >= wanted_lines) {
    unread_.erase(unread_.begin(),
                  unread_.begin() + static_cast<std::ptrdiff_t>(received.ends[wanted_lines - 1]));
    received.lines.resize(wanted_lines);
  } else {
    unread_.clear();
  }
  if (!received.lines.empty()) quiet_since_ = serve::wall_now();
  return received.lines;
}

std::vector<std::uint8_t> LibmodbusHost::receive(serve::WallTime within) {
  std::vector<std::uint8_t> bytes;
  if (read_some(bytes, serve::wall_now() + within) != 0) quiet_since_ = serve::wall_now();
  return bytes;
}

std::vector<std::uint8_t> LibmodbusHost::exchange(std::span<const std::uint8_t> bytes, std::size_t wanted,
                                                  serve::WallTime sending, serve::WallTime within) {
  keep_silence();
  const int port = modbus_get_socket(context_.get());
  tcflush(port, TCIFLUSH);
  const serve::WallTime start = serve::wall_now();
  write_all(bytes);
  const serve::WallTime deadline = std::max(start + sending, serve::wall_now()) + within;
  quiet_since_ = start + sending;
  std::vector<std::uint8_t> reply;
  while (reply.size() < wanted && serve::wall_now() < deadline) read_some(reply, deadline);
  // A byte that follows immediately belongs to the reply, even if it is not expected.
  if (!reply.empty() && serve::wall_now() < deadline) {
    read_some(reply, std::min(deadline, serve::wall_now() + std::chrono::milliseconds(3)));
  }
  if (!reply.empty()) quiet_since_ = serve::wall_now();
  return reply;
}

}  // namespace understudy::emulator::play
