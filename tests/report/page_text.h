// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <string>

namespace umbilic {

/// The page without the contents of its style and script elements, which hold no elements.
inline std::string markup(const std::string& page) {
    std::string result;
    std::size_t at = 0;
    while (at < page.size()) {
        const auto script = std::min(page.find("<script", at), page.find("<style", at));
        if (script == std::string::npos) break;
        const auto open_end = page.find('>', script) + 1;
        result += page.substr(at, open_end - at);
        at = page.find(page[script + 2] == 'c' ? "</script" : "</style", open_end);
    }
    return result + page.substr(at);
}

/// How often a part stands in a text.
inline std::size_t count(const std::string& text, const std::string& part) {
    std::size_t number = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++number;
    return number;
}

}  // namespace umbilic
