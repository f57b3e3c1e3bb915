// Makes the frames of a Modbus RTU host, and judges replies. It does not handle time or lines.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "emulator/play/executors/executor.h"

namespace understudy::emulator::play {

std::vector<std::uint8_t> read_request(int station, Table table, std::uint16_t first, int count);
/// Uses functions 05 and 06 for one coil or holding register, 0F and 10 for more. Each bit takes a word.
std::vector<std::uint8_t> write_request(int station, Table table, std::uint16_t first,
                                        std::span<const std::uint16_t> words);

/// Uses function 10 for any number of words.
std::vector<std::uint8_t> message_request(int station, std::uint16_t first,
                                          std::span<const std::uint16_t> words);

/// Returns how many bytes a host waits for after it has sent `request` and received `reply` so far.
std::size_t wanted_size(std::span<const std::uint8_t> request, std::span<const std::uint8_t> reply);

/// Returns the meaning of `reply` (all received bytes) as the answer to a request of read_request() or
/// write_request().
HostReply judge_reply(std::span<const std::uint8_t> request, std::span<const std::uint8_t> reply);

/// The same for the reply on a line of Modbus ASCII, to the request in that frame of RTU.
HostReply judge_ascii_reply(std::span<const std::uint8_t> request, std::span<const std::uint8_t> reply);

}  // namespace understudy::emulator::play
