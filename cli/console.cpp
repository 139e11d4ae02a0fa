// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cli/console.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include <fmt/format.h>
#include <unistd.h>

namespace umbilic {

namespace {

constexpr int bar_width = 30;
constexpr std::chrono::milliseconds bar_interval{50};
bool bar_on_screen = false;  // standard error is one, too

/// Columns a UTF-8 text takes on a screen (one a code point).
std::size_t columns(const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

std::string padded(const std::string& text, std::size_t width, bool right) {
    const std::string space(width - std::min(width, columns(text)), ' ');
    return right ? space + text : text + space;
}

std::string without_trailing_space(std::string line) {
    line.erase(line.find_last_not_of(' ') + 1);
    return line;
}

}  // namespace

ProgressCallback progress_bar(bool quiet) {
    if (quiet || isatty(STDERR_FILENO) == 0) return {};
    struct State {
        double fraction = 0.0;
        std::chrono::steady_clock::time_point drawn;
    };
    return [state = std::make_shared<State>()](double fraction, std::string_view stage) {
        const auto now = std::chrono::steady_clock::now();
        state->fraction = std::max(state->fraction, fraction);
        if (now - state->drawn < bar_interval) return true;
        state->drawn = now;
        const int filled = static_cast<int>(bar_width * std::min(1.0, state->fraction));
        fmt::print(stderr, "\r\033[2K[{:#<{}}{:.<{}}] {:3.0f} %  {}", "", filled, "", bar_width - filled,
                   100.0 * state->fraction, stage);
        std::fflush(stderr);
        bar_on_screen = true;
        return true;
    };
}

void clear_progress_bar() {
    if (!bar_on_screen) return;
    fmt::print(stderr, "\r\033[2K");
    std::fflush(stderr);
    bar_on_screen = false;
}

std::string bold(const std::string& text) {
    const bool plain = isatty(STDOUT_FILENO) == 0 || std::getenv("NO_COLOR") != nullptr;
    return plain ? text : "\033[1m" + text + "\033[0m";
}

std::string table(const std::vector<std::string>& heading, const std::vector<std::vector<std::string>>& rows,
                  const std::vector<int>& right) {
    std::vector<std::size_t> widths;
    for (const std::string& cell : heading) widths.push_back(columns(cell));
    for (const auto& row : rows) {
        for (std::size_t i = 0; i < widths.size(); ++i) widths[i] = std::max(widths[i], columns(row[i]));
    }
    const auto line = [&](const std::vector<std::string>& row) {
        std::string text;
        for (std::size_t i = 0; i < widths.size(); ++i) {
            const bool is_right = std::find(right.begin(), right.end(), static_cast<int>(i)) != right.end();
            text += (i == 0 ? "" : "  ") + padded(row[i], widths[i], is_right);
        }
        return without_trailing_space(text) + "\n";
    };
    std::string text = line(heading);
    std::size_t total = 2 * (widths.size() - 1);
    for (const std::size_t width : widths) total += width;
    text += std::string(total, '-') + "\n";
    for (const auto& row : rows) text += line(row);
    return text;
}

std::string facts(const std::vector<std::pair<std::string, std::string>>& lines) {
    std::size_t width = 0;
    for (const auto& [name, value] : lines) width = std::max(width, columns(name));
    std::string text;
    for (const auto& [name, value] : lines) {
        if (!value.empty()) text += padded(name, width, false) + "  " + value + "\n";
    }
    return text;
}

std::string printable(const std::string& text) {
    std::string result = text;
    std::replace_if(
        result.begin(), result.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
    return result;
}

}  // namespace umbilic
