// A capture of a line: what a host sent and what came back, with times.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "base/files/file_error.h"
#include "base/simulated_time.h"

namespace understudy::emulator::box {

using CapturedBytes = std::vector<std::uint8_t>;

/// The sender of bytes. Many tools distinguish two sides without knowing which one is the host. One adapter
/// on a two-wire RS-485 line receives both.
enum class Side : std::uint8_t { host, station, one, other, unknown };

/// Bytes of one direction that were seen together.
struct CapturedPiece {
  std::optional<SimTime> at{};  // when the first of them began; nothing: the file tells no times
  Side side = Side::unknown;
  std::string line{};  // its name in the capture
  CapturedBytes bytes{};
  std::size_t place = 0;              // its line in the file, or the number of its packet
  bool is_frame = false;              // neither more nor less than one frame, or one line of text
  bool counts_from_power_up = false;  // its time does, as in captures of a bench
  std::uint64_t pair = 0;  // the same number for a request and its reply, if the file tells; otherwise 0
};

/// A request and everything that came before the next one.
struct Exchange {
  SimTime at{0};
  CapturedBytes request;
  std::optional<SimTime> replied_at{};  // nothing: there was no reply, or the file gives no times
  CapturedBytes reply{};
  std::size_t place = 0;          // of the request
  bool has_broken_reply = false;  // bytes came back that belong to no frame
  bool follows_loss = false;      // an earlier request is lost that may have written
};

/// Observations of a reader about the whole capture.
struct CaptureNotes {
  std::string format{};  // "a log of socat"
  std::string line{};    // the one that was taken
  SimTime first_at{0};   // times are counted from this one in the file
  std::size_t exchanges = 0;
  std::size_t unasked = 0;  // frames, or pieces, of the controller that follow no request
  std::size_t bytes_of_no_frame = 0;
  std::size_t lost_requests = 0;      // that may have written
  std::size_t restored_requests = 0;  // from a reply that repeats them
  std::size_t elsewhere = 0;  // requests to stations that the bench does not have; left out by who knows it
  bool is_side_inferred = false;
  bool is_modbus_tcp = false;
  bool begins_at_power_up = false;  // its time 0 is the controller's power-up, if anybody says so
  bool knows_beginning = false;     // it is a recording, which says so
  std::string beyond_the_line{};    // what else has changed a recorded device, and when
};

/// A change of an input.
struct InputChange {
  SimTime at{0};
  std::size_t device = 0;  // of the bench
  int terminal = 0;
  std::int32_t level = 0;
};

struct Capture {
  std::string path;
  std::string line;  // the chosen line
  std::vector<Exchange> exchanges;
  CaptureNotes notes{};
  std::vector<InputChange> inputs{};  // of a recording
  bool is_cut = false;                // there were more exchanges
};

/// Thrown for a bad capture. The message begins with the path and the place, and says what was expected.
struct CaptureReadError : FileError {
  using FileError::FileError;
};

/// Thrown if the settings say that reading is over.
struct CaptureInterrupted : std::exception {
  const char* what() const noexcept override { return "interrupted"; }
};

struct CaptureSettings {
  std::string line{};                   // one of several lines; empty: the only one
  bool is_text = false;                 // the line speaks text, not Modbus
  std::string pattern{};                // of the lines of a log (log_pattern.h); empty: one of the known ones
  std::optional<SimTime> every{};       // the time between requests, if the file tells no times
  std::optional<double> sample_rate{};  // in Hz, if the file counts samples
  std::function<bool()> is_over{};      // asked again and again; empty: nothing ends the reading
};

/// Returns the format of a file from its beginning ("a log of socat -x"), or nothing if it is not a known
/// one.
std::string capture_format(const std::string& head);

using ExchangeSink = std::function<void(Exchange exchange)>;

/// Reads a capture, and hands on each exchange when the next one begins. It holds only the exchange that is
/// read. Throws CaptureReadError and CaptureInterrupted.
CaptureNotes read_exchanges(std::istream& file, const std::string& path, const CaptureSettings& settings,
                            const ExchangeSink& sink);
/// Like the above, for a file that cannot go back to its beginning. `head` is the beginning, or as much of it
/// as tells the format; `notes` are updated as the file is read.
void read_exchanges(std::istream& file, const std::string& head, const std::string& path,
                    const CaptureSettings& settings, CaptureNotes& notes, const ExchangeSink& sink);
/// Reads a whole capture into memory.
Capture read_capture(std::istream& file, const std::string& path, const CaptureSettings& settings);

}  // namespace understudy::emulator::box
