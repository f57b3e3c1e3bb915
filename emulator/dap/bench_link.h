// Exchanges control messages between a debug adapter and a daemon.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/files/descriptor.h"

namespace understudy::emulator::dap {

using Json = nlohmann::ordered_json;

/// Thrown if a request is refused. The message is one sentence.
struct RequestError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Thrown if the daemon has ended.
struct GoneError : RequestError {
  using RequestError::RequestError;
};

class BenchLink {
 public:
  virtual ~BenchLink() = default;

  /// Returns the reply. Throws RequestError if the daemon refuses, GoneError if it has ended.
  virtual Json ask(const Json& message) const = 0;
  /// Returns one member of the reply, or null.
  Json ask_for(const char* member, const Json& message) const { return ask(message).value(member, Json()); }
  /// Sends a message whose reply arrives later. Throws GoneError.
  virtual void begin(const Json& message) = 0;
  /// Returns true while that reply has not been taken.
  virtual bool is_awaiting() const = 0;
  /// Returns the descriptor on which the reply arrives, or -1.
  virtual int awaited() const = 0;
  /// Returns the reply once it is complete. Throws RequestError if it is a refusal, GoneError if it will
  /// never arrive.
  virtual std::optional<Json> take_reply() = 0;
  /// Ends the advance whose reply is awaited, and drops the reply.
  virtual void pause() = 0;
};

/// Parses a reply. Throws RequestError if it is a refusal.
Json judged_reply(const std::string& line);

/// Talks to a daemon over its control socket.
class SocketLink final : public BenchLink {
 public:
  explicit SocketLink(std::string socket) : socket_(std::move(socket)) {}

  Json ask(const Json& message) const override;
  void begin(const Json& message) override;
  bool is_awaiting() const override { return awaited_.get() >= 0; }
  int awaited() const override { return awaited_.get(); }
  std::optional<Json> take_reply() override;
  void pause() override;

 private:
  std::string socket_;
  Descriptor awaited_;
  std::string received_;
};

}  // namespace understudy::emulator::dap
