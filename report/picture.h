// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include <umbilic/core/types.h>

#include <report/color_scale.h>

namespace umbilic {

/// Parallel projection: rows are the directions in space of the picture's right, its top, and towards the viewer.
using ViewAxes = Matrix3;

/// Views named as on a drawing; z is up.
ViewAxes isometric_view();
ViewAxes front_view();
ViewAxes side_view();
ViewAxes top_view();

/// A picture drawn triangle by triangle with a depth buffer, for paper and for browsers without WebGL. Drawn at twice
/// its size and averaged, on white.
class Picture {
public:
    /// Shows `box` as large as fits into width x height pixels.
    Picture(const ViewAxes& axes, const BoundingBox& box, int width, int height);

    /// A surface lit from the viewer's side, one colour a vertex; opacity in (0, 1].
    void add_surface(const std::vector<Vector3>& points, const std::vector<Vector3>& normals,
                     const std::vector<std::array<int, 3>>& triangles, const std::vector<Color>& colors);
    /// A line, in front of surfaces that contain it; width in pixels.
    void add_line(const Vector3& from, const Vector3& to, const Color& color, double width);
    /// A disc that faces the viewer, in front of surfaces that contain its centre; radius in pixels.
    void add_disc(const Vector3& center, const Color& color, double radius);

    /// The picture as a PNG file. Throws NumericFailure if it cannot be encoded.
    std::string png() const;

private:
    Vector3 project(const Vector3& point) const;
    void plot(int x, int y, double depth, const Color& color);

    ViewAxes axes_;
    Vector3 center_;
    double scale_ = 1.0;
    double bias_ = 0.0;  ///< how far lines and discs come forward, mm
    int width_ = 0, height_ = 0;
    std::vector<Color> colors_;
    std::vector<float> depths_;
};

}  // namespace umbilic
