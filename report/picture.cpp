// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/picture.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <Eigen/Geometry>
#include <png.h>

#include <umbilic/core/errors.h>

namespace umbilic {

namespace {

/// Samples a pixel has along each side.
constexpr int oversampling = 2;
/// Share of the picture left free on each side.
constexpr double margin = 0.04;
/// How far lines come forward, relative to the diagonal of what is shown.
constexpr double line_bias = 4e-3;
/// Light that falls on every surface, whatever its direction.
constexpr double ambient = 0.62;
/// Whiteness and sharpness of the highlight.
constexpr double glossiness = 0.22;
constexpr double shininess = 8.0;

ViewAxes looking(const Vector3& toward, const Vector3& up) {
    ViewAxes axes;
    axes.row(2) = toward.normalized();
    axes.row(0) = up.cross(toward).normalized();
    axes.row(1) = Vector3(axes.row(2)).cross(Vector3(axes.row(0)));
    return axes;
}

}  // namespace

ViewAxes isometric_view() {
    return looking({1.0, -1.2, 0.8}, Vector3::UnitZ());
}
ViewAxes front_view() {
    return looking(-Vector3::UnitY(), Vector3::UnitZ());
}
ViewAxes side_view() {
    return looking(Vector3::UnitX(), Vector3::UnitZ());
}
ViewAxes top_view() {
    return looking(Vector3::UnitZ(), Vector3::UnitY());
}

Picture::Picture(const ViewAxes& axes, const BoundingBox& box, int width, int height)
    : axes_(axes),
      center_(box.empty() ? Vector3(Vector3::Zero()) : box.center()),
      bias_(line_bias * box.diagonal()),
      width_(width * oversampling),
      height_(height * oversampling),
      colors_(static_cast<std::size_t>(width_) * height_, Color{1.0f, 1.0f, 1.0f}),
      depths_(static_cast<std::size_t>(width_) * height_, -std::numeric_limits<float>::infinity()) {
    if (box.empty()) return;
    const Vector3 extent = axes_.cwiseAbs() * (box.high - box.low);
    const double free = 1.0 - 2.0 * margin;
    const double tiny = std::numeric_limits<double>::min();
    scale_ = std::min(free * width_ / std::max(extent.x(), tiny), free * height_ / std::max(extent.y(), tiny));
    if (!std::isfinite(scale_)) scale_ = 1.0;
}

Vector3 Picture::project(const Vector3& point) const {
    const Vector3 p = axes_ * (point - center_);
    return {0.5 * width_ + scale_ * p.x(), 0.5 * height_ - scale_ * p.y(), p.z()};
}

void Picture::plot(int x, int y, double depth, const Color& color) {
    const std::size_t i = static_cast<std::size_t>(y) * width_ + x;
    if (depth <= depths_[i]) return;
    depths_[i] = static_cast<float>(depth);
    colors_[i] = color;
}

void Picture::add_surface(const std::vector<Vector3>& points, const std::vector<Vector3>& normals,
                          const std::vector<std::array<int, 3>>& triangles, const std::vector<Color>& colors) {
    std::vector<Vector3> projected(points.size());
    std::vector<Color> lit(points.size());
    const Vector3 light = axes_.transpose() * Vector3(-0.35, 0.45, 0.82).normalized();
    for (std::size_t i = 0; i < points.size(); ++i) {
        projected[i] = project(points[i]);
        const auto brightness = static_cast<float>(ambient + (1.0 - ambient) * std::abs(normals[i].dot(light)));
        const auto shine = static_cast<float>(glossiness * std::pow(std::abs(normals[i].dot(light)), shininess));
        for (int k = 0; k < 3; ++k) {
            const float diffuse = brightness * colors[i][k];
            lit[i][k] = diffuse + shine * (1.0f - diffuse);  // the form shows on dark colours, too
        }
    }
    for (const auto& triangle : triangles) {
        const Vector3 &a = projected[triangle[0]], &b = projected[triangle[1]], &c = projected[triangle[2]];
        const double area = (b.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (b.y() - a.y());
        if (area == 0.0 || !std::isfinite(area)) continue;
        const int x_first = std::max(0, static_cast<int>(std::floor(std::min({a.x(), b.x(), c.x()}))));
        const int x_last = std::min(width_ - 1, static_cast<int>(std::ceil(std::max({a.x(), b.x(), c.x()}))));
        const int y_first = std::max(0, static_cast<int>(std::floor(std::min({a.y(), b.y(), c.y()}))));
        const int y_last = std::min(height_ - 1, static_cast<int>(std::ceil(std::max({a.y(), b.y(), c.y()}))));
        for (int y = y_first; y <= y_last; ++y) {
            for (int x = x_first; x <= x_last; ++x) {
                const double px = x + 0.5, py = y + 0.5;
                const double wb = ((px - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (py - a.y())) / area;
                const double wc = ((b.x() - a.x()) * (py - a.y()) - (px - a.x()) * (b.y() - a.y())) / area;
                const double wa = 1.0 - wb - wc;
                if (wa < 0.0 || wb < 0.0 || wc < 0.0) continue;
                Color color;
                for (int k = 0; k < 3; ++k) {
                    color[k] = static_cast<float>(wa * lit[triangle[0]][k] + wb * lit[triangle[1]][k] +
                                                  wc * lit[triangle[2]][k]);
                }
                plot(x, y, wa * a.z() + wb * b.z() + wc * c.z(), color);
            }
        }
    }
}

void Picture::add_line(const Vector3& from, const Vector3& to, const Color& color, double width) {
    const Vector3 a = project(from), b = project(to);
    const double length = std::hypot(b.x() - a.x(), b.y() - a.y());
    if (!std::isfinite(length)) return;
    const double half = 0.5 * width * oversampling;
    const int steps = static_cast<int>(std::ceil(length)) + 1;
    const int reach = static_cast<int>(std::ceil(half));
    for (int step = 0; step <= steps; ++step) {
        const Vector3 p = a + (b - a) * (static_cast<double>(step) / steps);
        for (int dy = -reach; dy <= reach; ++dy) {
            for (int dx = -reach; dx <= reach; ++dx) {
                if (dx * dx + dy * dy > half * half) continue;
                const int x = static_cast<int>(std::floor(p.x())) + dx, y = static_cast<int>(std::floor(p.y())) + dy;
                if (x >= 0 && x < width_ && y >= 0 && y < height_) plot(x, y, p.z() + bias_, color);
            }
        }
    }
}

void Picture::add_disc(const Vector3& center, const Color& color, double radius) {
    add_line(center, center, color, 2.0 * radius);
}

std::string Picture::png() const {
    const int width = width_ / oversampling, height = height_ / oversampling;
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(3) * width * height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int k = 0; k < 3; ++k) {
                float sum = 0.0f;
                for (int dy = 0; dy < oversampling; ++dy) {
                    for (int dx = 0; dx < oversampling; ++dx) {
                        sum += colors_[static_cast<std::size_t>(y * oversampling + dy) * width_ + x * oversampling + dx]
                                      [k];
                    }
                }
                const float mean = sum / (oversampling * oversampling);
                pixels[3 * (static_cast<std::size_t>(y) * width + x) + k] =
                    static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(mean, 0.0f, 1.0f)));
            }
        }
    }
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = width;
    image.height = height;
    image.format = PNG_FORMAT_RGB;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::string bytes(size, '\0');
    if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0, nullptr)) {
        throw NumericFailure(std::string("a picture of the report could not be encoded: ") + image.message);
    }
    bytes.resize(size);
    return bytes;
}

}  // namespace umbilic
