// A photograph of a real controller: everything that can be read, at about one moment.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/box/asking/asked.h"
#include "emulator/box/wire/wire.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/model.h"
#include "pty/line_settings.h"

namespace understudy::emulator::box {

struct PhotoValue {
  std::string name;
  std::string value;    // as text; in quotes in the file if it is not a number
  std::string table{};  // of a register
  std::uint16_t address = 0;
};

/// A value that the controller did not return.
struct PhotoRefusal {
  std::string name;
  std::string why;  // "exception 2", "no answer"
  std::string table{};
  std::uint16_t address = 0;
};

struct Photograph {
  std::string model;
  std::string place;
  std::string line;         // "19200 8E1"; empty if the port has no settings
  int station = -1;         // -1: the model has none
  bool is_echoing = false;  // the adapter echoes what is sent
  std::vector<PhotoValue> values{};
  std::vector<PhotoRefusal> refused{};
  std::vector<Asked> exchanges{};  // all of them, in order
  NvImage image{};                 // persistent values that differ from the factory's
  /// Persistent values that an image of the model cannot hold, and why.
  std::vector<std::pair<std::string, std::string>> left_out{};
  /// Why it ended before everything was read; then it has no image. Empty: it is whole.
  std::string ended{};
};

/// Receives the progress: the number of requests so far, and the next question.
using PhotoProgress = std::function<void(std::size_t requests, std::string_view next)>;

/// Thrown if the controller does not answer as its model would. The message is one line.
struct BoxError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct PhotoSettings {
  std::optional<int> station{};
  Firmware firmware = 0;
  WallTime timeout{0};
  int modules = 0;                  // of a chain; 0: ask the chain
  bool has_arrays = false;          // also reads the long arrays of a text controller
  std::function<bool()> is_over{};  // asked before each request; empty: nothing ends it
};

/// Throws BoxError for a model of Modbus ASCII, which is only emulated, except behind a gateway.
void require_rtu(const Model& model, const PortName& port);

/// Reads everything. Only reads are sent. If it ends early, it returns what it has. Throws BoxError and
/// WireError if nothing was read.
Photograph photograph(const Model& model, const PortName& port, const PhotoSettings& settings,
                      const PhotoProgress& progress);

}  // namespace understudy::emulator::box
