// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <string>

#include <CLI/CLI.hpp>

namespace umbilic {

/// Check of an option's number: finite and positive, or also zero. The message is one short line.
inline CLI::Validator finite_number(bool zero_too) {
    return CLI::Validator(
        [zero_too](const std::string& text) -> std::string {
            double value = 0.0;
            const bool number = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
            if (number && (value > 0.0 || (zero_too && value == 0.0))) return {};
            return text + (zero_too ? " is no finite number from 0 on" : " is no finite number above 0");
        },
        "");
}

}  // namespace umbilic
