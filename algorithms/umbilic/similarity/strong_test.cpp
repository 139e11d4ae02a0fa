// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/similarity/strong_test.h>

#include <algorithm>
#include <tuple>

#include <umbilic/similarity/foot_curvature.h>

namespace umbilic {

namespace {

/// An isolated generic umbilic of one model, seen from the other one.
struct Candidate {
    int index = 0;
    const Umbilic* umbilic = nullptr;
    Vector3 point = Vector3::Zero();  ///< in the original's frame
    bool expected = false;            ///< should have a partner
    bool paired = false;
};

/// `radius` in the model's own unit.
bool near_edge_or_knot_line(const Face& face, double u, double v, double radius) {
    if (near_knot_line(face.surface, u, v, radius, cubic_form_continuity)) return true;
    const ParameterBox domain = face.surface.domain();
    const SurfaceDerivatives d = face.surface.derivatives(u, v, 1);
    const double relative_u = radius / (d.r_u().norm() * domain.u.length());
    const double relative_v = radius / (d.r_v().norm() * domain.v.length());
    return face.region.classify(u, v, std::max(relative_u, relative_v)) != Containment::inside;
}

bool expects_partner(const Umbilic& umbilic, const PlacedModel& model, const PlacedModel& other, const Vector3& point,
                     MatchScope scope, double distance, double umbilic_distance) {
    if (!umbilic.certified) return false;
    if (near_edge_or_knot_line(model.prepared.model.face(umbilic.at.face), umbilic.at.u, umbilic.at.v,
                               umbilic_distance / model.original_model.scale))
        return false;
    const auto foot = other.prepared.tree.closest(other.original_model.inverse().apply(point));
    if (!foot) return false;
    const double scale = other.original_model.scale;
    if (foot->distance * scale > distance) return scope == MatchScope::global;
    return foot->kind == FootKind::interior &&
           !near_edge_or_knot_line(other.prepared.model.face(foot->at.face), foot->at.u, foot->at.v,
                                   umbilic_distance / scale);
}

std::vector<Candidate> candidates(const PlacedModel& model, const PlacedModel& other, MatchScope scope, double distance,
                                  double umbilic_distance) {
    std::vector<Candidate> result;
    const std::vector<const Umbilic*> inside = umbilics_inside(model.prepared.features.umbilics);
    for (std::size_t i = 0; i < inside.size(); ++i) {
        if (inside[i]->kind.type == UmbilicType::non_generic) continue;
        const Vector3 point = model.original_model.apply(inside[i]->point);
        result.push_back({static_cast<int>(i), inside[i], point,
                          expects_partner(*inside[i], model, other, point, scope, distance, umbilic_distance)});
    }
    return result;
}

bool types_agree(const Umbilic& a, const Umbilic& b) {
    if (a.kind.type == b.kind.type) return true;
    // A type that both may have.
    for (const GenericType one : classify(a.cubic, type_margin).possible_types())
        for (const GenericType other : classify(b.cubic, type_margin).possible_types())
            if (type_of(one) == type_of(other)) return true;
    return false;
}

std::string in_words(int count, const char* noun) {
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace

std::vector<const Umbilic*> umbilics_inside(std::span<const FaceUmbilics> faces) {
    std::vector<const Umbilic*> result;
    for (const FaceUmbilics& face : faces)
        for (const Umbilic& umbilic : face.umbilics)
            if (umbilic.containment == Containment::inside) result.push_back(&umbilic);
    return result;
}

StrongTest strong_test(const PlacedModel& original, const PlacedModel& suspect, MatchScope scope, double distance,
                       double umbilic_distance) {
    std::vector<Candidate> on_original = candidates(original, suspect, scope, distance, umbilic_distance);
    std::vector<Candidate> on_suspect = candidates(suspect, original, scope, distance, umbilic_distance);

    std::vector<std::tuple<double, Candidate*, Candidate*>> near;
    for (Candidate& a : on_original)
        for (Candidate& b : on_suspect)
            if (const double d = (a.point - b.point).norm();
                d <= umbilic_distance && types_agree(*a.umbilic, *b.umbilic))
                near.emplace_back(d, &a, &b);
    // Nearest first; equal distances in the order of the lists.
    std::ranges::sort(near, [](const auto& x, const auto& y) {
        return std::tuple(std::get<0>(x), std::get<1>(x)->index, std::get<2>(x)->index) <
               std::tuple(std::get<0>(y), std::get<1>(y)->index, std::get<2>(y)->index);
    });

    StrongTest result;
    for (auto& [d, a, b] : near) {
        if (a->paired || b->paired) continue;
        a->paired = b->paired = true;
        result.pairs.push_back({a->index, b->index, a->umbilic->kind.type, d});
    }
    std::ranges::sort(result.pairs, {}, &UmbilicPair::original);
    for (const Candidate& a : on_original)
        if (a.expected && !a.paired) result.unmatched_original.push_back(a.index);
    for (const Candidate& b : on_suspect)
        if (b.expected && !b.paired) result.unmatched_suspect.push_back(b.index);

    const int unmatched = static_cast<int>(result.unmatched_original.size() + result.unmatched_suspect.size());
    if (unmatched > 0) {
        result.passed = false;
        result.why = in_words(unmatched, "isolated generic umbilic") + " without a partner";
    } else if (!result.pairs.empty()) {
        result.passed = true;
        result.why = in_words(static_cast<int>(result.pairs.size()), "pair") + " of umbilics of the same type coincide";
    } else {
        result.why = on_original.empty() && on_suspect.empty()
                         ? "neither model has an isolated generic umbilic"
                         : "no isolated generic umbilic lies in the overlap, away from edges and knot lines";
    }
    return result;
}

}  // namespace umbilic
