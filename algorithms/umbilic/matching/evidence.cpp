// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/evidence.h>

#include <algorithm>
#include <cmath>
#include <map>

#include <umbilic/matching/pose_distance.h>

namespace umbilic {

namespace {

/// Fewer covered samples than these tell nothing about a face's form.
constexpr int fewest_samples = 3;

/// Two elementary surfaces are the same if they differ by less than this many tolerances.
constexpr double same_surface = 10.0;

enum class Form { plane, cylinder, sphere, developable, free };

/// An elementary surface by a direction (sign without meaning), a point and a radius, all in mm.
struct Element {
    Form form = Form::free;
    Vector3 direction = Vector3::Zero();  ///< times the model's length
    Vector3 location = Vector3::Zero();
    double radius = 0.0;
};

struct CoveredFace {
    BoundingBox box;
    int count = 0;
    double largest_max = 0.0, smallest_max = 0.0, largest_min = 0.0, smallest_min = 0.0;
    Curvature first;

    void add(const Curvature& c) {
        if (count++ == 0) {
            first = c;
            largest_max = smallest_max = c.kappa_max;
            largest_min = smallest_min = c.kappa_min;
        }
        box.add(c.point);
        largest_max = std::max(largest_max, c.kappa_max);
        smallest_max = std::min(smallest_max, c.kappa_max);
        largest_min = std::max(largest_min, c.kappa_min);
        smallest_min = std::min(smallest_min, c.kappa_min);
    }
};

Element element_of(const CoveredFace& face, const ShapeSize& size, double departure) {
    // A curvature of kappa over a width d lifts a surface by kappa d^2 / 8.
    const double width = face.box.diagonal();
    const auto negligible = [&](double kappa) { return std::abs(kappa) * width * width / 8.0 <= departure; };
    const bool max_zero = negligible(face.largest_max) && negligible(face.smallest_max);
    const bool min_zero = negligible(face.largest_min) && negligible(face.smallest_min);
    const bool max_constant = negligible(face.largest_max - face.smallest_max);
    const bool min_constant = negligible(face.largest_min - face.smallest_min);

    const Curvature& c = face.first;
    Element element;
    if (max_zero && min_zero) {
        element.form = Form::plane;
        element.direction = size.length * c.normal;
        element.location = c.normal.dot(c.point - size.centroid) * c.normal;
    } else if ((max_zero && min_constant) || (min_zero && max_constant)) {
        const double kappa = min_zero ? c.kappa_max : c.kappa_min;
        const Vector3 axis = min_zero ? c.direction_min : c.direction_max;
        const Vector3 centre = c.point - c.normal / kappa - size.centroid;
        element = {Form::cylinder, size.length * axis, centre - axis.dot(centre) * axis, std::abs(1.0 / kappa)};
    } else if (max_constant && min_constant && negligible(c.kappa_max - c.kappa_min)) {
        element = {Form::sphere, Vector3::Zero(), c.point - c.normal / c.mean(), std::abs(1.0 / c.mean())};
    } else if (max_zero || min_zero) {
        element.form = Form::developable;
    }
    return element;
}

bool same(const Element& a, const Element& b, double tolerance) {
    if (a.form != b.form || a.form == Form::developable || a.form == Form::free) return false;
    const double turn = std::min((a.direction - b.direction).norm(), (a.direction + b.direction).norm());
    return turn <= tolerance && (a.location - b.location).norm() <= tolerance &&
           std::abs(a.radius - b.radius) <= tolerance;
}

int equations(Form form) {
    switch (form) {
        case Form::plane:
            return 1;
        case Form::cylinder:
            return 3;
        case Form::sphere:
        case Form::developable:
            return 4;
        case Form::free:
            return free_form_equations;
    }
    return 0;
}

}  // namespace

int satisfied_equations(const PreparedModel& model, const std::vector<double>& distances, double tolerance,
                        double scale) {
    std::map<int, CoveredFace> faces;
    const auto& samples = model.features.samples;
    for (std::size_t i = 0; i < samples.size(); ++i)
        if (distances[i] <= tolerance) faces[samples[i].at.face].add(samples[i].curvature);

    const ShapeSize size = shape_size(model.features);
    const double own_tolerance = tolerance / scale;
    std::vector<Element> elements;
    int sum = 0;
    for (const auto& [number, face] : faces) {
        if (face.count < fewest_samples) continue;
        const Element element = element_of(face, size, elementary_departure * own_tolerance);
        const bool known = std::any_of(elements.begin(), elements.end(), [&](const Element& other) {
            return same(element, other, same_surface * own_tolerance);
        });
        if (known) continue;
        elements.push_back(element);
        sum += equations(element.form);
        if (sum >= free_form_equations) return free_form_equations;
    }
    return sum;
}

}  // namespace umbilic
