#include "emulator/edge/port.h"

#include <array>

namespace understudy::emulator {

Port::Port(EventLoop& loop, World& world, std::size_t line_number, const std::string& link_path,
           std::function<void()> catch_up)
    : loop_(loop),
      world_(world),
      line_number_(line_number),
      catch_up_(std::move(catch_up)),
      terminal_(link_path) {
  loop_.watch(terminal_.presence_descriptor(), EventLoop::readable, [this](std::uint32_t) { on_presence(); });
  loop_.watch(terminal_.data_descriptor(), EventLoop::readable,
              [this](std::uint32_t ready) { on_data(ready); });
}

Port::~Port() {
  loop_.unwatch(terminal_.data_descriptor());
  loop_.unwatch(terminal_.presence_descriptor());
}

void Port::on_presence() {
  const pty::PseudoTerminal::Presence presence = terminal_.poll_presence();
  if (!presence.opened && !presence.closed) return;
  catch_up_();
  // Both at once: one went and another came, or one came and has gone again.
  if (presence.closed && terminal_.host_present()) line().host_closed();
  if (presence.opened) line().host_opened();
  if (presence.closed && !terminal_.host_present()) line().host_closed();
}

void Port::on_data(std::uint32_t ready) {
  if ((ready & EventLoop::readable) != 0) {
    std::array<std::uint8_t, pty::Line::kInputCapacity> bytes;
    const std::size_t count = terminal_.read(std::span(bytes).first(line().room()));
    if (terminal_.has_presence_news()) on_presence();
    if (count > 0) {
      catch_up_();
      line().host_settings(terminal_.poll_host_settings());
      line().receive(std::span(bytes).first(count), world_.now());
      world_.advance_to(world_.now());
    }
  }
  flush();
}

void Port::flush() {
  while (!line().output().empty()) {
    const std::size_t taken = terminal_.write(line().output());
    if (taken == 0) break;  // nobody reads
    line().take_output(taken);
  }
  const std::uint32_t interest =
      (line().room() > 0 ? EventLoop::readable : 0U) | (line().output().empty() ? 0U : EventLoop::writable);
  loop_.change_interest(terminal_.data_descriptor(), interest);
}

}  // namespace understudy::emulator
