#include "emulator/box/capture/capture.h"

#include <istream>
#include <string>
#include <utility>

#include "base/text/one_line.h"
#include "emulator/box/capture/piece_readers.h"

namespace understudy::emulator::box {

namespace {

/// Joins pieces to exchanges. Pieces arrive in the order of their ends, so a reply follows its request.
class Joiner {
 public:
  Joiner(Capture& capture, std::string wanted) : capture_(capture), wanted_(std::move(wanted)) {}

  void add(CapturedPiece piece) {
    if (!wanted_.empty() && piece.line != wanted_) {
      others_ = piece.line;
      return;
    }
    if (capture_.line.empty()) capture_.line = piece.line;
    if (piece.line != capture_.line)
      throw CaptureReadError(capture_.path + ": has several lines, " + quoted(capture_.line) + " and " +
                             quoted(piece.line) + "; expected --line with one of them");
    if (piece.is_from_host) {
      if (piece.at < last_)
        throw CaptureReadError(
            capture_.path + ":" + std::to_string(piece.place) +
            ": the time of this request is before the last one; expected increasing times");
      last_ = piece.at;
      capture_.exchanges.push_back({.at = piece.at, .request = std::move(piece.bytes), .place = piece.place});
      return;
    }
    if (capture_.exchanges.empty()) {
      ++capture_.unasked;
      return;
    }
    Exchange& exchange = capture_.exchanges.back();
    if (!exchange.replied_at) exchange.replied_at = piece.at;
    exchange.reply.insert(exchange.reply.end(), piece.bytes.begin(), piece.bytes.end());
  }

  void finish() const {
    if (!capture_.exchanges.empty()) return;
    const std::string& path = capture_.path;
    if (!others_.empty())
      throw CaptureReadError(path + ": has no line called " + quoted(wanted_) + "; expected one such as " +
                             quoted(others_));
    throw CaptureReadError(path + ": has no request from a host; expected a capture of both directions");
  }

 private:
  Capture& capture_;
  std::string wanted_;
  std::string others_;
  SimTime last_{0};
};

}  // namespace

Capture read_capture(std::istream& file, const std::string& path, const std::string& line) {
  Capture capture{.path = path, .line = line, .exchanges = {}};
  Joiner joiner(capture, line);
  const auto sink = [&](CapturedPiece piece) { joiner.add(std::move(piece)); };
  constexpr int kPcapng = 0x0A;
  file.peek() == kPcapng ? read_pcapng_pieces(file, path, sink) : read_text_pieces(file, path, sink);
  joiner.finish();
  return capture;
}

}  // namespace understudy::emulator::box
