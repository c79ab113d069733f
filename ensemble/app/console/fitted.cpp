// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/console/fitted.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>

namespace sturz::app {
namespace {

constexpr int least_columns = 30;  ///< below, folding would only tear words apart
constexpr std::size_t gap = 2;     ///< between two columns of a table

/// Characters that a terminal shows of UTF-8 text.
std::size_t shown_width(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

std::string padded(const std::string& text, std::size_t width) {
  const std::size_t shown = shown_width(text);
  return text + std::string(width > shown ? width - shown : 0, ' ');
}

/// Where the rest of a folded line begins.
std::size_t hanging_indent(std::string_view line, std::size_t columns) {
  const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
  std::size_t hang = begin + gap;
  const std::size_t wide = line.find("  ", begin);
  if (wide != std::string_view::npos) {
    const std::size_t text = line.find_first_not_of(' ', wide);
    if (text != std::string_view::npos) hang = text;
  }
  return hang <= columns / 2 ? hang : begin + gap;
}

std::string one_line(const std::vector<std::string>& row, const std::vector<std::size_t>& width,
                     const std::vector<std::size_t>& chosen) {
  std::string line;
  for (const std::size_t c : chosen) {
    if (c >= row.size()) continue;
    if (!line.empty()) line += std::string(gap, ' ');
    line += padded(row[c], width[c]);
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

}  // namespace

int columns_of(int stream) {
  winsize size{};
  if (isatty(stream) == 0 || ioctl(stream, TIOCGWINSZ, &size) != 0) return 0;
  return size.ws_col >= least_columns ? size.ws_col : 0;
}

int help_columns(int stream) {
  if (const char* const said = std::getenv("COLUMNS")) {
    int n = 0;
    const auto [end, problem] = std::from_chars(said, said + std::strlen(said), n);
    if (problem == std::errc{} && *end == '\0' && n >= least_columns) return n;
  }
  return columns_of(stream);
}

std::string folded(std::string_view line, int columns, std::optional<int> hang) {
  const auto limit = static_cast<std::size_t>(std::max(columns, 0));
  if (limit == 0 || shown_width(line) <= limit) return std::string(line);
  const std::string indent(
      hang ? static_cast<std::size_t>(std::max(*hang, 0)) : hanging_indent(line, limit), ' ');
  std::string all, current;
  std::size_t at = 0;
  while (at < line.size()) {
    // A word with the blanks before it, so that aligned text keeps its gaps.
    const std::size_t word = std::min(line.find_first_not_of(' ', at), line.size());
    const std::size_t end = std::min(line.find(' ', word), line.size());
    const bool begins = current.find_first_not_of(' ') == std::string::npos;
    const std::string_view next = line.substr(at, end - at);
    if (!begins && shown_width(current) + shown_width(next) > limit) {
      all += current + "\n";
      current = indent + std::string(line.substr(word, end - word));
    } else {
      current += next;
    }
    at = end;
  }
  return all + current;
}

std::vector<std::string> fitted_table(const std::vector<std::vector<std::string>>& rows,
                                      int columns) {
  std::vector<std::size_t> width;
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (c == width.size()) width.push_back(0);
      width[c] = std::max(width[c], shown_width(row[c]));
    }
  std::vector<std::string> lines;
  std::size_t next = 1;
  do {
    std::vector<std::size_t> chosen{0};
    std::size_t used = width.empty() ? 0 : width[0];
    for (; next < width.size(); ++next) {
      used += gap + width[next];
      if (columns > 0 && chosen.size() > 1 && used > static_cast<std::size_t>(columns)) break;
      chosen.push_back(next);
    }
    for (const auto& row : rows) lines.push_back(one_line(row, width, chosen));
  } while (next < width.size());
  return lines;
}

}  // namespace sturz::app
