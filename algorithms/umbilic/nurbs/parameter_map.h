// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

namespace umbilic {

/// Monotone map between the parameter a file gives a surface (the "native" one: an angle for a cylinder) and the
/// parameter of the NURBS surface that stands for it here. For B-spline faces it is the identity.
///
/// The angular map belongs to the exact rational quadratic form of a circle: on the span [a, b] of angles, with t = (u
/// - a) / (b - a), the angle is a + 2 atan2(t sin(d/2), (1 - t) + t cos(d/2)), d = b - a < pi.
class ParameterMap {
public:
    /// The identity.
    ParameterMap() = default;
    /// Angular map with the given increasing span ends (radians), each span shorter than pi. Throws InvalidInput
    /// otherwise.
    static ParameterMap angular(std::vector<double> breaks);

    bool identity() const { return breaks_.empty(); }
    /// Span ends of an angular map; empty for the identity.
    const std::vector<double>& breaks() const { return breaks_; }
    /// Native parameter of the surface parameter; both agree at the breaks. Values outside continue the outer spans
    /// linearly.
    double native(double surface_parameter) const;
    /// Surface parameter of the native parameter.
    double surface(double native_parameter) const;

private:
    std::vector<double> breaks_;
};

}  // namespace umbilic
