// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include <umbilic/core/errors.h>

namespace umbilic {

/// Walks through the lines of a text, whatever ends them.
class TextLines {
public:
    explicit TextLines(std::string_view text) : rest_(text) {
        if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);
    }

    /// The next line without its end; none after the last.
    std::optional<std::string_view> next() {
        if (rest_.empty()) return {};
        ++number_;
        const std::size_t end = rest_.find_first_of("\r\n");
        const std::string_view line = rest_.substr(0, end);
        if (end == std::string_view::npos)
            rest_ = {};
        else
            rest_.remove_prefix(end + (rest_.substr(end, 2) == "\r\n" ? 2 : 1));
        return line;
    }

    /// Number of the line that next() gave last, from 1.
    std::size_t number() const { return number_; }
    std::size_t bytes_left() const { return rest_.size(); }
    std::string_view rest() const { return rest_; }

private:
    std::string_view rest_;
    std::size_t number_ = 0;
};

/// Takes the next word, up to blanks or one of `separators`, from the front of a line; empty at its end.
inline std::string_view take_word(std::string_view& line, std::string_view separators = " \t") {
    const std::size_t start = line.find_first_not_of(separators);
    if (start == std::string_view::npos) {
        line = {};
        return {};
    }
    const std::size_t end = std::min(line.find_first_of(separators, start), line.size());
    const std::string_view word = line.substr(start, end - start);
    line.remove_prefix(end);
    return word;
}

/// The number a word writes, in full and independent of the locale: also nan and inf, which is what numbers too large
/// become. None if the word is no number.
inline std::optional<double> number_in(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || end != word.data() + word.size()) return {};
    if (error == std::errc::result_out_of_range) {
        const bool tiny = word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos;
        return tiny ? 0.0 : std::numeric_limits<double>::infinity();
    }
    return error == std::errc() ? std::optional(value) : std::nullopt;
}

[[noreturn]] inline void bad_line(const std::string& path, std::size_t line, const std::string& what) {
    throw InvalidInput(path + ": line " + std::to_string(line) + ": " + what);
}

}  // namespace umbilic
