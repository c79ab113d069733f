// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/console/console.hpp"

#include "engine/core/error.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>

namespace sturz::app {
namespace {

/// Text from files and names, without what would command the terminal: control characters are
/// shown as \x1b. Line ends and tabs stay.
std::string harmless(std::string_view line) {
  std::string text;
  text.reserve(line.size());
  for (std::size_t i = 0; i < line.size(); ++i) {
    const auto byte = static_cast<unsigned char>(line[i]);
    const auto next = i + 1 < line.size() ? static_cast<unsigned char>(line[i + 1]) : 0;
    if (byte == 0xC2 && next >= 0x80 && next < 0xA0) {  // the same controls, as UTF-8
      text += fmt::format("\\x{:02x}", next);
      ++i;
    } else if ((byte < 0x20 && byte != '\n' && byte != '\t') || byte == 0x7F) {
      text += fmt::format("\\x{:02x}", byte);
    } else {
      text += line[i];
    }
  }
  return text;
}

/// Bytes that are no UTF-8 (names of files may hold them) become U+FFFD.
std::string as_event(const char* kind, std::string_view text) {
  return nlohmann::json{{"event", kind}, {"text", text}}.dump(
      -1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

struct Console::LogFile {
  std::shared_ptr<spdlog::logger> logger;
};

Console::Console(bool json) : json_(json), tty_(isatty(STDERR_FILENO) != 0) {}
Console::~Console() { clear_progress(); }

void Console::log_to(const std::string& path) {
  try {
    auto sink = std::make_shared<spdlog::sinks::basic_file_sink_mt>(path, false);
    auto logger = std::make_shared<spdlog::logger>("sturz", std::move(sink));
    logger->set_pattern("%Y-%m-%d %H:%M:%S.%e %^%l%$ %v");
    logger->flush_on(spdlog::level::info);
    // A full disk must not end a run through its log; the results' writer reports it.
    logger->set_error_handler([](const std::string&) {});
    log_ = std::make_unique<LogFile>(LogFile{std::move(logger)});
  } catch (const spdlog::spdlog_ex& problem) {
    throw SetupError(fmt::format("{}: the log cannot be written ({}). Is the folder writable?",
                                 path, problem.what()));
  }
}

void Console::say(std::string_view line) {
  note(line);
  if (json_) return;
  clear_progress();
  fmt::print("{}\n", harmless(line));
  std::fflush(stdout);
}

void Console::note(std::string_view line) {
  if (log_) log_->logger->info("{}", harmless(line));
}

void Console::warn(std::string_view line) {
  if (log_) log_->logger->warn("{}", harmless(line));
  clear_progress();
  if (json_) return event(as_event("warning", line));
  fmt::print(stderr, "warning: {}\n", harmless(line));
}

void Console::error(std::string_view line) {
  if (log_) log_->logger->error("{}", harmless(line));
  clear_progress();
  if (json_) event(as_event("error", line));
  fmt::print(stderr, "error: {}\n", harmless(line));
}

void Console::event(std::string_view json_object) {
  if (!json_) return;
  fmt::print("{}\n", json_object);
  std::fflush(stdout);
}

void Console::progress(std::string_view line) {
  if (!shows_progress()) return;
  fmt::print(stderr, "\r\033[2K{}", line);
  std::fflush(stderr);
  bar_on_screen_ = true;
}

void Console::clear_progress() {
  if (!bar_on_screen_) return;
  fmt::print(stderr, "\r\033[2K");
  std::fflush(stderr);
  bar_on_screen_ = false;
}

int Console::columns() const {
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return 80;
}

}  // namespace sturz::app
