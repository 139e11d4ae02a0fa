// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/json_curves.h>

#include <utility>

#include <report/json_geometry.h>

namespace umbilic {

namespace {

Json points_json(const Model& model, const SurfaceCurve& curve) {
    Json points = Json::array();
    int number = 0;
    const Face* face = nullptr;
    for (const SurfaceCurvePoint& p : curve.points) {
        if (!face || p.at.face != number) {
            number = p.at.face;
            face = &model.face(number);
        }
        const Vector2 native = native_parameters(*face, p.at.u, p.at.v);
        points.push_back({{"s", number_json(p.s)},
                          {"face", p.at.face},
                          {"u", number_json(native.x())},
                          {"v", number_json(native.y())},
                          {"point", vector_json(p.point)}});
    }
    return points;
}

Json curve_json(const Model& model, const SurfaceCurve& curve) {
    return {{"closed", curve.closed},
            {"started", name(curve.started)},
            {"ended", name(curve.ended)},
            {"length", number_json(curve.length)},
            {"error", number_json(curve.error)},
            {"points", points_json(model, curve)}};
}

}  // namespace

Json curves_json(const CurveResult& result) {
    Json curves = Json::array();
    for (const NamedCurve& named : result.curves) {
        Json one = {{"family", named.family.empty() ? Json(nullptr) : Json(named.family)}};
        one.update(curve_json(*result.model, named.curve));
        if (result.kind == "project") {
            one["left_target"] = named.left_target;
            one["original"] = named.original ? curve_json(*result.original_model, *named.original) : Json(nullptr);
        }
        curves.push_back(std::move(one));
    }
    Json json = {{"schema", "umbilic.curve/1"}, {"kind", result.kind}, {"input", input_json(*result.model)}};
    if (result.original_model) json["original_input"] = input_json(*result.original_model);
    json["curves"] = std::move(curves);
    if (!result.why.empty()) json["why"] = result.why;
    return json;
}

std::string end_text(CurveEnd end) {
    switch (end) {
        case CurveEnd::length:
            return "the length asked for";
        case CurveEnd::boundary:
            return "the border of the surface";
        case CurveEnd::trim:
            return "a trimming loop";
        case CurveEnd::umbilic:
            return "an umbilic";
        case CurveEnd::closed:
            return "its start: it is closed";
        case CurveEnd::evolute:
            return "a centre of curvature of the target";
        case CurveEnd::point:
            return "the point given";
    }
    return "";
}

}  // namespace umbilic
