// Makes exchanges from pieces: finds frames, infers their senders, and joins replies to requests.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/box/capture/capture.h"
#include "emulator/box/capture/rtu_frames.h"

namespace understudy::emulator::box {

class ExchangeBuilder {
 public:
  ExchangeBuilder(const std::string& path, const CaptureSettings& settings, CaptureNotes& notes,
                  const ExchangeSink& sink);

  void add(CapturedPiece piece);
  /// Passes on the last exchange. Throws CaptureReadError if there was no request, or never a reply.
  void finish();

 private:
  struct Pending;

  CaptureReadError refuse(std::size_t place, const std::string& what) const;
  bool is_of_wanted_line(const CapturedPiece& piece);
  void require_protocol(const CapturedPiece& piece) const;
  void require_rising_time(const CapturedPiece& piece);
  void hold_until_sides_are_known(CapturedPiece piece);
  void decide_sides();
  void add_with_side(CapturedPiece piece);
  void add_text(CapturedPiece piece);
  void find_frames(bool at_end);
  void take_mixed(bool at_end);
  void take_sides(bool at_end);
  bool gives_up(const FrameFinder& finder, bool at_end) const;
  void note_broken_reply(std::size_t bytes);
  void take_request(FoundFrame frame);
  void take_reply(FoundFrame frame, bool is_whole_piece = false);
  bool restore_request(const FoundFrame& reply);
  void begin(Exchange exchange, std::uint64_t pair);
  void hand_on_all_but(std::size_t count);
  void take_early(Pending& first);
  bool account_for(const FoundFrame& unasked, const Exchange& next);

  struct Pending {
    Exchange exchange;
    std::uint64_t pair = 0;
    std::vector<FoundFrame> early{};  // replies without a request that came before this one in the file
  };

  const std::string& path_;
  const CaptureSettings& settings_;
  CaptureNotes& notes_;
  const ExchangeSink& sink_;
  std::string others_;  // another line's name
  std::vector<CapturedPiece> held_;
  std::optional<Side> host_;  // which of the sides `one` and `other` is the host's
  FrameFinder requests_{FrameRole::request};
  FrameFinder replies_{FrameRole::reply};
  FrameFinder mixed_{FrameRole::either};
  bool is_mixed_ = false;
  std::optional<FoundFrame> next_request_;
  std::vector<FoundFrame> early_;
  CapturedBytes last_request_;              // of the exchanges that were passed on
  SimTime last_passed_at_{0};               // the same
  std::optional<CapturedPiece> text_line_;  // of the host, which has not ended
  std::optional<FoundFrame> text_echo_;     // what the controller said meanwhile
  std::deque<Pending> pending_;             // the last requests
  std::optional<SimTime> newest_;           // of all pieces
  std::optional<SimTime> host_last_;
  std::optional<SimTime> station_last_;
  SimTime first_{0};
  SimTime last_at_{0};  // of the last request
  bool has_pieces_ = false;
  bool has_text_ = false;  // a request that is a line of text
  bool follows_loss_ = false;
  std::size_t lost_ = 0;  // bytes of a request that was not found, since the last reply
  std::size_t replies_taken_ = 0;
  std::size_t last_place_ = 0;
};

}  // namespace understudy::emulator::box
