// SPDX-License-Identifier: LGPL-2.1-or-later
#include <support/exchange.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include <support/surfaces.h>

namespace umbilic::support {
namespace {

/// Points at the share (s, t) of both domains, where the file may have exchanged or reversed the parameters.
Vector3 at_share(const NurbsSurface& surface, double s, double t) {
    const ParameterBox domain = surface.domain();
    return surface.value(domain.u.low + s * domain.u.length(), domain.v.low + t * domain.v.length());
}

void expect_same_face(const Face& before, const Face& after, double deviation) {
    EXPECT_EQ(before.region.whole_domain(), after.region.whole_domain());
    const std::function<Vector2(double, double)> maps[] = {
        [](double s, double t) { return Vector2(s, t); }, [](double s, double t) { return Vector2(t, s); },
        [](double s, double t) { return Vector2(1 - s, t); }, [](double s, double t) { return Vector2(s, 1 - t); }};
    const double signs[] = {1, -1, -1, -1};
    int fitting = 0;
    for (int k = 0; k < 4; ++k) {
        double worst = 0.0;
        bool same_containment = true;
        for (const double s : {0.05, 0.3, 0.62, 0.97})
            for (const double t : {0.0, 0.45, 0.8}) {
                const Vector2 image = maps[k](s, t);
                worst = std::max(
                    worst, (at_share(before.surface, s, t) - at_share(after.surface, image.x(), image.y())).norm());
                const auto classify = [](const Face& face, double x, double y, double radius) {
                    const ParameterBox domain = face.surface.domain();
                    return face.region.classify(domain.u.low + x * domain.u.length(),
                                                domain.v.low + y * domain.v.length(), radius);
                };
                same_containment =
                    same_containment && (classify(before, s, t, 1e-3) == Containment::boundary ||
                                         classify(before, s, t, 0.0) == classify(after, image.x(), image.y(), 0.0));
            }
        if (worst > deviation) continue;
        ++fitting;
        EXPECT_TRUE(same_containment);
        EXPECT_EQ(before.reversed == after.reversed, signs[k] > 0);
    }
    EXPECT_EQ(fitting, 1);
}

TEST(Exchange, FacesComeBackInOrderWithTheirPointsAndLoops) {
    Model model = model_of({rough_bicubic(6, 1), random_surface(3, 2, 5, 6, 2, 0.3, 4.0), torus_quarter(3, 1)});
    model.faces[0].region = TrimmingRegion(model.faces[0].surface.domain(),
                                           {{{NurbsCurve2(KnotVector::bezier(2), {{0.2, 0.2}, {0.9, 0.1}, {0.7, 0.9}})},
                                             {NurbsCurve2(KnotVector::bezier(1), {{0.7, 0.9}, {0.2, 0.2}})}}},
                                           {}, {});
    model.faces[1].reversed = true;
    for (const Invariance& exchange : exchanges()) {
        SCOPED_TRACE(exchange.name);
        const ModelCopy copy = exchange.copy(model);
        EXPECT_FALSE(copy.parameters);
        ASSERT_EQ(copy.model.faces.size(), model.faces.size());
        for (std::size_t i = 0; i < model.faces.size(); ++i) {
            expect_same_face(model.faces[i], copy.model.faces[i], copy.deviation);
        }
    }
}

}  // namespace
}  // namespace umbilic::support
