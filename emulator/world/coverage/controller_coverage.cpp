#include "emulator/world/coverage/controller_coverage.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/device/axes.h"
#include "emulator/device/device.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/model.h"
#include "emulator/world/coverage/device_touches.h"
#include "emulator/world/coverage/program_coverage.h"
#include "emulator/world/coverage/touched.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/faults/kinds.h"
#include "emulator/world/outside.h"
#include "emulator/world/protocol/modbus_request.h"
#include "emulator/world/view/world_view.h"
#include "emulator/world/world.h"
#include "pty/ascii_frame.h"
#include "pty/capture.h"
#include "pty/capture_frames.h"
#include "pty/line_observer.h"
#include "pty/station.h"

namespace understudy::emulator::world {

namespace {

constexpr std::uint8_t kExceptionBit = 0x80;

bool is_moving(const Device& device) {
  const Axes* const axes = device.axes();
  for (std::size_t i = 0; axes != nullptr && i < device.model().axes.size(); ++i) {
    const int axis = static_cast<int>(i);
    if (axes->has_axis(axis) && axes->speed_pps(axis) != 0) return true;
  }
  return false;
}

std::string_view without_ends(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(kSpace);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kSpace) + 1 - begin);
}

}  // namespace

class ControllerCoverage::Counting final : private OutsideListener {
 public:
  explicit Counting(World& world) : world_(world), programs_(world) {
    for (std::size_t d = 0; d < world.device_count(); ++d) devices_.emplace_back(world.device(d));
    watch();
    world_.add_listener(*this);
  }
  ~Counting() override {
    world_.remove_listener(*this);
    ignore();
  }
  Counting(const Counting&) = delete;
  Counting& operator=(const Counting&) = delete;

  TouchedReport report() const {
    TouchedReport report;
    for (std::size_t d = 0; d < devices_.size(); ++d) {
      TouchedReport one;
      one.models[std::string(world_.device(d).model().name)] = devices_[d].tables(programs_.by_first_word(d));
      report.add(one);
    }
    return report;
  }

  void watch_anew() {
    ignore();
    watch();
  }

 private:
  /// The packets on a line, and the last line of text from a host.
  struct Line {
    std::unique_ptr<pty::CaptureFrames> packets;
    std::vector<std::uint8_t> request{};
  };

  /// Observes the faults that affect messages, and the requests that stations serve.
  class Strikes final : public pty::LineObserver {
   public:
    Strikes(Counting& counting, std::size_t line) : counting_(counting), line_(line) {}
    void on_start_bit(SimTime /*at*/) override {}
    void on_character(const pty::TimedByte& /*character*/, bool /*is_heard*/) override {}
    void on_nothing_more() override {}
    void on_transmission(const pty::Transmission& /*transmission*/) override {}
    void on_strike(const pty::StruckMessage& message) override { counting_.struck(line_, message); }
    void on_served(const pty::ServedRequest& request) override { counting_.served(line_, request); }
    std::size_t quiet_characters() const override { return SIZE_MAX; }
    std::optional<SimTime> due() const override { return std::nullopt; }
    void run(SimTime /*now*/) override {}

   private:
    Counting& counting_;
    std::size_t line_;
  };

  void watch() {
    for (std::size_t l = 0; l < world_.line_count(); ++l) {
      lines_.push_back(
          {world_.line(l).packets(l, [this](const pty::CapturedPacket& packet) { take(packet); })});
      strikes_.push_back(std::make_unique<Strikes>(*this, l));
      world_.add_observer(l, *lines_[l].packets);
      world_.add_observer(l, *strikes_[l]);
    }
  }
  void ignore() {
    for (std::size_t l = 0; l < lines_.size(); ++l) {
      world_.remove_observer(l, *lines_[l].packets);
      world_.remove_observer(l, *strikes_[l]);
    }
    lines_.clear();
    strikes_.clear();
  }

  template <class Act>
  void for_devices_on(std::size_t line, Act act) {
    for (const auto& station : world_.line(line).stations) {
      for (std::size_t d = 0; d < devices_.size(); ++d) {
        if (&world_.device(d) == &station->device()) act(station->device(), devices_[d]);
      }
    }
  }

  // --- what goes over the lines --------------------------------------------------------------------

  void take(const pty::CapturedPacket& packet) {
    if (packet.bytes.empty() || packet.remark == pty::Remark::wrong_checksum ||
        packet.remark == pty::Remark::incomplete || packet.remark == pty::Remark::not_a_frame ||
        packet.remark == pty::Remark::unheard) {
      return;
    }
    // A Modbus ASCII frame is handled like an RTU frame.
    if (packet.is_text && !pty::rtu_of_ascii(packet.bytes)) take_text(packet);
  }

  /// A request counts as answered if the device executes it, even if the reply is lost.
  void served(std::size_t line, const pty::ServedRequest& served) {
    const Device* const device = &world_.line(line).stations[served.station]->device();
    const ModbusRequest request = parse_request_frame(served.request);
    for_devices_on(line, [&](const Device& one, DeviceTouches& touches) {
      if (&one != device || served.answer.size() < 2) return;
      if ((served.answer[0] & kExceptionBit) != 0) {
        const bool is_answered = one.modbus()->answers_refusals() &&
                                 one.modbus()->addressing(served.request[0]) == Addressing::execute_and_reply;
        return touches.refused(request, is_answered ? std::optional<int>(served.answer[1]) : std::nullopt);
      }
      touches.answered(request, request.reads ? served.answer.subspan(2) : std::span<const std::uint8_t>());
    });
  }

  /// A command counts as accepted if the next answer is not a refusal, or if another command follows.
  void take_text(const pty::CapturedPacket& packet) {
    Line& line = lines_[packet.line];
    const bool is_of_host = packet.direction == pty::Direction::from_host;
    const bool is_refusal = !is_of_host && world_.line(packet.line).protocol.is_refusal(packet.bytes);
    const std::vector<std::uint8_t> pending = std::exchange(line.request, {});
    const std::string_view text = without_ends(
        {reinterpret_cast<const char*>(pending.data()), pending.size()});  // NOLINT: bytes are text
    if (!text.empty()) {
      for_devices_on(packet.line,
                     [&](const Device&, DeviceTouches& touches) { touches.command(text, is_refusal); });
    }
    if (is_of_host) line.request.assign(packet.bytes.begin(), packet.bytes.end());
  }

  void struck(std::size_t line, const pty::StruckMessage& message) {
    for (const pty::Strike& strike : message.strikes) {
      for (const FaultKindRow& row : fault_kinds()) {
        if (row.name != strike.kind) continue;
        for_devices_on(line, [&](const Device& device, DeviceTouches& touches) {
          touches.fault(row.kind, is_moving(device));
        });
      }
    }
  }

  // --- other events from outside -------------------------------------------------------------------

  void on_input(std::size_t /*device*/, int /*terminal*/, std::int32_t /*level*/) override {}
  void on_power(std::size_t /*device*/, bool /*on*/) override {}
  void on_clear_fault(std::size_t /*number*/) override {}
  void on_assign(std::size_t /*device*/, std::string_view /*name*/, double /*value*/) override {}
  void on_program(std::size_t /*device*/, std::string_view /*text*/, bool /*is_refused*/) override {}
  void on_write(std::size_t device, const PreparedWrite& write) override {
    devices_[device].written(write.table, write.first, std::span(write.words).first(write.count));
  }
  void on_command(std::size_t device, std::string_view text) override {
    devices_[device].command(without_ends(text), false);
  }
  void on_inject(const Fault& fault) override {
    // A fault that ends immediately is not reported again.
    if (is_done_at_once(fault.kind) && !waits(fault)) begin(fault);
  }
  void on_fault(std::size_t number, bool in_force) override {
    const auto found = world_.faults().find(number);
    if (in_force && found != world_.faults().end()) begin(found->second.fault);
  }
  void begin(const Fault& fault) {
    devices_[fault.device].fault(fault.kind, is_moving(world_.device(fault.device)));
  }

  World& world_;
  ProgramCoverage programs_;
  std::vector<DeviceTouches> devices_;
  std::vector<Line> lines_;
  std::vector<std::unique_ptr<Strikes>> strikes_;
};

ControllerCoverage::ControllerCoverage(World& world) : counting_(std::make_unique<Counting>(world)) {}
ControllerCoverage::~ControllerCoverage() = default;
TouchedReport ControllerCoverage::report() const { return counting_->report(); }
void ControllerCoverage::world_restored() { counting_->watch_anew(); }

}  // namespace understudy::emulator::world
