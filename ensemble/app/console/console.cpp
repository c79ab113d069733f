// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/console/console.hpp"

#include "engine/core/error.hpp"
#include "ensemble/app/console/fitted.hpp"
#include "ensemble/app/console/json_text.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace sturz::app {
namespace {

/// What cannot be written is remembered by the stream; command_line() looks at the end. The work
/// goes on meanwhile: hours of members are worth more than a line.
void put(std::FILE* stream, std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stream);
  std::fflush(stream);
}

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

/// Each line of the text folded to the terminal.
std::string fitting(const std::string& text, int columns) {
  if (columns == 0) return text;
  std::string all;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (at > 0) all += '\n';
    all += folded(text.substr(at, end - at), columns);
    at = end + 1;
  }
  return all;
}

}  // namespace

struct Console::LogFile {
  std::shared_ptr<spdlog::logger> logger;
};

Console::Console(bool json)
    : json_(json),
      tty_(isatty(STDERR_FILENO) != 0),
      out_columns_(columns_of(STDOUT_FILENO)),
      err_columns_(columns_of(STDERR_FILENO)) {}
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
  put(stdout, fmt::format("{}\n", fitting(harmless(line), out_columns_)));
}

void Console::note(std::string_view line) {
  if (log_) log_->logger->info("{}", harmless(line));
}

void Console::warn(std::string_view line) {
  if (log_) log_->logger->warn("{}", harmless(line));
  clear_progress();
  if (json_) return event(json_text(nlohmann::json{{"event", "warning"}, {"text", line}}));
  put(stderr,
      fmt::format("{}\n", fitting(fmt::format("warning: {}", harmless(line)), err_columns_)));
}

void Console::error(std::string_view line) {
  if (log_) log_->logger->error("{}", harmless(line));
  clear_progress();
  if (json_) event(json_text(nlohmann::json{{"event", "error"}, {"text", line}}));
  put(stderr, fmt::format("{}\n", fitting(fmt::format("error: {}", harmless(line)), err_columns_)));
}

void Console::event(std::string_view json_object) {
  if (json_) put(stdout, fmt::format("{}\n", json_object));
}

void Console::progress(std::string_view line) {
  if (!shows_progress()) return;
  put(stderr, fmt::format("\r\033[2K{}", line));
  bar_on_screen_ = true;
}

void Console::clear_progress() {
  if (!bar_on_screen_) return;
  put(stderr, "\r\033[2K");
  bar_on_screen_ = false;
}

int Console::columns() const {
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return 80;
}

}  // namespace sturz::app
