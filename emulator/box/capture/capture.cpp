#include "emulator/box/capture/capture.h"

#include <cstddef>
#include <istream>
#include <string>
#include <utility>

#include "base/text/lines.h"
#include "emulator/box/capture/exchange_builder.h"
#include "emulator/box/capture/packet_file.h"
#include "emulator/box/capture/piece_readers.h"

namespace understudy::emulator::box {

namespace {

/// Enough to recognize a format.
constexpr std::size_t kHead = std::size_t{64} << 10;

std::string head_of(std::istream& file) {
  std::string head(kHead, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  file.clear();
  file.seekg(0);
  return head;
}

std::string read_pieces(std::istream& file, const std::string& head, const std::string& path,
                        const CaptureSettings& settings, const PieceSink& sink) {
  if (is_packet_file(head)) return read_packet_pieces(file, path, sink);
  if (settings.pattern.empty() && is_our_text(head)) {
    read_text_pieces(file, path, sink);
    return "a capture of understudy";
  }
  return read_log_pieces(file, head, path, settings, sink);
}

}  // namespace

std::string capture_format(const std::string& head) {
  if (is_packet_file(head)) return "a capture of packets";
  return is_our_text(head) ? "a capture" : log_format(head);
}

void read_exchanges(std::istream& file, const std::string& whole_head, const std::string& path,
                    const CaptureSettings& settings, CaptureNotes& notes, const ExchangeSink& sink) {
  const std::string head(without_byte_order_mark(whole_head));
  file.ignore(static_cast<std::streamsize>(whole_head.size() - head.size()));
  notes.line = settings.line;
  ExchangeBuilder builder(path, settings, notes, sink);
  notes.format = read_pieces(file, head, path, settings, [&](CapturedPiece piece) {
    if (piece.counts_from_power_up) notes.begins_at_power_up = true;
    builder.add(std::move(piece));
  });
  builder.finish();
}

CaptureNotes read_exchanges(std::istream& file, const std::string& path, const CaptureSettings& settings,
                            const ExchangeSink& sink) {
  CaptureNotes notes;
  const std::string head = head_of(file);
  read_exchanges(file, head, path, settings, notes, sink);
  return notes;
}

Capture read_capture(std::istream& file, const std::string& path, const CaptureSettings& settings) {
  Capture capture{.path = path, .line = {}, .exchanges = {}};
  capture.notes = read_exchanges(
      file, path, settings, [&](Exchange exchange) { capture.exchanges.push_back(std::move(exchange)); });
  capture.line = capture.notes.line;
  return capture;
}

}  // namespace understudy::emulator::box
