// Executes scenarios with real controllers. A host on their lines sends what the user has allowed. A
// simulated world supplies the names of their values, but no values. In a rehearsal, that world replies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "emulator/box/stage/box_lines.h"
#include "emulator/box/stage/permission.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/hazards.h"
#include "emulator/play/executors/executor.h"
#include "emulator/play/executors/free_executor.h"
#include "emulator/play/executors/real_box.h"
#include "emulator/play/scenario/scenario.h"

namespace understudy::emulator::box {

struct StageSettings {
  Hazards allowed = Hazards::reads;
  Envelope envelope{};
  std::string rig;  // a command; empty: there is none
  bool asks = false;
  bool rehearses = false;   // the world answers: nothing is sent
  bool only_plans = false;  // this too, and requests are listed instead of judged
  bool is_bare = false;     // what a scenario changes is put back at its end, and inputs are made before
  std::string rig_name{};   // what the rig calls the device; empty: as the bench does
  /// Receives a line for the user: a stop that was sent, or a request of a plan.
  std::function<void(const std::string&)> say{};
  std::function<bool()> is_interrupted{};
  std::function<void()> on_rig_failure{};
};

class BoxExecutor final : public play::Executor, public play::RealBox {
 public:
  /// Both references must outlive it. Throws BoxError and WireError.
  BoxExecutor(const play::Scenario& scenario, BoxLines& lines, const StageSettings& settings);
  /// Stops everything that may move.
  ~BoxExecutor() override;

  play::RealBox* box() override { return this; }

  play::HostReply read(std::size_t line, int station, Table table, std::uint16_t first, int count) override;
  play::HostReply write(std::size_t line, int station, Table table, std::uint16_t first,
                        std::span<const std::uint16_t> words) override;
  play::HostReply write_message(std::size_t line, int station, std::uint16_t first,
                                std::span<const std::uint16_t> words) override;
  std::vector<std::uint8_t> exchange(std::size_t line, std::span<const std::uint8_t> bytes,
                                     std::size_t wanted, SimTime within) override;
  void send_text(std::size_t line, const std::string& text) override;
  std::vector<std::string> exchange_text(std::size_t line, const std::optional<std::string>& text,
                                         const world::LinesWanted& wanted, SimTime within) override;

  void with_world(const std::function<void(world::World&)>& act) override { shadow_.with_world(act); }
  bool run_until(const play::Awaited& awaited, SimTime deadline) override;
  void advance(SimTime by) override;
  SimTime now() override;
  Tick tick_of_last_write() override { return 0; }

  std::optional<std::string> why_unreachable(std::size_t line) const override;
  std::optional<std::string> act(const std::vector<std::string>& words) override;
  std::optional<std::string> tell(const std::string& name) override;
  std::optional<std::string> why_no_query(std::size_t line) const override;
  play::Moment last_write() const override { return last_write_; }
  std::vector<std::string> last_frames() const override { return {frames_.begin(), frames_.end()}; }
  bool is_rehearsal() const override { return settings_.rehearses || settings_.only_plans; }
  bool only_plans() const override { return settings_.only_plans; }
  bool is_bare() const override { return settings_.is_bare; }
  void stop() override;

 private:
  play::HostReply ask(std::size_t line, const Bytes& request);
  /// Returns the effects that the request can have. Throws NotAllowed and BeyondEnvelope.
  Hazards require(std::size_t line, const SentRequest& request);
  void note_written(std::size_t line, SimTime begin, std::size_t bytes, Hazards hazards);
  void note(std::size_t line, const char* arrow, const std::string& text);
  void note_edit(std::size_t line, const std::string& text);
  void plan(const SentRequest& request, std::size_t line, const std::string& remark);
  void plan(const SentRequest& request, std::size_t line);
  void plan_deed(const std::vector<std::string>& words, bool is_optional);
  std::optional<std::string> done(const std::vector<std::string>& words);
  std::string named_for_rig(const std::string& word) const;
  std::string value_in_rehearsal(const std::string& name);
  void keep_before(const std::vector<std::string>& words);
  /// Returns the real line of a device, or nothing.
  std::optional<std::size_t> line_of(std::size_t device) const;
  void ask_word_order(std::size_t device);
  void keep_before(std::size_t line, const Bytes& request);
  void put_back();
  void put_back_surroundings();
  void put_back_registers();
  void stop_device(std::size_t device);
  std::string send_stop(std::size_t device, std::size_t line, const StopStep& step);
  void throw_if_interrupted() const;
  LineHost& host(std::size_t line) { return *hosts_[line]; }

  const play::Scenario& scenario_;
  const StageSettings& settings_;
  play::FreeExecutor shadow_;
  std::vector<LineHost*> hosts_;  // by line; null: not real, or only planned
  std::vector<bool> is_real_;
  WallTime begin_;
  play::Moment last_write_{};
  std::deque<std::string> frames_;
  std::set<std::size_t> may_move_;  // devices
  std::set<std::string> planned_;   // reads since the last write
  bool is_plan_cut_ = false;        // something is not sent or done, so nothing after it is
  /// The lines of text on which a program is being entered, with the commands that began it.
  std::map<std::size_t, EditMark> editing_;
  /// The value of a register before its first write.
  struct Before {
    std::size_t line = 0;
    int station = 0;
    Table table = Table::holding;
    std::uint16_t first = 0;
    std::vector<std::uint16_t> words{};
  };
  std::vector<Before> before_;
  /// What a rig has done, by what undoes it, the oldest first: {"input", "box.DIN_2", "off"}.
  std::vector<std::vector<std::string>> undoing_;
  bool is_stopping_ = false;
};

}  // namespace understudy::emulator::box
