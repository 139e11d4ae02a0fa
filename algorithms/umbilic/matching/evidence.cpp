// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/evidence.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include <umbilic/differential/elementary_fit.h>
#include <umbilic/matching/pose_distance.h>

namespace umbilic {

namespace {

/// Fewer covered samples than these tell nothing about a face's form.
constexpr std::size_t fewest_samples = 3;

/// Two elementary surfaces are the same if they differ by less than this many tolerances.
constexpr double same_surface = 10.0;

/// Conditions of a developable surface that is neither cylinder nor cone.
constexpr int developable_equations = 4;

enum class Form { plane, cylinder, cone, sphere, torus, developable, free };

/// An elementary surface in the model's coordinates relative to its centroid, mm.
struct Element {
    Form form = Form::free;
    Vector3 direction = Vector3::Zero();  ///< unit, sign without meaning
    /// Foot of the centroid on a plane, foot on the axis of a cylinder, apex of a cone, centre of a sphere or torus.
    Vector3 location = Vector3::Zero();
    std::array<double, 2> radii = {0.0, 0.0};

    bool has_axis() const { return form == Form::cylinder || form == Form::cone || form == Form::torus; }
};

struct CoveredFace {
    std::vector<Vector3> points;
    BoundingBox box;
    double largest_max = 0.0, smallest_max = 0.0, largest_min = 0.0, smallest_min = 0.0;
    Curvature first;

    void add(const Curvature& c) {
        if (points.empty()) {
            first = c;
            largest_max = smallest_max = c.kappa_max;
            largest_min = smallest_min = c.kappa_min;
        }
        points.push_back(c.point);
        box.add(c.point);
        largest_max = std::max(largest_max, c.kappa_max);
        smallest_max = std::min(smallest_max, c.kappa_max);
        largest_min = std::max(largest_min, c.kappa_min);
        smallest_min = std::min(smallest_min, c.kappa_min);
    }
};

/// The plane on which the points lie to within `departure`, mm.
std::optional<Element> plane_of(const std::vector<Vector3>& points, const ShapeSize& size, double departure) {
    const std::optional<ElementarySurface> plane = plane_through(points);
    const auto on_plane = [&](const Vector3& point) {
        return std::abs(plane->axis.dot(point - plane->location)) <= departure;
    };
    if (!plane || !std::all_of(points.begin(), points.end(), on_plane)) return std::nullopt;
    return Element{.form = Form::plane,
                   .direction = plane->axis,
                   .location = plane->axis.dot(plane->location - size.centroid) * plane->axis};
}

Element element_of(const CoveredFace& face, const AnalyticFeature* feature, const ShapeSize& size, double departure) {
    if (const std::optional<Element> plane = plane_of(face.points, size, departure)) return *plane;
    // A curvature of kappa over a width d lifts a surface by kappa d^2 / 8.
    const double width = face.box.diagonal();
    const auto negligible = [&](double kappa) { return std::abs(kappa) * width * width / 8.0 <= departure; };
    const bool max_zero = negligible(face.largest_max) && negligible(face.smallest_max);
    const bool min_zero = negligible(face.largest_min) && negligible(face.smallest_min);
    const bool max_constant = negligible(face.largest_max - face.smallest_max);
    const bool min_constant = negligible(face.largest_min - face.smallest_min);

    const Curvature& c = face.first;
    Element element;
    if ((max_zero && min_constant) || (min_zero && max_constant)) {
        const double kappa = min_zero ? c.kappa_max : c.kappa_min;
        const Vector3 axis = min_zero ? c.direction_min : c.direction_max;
        const Vector3 centre = c.point - c.normal / kappa - size.centroid;
        element = {Form::cylinder, axis, centre - axis.dot(centre) * axis, {std::abs(1.0 / kappa), 0.0}};
    } else if (max_constant && min_constant && negligible(c.kappa_max - c.kappa_min)) {
        element = {Form::sphere,
                   Vector3::Zero(),
                   c.point - c.normal / c.mean() - size.centroid,
                   {std::abs(1.0 / c.mean()), 0.0}};
    } else if (feature && (feature->kind == SurfaceKind::cone || feature->kind == SurfaceKind::torus)) {
        element = {feature->kind == SurfaceKind::cone ? Form::cone : Form::torus,
                   feature->direction,
                   feature->point - size.centroid,
                   {feature->radius, feature->minor_radius}};
    } else if (max_zero || min_zero) {
        element.form = Form::developable;
    }
    return element;
}

/// Sets of elementary surfaces, with what conventions of design make equal counted once.
class Conditions {
public:
    Conditions(double length, double tolerance) : length_(length), tolerance_(tolerance) {}

    void add(const Element& element) {
        if (element.form == Form::developable || element.form == Form::free) {
            if (element.form == Form::free)
                count_ += free_form_equations;
            else if (!developable_)
                count_ += developable_equations;
            developable_ = developable_ || element.form == Form::developable;
            any_direction_ = true;
            return;
        }
        const auto same = [&](const Element& other) {
            return element.form == other.form && parallel(element, other) &&
                   (element.location - other.location).norm() <= tolerance_ &&
                   std::abs(element.radii[0] - other.radii[0]) <= tolerance_ &&
                   std::abs(element.radii[1] - other.radii[1]) <= tolerance_;
        };
        if (std::any_of(elements_.begin(), elements_.end(), same)) return;
        if (element.form == Form::plane || element.form == Form::cone || element.form == Form::torus) ++count_;
        if (element.form == Form::sphere) count_ += 3;
        const auto in_line = [&](const Element& other) {
            const Vector3 apart = element.location - other.location;
            return other.has_axis() && parallel(element, other) &&
                   (apart - apart.dot(element.direction) * element.direction).norm() <= tolerance_;
        };
        if (element.has_axis() && std::none_of(elements_.begin(), elements_.end(), in_line)) count_ += 2;
        for (const double radius : element.radii) {
            const auto equal = [&](double other) { return std::abs(radius - other) <= tolerance_; };
            if (radius == 0.0 || std::any_of(radii_.begin(), radii_.end(), equal)) continue;
            radii_.push_back(radius);
            ++count_;
        }
        elements_.push_back(element);
    }

    int count() const { return count_ - (any_direction_ ? 0 : free_turns()); }

private:
    bool parallel(const Element& a, const Element& b) const {
        return length_ * std::min((a.direction - b.direction).norm(), (a.direction + b.direction).norm()) <= tolerance_;
    }

    int free_turns() const {
        const auto directed = [](const Element& element) { return element.form != Form::sphere; };
        const auto first = std::find_if(elements_.begin(), elements_.end(), directed);
        if (first == elements_.end()) return 3;
        const auto across = [&](const Element& other) { return directed(other) && !parallel(*first, other); };
        return std::any_of(first, elements_.end(), across) ? 0 : 1;
    }

    double length_, tolerance_;  ///< mm
    int count_ = 0;
    bool developable_ = false;
    bool any_direction_ = false;
    std::vector<Element> elements_;
    std::vector<double> radii_;
};

/// True if at least half of a covered sample's neighbours are covered too: there the surfaces lie on each other. Where
/// they only cross, a narrow band is within the tolerance.
bool amid_covered(const std::vector<int>& neighbours, const std::vector<bool>& covered) {
    return 2 * std::count_if(neighbours.begin(), neighbours.end(), [&](int i) { return covered[i]; }) >=
           static_cast<std::ptrdiff_t>(neighbours.size());
}

}  // namespace

int satisfied_equations(const PreparedModel& model, const std::vector<double>& distances, double tolerance,
                        double scale) {
    std::vector<bool> covered;
    for (const double distance : distances) covered.push_back(distance <= tolerance);
    std::map<int, CoveredFace> faces;
    const auto& samples = model.features.samples;
    for (std::size_t i = 0; i < samples.size(); ++i)
        if (covered[i] && amid_covered(model.features.neighbours[i], covered))
            faces[samples[i].at.face].add(samples[i].curvature);

    std::map<int, const AnalyticFeature*> features;
    for (const AnalyticFeature& feature : model.features.analytic)
        for (const int number : feature.faces) features[number] = &feature;

    const ShapeSize size = shape_size(model.features);
    const double own_tolerance = tolerance / scale;
    Conditions conditions(size.length, same_surface * own_tolerance);
    for (const auto& [number, face] : faces) {
        if (face.points.size() < fewest_samples) continue;
        const auto feature = features.find(number);
        conditions.add(element_of(face, feature == features.end() ? nullptr : feature->second, size,
                                  elementary_departure * own_tolerance));
        if (conditions.count() >= free_form_equations) return free_form_equations;
    }
    return std::max(conditions.count(), 0);
}

}  // namespace umbilic
