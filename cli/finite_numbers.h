// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <string>

#include <CLI/CLI.hpp>

namespace umbilic {

/// Check of an option's number: finite and positive, or also zero. The message is one short line that says what the
/// number must be, not what the machine can hold.
inline CLI::Validator finite_number(bool zero_too) {
    return CLI::Validator(
        [zero_too](const std::string& text) -> std::string {
            constexpr std::size_t longest_shown = 40;
            double value = 0.0;
            const bool number = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
            if (number && (value > 0.0 || (zero_too && value == 0.0))) return {};
            const std::string given = text.size() <= longest_shown ? text : text.substr(0, longest_shown) + "…";
            return std::string(zero_too ? "must be 0 or a positive number" : "must be a positive number") + ", not '" +
                   given + "'";
        },
        "");
}

}  // namespace umbilic
