// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/given_pairs_text.h>

#include <algorithm>

#include <report/readable.h>

namespace umbilic {

std::string given_pairs_text(const std::vector<GivenPair>& pairs) {
    double greatest = 0.0;
    std::string wrong;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        if (!pairs[k].outlier)
            greatest = std::max(greatest, pairs[k].residual);
        else
            wrong += (wrong.empty() ? "; left out as wrong: number " : ", ") + readable_count(k + 1) + " (off by " +
                     readable(pairs[k].residual, "mm", 3) + ")";
    }
    return readable_count(pairs.size()) + " given, residuals up to " + readable(greatest, "mm", 3) + wrong;
}

}  // namespace umbilic
