#include "emulator/page/page.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/files/text_file.h"
#include "base/version.h"
#include "emulator/page/access.h"
#include "emulator/page/bundle.h"
#include "emulator/page/gzip.h"
#include "emulator/page/page_bench.h"
#include "emulator/page/page_verbs.h"
#include "emulator/page/web.h"
#include "emulator/page/web_files.h"

namespace understudy::emulator::page {

namespace {

constexpr std::size_t kMaxAsked = 32;  // replies that one browser can wait for
constexpr std::chrono::milliseconds kForToken{5'000};

std::string dumped(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::string_view word_for(PageBench::State state) {
  switch (state) {
    case PageBench::State::unknown: return "unknown";
    case PageBench::State::there: return "there";
    case PageBench::State::silent: return "silent";
    case PageBench::State::gone: return "gone";
  }
  return {};
}

constexpr std::string_view kIndex = "index.html";
constexpr std::string_view kEarly = "early.js";
constexpr std::string_view kRest = "rest.js";  // the second part of the bundle

bool is_file_name(std::string_view name) {
  return !name.empty() && name.front() != '.' && std::all_of(name.begin(), name.end(), [](char letter) {
    return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
           (letter >= '0' && letter <= '9') || letter == '.' || letter == '-' || letter == '_';
  });
}

}  // namespace

Page::Page(const PageOptions& options)
    : options_(options), token_(make_token()), web_(options.address, options.limits, *this) {
  options_.address.port = web_.port();
  web_.admit(access_of(options_.address, options_.hosts));
  for (std::size_t i = 0; i < options_.sockets.size(); ++i) {
    benches_.push_back(
        std::make_unique<PageBench>(web_, options_.sockets[i],
                                    PageBench::Callbacks{.looked = [this, i] { show(i); },
                                                         .state_changed = [this, i] { send_state(i); }}));
  }
}

Page::~Page() = default;

std::string Page::address() const {
  const std::string& host = options_.hosts.empty() ? options_.address.address : options_.hosts.front();
  const bool is_v6 = host.find(':') != std::string::npos;
  return "http://" + (is_v6 ? "[" + host + "]" : host) + ":" + std::to_string(options_.address.port) + "/#" +
         token_;
}

std::optional<WebFile> Page::file(std::string_view path) {
  if (!path.starts_with('/')) return std::nullopt;
  const std::string_view name = path == "/" ? kIndex : path.substr(1);
  if (!is_file_name(name)) return std::nullopt;
  if (!options_.folder.empty()) {
    if (const auto text = read_text_file(options_.folder + "/" + std::string(name))) {
      return WebFile{.type = std::string(type_of(name)), .bytes = *text, .gzipped = {}};
    }
  }
  return built_in(name);
}

std::optional<WebFile> Page::built_in(std::string_view name) {
  if (const auto known = files_.find(name); known != files_.end()) return known->second;
  std::string bytes(name == kRest ? bundled(embedded_text).rest : std::string(embedded_text(name)));
  if (bytes.empty()) return std::nullopt;
  WebFile file{.type = std::string(type_of(name)), .bytes = {}, .gzipped = {}};
  if (name == kIndex && options_.folder.empty()) {
    file.nonce = make_token();
    bytes = with_scripts(bytes, embedded_text(kEarly), bundled(embedded_text).first, file.nonce);
  }
  file.gzipped = gzipped(bytes);
  file.bytes = std::move(bytes);
  return files_.emplace(name, std::move(file)).first->second;
}

void Page::opened(BrowserId browser) {
  browsers_[browser];
  web_.after(kForToken, [this, browser] {
    const auto found = browsers_.find(browser);
    if (found != browsers_.end() && !found->second.is_known) web_.close(browser, "the token is missing");
  });
}

void Page::received(BrowserId browser, std::string_view text) {
  Browser& whose = browsers_[browser];
  if (!whose.is_known) {
    if (!is_token(token_of(text), token_)) return web_.close(browser, "the token is wrong");
    const auto known = std::count_if(browsers_.begin(), browsers_.end(),
                                     [](const auto& one) { return one.second.is_known; });
    if (static_cast<std::size_t>(known) >= options_.browsers) return web_.close(browser, "too many browsers");
    whose.is_known = true;
    web_.authenticated(browser);
    return greet(browser);
  }
  try {
    take(browser, text);
  } catch (const BrowserError& mistake) {
    send(browser, dumped({{"is", "error"}, {"error", mistake.what()}}));
  }
}

void Page::greet(BrowserId browser) {
  Json benches = Json::array();
  for (const auto& bench : benches_) {
    benches.push_back(
        {{"socket", bench->socket()}, {"state", word_for(bench->state())}, {"epoch", bench->epoch()}});
  }
  send(browser, dumped({{"is", "hello"},
                        {"version", program_version()},
                        {"read_only", options_.is_read_only},
                        {"benches", std::move(benches)}}));
}

void Page::take(BrowserId browser, std::string_view text) {
  Browser& whose = browsers_.at(browser);
  BrowserMessage message = parse_browser_message(text, benches_.size(), options_.is_read_only);
  if (message.what == BrowserMessage::What::watch) return watch(whose, std::move(message));
  const auto answer = [this, browser, id = message.id, bench = message.bench](const std::string& reply) {
    send(browser, R"({"is":"answer","bench":)" + std::to_string(bench) + ",\"id\":" + id +
                      ",\"reply\":" + reply + "}");
  };
  const auto refuse = [&](const std::string& why) { answer(dumped({{"ok", false}, {"error", why}})); };
  if (!message.refusal.empty()) return refuse(message.refusal);
  if (whose.asked >= kMaxAsked) return refuse("too many requests at once");
  ++whose.asked;
  benches_[message.bench]->ask(
      std::move(message.message), [this, browser, answer](const std::optional<std::string>& reply) {
        const auto found = browsers_.find(browser);
        if (found == browsers_.end()) return;
        --found->second.asked;
        answer(reply ? *reply : R"({"ok":false,"error":"the bench does not answer"})");
      });
}

void Page::watch(Browser& whose, BrowserMessage message) {
  Watching next{.names = std::move(message.names),
                .frames = message.frames,
                .events = message.events,
                .status = message.status,
                .epoch = benches_[message.bench]->epoch()};
  // The browser already has the frames and events that were sent to it.
  const auto before = whose.watched.find(message.bench);
  if (before != whose.watched.end() && before->second.epoch == next.epoch) {
    next.next_frame = before->second.next_frame;
    next.next_event = before->second.next_event;
  }
  if (message.watches) {
    whose.watched[message.bench] = std::move(next);
  } else {
    whose.watched.erase(message.bench);
  }
  watched_changed(message.bench);
}

/// Combines the requests of all browsers for a bench.
void Page::watched_changed(std::size_t bench) {
  PageBench::Wanted wanted;
  for (const auto& [id, browser] : browsers_) {
    const auto found = browser.watched.find(bench);
    if (found == browser.watched.end()) continue;
    const Watching& watching = found->second;
    wanted.anybody = true;
    wanted.frames = wanted.frames || watching.frames;
    wanted.events = wanted.events || watching.events;
    wanted.status = wanted.status || watching.status;
    for (const std::string& name : watching.names) {
      if (wanted.names.size() < PageBench::kMaxNames) wanted.names.insert(name);
    }
  }
  benches_[bench]->want(std::move(wanted));
}

void Page::closed(BrowserId browser) {
  const auto found = browsers_.find(browser);
  if (found == browsers_.end()) return;
  const Browser gone = std::move(found->second);
  browsers_.erase(found);
  for (const auto& [bench, watching] : gone.watched) watched_changed(bench);
}

void Page::drained(BrowserId browser) {
  const auto found = browsers_.find(browser);
  if (found == browsers_.end()) return;
  for (const auto& [bench, watching] : found->second.watched) {
    if (benches_[bench]->state() == PageBench::State::there) show_to(browser, found->second, bench);
  }
}

void Page::show(std::size_t bench) {
  for (auto& [id, browser] : browsers_) show_to(id, browser, bench);
}

/// A browser that still receives the last update gets the next one afterwards.
void Page::show_to(BrowserId browser, Browser& whose, std::size_t bench) {
  const auto found = whose.watched.find(bench);
  if (found == whose.watched.end() || web_.waiting(browser) > 0) return;
  const std::string news = benches_[bench]->news_for(found->second);
  if (news.empty()) return;
  send(browser, "{\"is\":\"look\",\"bench\":" + std::to_string(bench) + "," + news + "}");
}

void Page::send_state(std::size_t bench) {
  const Json printed{{"is", "bench"},
                     {"bench", bench},
                     {"state", word_for(benches_[bench]->state())},
                     {"epoch", benches_[bench]->epoch()}};
  for (auto& [id, browser] : browsers_) {
    if (!browser.is_known) continue;
    // If another daemon replies, all its data is new.
    if (const auto found = browser.watched.find(bench);
        found != browser.watched.end() && benches_[bench]->state() == PageBench::State::there) {
      if (found->second.epoch != benches_[bench]->epoch()) {
        found->second.epoch = benches_[bench]->epoch();
        found->second.seen = found->second.next_frame = found->second.next_event = found->second.status_seen =
            0;
      }
    }
    send(id, dumped(printed));
  }
}

void Page::send(BrowserId browser, std::string text) {
  web_.send(browser, std::make_shared<const std::string>(std::move(text)));
}

}  // namespace understudy::emulator::page
