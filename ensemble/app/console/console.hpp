// SPDX-License-Identifier: Apache-2.0
/// What the user sees: words on a terminal, JSON lines for machines, and the log file.
///
/// Results go to stdout; progress, warnings and errors go to stderr.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace sturz::app {

class Console {
 public:
  /// \param json one JSON object per line instead of words
  explicit Console(bool json);
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  bool json() const { return json_; }
  /// Sends a copy of everything to a log file from now on. A file that cannot be opened is an
  /// error.
  void log_to(const std::string& path);

  void say(std::string_view line);    ///< a result: stdout in words mode, log always
  void note(std::string_view line);   ///< only into the log
  void warn(std::string_view line);   ///< stderr and log
  void error(std::string_view line);  ///< stderr and log
  /// A finished JSON object: stdout in JSON mode, nothing otherwise.
  void event(std::string_view json_object);

  /// Replaces the one-line progress bar; words on a terminal only.
  void progress(std::string_view line);
  /// Wipes the progress bar before other output.
  void clear_progress();
  bool shows_progress() const { return tty_ && !json_; }
  int columns() const;
  /// Columns that what is said may take; 0 where standard output is no terminal.
  int said_columns() const { return json_ ? 0 : out_columns_; }

 private:
  struct LogFile;
  std::unique_ptr<LogFile> log_;
  bool json_, tty_;
  int out_columns_, err_columns_;  ///< 0: lines are not folded
  bool bar_on_screen_ = false;
};

}  // namespace sturz::app
