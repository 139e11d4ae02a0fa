// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/bernstein/coefficient_array.h>

#include <algorithm>
#include <limits>

namespace umbilic {

namespace {

/// Smallest and greatest of numbers that come in groups of four, and some that are left over.
class RangeOfFour {
public:
    void add(const Eigen::Array4d& values) {
        low_ = low_.min(values);
        high_ = high_.max(values);
    }
    void add(double value) {
        rest_low_ = std::min(rest_low_, value);
        rest_high_ = std::max(rest_high_, value);
    }
    Interval range() const { return {std::min(low_.minCoeff(), rest_low_), std::max(high_.maxCoeff(), rest_high_)}; }

private:
    static constexpr double infinity_ = std::numeric_limits<double>::infinity();
    Eigen::Array4d low_ = Eigen::Array4d::Constant(infinity_), high_ = Eigen::Array4d::Constant(-infinity_);
    double rest_low_ = infinity_, rest_high_ = -infinity_;
};

}  // namespace

Interval coefficient_range(const double* c, int count) {
    RangeOfFour result;
    int k = 0;
    for (; k + 4 <= count; k += 4) result.add(Eigen::Map<const Eigen::Array4d>(c + k));
    for (; k < count; ++k) result.add(c[k]);
    return result.range();
}

Interval range_beside(CoefficientShape shape, const double* c, const Vector2& slope) {
    RangeOfFour result;
    const int length = shape.row_length();
    const double u_step = shape.p > 0 ? slope.x() / shape.p : 0.0, v_step = shape.q > 0 ? slope.y() / shape.q : 0.0;
    const Eigen::Array4d steps = v_step * Eigen::Array4d(0.0, 1.0, 2.0, 3.0);
    for (int i = 0; i <= shape.p; ++i, c += length) {
        int j = 0;
        for (; j + 4 <= length; j += 4)
            result.add(Eigen::Map<const Eigen::Array4d>(c + j) - steps - (i * u_step + j * v_step));
        for (; j < length; ++j) result.add(c[j] - (i * u_step + j * v_step));
    }
    return result.range();
}

std::array<Interval, 2> difference_hulls(CoefficientShape shape, const double* c) {
    const int length = shape.row_length();
    const auto add = [](RangeOfFour& result, const double* from, const double* to, int count) {
        int k = 0;
        for (; k + 4 <= count; k += 4)
            result.add(Eigen::Map<const Eigen::Array4d>(to + k) - Eigen::Map<const Eigen::Array4d>(from + k));
        for (; k < count; ++k) result.add(to[k] - from[k]);
    };
    RangeOfFour u, v;
    add(u, c, c + length, shape.p * length);
    for (int i = 0; i <= shape.p; ++i) add(v, c + i * length, c + i * length + 1, shape.q);
    return {shape.p > 0 ? u.range() : Interval(0.0), shape.q > 0 ? v.range() : Interval(0.0)};
}

}  // namespace umbilic
