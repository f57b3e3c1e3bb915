// The readers of the formats of captures. Each passes on pieces in the order of the file.
#pragma once

#include <functional>
#include <istream>
#include <string>
#include <string_view>

#include "emulator/box/capture/capture.h"

namespace understudy::emulator::box {

using PieceSink = std::function<void(CapturedPiece piece)>;

/// "0.102400000 in  rs485 01 06 10 02 00 C8 2D 5C  # remark", as `serve --capture` writes it
void read_text_pieces(std::istream& file, const std::string& path, const PieceSink& sink);
bool is_our_text(std::string_view head);

/// Reads pcap and pcapng. Returns a description of the content: "packets of TCP".
std::string read_packet_pieces(std::istream& file, const std::string& path, const PieceSink& sink);

/// Reads logs of other programs (log_pieces.cpp). `head` is the beginning of the file. Returns the format.
std::string read_log_pieces(std::istream& file, const std::string& head, const std::string& path,
                            const CaptureSettings& settings, const PieceSink& sink);
/// Returns the format of a log from its beginning, or an empty text if it is unknown.
std::string log_format(const std::string& head);

}  // namespace understudy::emulator::box
