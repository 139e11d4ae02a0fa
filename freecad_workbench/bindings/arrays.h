// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <pybind11/numpy.h>

#include <algorithm>
#include <array>
#include <vector>

#include <umbilic/core/types.h>

namespace umbilic::python {

/// Array of shape (values.size(), columns), each row written by `row(value, first_element)`.
template <class T, class Values, class Row>
pybind11::array_t<T> rows(const Values& values, pybind11::ssize_t columns, Row&& row) {
    pybind11::array_t<T> array({static_cast<pybind11::ssize_t>(values.size()), columns});
    T* out = array.mutable_data();
    for (const auto& value : values) {
        row(value, out);
        out += columns;
    }
    return array;
}

/// Array of shape (values.size(),) of `entry(value)`.
template <class T, class Values, class Entry>
pybind11::array_t<T> column(const Values& values, Entry&& entry) {
    pybind11::array_t<T> array(static_cast<pybind11::ssize_t>(values.size()));
    T* out = array.mutable_data();
    for (const auto& value : values) *out++ = entry(value);
    return array;
}

/// Array of shape (points.size(), 3).
inline pybind11::array_t<double> point_rows(const std::vector<Vector3>& points) {
    return rows<double>(points, 3, [](const Vector3& point, double* out) { std::copy_n(point.data(), 3, out); });
}

/// Array of shape (triangles.size(), 3).
inline pybind11::array_t<int> triangle_rows(const std::vector<std::array<int, 3>>& triangles) {
    return rows<int>(triangles, 3, [](const auto& triangle, int* out) { std::copy_n(triangle.data(), 3, out); });
}

}  // namespace umbilic::python
