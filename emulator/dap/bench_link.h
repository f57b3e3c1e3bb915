// The control socket of a daemon, as a debug adapter uses it.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/files/descriptor.h"

namespace understudy::emulator::dap {

using Json = nlohmann::ordered_json;

/// A request is refused. The message is one sentence.
struct RequestError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The daemon is not there any more.
struct GoneError : RequestError {
  using RequestError::RequestError;
};

class BenchLink {
 public:
  explicit BenchLink(std::string socket) : socket_(std::move(socket)) {}

  /// Returns the reply. Throws RequestError if the daemon refuses, GoneError if it is not there.
  Json ask(const Json& message) const;
  /// Returns one member of the reply, or null.
  Json ask_for(const char* member, const Json& message) const;
  /// Sends a message whose reply comes later. Throws GoneError.
  void begin(const Json& message);
  /// Returns the descriptor at which that reply comes, or -1.
  int awaited() const { return awaited_.get(); }
  /// Returns the reply once it is whole. Throws RequestError if it is a refusal,
  /// GoneError if it never comes.
  std::optional<Json> take_reply();
  /// Ends the advance whose reply is awaited, and drops the reply.
  void pause();

 private:
  std::string socket_;
  Descriptor awaited_;
  std::string received_;
};

}  // namespace understudy::emulator::dap
