// Reads the two formats that `serve --capture` writes.
#pragma once

#include <functional>
#include <istream>
#include <string>

#include "emulator/box/capture/capture.h"

namespace understudy::emulator::box {

using PieceSink = std::function<void(CapturedPiece piece)>;

/// Reads lines such as "0.102400000 in  rs485 01 06 10 02 00 C8 2D 5C  # remark".
void read_text_pieces(std::istream& file, const std::string& path, const PieceSink& sink);
/// Reads pcapng with the link type "Wireshark upper PDU".
void read_pcapng_pieces(std::istream& file, const std::string& path, const PieceSink& sink);

}  // namespace understudy::emulator::box
