// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/base64.h>

#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>

namespace umbilic {

std::string base64(std::string_view bytes) {
    using namespace boost::archive::iterators;
    // Whole groups of three bytes first: the iterators must not read past the end.
    using Encode = base64_from_binary<transform_width<const char*, 6, 8>>;
    const std::size_t whole = bytes.size() - bytes.size() % 3;
    std::string text(Encode(bytes.data()), Encode(bytes.data() + whole));
    if (whole < bytes.size()) {
        std::string last(bytes.substr(whole));
        const std::size_t missing = 3 - last.size();
        last.append(missing, '\0');
        text.append(Encode(last.data()), Encode(last.data() + 3));
        text.replace(text.size() - missing, missing, missing, '=');
    }
    return text;
}

}  // namespace umbilic
