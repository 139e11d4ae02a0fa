// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include <umbilic/curves/line_tracer.h>

namespace umbilic {

/// A place on a line of a net.
struct NetSample {
    double s = 0.0;  ///< signed arc length from the line's seed
    Vector2 parameters;
    Vector3 point, tangent, normal;
};

/// A place where a line shall start.
struct NetSeed {
    double distance = 0.0;  ///< from the start of the net, along lines, mm
    Vector2 parameters = Vector2::Zero();
    CurvatureFamily family = CurvatureFamily::maximum;
    std::optional<Vector3> one_way;
    int line = -1;  ///< that it shall cross, at the arc length s
    double s = 0.0;
};

/// A line of a net.
struct NetLine {
    CurvatureFamily family = CurvatureFamily::maximum;
    TracedLine ahead, behind;
    bool closed = false;
    double low = 0.0, high = 0.0;     ///< arc lengths of its ends
    double distance = 0.0;            ///< of its seed from the start, along lines
    std::vector<NetSample> samples;   ///< increasing s
    std::map<double, int> crossings;  ///< node by arc length
    std::vector<double> refused;      ///< arc lengths at which a line was tried
    bool opened = false;              ///< was closed and has been cut
    std::vector<NetSeed> seeds;       ///< where lines that cross it are missing
    bool changed = true;              ///< since `seeds` were found
    double overlap = 0.0;             ///< mm: a closed line is followed so far beyond its ends

    /// Parameters at the signed arc length s; a little beyond its ends the line goes straight on.
    Vector2 at(double s) const {
        const auto [step, x, over] = locate(s);
        return step->at(x) + over * step->rate(x);
    }
    /// Their derivative by s.
    Vector2 rate(double s) const {
        const auto [step, x, over] = locate(s);
        return (on_ahead(s) ? 1.0 : -1.0) * step->rate(x);
    }

private:
    bool on_ahead(double s) const { return closed || opened || s >= 0.0 || behind.steps.empty(); }

    /// The step that holds s, the fraction of it, and the arc length beyond its end, along the part's own direction.
    std::tuple<const TracedStep*, double, double> locate(double s) const {
        const TracedLine& part = on_ahead(s) ? ahead : behind;
        double t = on_ahead(s) ? s : -s;
        // The ends of a closed line meet only within the accuracy of its steps: about its seed it goes on from there.
        const bool about_seed = t > -overlap && t < part.length + overlap;
        if ((closed || opened) && !about_seed) t -= part.length * std::floor(t / part.length);
        const TracedStep& step = part.steps[part.step_at(t)];
        const double x = std::clamp((t - step.s) / step.length, 0.0, 1.0);
        return {&step, x, t - step.s - x * step.length};
    }
};

}  // namespace umbilic
