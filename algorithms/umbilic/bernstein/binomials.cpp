// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/bernstein/binomials.h>

#include <cassert>
#include <vector>

namespace umbilic {

namespace {

struct Triangle {
    std::vector<double> values, inverses;
    Triangle() {
        const int count = (maximum_product_degree + 1) * (maximum_product_degree + 2) / 2;
        values.resize(count);
        inverses.resize(count);
        for (int n = 0; n <= maximum_product_degree; ++n)
            for (int k = 0; k <= n; ++k) {
                const int at = start(n) + k;
                values[at] = k == 0 || k == n ? 1.0 : values[start(n - 1) + k - 1] + values[start(n - 1) + k];
                inverses[at] = 1.0 / values[at];
            }
    }
    static int start(int n) { return n * (n + 1) / 2; }
};

const Triangle& triangle() {
    static const Triangle result;
    return result;
}

}  // namespace

const double* binomials(int n) {
    assert(0 <= n && n <= maximum_product_degree);
    return triangle().values.data() + Triangle::start(n);
}

const double* inverse_binomials(int n) {
    assert(0 <= n && n <= maximum_product_degree);
    return triangle().inverses.data() + Triangle::start(n);
}

}  // namespace umbilic
