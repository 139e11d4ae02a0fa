// SPDX-License-Identifier: LGPL-2.1-or-later
#include <support/invariance.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include <support/mapped_trimming.h>
#include <support/reparametrisation.h>
#include <support/surfaces.h>
#include <umbilic/nurbs/area.h>

namespace umbilic::support {

namespace {

/// The face with another surface of the same shape or a part of it, untrimmed.
Face on_surface(const Face& face, NurbsSurface surface) {
    Face result = face;
    result.kind = SurfaceKind::bspline;
    result.elementary.reset();
    result.region = TrimmingRegion(surface.domain());
    result.surface = std::move(surface);
    return result;
}

/// Numbers the faces again and sums what the model sums over them.
void finish(Model& model) {
    model.area = 0.0;
    model.box = {};
    for (std::size_t i = 0; i < model.faces.size(); ++i) {
        model.faces[i].number = static_cast<int>(i) + 1;
        model.area += model.faces[i].area;
        model.box.add(model.faces[i].surface.pole_box());
    }
    model.declared_faces = static_cast<int>(model.faces.size());
    model.skipped.clear();
}

/// Numbers of the faces, in the model's order.
std::vector<int> numbers_of(const Model& model) {
    std::vector<int> result;
    for (const Face& face : model.faces) result.push_back(face.number);
    return result;
}

std::size_t index_of(const std::vector<int>& numbers, int number) {
    return static_cast<std::size_t>(std::find(numbers.begin(), numbers.end(), number) - numbers.begin());
}

ModelCopy moved(const Model& model, const SimilarityTransform& space) {
    ModelCopy copy{model, space};
    copy.normal_sign = space.mirrored ? -1.0 : 1.0;
    const double s = space.scale;
    for (Face& face : copy.model.faces) {
        face.surface = transformed(face.surface, space);
        face.reversed = face.reversed != space.mirrored;
        face.area *= s * s;
        face.conversion_error *= s;
        face.tolerance *= s;
        // The angle 0 of a mirrored cylinder runs backwards: its parameters are no longer those of its kind.
        if (space.mirrored && !(face.region.u_map().identity() && face.region.v_map().identity())) {
            const double area = face.area;
            const TrimmingRegion region = mapped(
                face.region, face.surface.domain(), [](const Vector2& at) { return at; }, false);
            face = on_surface(face, face.surface);
            face.region = region;
            face.area = area;
        }
        if (!face.elementary) continue;
        ElementarySurface& e = *face.elementary;
        e.location = space.apply(e.location);
        e.axis = space.apply_direction(e.axis);
        e.x_axis = space.apply_direction(e.x_axis);
        e.radius *= s;
        e.minor_radius *= s;
    }
    for (Solid& solid : copy.model.solids) {
        const Matrix3 turn = space.orthogonal();
        solid.volume *= s * s * s;
        solid.area *= s * s;
        solid.centroid = space.apply(solid.centroid);
        solid.inertia = std::pow(s, 5) * turn * solid.inertia * turn.transpose();
    }
    copy.model.volume *= s * s * s;
    finish(copy.model);
    const std::vector<int> numbers = numbers_of(model);
    copy.parameters = [numbers](const SurfacePoint& at) {
        return std::vector<SurfacePoint>{{static_cast<int>(index_of(numbers, at.face)) + 1, at.u, at.v}};
    };
    return copy;
}

ModelCopy reparametrised(const Model& model, const std::function<Reparametrised(const NurbsSurface&)>& make,
                         double normal_sign) {
    ModelCopy copy{model, {}};
    copy.normal_sign = normal_sign;
    std::vector<PointMap> maps;
    for (Face& face : copy.model.faces) {
        const Reparametrised other = make(face.surface);
        const double area = face.area;
        const TrimmingRegion region =
            mapped(face.region, other.surface.domain(), other.parameters, other.affine, other.bend);
        const ParameterBox domain = face.surface.domain();
        const Vector2 along_u =
            other.parameters({domain.u.high, domain.v.low}) - other.parameters({domain.u.low, domain.v.low});
        face = on_surface(face, other.surface);
        face.region = region;
        face.area = area;
        face.reversed = face.reversed != (normal_sign < 0);
        if (along_u.x() == 0.0) {
            std::swap(face.u_closed, face.v_closed);
            std::swap(face.u_periodic, face.v_periodic);
        }
        maps.push_back(other.parameters);
    }
    finish(copy.model);
    const std::vector<int> numbers = numbers_of(model);
    copy.parameters = [maps, numbers](const SurfacePoint& at) {
        const std::size_t index = index_of(numbers, at.face);
        const Vector2 image = maps[index]({at.u, at.v});
        return std::vector<SurfacePoint>{{static_cast<int>(index) + 1, image.x(), image.y()}};
    };
    return copy;
}

ParameterInterval share(const ParameterInterval& domain, double low, double high) {
    return {low == 0.0 ? domain.low : domain.low + low * domain.length(),
            high == 1.0 ? domain.high : domain.low + high * domain.length()};
}

TrimmingRegion rectangle(const ParameterBox& domain, const ParameterBox& box) {
    const Vector2 corner[4] = {
        {box.u.low, box.v.low}, {box.u.high, box.v.low}, {box.u.high, box.v.high}, {box.u.low, box.v.high}};
    TrimmingLoop loop;
    for (int k = 0; k < 4; ++k) loop.push_back({NurbsCurve2(KnotVector::bezier(1), {corner[k], corner[(k + 1) % 4]})});
    return TrimmingRegion(domain, {loop}, {}, {});
}

/// Copy of a model each of whose faces became the listed pieces: numbers in the copy and the part of the original's
/// parameters that each holds.
struct Piece {
    int face = 0;
    ParameterBox box;
};

std::function<std::vector<SurfacePoint>(const SurfacePoint&)> into_pieces(const Model& model,
                                                                          std::vector<std::vector<Piece>> pieces) {
    return [numbers = numbers_of(model), pieces = std::move(pieces)](const SurfacePoint& at) {
        std::vector<SurfacePoint> result;
        for (const Piece& piece : pieces[index_of(numbers, at.face)])
            if (piece.box.contains(at.u, at.v)) result.push_back({piece.face, at.u, at.v});
        return result;
    };
}

ModelCopy split_faces(const Model& model) {
    ModelCopy copy{model, {}};
    copy.model.faces.clear();
    std::vector<std::vector<Piece>> pieces(model.faces.size());
    for (std::size_t i = 0; i < model.faces.size(); ++i) {
        const Face& face = model.faces[i];
        const ParameterBox domain = face.surface.domain();
        if (!face.region.whole_domain()) {
            copy.model.faces.push_back(face);
            pieces[i].push_back({static_cast<int>(copy.model.faces.size()), domain});
            continue;
        }
        const double u[3] = {0.0, 0.4, 1.0}, v[3] = {0.0, 0.55, 1.0};
        for (int a = 0; a < 2; ++a)
            for (int b = 0; b < 2; ++b) {
                const ParameterBox box{share(domain.u, u[a], u[a + 1]), share(domain.v, v[b], v[b + 1])};
                Face piece = on_surface(face, restricted(face.surface, box));
                piece.area = surface_area(piece.surface);
                piece.u_closed = piece.v_closed = piece.u_periodic = piece.v_periodic = false;
                copy.model.faces.push_back(std::move(piece));
                pieces[i].push_back({static_cast<int>(copy.model.faces.size()), box});
            }
    }
    finish(copy.model);
    copy.parameters = into_pieces(model, std::move(pieces));
    return copy;
}

ModelCopy part_of(const Model& model) {
    ModelCopy copy{model, {}};
    copy.part = true;
    copy.model.faces.clear();
    copy.model.solids.clear();
    copy.model.volume = 0.0;
    std::vector<std::vector<Piece>> pieces(model.faces.size());
    const bool untrimmed = std::any_of(model.faces.begin(), model.faces.end(),
                                       [](const Face& face) { return face.region.whole_domain(); });
    for (std::size_t i = 0; i < model.faces.size(); ++i) {
        const Face& face = model.faces[i];
        if (untrimmed ? !face.region.whole_domain() : 2 * i > model.faces.size()) continue;
        const ParameterBox domain = face.surface.domain();
        ParameterBox box = domain;
        Face left = face;
        if (untrimmed) {
            box = {share(domain.u, 0.1, 0.85), share(domain.v, 0.05, 0.9)};
            left = on_surface(face, face.surface);
            left.region = rectangle(domain, box);
            left.area = surface_area(restricted(face.surface, box));
        }
        left.solid = -1;
        copy.model.faces.push_back(std::move(left));
        pieces[i].push_back({static_cast<int>(copy.model.faces.size()), box});
    }
    finish(copy.model);
    copy.parameters = into_pieces(model, std::move(pieces));
    return copy;
}

ModelCopy with_foreign(const Model& model, unsigned seed) {
    ModelCopy copy = moved(model, {});
    copy.foreign = true;
    SimilarityTransform beside;
    beside.scale = model.box.diagonal();
    beside.translation = model.box.high + 0.5 * (model.box.high - model.box.low);
    Model foreign = model_of({transformed(rough_bicubic(7, seed), beside)});
    copy.model.faces.push_back(std::move(foreign.faces[0]));
    finish(copy.model);
    return copy;
}

ModelCopy reapproximation(const Model& model, double relative_deviation) {
    ModelCopy copy{model, {}};
    for (Face& face : copy.model.faces) {
        Reapproximated other = reapproximated(face.surface, 5, relative_deviation * model.size());
        const TrimmingRegion region = mapped(
            face.region, face.surface.domain(), [](const Vector2& at) { return at; }, true);
        // The kernel's area of a trimmed face stays: it is as good as the deviation.
        const double area = face.region.whole_domain() ? surface_area(other.surface) : face.area;
        face = on_surface(face, std::move(other.surface));
        face.region = region;
        face.area = area;
        face.conversion_error += other.deviation;
        copy.deviation = std::max(copy.deviation, other.deviation);
    }
    finish(copy.model);
    copy.parameters = moved(model, {}).parameters;
    return copy;
}

}  // namespace

std::vector<Invariance> similarities(unsigned seed) {
    const auto by = [seed](double scale, bool mirrored) {
        return [=](const Model& model) {
            return moved(model, random_similarity(seed, scale, mirrored, 3 * scale * model.box.diagonal()));
        };
    };
    return {{"moved", by(1.0, false)},
            {"scaled_by_0_1", by(0.1, false)},
            {"scaled_by_25_4", by(25.4, false)},
            {"scaled_by_1000", by(1000.0, false)},
            {"mirrored", by(1.0, true)}};
}

std::vector<Invariance> reparametrisations(unsigned seed) {
    std::vector<Invariance> result;
    const auto add = [&](std::string name, double normal_sign,
                         std::function<Reparametrised(const NurbsSurface&)> make) {
        result.push_back({std::move(name), [make = std::move(make), normal_sign](const Model& model) {
                              return reparametrised(model, make, normal_sign);
                          }});
    };
    add("parameters_exchanged", -1, exchanged);
    add("u_reversed", -1, u_backwards);
    add("v_reversed", -1, v_backwards);
    add("u_degree_raised", 1, [](const NurbsSurface& s) { return elevated(s, 1, 0); });
    add("v_degree_raised", 1, [](const NurbsSurface& s) { return elevated(s, 0, 1); });
    add("degrees_raised", 1, [](const NurbsSurface& s) { return elevated(s, 1, 2); });
    add("knots_inserted", 1, [seed](const NurbsSurface& s) {
        std::mt19937 random(seed);
        std::vector<double> knots[2];
        const ParameterInterval domain[2] = {s.domain().u, s.domain().v};
        for (int k = 0; k < 2; ++k) {
            std::uniform_real_distribution<double> inside(domain[k].low, domain[k].high);
            for (int i = 0; i < 3; ++i) knots[k].push_back(inside(random));
            knots[k].push_back(knots[k][0]);
        }
        return with_knots(s, knots[0], knots[1]);
    });
    add("bezier_form", 1, in_bezier_form);
    add("moebius_in_u", 1, [](const NurbsSurface& s) { return moebius(s, 1.7, 1.0); });
    add("moebius_in_both", 1, [](const NurbsSurface& s) { return moebius(s, 0.6, 1.4); });
    add("made_rational", 1, [](const NurbsSurface& s) { return with_common_factor(s, 1.5, 0.7); });
    add("rejoined", 1, rejoined);
    result.push_back(elementary_as_nurbs());
    return result;
}

Invariance elementary_as_nurbs() {
    return {"elementary_as_nurbs", [](const Model& model) {
                const auto same = [](const NurbsSurface& surface) {
                    return Reparametrised{surface, [](const Vector2& at) { return at; }};
                };
                return reparametrised(model, same, 1);
            }};
}

Invariance split() {
    return {"split", split_faces};
}

Invariance trimmed_to_part() {
    return {"trimmed_to_part", part_of};
}

Invariance with_foreign_material(unsigned seed) {
    return {"foreign_material", [seed](const Model& model) { return with_foreign(model, seed); }};
}

Invariance reapproximated_within(double relative_deviation) {
    return {"reapproximated", [=](const Model& model) { return reapproximation(model, relative_deviation); }};
}

std::vector<Invariance> invariances(unsigned seed) {
    std::vector<Invariance> result = similarities(seed);
    for (Invariance& one : reparametrisations(seed)) result.push_back(std::move(one));
    result.push_back(split());
    result.push_back(trimmed_to_part());
    result.push_back(with_foreign_material(seed));
    return result;
}

}  // namespace umbilic::support
