#include "emulator/page/web.h"

#include <boost/asio/error.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/basic_stream.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "emulator/page/access.h"
#include "emulator/page/gzip.h"
#include "emulator/page/unix_wire.h"

namespace understudy::emulator::page {

namespace {

namespace net = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;

using Error = boost::system::error_code;
using Executor = net::io_context::executor_type;
using Tcp = net::ip::tcp;
using TcpStream = beast::basic_stream<Tcp, Executor>;
// It does not compress, because most browsers are on the same machine.
using Socket = websocket::stream<TcpStream, false>;
using Timer = net::basic_waitable_timer<std::chrono::steady_clock,
                                        net::wait_traits<std::chrono::steady_clock>, Executor>;
using Request = http::request<http::empty_body>;
using Response = http::response<http::string_body>;

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

/// Sets the headers of every reply: pages load nothing from other sites, stay out of frames, and are not
/// cached. Scripts inside a page must have its nonce.
void set_policy(http::fields& fields, const std::string& nonce = {}) {
  fields.set(http::field::server, "understudy");
  const std::string scripts = "'self'" + (nonce.empty() ? std::string() : " 'nonce-" + nonce + "'");
  fields.set("Content-Security-Policy",
             "default-src 'self'; script-src " + scripts +
                 "; style-src 'self'; connect-src 'self'; img-src 'self' data: blob:; "
                 "object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
  fields.set("X-Content-Type-Options", "nosniff");
  fields.set("X-Frame-Options", "DENY");
  fields.set("Referrer-Policy", "no-referrer");
  fields.set("Cross-Origin-Opener-Policy", "same-origin");
  fields.set("Cross-Origin-Resource-Policy", "same-origin");
  fields.set(http::field::cache_control, "no-store");
}

Response answer_to(const Request& request, http::status status, const std::string& type, std::string body) {
  Response response{status, 11};
  set_policy(response);
  response.set(http::field::content_type, type);
  response.keep_alive(false);
  if (status == http::status::method_not_allowed) response.set(http::field::allow, "GET, HEAD");
  const std::size_t length = body.size();
  if (request.method() != http::verb::head) response.body() = std::move(body);
  response.content_length(length);
  return response;
}

Response refusal_of(const Request& request, http::status status, const std::string& why) {
  return answer_to(request, status, "text/plain; charset=utf-8", why + "\n");
}

/// Holds the place of an unauthenticated connection until it is authenticated or closed.
class PendingSlot {
 public:
  explicit PendingSlot(std::list<PendingSlot*>& unauthenticated) : unauthenticated_(unauthenticated) {
    place_ = unauthenticated_.insert(unauthenticated_.end(), this);
  }
  ~PendingSlot() { authenticated(); }
  PendingSlot(const PendingSlot&) = delete;
  PendingSlot& operator=(const PendingSlot&) = delete;

  void authenticated() {
    if (is_pending_) unauthenticated_.erase(place_);
    is_pending_ = false;
  }
  /// Sets how to close the connection. An empty function means that it is already closing.
  void set_end(std::function<void()> end) { end_ = std::move(end); }
  /// Frees the place for another connection.
  void vacate() {
    authenticated();
    if (const auto end = std::exchange(end_, {})) end();
  }

 private:
  std::list<PendingSlot*>& unauthenticated_;
  std::list<PendingSlot*>::iterator place_;
  bool is_pending_ = true;
  std::function<void()> end_;
};

}  // namespace

// --- inside ----------------------------------------------------------------------------------------

class Web::Inside {
 public:
  class Visit;
  class Browser;

  Inside(const WebAddress& address, const WebLimits& given, WebEvents& given_events);
  void accept();

  WebLimits limits;
  WebEvents& events;
  WebAccess access;
  std::list<PendingSlot*> unauthenticated;  // the oldest first; outlives `io`, whose handlers hold slots
  BrowserId last_browser = 0;
  net::io_context io{1};
  net::basic_socket_acceptor<Tcp, Executor> acceptor{io};
  std::map<BrowserId, std::shared_ptr<Browser>> browsers;
};

/// Implements a browser's WebSocket.
class Web::Inside::Browser : public std::enable_shared_from_this<Browser> {
 public:
  Browser(Inside& inside, TcpStream&& stream, std::shared_ptr<PendingSlot> pending_slot, BrowserId id)
      : inside_(inside), pending_slot_(std::move(pending_slot)), socket_(std::move(stream)), id_(id) {
    pending_slot_->set_end([this] { cut(); });
  }
  ~Browser() { pending_slot_->set_end({}); }
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  void authenticated() { pending_slot_->authenticated(); }

  void open(const Request& request) {
    websocket::stream_base::timeout timeout{};
    timeout.handshake_timeout = inside_.limits.request;
    timeout.idle_timeout = inside_.limits.silence;
    timeout.keep_alive_pings = true;
    socket_.set_option(timeout);
    socket_.set_option(
        websocket::stream_base::decorator([](websocket::response_type& response) { set_policy(response); }));
    socket_.auto_fragment(false);  // sends each message as one frame
    socket_.read_message_max(inside_.limits.message_bytes);
    socket_.async_accept(request, [self = shared_from_this()](Error error) {
      if (error) return;
      self->is_open_ = true;
      self->inside_.browsers[self->id_] = self;
      self->inside_.events.opened(self->id_);
      self->read();
    });
  }

  void send(std::shared_ptr<const std::string> text) {
    if (!is_open_ || is_closing_) return;
    waiting_bytes_ += text->size();
    if (waiting_bytes_ > inside_.limits.waiting_bytes) return cut();
    waiting_.push_back(std::move(text));
    if (waiting_.size() == 1) write();
  }

  std::size_t waiting() const { return waiting_bytes_; }

  /// Sends the queued data first, if the browser accepts it.
  void close(std::string_view why) {
    if (is_closing_) return;
    is_closing_ = true;
    reason_ = std::string(why.substr(0, 120));
    if (waiting_.empty()) send_close();
  }

 private:
  void read() {
    socket_.async_read(input_, [self = shared_from_this()](Error error, std::size_t) {
      if (error || !self->is_open_) return self->be_gone();
      if (!self->is_closing_) {
        const auto bytes = self->input_.data();
        self->inside_.events.received(self->id_, {static_cast<const char*>(bytes.data()), bytes.size()});
      }
      self->input_.consume(self->input_.size());
      self->read();
    });
  }

  void write() {
    socket_.async_write(net::buffer(*waiting_.front()),
                        [self = shared_from_this()](Error error, std::size_t) {
                          if (error || !self->is_open_) return self->be_gone();
                          self->waiting_bytes_ -= self->waiting_.front()->size();
                          self->waiting_.pop_front();
                          if (!self->waiting_.empty()) return self->write();
                          if (self->is_closing_) return self->send_close();
                          self->inside_.events.drained(self->id_);
                        });
  }

  void send_close() {
    const websocket::close_reason reason(websocket::close_code::policy_error,
                                         beast::string_view(reason_.data(), reason_.size()));
    socket_.async_close(reason, [self = shared_from_this()](Error) { self->be_gone(); });
  }

  /// The pending read reports that the browser is gone, not this call.
  void cut() {
    is_closing_ = true;
    Error ignored;
    beast::get_lowest_layer(socket_).socket().close(ignored);
  }

  void be_gone() {
    if (!std::exchange(is_open_, false)) return;
    inside_.browsers.erase(id_);
    inside_.events.closed(id_);
  }

  Inside& inside_;
  std::shared_ptr<PendingSlot> pending_slot_;
  Socket socket_;
  BrowserId id_;
  beast::flat_buffer input_;
  std::deque<std::shared_ptr<const std::string>> waiting_;
  std::size_t waiting_bytes_ = 0;
  std::string reason_;
  bool is_open_ = false;
  bool is_closing_ = false;
};

/// Serves a connection with one request: it sends a reply or opens a WebSocket.
class Web::Inside::Visit : public std::enable_shared_from_this<Visit> {
 public:
  Visit(Inside& inside, net::basic_stream_socket<Tcp, Executor>&& socket)
      : inside_(inside),
        pending_slot_(std::make_shared<PendingSlot>(inside.unauthenticated)),
        stream_(std::move(socket)),
        input_(64 * 1024) {
    pending_slot_->set_end([this] { stream_.close(); });
    parser_.header_limit(static_cast<std::uint32_t>(inside.limits.request_bytes));
    parser_.body_limit(0);
  }

  /// The connection may live on as a browser.
  ~Visit() {
    if (!is_browser_) pending_slot_->set_end({});
  }
  Visit(const Visit&) = delete;
  Visit& operator=(const Visit&) = delete;

  void begin() {
    Error ignored;
    stream_.socket().set_option(Tcp::no_delay(true), ignored);
    stream_.expires_after(inside_.limits.request);
    http::async_read(stream_, input_, parser_,
                     [self = shared_from_this()](Error error, std::size_t) { self->have_read(error); });
  }

 private:
  void have_read(Error error) {
    const Request& request = parser_.get();
    if (error == http::error::header_limit) {
      return respond(
          refusal_of(request, http::status::request_header_fields_too_large, "the request is too long"));
    }
    if (error == http::error::body_limit)
      return respond(refusal_of(request, http::status::payload_too_large, "expected no body"));
    if (error && error.category() == http::make_error_code(http::error::bad_method).category() &&
        error != http::error::end_of_stream && error != http::error::partial_message) {
      return respond(refusal_of(request, http::status::bad_request, "the request is not HTTP"));
    }
    if (error) return;
    answer(request);
  }

  void answer(const Request& request) {
    const bool is_upgrade = websocket::is_upgrade(request);
    if (request.method() != http::verb::get && request.method() != http::verb::head) {
      return respond(refusal_of(request, http::status::method_not_allowed, "expected GET"));
    }
    const auto origin = view(request[http::field::origin]);
    if (request.count(http::field::host) != 1 ||
        !inside_.access.admits_host(view(request[http::field::host])) ||
        (is_upgrade || !origin.empty() ? !inside_.access.admits_origin(origin) : false)) {
      return respond(refusal_of(request, http::status::forbidden, "this is not the address of the page"));
    }
    const std::string_view target = view(request.target());
    if (is_upgrade) {
      if (target != "/ws") return respond(refusal_of(request, http::status::not_found, "not found"));
      stream_.expires_never();
      is_browser_ = true;
      const auto browser =
          std::make_shared<Browser>(inside_, std::move(stream_), pending_slot_, ++inside_.last_browser);
      return browser->open(request);
    }
    auto file = inside_.events.file(target.substr(0, target.find('?')));
    if (!file) return respond(refusal_of(request, http::status::not_found, "not found"));
    const bool is_packed =
        !file->gzipped.empty() && accepts_gzip(view(request[http::field::accept_encoding]));
    Response found =
        answer_to(request, http::status::ok, file->type, std::move(is_packed ? file->gzipped : file->bytes));
    set_policy(found, file->nonce);
    found.set(http::field::vary, "Accept-Encoding");
    if (is_packed) found.set(http::field::content_encoding, "gzip");
    respond(std::move(found));
  }

  void respond(Response&& response) {
    response_ = std::move(response);
    stream_.expires_after(inside_.limits.request);
    http::async_write(stream_, response_, [self = shared_from_this()](Error, std::size_t) {
      Error ignored;
      self->stream_.socket().shutdown(Tcp::socket::shutdown_send, ignored);
    });
  }

  Inside& inside_;
  std::shared_ptr<PendingSlot> pending_slot_;
  TcpStream stream_;
  beast::flat_buffer input_;
  http::request_parser<http::empty_body> parser_;
  bool is_browser_ = false;
  Response response_;
};

Web::Inside::Inside(const WebAddress& address, const WebLimits& given, WebEvents& given_events)
    : limits(given), events(given_events) {
  Error error;
  const auto parsed = net::ip::make_address(address.address, error);
  if (error) throw WebError(address.address + ": is not an address; expected one such as 127.0.0.1");
  const Tcp::endpoint endpoint(parsed, address.port);
  const auto require = [&](const char* what) {
    if (!error) return;
    throw WebError(address.address + " port " + std::to_string(address.port) + ": " + what + " (" +
                   error.message() + "); expected a free port");
  };
  acceptor.open(endpoint.protocol(), error);
  require("cannot be opened");
  acceptor.set_option(net::socket_base::reuse_address(true), error);
  acceptor.bind(endpoint, error);
  require("cannot be opened");
  acceptor.listen(64, error);
  require("cannot be opened");
}

void Web::Inside::accept() {
  acceptor.async_accept([this](Error error, net::basic_stream_socket<Tcp, Executor> socket) {
    if (error == net::error::operation_aborted) return;
    if (error) {  // no descriptors are left; an immediate retry would fail again and again
      auto rest = std::make_shared<Timer>(io, std::chrono::milliseconds(100));
      return rest->async_wait([this, rest](Error) { accept(); });
    }
    // Otherwise connections without a token would keep other browsers out.
    if (unauthenticated.size() >= limits.unauthenticated) unauthenticated.front()->vacate();
    std::make_shared<Visit>(*this, std::move(socket))->begin();
    accept();
  });
}

// --- outside ---------------------------------------------------------------------------------------

Web::Web(const WebAddress& address, const WebLimits& limits, WebEvents& events)
    : inside_(std::make_unique<Inside>(address, limits, events)) {}

Web::~Web() = default;

std::uint16_t Web::port() const { return inside_->acceptor.local_endpoint().port(); }

void Web::admit(WebAccess access) { inside_->access = std::move(access); }

void Web::run(bool watch_signals) {
  net::basic_signal_set<Executor> signals(inside_->io);
  if (watch_signals) {
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) signals.add(number);
    signals.async_wait([this](Error error, int) {
      if (!error) inside_->io.stop();
    });
  }
  inside_->accept();
  inside_->io.run();
}

void Web::stop() { inside_->io.stop(); }

void Web::authenticated(BrowserId browser) {
  const auto found = inside_->browsers.find(browser);
  if (found != inside_->browsers.end()) found->second->authenticated();
}

void Web::send(BrowserId browser, std::shared_ptr<const std::string> text) {
  const auto found = inside_->browsers.find(browser);
  if (found != inside_->browsers.end()) std::shared_ptr(found->second)->send(std::move(text));
}

std::size_t Web::waiting(BrowserId browser) const {
  const auto found = inside_->browsers.find(browser);
  return found == inside_->browsers.end() ? 0 : found->second->waiting();
}

void Web::close(BrowserId browser, std::string_view why) {
  const auto found = inside_->browsers.find(browser);
  if (found != inside_->browsers.end()) std::shared_ptr(found->second)->close(why);
}

void Web::after(std::chrono::milliseconds time, std::function<void()> act) {
  auto timer = std::make_shared<Timer>(inside_->io, time);
  timer->async_wait([timer, act = std::move(act)](Error error) {
    if (!error) act();
  });
}

std::unique_ptr<ControlWire> Web::wire(const std::string& socket) {
  return std::make_unique<UnixWire>(inside_->io, socket, inside_->limits.reply_bytes);
}

}  // namespace understudy::emulator::page
